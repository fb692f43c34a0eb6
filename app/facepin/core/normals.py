"""Smooth vertex normals of a face that moves."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from facepin.core.arrays import Points
from facepin.core.cells import Cells, Numbers, area_vectors, make_cells
from facepin.core.rig import Rig

WHOLE = 0.25
"""Share of moved cells above which all are computed, for picking out costs as much."""
NOWHERE = np.float32(1e-6)
"""Added to z (normals have lengths of about 2π), so that those of collapsed cells can be normalised too."""

Mask = NDArray[np.bool_]


class NormalField:
    """Vertex normals of posed positions, frame after frame; one per pane.

    A normal is the sum over the cells (quads and triangles) round a vertex of their area vectors, times
    constants chosen so that in the neutral it is the angle-weighted normal (Thürmer and Wüthrich 1998), which
    hardly depends on how a surface is cut into cells; later it costs what the area-weighted normal costs.
    Vertices that a texture seam has split get the normal of the whole.

    Only cells with a corner that moved are computed again.
    """

    def __init__(self, rig: Rig, cells: Cells | None = None) -> None:
        self._rig = rig
        self._cells = cells or make_cells(rig)
        self._areas = np.zeros((3, self._cells.diagonals.shape[2]), np.float32)
        self._normals: Points = np.zeros_like(rig.neutral)
        self._watched: Mask = np.ones(rig.vertex_count, np.bool_)
        self._watch(np.ones(rig.neutral.shape, np.bool_))
        self._compute(rig.neutral)

    def twin(self) -> "NormalField":
        """Return a field for another pane of the same rig, without making its tables again."""
        return NormalField(self._rig, self._cells)

    def normals(self, positions: Points) -> Points:
        """Normals of posed positions (n, 3).

        Returns
        -------
        (n, 3) float32
            Read-only, finite, of any length but zero: shaders normalise.  A new array on every call, except
            that the positions array of the call before returns the same normals.
        """
        if positions is not self._positions:
            moved = positions != self._positions
            if (moved & self._still).any() or 2 * np.count_nonzero(moved) < self._usual:
                self._watch(moved)
            self._compute(positions)
        return self._normals

    def _watch(self, moved: Mask) -> None:
        """From now on compute what depends on the vertices whose coordinates `moved` (n, 3) marks.

        Those watched so far stay if most of them still move, so that a growing drag settles soon.
        """
        vertices = moved[:, 0] | moved[:, 1] | moved[:, 2]
        if 2 * np.count_nonzero(self._watched & vertices) > np.count_nonzero(self._watched):
            vertices |= self._watched
        self._watched = vertices
        self._still = np.repeat(~vertices[:, None], 3, axis=1)
        self._usual = int(np.count_nonzero(moved))
        self._patch = _around(self._cells, vertices)

    def _compute(self, positions: Points) -> None:
        patch = self._patch
        areas = area_vectors(np.ascontiguousarray(positions.T), patch.diagonals)
        normals = self._normals.copy()
        for axis in range(3):
            self._areas[axis, patch.cells] = areas[axis]
            normals[patch.rows, axis] = patch.sums @ self._areas[axis]
        normals[patch.rows, 2] += NOWHERE
        normals.flags.writeable = False
        self._positions, self._normals = positions, normals


@dataclass(frozen=True, eq=False)
class _Patch:
    """What has to be computed when some vertices move."""

    cells: Numbers | slice
    diagonals: Numbers
    """Of these cells; see `Cells`."""
    rows: Numbers | slice
    """Vertices whose normals depend on the cells."""
    sums: csr_array
    """Turns area vectors of all cells into normals of the rows."""


def _around(cells: Cells, moved: Mask) -> _Patch:
    """Return what depends on the vertices that `moved` (n,) marks."""
    touched: Mask = np.logical_or.reduce(moved[cells.diagonals], axis=(0, 1))
    if np.count_nonzero(touched) > WHOLE * len(touched):
        return _Patch(slice(None), cells.diagonals, slice(None), cells.sums)
    chosen = np.flatnonzero(touched)
    reached: Points = np.asarray(cells.sums @ touched.astype(np.float32))
    rows = np.flatnonzero(reached)
    return _Patch(chosen, cells.diagonals[:, :, chosen], rows, cells.sums[rows])
