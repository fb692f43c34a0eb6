"""Rigs, models, poses and pins as files.  The doors are `open_rig`, `write_model` and `pose_file`."""

from facepin.files.formats import READERS, open_rig

__all__ = ["READERS", "open_rig"]
