"""What Facepin itself keeps: scenes, poses, pins, library, drafts, preferences."""
