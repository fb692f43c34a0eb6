"""A frame as numpy is plainly asked for it: what the drag path is measured against."""

import numpy as np

from facepin.core.arrays import Floats, Points
from facepin.core.rig import Rig

MOST_BYTES = 2**30
"""Memory that B may take when its zeros are written out."""


class PlainFrame:
    """Positions as one dense product with B, and unit normals from all triangles, of any pose."""

    def __init__(self, rig: Rig) -> None:
        self._rig = rig
        self._deltas: Points = np.ascontiguousarray(rig.deltas.toarray())

    @staticmethod
    def fits(rig: Rig) -> bool:
        """Say whether there should be memory for it."""
        rows, columns = rig.deltas.shape
        return bool(4 * rows * columns <= MOST_BYTES)

    def compute(self, weights: Floats) -> tuple[Points, Floats]:
        """Return positions (n, 3) float32 and normals (n, 3) float64 for weights (k,)."""
        rig = self._rig
        moved = self._deltas @ rig.amounts(weights).astype(np.float32)
        positions: Points = rig.neutral + moved.reshape(-1, 3)
        a, b, c = (positions[corner] for corner in rig.triangles.T)
        areas = np.cross(b - a, c - a)
        corners = rig.triangles.ravel()
        sums = [np.bincount(corners, np.repeat(area, 3), rig.vertex_count) for area in areas.T]
        normals = np.stack(sums, axis=1)
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        return positions, normals / np.maximum(lengths, np.finfo(np.float64).tiny)
