"""How a face is looked at: camera, shading, heat."""
