"""Smooth vertex normals of a face that moves."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from facepin.core.arrays import Indices, Points
from facepin.core.rig import Rig
from facepin.core.topology import weld_map

CREASE = 0.5
"""Cosine of the angle (60 degrees) between neutral normals up to which welded vertices are smoothed."""
MOST_WELDED = 16
"""Vertices in one place that are compared with each other; more are a heap, not a seam."""
SLIVER = 0.02
"""Cells below this share of their neighbours' size weigh as if they had it, lest they rule once opened."""
WHOLE = 0.25
"""Share of moved cells above which all are computed, for picking out costs as much."""
NOWHERE = np.float32(1e-6)
"""Added to z (normals have lengths of about 2π), so that those of collapsed cells can be normalised too."""

Mask = NDArray[np.bool_]
Numbers = NDArray[np.intp]


class NormalField:
    """Vertex normals of posed positions, frame after frame; one per pane.

    A normal is the sum over the cells (quads and triangles) round a vertex of their area vectors, times
    constants chosen so that in the neutral it is the angle-weighted normal (Thürmer and Wüthrich 1998), which
    hardly depends on how a surface is cut into cells; later it costs what the area-weighted normal costs.
    Vertices that a texture seam has split get the normal of the whole.

    Only cells with a corner that moved are computed again.
    """

    def __init__(self, rig: Rig) -> None:
        self._begin(_Cells(rig), rig.neutral)

    def _begin(self, cells: "_Cells", neutral: Points) -> None:
        self._cells = cells
        self._areas = np.zeros((3, cells.count), np.float32)
        self._normals: Points = np.zeros_like(neutral)
        self._watched: Mask = np.ones(len(neutral), np.bool_)
        self._watch(np.ones(neutral.shape, np.bool_))
        self._compute(neutral)

    def twin(self) -> "NormalField":
        """Return a field for another pane that shares the big tables with this one."""
        twin = object.__new__(NormalField)
        twin._begin(self._cells, self._positions)
        return twin

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
        self._patch = self._cells.around(vertices)

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


def area_vectors(points: Points, diagonals: Numbers) -> Points:
    """Twice the area vectors of cells.

    Parameters
    ----------
    points : (3, n) float32
        Coordinates: all x, all y, all z.
    diagonals : (2, 2, m) int
        For each cell the two ends of one diagonal, and of the other; of a triangle, of two sides.

    Returns
    -------
    (3, m) float32
    """
    (a, b), (c, d) = diagonals
    # Clipping never happens; asking for it spares numpy a check of every index.
    u = points.take(b, axis=1, mode="clip")
    u -= points.take(a, axis=1, mode="clip")
    v = points.take(d, axis=1, mode="clip")
    v -= points.take(c, axis=1, mode="clip")
    return np.stack([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]])


@dataclass(frozen=True, eq=False)
class _Patch:
    """What has to be computed when some vertices move."""

    cells: Numbers | slice
    diagonals: Numbers
    """Of these cells; see `area_vectors`."""
    rows: Numbers | slice
    """Vertices whose normals depend on the cells."""
    sums: csr_array
    """Turns area vectors of all cells into normals of the rows."""


class _Cells:
    """Faces cut into quads and triangles, and what each adds to the normals of its corners."""

    def __init__(self, rig: Rig) -> None:
        quads, triangles = _cut(rig.corners, rig.face_sizes)
        self.diagonals = np.hstack([quads[[0, 2, 1, 3]], triangles[[0, 1, 0, 2]]]).reshape(2, 2, -1)
        self.count = self.diagonals.shape[2]
        areas = area_vectors(rig.neutral.T, self.diagonals)
        self.sums = _welded(_corner_weights(rig.neutral, quads, triangles, areas), areas, weld_map(rig))
        self._whole = _Patch(slice(None), self.diagonals, slice(None), self.sums)

    def around(self, moved: Mask) -> _Patch:
        """Return what depends on the vertices that `moved` (n,) marks."""
        touched: Mask = np.logical_or.reduce(moved[self.diagonals], axis=(0, 1))
        if np.count_nonzero(touched) > WHOLE * self.count:
            return self._whole
        cells = np.flatnonzero(touched)
        reached: Points = np.asarray(self.sums @ touched.astype(np.float32))
        rows = np.flatnonzero(reached)
        return _Patch(cells, self.diagonals[:, :, cells], rows, self.sums[rows])


def _cut(corners: Indices, sizes: Indices) -> tuple[Numbers, Numbers]:
    """Cut every face into a fan of quads, and a triangle where its size is odd: (4, q) and (3, t)."""
    starts = np.cumsum(sizes) - sizes
    per_face = (sizes - 2) // 2
    first = np.repeat(starts, per_face)
    step = 2 * (np.arange(len(first)) - np.repeat(np.cumsum(per_face) - per_face, per_face))
    odd = starts[sizes % 2 == 1]
    last = odd + sizes[sizes % 2 == 1] - 1
    quads = np.stack(
        [corners[first], corners[first + step + 1], corners[first + step + 2], corners[first + step + 3]]
    )
    triangles = np.stack([corners[odd], corners[last - 1], corners[last]])
    return quads.astype(np.intp), triangles.astype(np.intp)


def _corner_weights(neutral: Points, quads: Numbers, triangles: Numbers, areas: Points) -> csr_array:
    """Angle of each cell at each corner over the length of its area vector, neutral, (n, m) float32."""
    kinds = (quads, triangles)
    at, before, after = (
        np.concatenate([np.roll(cells, step, axis=0).ravel() for cells in kinds]) for step in (0, 1, -1)
    )
    numbers = np.split(np.arange(areas.shape[1]), [quads.shape[1]])
    cell = np.concatenate([np.tile(own, len(cells)) for own, cells in zip(numbers, kinds, strict=True)])

    points, count = neutral.astype(np.float64), len(neutral)
    u, v = points[before] - points[at], points[after] - points[at]
    angle = np.arctan2(np.linalg.norm(np.cross(u, v), axis=1), (u * v).sum(axis=1))
    size = np.linalg.norm(areas.astype(np.float64), axis=0)[cell]
    usual = np.bincount(at, size, count) / np.maximum(np.bincount(at, minlength=count), 1)
    size = np.maximum(size, SLIVER * usual[at])
    weight = np.divide(angle, size, out=np.zeros_like(angle), where=size > 0)
    return csr_array((weight.astype(np.float32), (at, cell)), shape=(count, areas.shape[1]))


def _welded(sums: csr_array, areas: Points, same: Indices) -> csr_array:
    """Give vertices that always coincide and face about the same way the cells of each other.

    Parameters
    ----------
    sums : (n, m)
        What the cells add to each vertex.
    areas : (3, m) float32
        Area vectors of the cells in the neutral.
    same : (n,) int32
        From `weld_map`.
    """
    order = np.argsort(same, kind="stable")
    normals = sums @ areas.T.astype(np.float64)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
    links = [np.stack([order, order])]
    for step in range(1, MOST_WELDED):
        pair = np.stack([order[:-step], order[step:]])
        pair = pair[:, same[pair[0]] == same[pair[1]]]
        if not pair.size:
            break
        pair = pair[:, (normals[pair[0]] * normals[pair[1]]).sum(axis=1) > CREASE]
        links += [pair, pair[::-1]]
    if len(links) == 1:
        return sums
    at, other = np.hstack(links)
    link = csr_array((np.ones(len(at), np.float32), (at, other)), shape=(len(order), len(order)))
    return csr_array(link @ sums)
