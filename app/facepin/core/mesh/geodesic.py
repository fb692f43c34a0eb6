"""Distances along the surface, and how much of each shape happens near some vertices."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from facepin.core.arrays import Floats
from facepin.core.mesh.topology import weld_map
from facepin.core.rig import Rig


def geodesic_distances(rig: Rig, vertices: Sequence[int], limit: float) -> Floats:
    """Return how far each vertex is from the nearest of `vertices` along the neutral, (n,) lengths.

    Paths run along the edges of the triangles and both diagonals of quads, so they are somewhat longer than
    the shortest ones across the faces (8 % at worst on a square grid).  Lips that touch are as far apart as
    the way around the corner of the mouth; surfaces that do not hang together are infinitely far apart.

    Parameters
    ----------
    vertices : p vertex indices
    limit : float
        A length, in the rig's unit; what is further counts as infinitely far.
    """
    if not len(vertices):
        return np.full(rig.vertex_count, np.inf)
    # Takes 0.2 s to import, and only those need it who confine their edits.
    from scipy.sparse.csgraph import dijkstra

    weld = weld_map(rig)
    sources = weld[np.asarray(vertices, np.intp)]
    points = rig.neutral.astype(np.float64)
    # No way is shorter than the straight one, so what is further than that need not be looked at.
    near = np.zeros(rig.vertex_count, bool)
    for x, y, z in points[sources]:
        near |= (points[:, 0] - x) ** 2 + (points[:, 1] - y) ** 2 + (points[:, 2] - z) ** 2 <= limit**2
    graph = _edges(rig, weld, points, near)
    distances: Floats = dijkstra(graph, directed=False, indices=sources, min_only=True, limit=limit)
    return distances[weld]


def _edges(rig: Rig, weld: NDArray[np.int32], points: Floats, near: NDArray[np.bool_]) -> csr_array:
    """Return the lengths of the edges between near vertices, (n, n), each in one direction or both."""
    a, b, c = weld[rig.triangles].T
    quads = np.flatnonzero(rig.face_sizes == 4)
    at = (np.cumsum(rig.face_sizes, dtype=np.intp) - rig.face_sizes)[quads]
    # The triangles have one diagonal of each quad; which one does not matter, as both are added.
    p, q, r, s = (weld[rig.corners[at + corner]] for corner in range(4))
    start, end = np.concatenate([a, b, c, p, q]), np.concatenate([b, c, a, r, s])
    kept = near[start] & near[end] & (start != end)
    start, end = start[kept], end[kept]
    order = np.argsort(start, kind="stable")
    start, end = start[order], end[order]
    lengths = np.linalg.norm(points[start] - points[end], axis=1)
    # Made by hand: the usual way adds up the lengths where two triangles have the same edge.
    rows = np.concatenate([[0], np.cumsum(np.bincount(start, minlength=len(points)))])
    return csr_array((lengths, end, rows.astype(np.int32)), shape=(len(points), len(points)))


def shape_locality(rig: Rig, vertices: Sequence[int], radius: float, weights: Floats) -> Floats:
    """Return how much of each shape happens near some vertices, (k,) shares 0..1.

    The share of its squared motion that remains when vertex i counts kᵢ = 1 - dᵢ / radius, where dᵢ is its
    geodesic distance from the nearest of `vertices`, and 0 beyond the radius: sⱼ = Σᵢ kᵢ ‖bᵢⱼ‖² / Σᵢ ‖bᵢⱼ‖².
    The kernel is that of the localised deformation components of Neumann et al. 2013.  0 for shapes that move
    nothing.

    Parameters
    ----------
    vertices : p vertex indices
    radius : float
        A length > 0, in the rig's unit.
    weights : (k,)
        The pose; what a shape does at it differs on rigs with combinations only.
    """
    kernel = 1.0 - np.minimum(geodesic_distances(rig, vertices, radius) / radius, 1.0)
    inside = np.flatnonzero(kernel)
    deltas = rig.slope_deltas(weights)
    total = np.zeros(rig.shape_count)
    filled = np.flatnonzero(np.diff(deltas.indptr))
    if not len(filled):
        return total
    squares = deltas.data * deltas.data
    total[filled] = np.add.reduceat(squares, deltas.indptr[filled], dtype=np.float64)
    rows = rig.slopes(rig.rows_at(inside.tolist()), weights)
    near = np.repeat(kernel[inside], 3) @ (rows * rows)
    return np.divide(near, total, out=np.zeros_like(total), where=total > 0)
