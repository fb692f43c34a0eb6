"""The pose library."""
