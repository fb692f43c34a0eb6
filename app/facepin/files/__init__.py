"""Rigs, models, poses and pins as files: `open_rig`, `write_model`; modules `pose_file` and `pins_file`."""

from facepin.files.formats import READERS, WRITERS, open_rig, write_model

__all__ = ["READERS", "WRITERS", "open_rig", "write_model"]
