"""Positions of a face on every frame of a drag."""

from facepin.core.arrays import Floats, Points
from facepin.core.rig import Rig


class Deformer:
    """Evaluates f0 + B w for weights that change a little from call to call: one per pane."""

    def __init__(self, rig: Rig) -> None:
        self._rig = rig

    def deform(self, weights: Floats) -> Points:
        """Posed positions, (n, 3) float32: a new read-only array on every call."""
        positions = self._rig.evaluate(weights)
        positions.flags.writeable = False
        return positions
