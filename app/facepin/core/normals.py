"""Smooth vertex normals of a face that moves."""

import numpy as np
from scipy.sparse import csr_array

from facepin.core.arrays import Points
from facepin.core.rig import Rig


class NormalField:
    """Vertex normals, not normalised (the shader does that): one per pane."""

    def __init__(self, rig: Rig) -> None:
        self._triangles = rig.triangles
        t, n = len(rig.triangles), rig.vertex_count
        ones = np.ones(3 * t, np.float32)
        at = (rig.triangles.T.ravel(), np.tile(np.arange(t, dtype=np.int32), 3))
        self._sum = csr_array((ones, at), shape=(n, t))

    def normals(self, positions: Points) -> Points:
        """Normals (n, 3) float32 of posed positions (n, 3), of any length: a new read-only array per call."""
        a, b, c = (positions[corner] for corner in self._triangles.T)
        normals = np.asarray(self._sum @ np.cross(b - a, c - a), np.float32)
        normals.flags.writeable = False
        return normals
