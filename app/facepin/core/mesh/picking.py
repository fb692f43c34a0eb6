"""Which triangle of a face lies under the cursor."""

from collections.abc import Callable
from dataclasses import dataclass
from math import copysign

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats, Indices, Points
from facepin.core.look.camera import Camera, Viewport
from facepin.core.pose import Vector, as_vector

Presence = Callable[[int, Floats], bool]
"""(number of a triangle, shares (3,) of its corners in a point of it) -> whether anything is there."""

SLACK = 4e-6
"""Rounding of the float32 sieve, relative to the largest coordinate, with a good margin."""


@dataclass(frozen=True)
class Hit:
    """Where a ray first meets the mesh."""

    triangle: int
    vertex: int
    """Nearest vertex of that triangle.  Not of the mesh: the other lip can be a millimetre away."""
    point: Vector
    distance: float
    """From the eye."""


def pick(
    positions: Points,
    triangles: Indices,
    camera: Camera,
    viewport: Viewport,
    pixel: tuple[float, float],
    two_sided: bool = True,
    present: Presence | None = None,
) -> Hit | None:
    """Return what lies under a pixel, or None.

    Parameters
    ----------
    positions : (n, 3) float32
        Vertices as they are drawn now.
    triangles : (t, 3) int32
        Vertex indices.
    camera, viewport
        As they are drawn now.
    pixel : (x, y)
        Framebuffer pixels; nothing is hit outside the viewport.
    two_sided : bool
        Back faces count too, so that an open or inside-out mesh can be picked; otherwise only
        counter-clockwise triangles do.
    present : callable
        Tells where a triangle has holes, or is too clear to be taken.

    Returns
    -------
    Hit or None
        The nearest hit beyond the camera's near depth, as drawing shows it.
    """
    if not viewport.contains(*pixel) or not len(triangles):
        return None
    origin, direction = camera.ray(pixel, viewport)
    nearest = camera.near / float(direction @ -camera.axes[2])
    return first_hit(positions, triangles, origin, direction, nearest, two_sided, present)


def first_hit(
    positions: Points,
    triangles: Indices,
    origin: Floats,
    direction: Floats,
    nearest: float = 0.0,
    two_sided: bool = True,
    present: Presence | None = None,
) -> Hit | None:
    """Return the first triangle that a ray meets further than `nearest` from its origin, or None.

    Seen along the ray, the mesh is a flat drawing and the ray is one dot in it: a triangle is hit when the
    dot lies inside.  Nothing is divided by depth, so triangles that reach behind the eye are no trouble.

    Parameters
    ----------
    positions : (n, 3) float32
        Vertices.
    triangles : (t, 3) int32
        Vertex indices.
    origin, direction : (3,) float64
        The ray; the direction is a unit vector.
    nearest : float
        Hits closer than this are passed over.
    two_sided : bool
        Count triangles seen from behind as well.
    present : callable
        Tells where a triangle has holes, or is too clear to be taken.
    """
    frame = _frame(direction)
    u, v, _ = frame
    # A coarse sieve in float32: a triangle all on one side of the dot in x or in y cannot hold it.
    x = positions @ u.astype(np.float32) - np.float32(u @ origin)
    y = positions @ v.astype(np.float32) - np.float32(v @ origin)
    reach = max(float(positions.max()), -float(positions.min()), float(np.abs(origin).max()))
    slack = np.float32(SLACK * reach)
    sides = (x < -slack).view(np.uint8)
    for bit, side in enumerate((x > slack, y < -slack, y > slack), start=1):
        sides |= side.view(np.uint8) << np.uint8(bit)
    corners = sides.take(triangles, mode="clip")
    numbers = np.flatnonzero((corners[:, 0] & corners[:, 1] & corners[:, 2]) == 0)
    candidates = triangles[numbers]

    # Exactly, in float64.  Sums are written out, for a matrix product may round the same vertex differently
    # in two triangles.
    local = positions[candidates].astype(np.float64) - origin
    x, y, z = (local[..., 0] * axis[0] + local[..., 1] * axis[1] + local[..., 2] * axis[2] for axis in frame)
    # Twice the area that each edge spans with the dot.  Two triangles that share an edge get the same number
    # with opposite sign, so no ray slips between them.
    spans = np.stack([x[:, i] * y[:, j] - x[:, j] * y[:, i] for i, j in ((1, 2), (2, 0), (0, 1))])
    area = spans.sum(axis=0)
    inside = (spans >= 0).all(axis=0) & (area > 0)
    if two_sided:
        inside |= (spans <= 0).all(axis=0) & (area < 0)
    distance = np.full(len(numbers), np.inf)
    np.divide((spans * z.T).sum(axis=0), area, out=distance, where=inside)
    distance[distance < nearest] = np.inf
    best = _first(distance, numbers, spans, area, present)
    if best is None:
        return None
    point = origin + distance[best] * direction
    gaps = np.linalg.norm(positions[candidates[best]] - point, axis=1)
    vertex = int(candidates[best, np.argmin(gaps)])
    return Hit(int(numbers[best]), vertex, as_vector(point), float(distance[best]))


def _first(
    distance: Floats, numbers: NDArray[np.intp], spans: Floats, area: Floats, present: Presence | None
) -> int | None:
    """Return which candidate comes first of those that are there at all, None where there is none."""
    if not len(distance):
        return None
    if present is None:
        best = int(np.argmin(distance))
        return best if distance[best] < np.inf else None
    hit = np.flatnonzero(distance < np.inf)
    nearest_first = hit[np.argsort(distance[hit], kind="stable")].tolist()
    return next((at for at in nearest_first if present(int(numbers[at]), spans[:, at] / area[at])), None)


def _frame(direction: Floats) -> Floats:
    """Return (3, 3) rows u, v and the direction, at right angles, u × v = −direction (Duff et al. 2017)."""
    x, y, z = direction.tolist()
    sign = copysign(1.0, z)
    a = -1.0 / (sign + z)
    u = (1.0 + sign * x * x * a, sign * x * y * a, -sign * x)
    v = (-x * y * a, -sign - y * y * a, y)
    return np.array([u, v, (x, y, z)])
