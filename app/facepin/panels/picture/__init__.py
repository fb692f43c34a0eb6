"""What floats over the face."""
