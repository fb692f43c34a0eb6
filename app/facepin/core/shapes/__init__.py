"""What the shapes of a rig do: deformation, motion, regions, sides, places."""
