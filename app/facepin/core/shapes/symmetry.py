"""Which vertex is at the mirrored place of which, and where the plane between left and right is."""

from typing import Any

import numpy as np

from facepin.core.arrays import Floats, Indices
from facepin.core.rig import Rig

CANDIDATES = 8
"""Nearest vertices of which one is the twin."""
SAME_PLACE = 0.05
"""How much farther than the nearest others may be, as a share of the length of edges there."""
SAMPLES = 1000
"""Vertices by which planes are compared."""
NEAR = 0.01
"""How far from its mirrored place a twin may be for that, as a share of the face height."""
BETTER = 1.05
"""How many times as many vertices need a twin across another plane than across the middle of the world."""
CENTRED = 0.02
"""A middle that is off by less than this share of the width is the middle of the world: nearly all rigs
stand there."""


def middle_of(rig: Rig) -> float:
    """Return x of the plane between left and right: that of what shapes move, since hair may be one-sided."""
    from scipy.spatial import cKDTree

    moved = np.zeros(rig.vertex_count, np.bool_)
    moved[rig.deltas.indices // 3] = True
    points = rig.neutral[moved if moved.any() else np.ones_like(moved)].astype(np.float64)
    x = points[:, 0]
    found = [float(np.median(x)), float(x.min() + x.max()) / 2]
    found = [middle for middle in found if abs(middle) >= CENTRED * np.ptp(x)]
    if not found:
        return 0.0
    planes = [0.0, *found]
    tree, some = cKDTree(points), points[:: max(1, len(points) // SAMPLES)]
    nearest = [tree.query(across(some, plane), distance_upper_bound=NEAR * rig.height)[0] for plane in planes]
    twins = [int(np.isfinite(distances).sum()) for distances in nearest]
    best = int(np.argmax(twins))
    if twins[best] > BETTER * twins[0]:
        return planes[best]
    # Where no plane is one of symmetry, the face has a left and a right all the same.
    return 0.0 if twins[0] > len(some) / 2 else found[0]


def across(points: Floats, middle: float) -> Floats:
    """Mirror points (..., 3)."""
    return points * (-1.0, 1.0, 1.0) + (2 * middle, 0.0, 0.0)


def twin_vertices(rig: Rig, middle: float, near: float) -> Indices:
    """Return for each vertex the one at its mirrored place, (n,), -1 where none is `near` that points back.

    Where several are there (closed lips and lids, seams of a texture) it is the one whose neighbours lie on
    the mirrored side, and which the shapes together move like the mirror image.
    """
    from scipy.spatial import cKDTree

    points = rig.neutral.astype(np.float64)
    count = len(points)
    ways, lengths = _ways_to_neighbours(rig)
    sums = np.asarray(rig.deltas[:, : rig.shape_count].sum(axis=1), np.float64).reshape(-1, 3)
    size = float(np.linalg.norm(sums, axis=1).max(initial=0.0)) or 1.0
    tree: Any = cKDTree(points)  # a list of k gives tables, whatever its length; its types do not tell
    distances, nearest = tree.query(
        across(points, middle), k=range(1, min(CANDIDATES, count) + 1), distance_upper_bound=near
    )
    there = np.where(np.isfinite(distances), nearest, 0)
    costs = np.where(distances <= distances[:, :1] + SAME_PLACE * lengths[:, None], distances, np.inf)
    costs /= lengths[:, None]
    for vectors, unit in ((ways, lengths[:, None]), (sums, size)):
        wanted = across(vectors, 0.0)[:, None]
        costs += np.minimum(np.linalg.norm(wanted - vectors[there], axis=2) / unit, 1.0)
    best = np.argmin(costs, axis=1)
    rows = np.arange(count)
    twins = np.where(np.isfinite(costs[rows, best]), there[rows, best], -1).astype(np.int32)
    # Where vertices coincide the way back may end on another one at the same place.
    back = np.where(twins >= 0, twins[twins], -1)
    mutual: Indices = np.where((back >= 0) & (points[back] == points).all(axis=1), twins, -1)
    return mutual


def _ways_to_neighbours(rig: Rig) -> tuple[Floats, Floats]:
    """Return the way from each vertex to the mean of its neighbours, (n, 3), and the mean length of these
    edges, (n,), never zero.
    """
    ends = np.cumsum(rig.face_sizes)
    following = np.arange(1, len(rig.corners) + 1)
    following[ends - 1] = ends - rig.face_sizes
    edges = np.stack([rig.corners, rig.corners[following]], axis=1)
    edges = np.concatenate([edges, edges[:, ::-1]])
    starts, steps = edges[:, 0], (rig.neutral[edges[:, 1]] - rig.neutral[edges[:, 0]]).astype(np.float64)
    count = rig.vertex_count
    number = np.maximum(np.bincount(starts, minlength=count), 1)
    ways = np.stack([np.bincount(starts, steps[:, axis], count) for axis in range(3)], axis=1)
    lengths = np.bincount(starts, np.linalg.norm(steps, axis=1), count) / number
    typical = float(np.median(lengths[lengths > 0])) if (lengths > 0).any() else rig.height
    return ways / number[:, None], np.where(lengths > 0, lengths, typical)
