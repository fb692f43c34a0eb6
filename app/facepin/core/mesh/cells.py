"""The quads and triangles whose area vectors make the normals of a mesh, and what each adds where."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from facepin.core.arrays import Indices, Points
from facepin.core.mesh.area_vectors import AreaVectors, Numbers
from facepin.core.mesh.topology import weld_map
from facepin.core.rig import Rig

FLAT = 0.985
"""Cosine of the angle (10 degrees) up to which two triangles may be taken for one quad."""
CREASE = 0.5
"""Cosine of the angle (60 degrees) between neutral normals up to which welded vertices are smoothed."""
MOST_WELDED = 16
"""Vertices in one place that are compared with each other; more are a heap, not a seam."""
SLIVER = 0.02
"""Cells below this share of their neighbours' size weigh as if they had it, lest they rule once opened."""


@dataclass(frozen=True, eq=False)
class Cells:
    """m quads and triangles that cover a mesh."""

    diagonals: Numbers
    """(2, 2, m), see `AreaVectors`."""
    sums: csr_array
    """(3 n, 4 m) float32 with int32 indices: turns `AreaVectors`, flattened, into flattened normals of any
    length, in the neutral the angle-weighted."""


def make_cells(rig: Rig) -> Cells:
    """Cut the faces of a rig into as few cells as possible, and weigh them.

    A vertex that a texture seam has split gets what all its copies get, unless they belong to a sharp edge.
    """
    quads, triangles = _cut(rig.corners, rig.face_sizes)
    pairs, triangles = paired(triangles, rig.neutral)
    quads = np.hstack([quads, pairs])
    diagonals = np.hstack([quads[[0, 2, 1, 3]], triangles[[0, 1, 0, 2]]]).reshape(2, 2, -1)
    areas = AreaVectors(rig.vertex_count, diagonals).of(rig.neutral)[:, :3].T
    sums = _corner_weights(rig.neutral, quads, triangles, areas)
    return Cells(diagonals, _for_each_axis(_welded(sums, areas, weld_map(rig))))


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


def paired(triangles: Numbers, neutral: Points, flat: float = FLAT) -> tuple[Numbers, Numbers]:
    """Take triangles (3, t) that follow each other and lie flat side by side for the quads they once were.

    Most files hold triangles only, each quad cut in two: half as many cells are half the work on every frame.

    Returns
    -------
    quads : (4, q), triangles : (3, t - 2 q)
    """
    number = np.arange(triangles.shape[1] - 1)
    fits, loop = np.zeros(number.shape, np.bool_), np.zeros((4, *number.shape), np.intp)
    for i, j in np.ndindex(3, 3):  # p, q, r is the first triangle; o, r, q the second
        p, q, r = (triangles[(i + step) % 3, :-1] for step in range(3))
        o, r_again, q_again = (triangles[(j + step) % 3, 1:] for step in range(3))
        here = (q == q_again) & (r == r_again) & (o != p)
        fits |= here
        loop[:, here] = np.stack([p, q, o, r])[:, here]
    points = np.ascontiguousarray(neutral.T)
    sides = points[:, np.roll(loop, -1, axis=0)] - points[:, loop]
    corners = _cross(np.roll(sides, 1, axis=1), sides)
    length = _length(corners)
    # Flat and convex: the four corners point the same way.
    fits &= ((corners * corners[:, :1]).sum(axis=0) > flat * length * length[0]).all(axis=0)
    # In a run of triangles that could all pair up, pair the first two, the next two, …
    begins = np.maximum.accumulate(np.where(fits, 0, number + 1))
    taken = np.flatnonzero(fits & ((number - begins) % 2 == 0))
    left = np.ones(triangles.shape[1], np.bool_)
    left[taken] = left[taken + 1] = False
    return loop[:, taken], triangles[:, left]


def _corner_weights(neutral: Points, quads: Numbers, triangles: Numbers, areas: Points) -> csr_array:
    """Angle of each cell at each corner over the length of its area vector, neutral, (n, m) float32."""
    kinds = (quads, triangles)
    at, before, after = (
        np.concatenate([np.roll(cells, step, axis=0).ravel() for cells in kinds]) for step in (0, 1, -1)
    )
    numbers = np.split(np.arange(areas.shape[1]), [quads.shape[1]])
    cell = np.concatenate([np.tile(own, len(cells)) for own, cells in zip(numbers, kinds, strict=True)])

    points, count = np.ascontiguousarray(neutral.T), len(neutral)
    u, v = points[:, before] - points[:, at], points[:, after] - points[:, at]
    angle = np.arctan2(_length(_cross(u, v)), (u * v).sum(axis=0))
    size = _length(areas)[cell]
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


def _for_each_axis(sums: csr_array) -> csr_array:
    """Return what does to x, y and z of (m, 4) vectors what `sums` (n, m) does to m numbers: (3 n, 4 m)."""
    rows, columns = sums.shape
    uses = np.diff(sums.indptr)
    starts = np.zeros(3 * rows + 1, np.int32)
    np.cumsum(np.repeat(uses, 3), out=starts[1:])
    by_axis = sums[np.repeat(np.arange(rows), 3)]
    axis = np.repeat(np.tile(np.arange(3), rows), np.diff(starts))
    return csr_array(
        (by_axis.data, (4 * by_axis.indices + axis).astype(np.int32), starts), shape=(3 * rows, 4 * columns)
    )


def _cross(u: Points, v: Points) -> Points:
    """Cross products of vectors (3, …), components first."""
    return np.stack([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]])


def _length(vectors: Points) -> Points:
    """Lengths of vectors (3, …), components first."""
    x, y, z = vectors
    length: Points = np.sqrt(x * x + y * y + z * z)
    return length
