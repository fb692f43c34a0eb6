"""The hand: gestures that turn input into edits."""
