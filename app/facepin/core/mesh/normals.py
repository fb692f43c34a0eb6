"""Smooth vertex normals of a face that moves."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from facepin.core.arrays import Points
from facepin.core.mesh.area_vectors import AreaVectors, Numbers
from facepin.core.mesh.cells import Cells, make_cells
from facepin.core.rig import Rig

WHOLE = 0.5
"""Share of moved cells above which those round all vertices that any shape moves are computed."""
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

    def __init__(self, rig: Rig, tables: "_Tables | None" = None) -> None:
        self._rig = rig
        self._tables = tables or _make_tables(rig)
        self._normals: Points = np.zeros_like(rig.neutral)
        self._look_at(self._tables.whole, rig.neutral)
        self._compute(rig.neutral)
        self._look_at(self._tables.movable, rig.neutral)
        self._usual = rig.neutral.size

    def twin(self) -> "NormalField":
        """Return a field for another pane of the same rig, without making its tables again."""
        return NormalField(self._rig, self._tables)

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
            if np.count_nonzero(moved & self._still) or 2 * np.count_nonzero(moved) < self._usual:
                self._watch(moved, positions)
            self._compute(positions)
        return self._normals

    def _watch(self, moved: Mask, positions: Points) -> None:
        """From now on compute what depends on the vertices whose coordinates `moved` (n, 3) marks.

        Those watched so far stay if most of them still move, so that a growing drag settles soon.
        """
        vertices, watched = moved[:, 0] | moved[:, 1] | moved[:, 2], self._patch.vertices
        if 2 * np.count_nonzero(watched & vertices) > np.count_nonzero(watched):
            vertices |= watched
        self._look_at(self._tables.patch(vertices), positions)
        self._usual = int(np.count_nonzero(moved))

    def _look_at(self, patch: "_Patch", positions: Points) -> None:
        self._patch = patch
        self._still: Mask = np.repeat(~patch.vertices[:, None], 3, axis=1)
        # What does not move stays as it is here: area vectors, and where all is computed, normals too.
        count = len(positions)
        values = AreaVectors(count, patch.diagonals).of(positions)
        self._areas = AreaVectors(count, patch.diagonals[:, :, : patch.moving], values[: patch.moving])
        self._flat_areas = values.reshape(-1)
        ground = np.array(self._normals)
        ground[patch.changing] = (0, 0, NOWHERE)
        self._ground = (ground if patch.coordinates is None else ground[patch.changing]).ravel()

    def _compute(self, positions: Points) -> None:
        self._areas.of(positions)
        sums: Points = self._patch.sums @ self._flat_areas
        sums += self._ground
        if self._patch.coordinates is None:
            normals = sums
        else:
            normals = self._normals.flatten()
            normals[self._patch.coordinates] = sums
        normals.flags.writeable = False
        self._positions, self._normals = positions, normals.reshape(-1, 3)


@dataclass(frozen=True, eq=False)
class _Patch:
    """What has to be computed when some vertices move."""

    vertices: Mask
    """(n,) those that may move."""
    diagonals: Numbers
    """Of the cells round all vertices whose normals change, those that move first; see `Cells`."""
    moving: int
    """How many of them do."""
    changing: Numbers
    """(r,) vertices whose normals change."""
    coordinates: Numbers | None
    """Their places in flattened normals, x, y, z of one after the other; None: taken as all there are."""
    sums: csr_array
    """Turns area vectors of the cells, flattened, into these coordinates; of vertices that are not `changing`
    it makes nothing."""


@dataclass(frozen=True, eq=False)
class _Tables:
    """What all fields of a rig share."""

    cells: Cells
    whole: _Patch
    movable: _Patch
    """For whatever shapes can move."""

    def patch(self, vertices: Mask) -> _Patch:
        """Return what to compute when the vertices (n,) move, or more than they."""
        touched = _touched(self.cells, vertices)
        if np.count_nonzero(touched) <= WHOLE * len(touched):
            return _around(self.cells, vertices, touched)
        return self.whole if (vertices & ~self.movable.vertices).any() else self.movable


def _make_tables(rig: Rig) -> _Tables:
    cells = make_cells(rig)
    everything = np.arange(rig.vertex_count)
    all_of_them = np.ones(rig.vertex_count, np.bool_)
    whole = _Patch(all_of_them, cells.diagonals, cells.diagonals.shape[2], everything, None, cells.sums)
    # Moves that should happen to cancel each other only make the patch smaller than it might be.
    moved = rig.evaluate(np.ones(rig.shape_count)) != rig.neutral
    movable: Mask = moved[:, 0] | moved[:, 1] | moved[:, 2]
    patch = _around(cells, movable, _touched(cells, movable))
    uses = np.zeros(cells.sums.shape[0], np.int32)
    uses[patch.coordinates] = np.diff(patch.sums.indptr)
    starts = np.concatenate([np.zeros(1, np.int32), np.cumsum(uses, dtype=np.int32)])
    sums = csr_array((patch.sums.data, patch.sums.indices, starts), shape=(len(uses), patch.sums.shape[1]))
    return _Tables(cells, whole, replace(patch, coordinates=None, sums=sums))


def _touched(cells: Cells, vertices: Mask) -> Mask:
    """Cells (m,) with a corner among the vertices (n,)."""
    touched: Mask = np.logical_or.reduce(vertices[cells.diagonals], axis=(0, 1))
    return touched


def _around(cells: Cells, vertices: Mask, touched: Mask) -> _Patch:
    """Return what depends on the vertices (n,), corners of the cells `touched` (m,)."""
    reached: Points = np.asarray(cells.sums @ np.repeat(touched, 4).astype(np.float32))
    coordinates = np.flatnonzero(reached)
    sums = cells.sums[coordinates]
    cell, axis = sums.indices >> 2, sums.indices & 3
    used = np.zeros(len(touched), np.bool_)
    used[cell] = True
    chosen = np.concatenate([np.flatnonzero(touched), np.flatnonzero(used & ~touched)])
    place = np.zeros(len(touched), np.int32)
    place[chosen] = 4 * np.arange(len(chosen))
    shape = len(coordinates), 4 * len(chosen)
    sums = csr_array((sums.data, place[cell] + axis, sums.indptr), shape=shape)
    moving = int(np.count_nonzero(touched))
    return _Patch(vertices, cells.diagonals[:, :, chosen], moving, coordinates[::3] // 3, coordinates, sums)
