"""Facepin: pose a blendshape face by pinning points on it and dragging them."""

__version__ = "0.1.0"
