"""Which triangle of a face lies under the cursor."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats, Indices, Points
from facepin.core.camera import Camera, Viewport


@dataclass(frozen=True)
class Hit:
    """Where a ray first meets the mesh."""

    triangle: int
    vertex: int
    """Nearest vertex of that triangle.  Not of the mesh: the other lip can be a millimetre away."""
    point: tuple[float, float, float]
    distance: float
    """From the eye."""


def pick(
    positions: Points,
    triangles: Indices,
    camera: Camera,
    viewport: Viewport,
    pixel: tuple[float, float],
    two_sided: bool = True,
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

    Returns
    -------
    Hit or None
        The nearest hit beyond the camera's near depth, as drawing shows it.
    """
    if not viewport.contains(*pixel) or not len(triangles):
        return None
    origin, direction = camera.ray(pixel, viewport)
    nearest = camera.near / float(direction @ -camera.axes[2])
    return first_hit(positions, triangles, origin, direction, nearest, two_sided)


def first_hit(
    positions: Points,
    triangles: Indices,
    origin: Floats,
    direction: Floats,
    nearest: float = 0.0,
    two_sided: bool = True,
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
    """
    across = _across(direction)
    drawing = np.asarray(across, np.float32) @ positions.T
    drawing -= np.asarray(across @ origin, np.float32)[:, None]
    # A coarse sieve in float32: a triangle all on one side of the dot in x or in y cannot hold it.
    slack = np.float32(1e-5) * max(float(np.abs(drawing).max(initial=0.0)), float(np.abs(origin).max()))
    sides = (drawing[0] < -slack) | (drawing[0] > slack) * np.uint8(2)
    sides |= (drawing[1] < -slack) * np.uint8(4) | (drawing[1] > slack) * np.uint8(8)
    a, b, c = triangles.T
    near = np.flatnonzero((sides[a] & sides[b] & sides[c]) == 0)
    return _nearest_hit(positions, triangles[near], near, origin, direction, nearest, two_sided)


def _across(direction: Floats) -> Floats:
    """Two unit vectors (2, 3) at right angles to a direction and to each other, u × v = −direction."""
    helper = np.zeros(3)
    helper[np.argmin(np.abs(direction))] = 1.0
    u = np.cross(helper, direction)
    u /= np.linalg.norm(u)
    return np.stack([u, np.cross(u, direction)])


def _nearest_hit(
    positions: Points,
    candidates: Indices,
    names: NDArray[np.intp],
    origin: Floats,
    direction: Floats,
    nearest: float,
    two_sided: bool,
) -> Hit | None:
    """Test a few triangles exactly (float64) and return the nearest hit."""
    frame = np.vstack([_across(direction), direction])
    # Sums written out: a matrix product may round a shared vertex differently in its two triangles.
    px, py, pz = np.moveaxis(positions[candidates].astype(np.float64) - origin, 2, 0)
    x, y, z = (px * f[0] + py * f[1] + pz * f[2] for f in frame)
    # Twice the area that each edge spans with the dot.  Two triangles that share an edge get the same number
    # with opposite sign, so no ray slips between them.
    spans = np.roll(x, -1, 1) * np.roll(y, -2, 1) - np.roll(x, -2, 1) * np.roll(y, -1, 1)
    area = spans.sum(axis=1)
    inside = (spans >= 0).all(axis=1) & (area > 0)
    if two_sided:
        inside |= (spans <= 0).all(axis=1) & (area < 0)
    distance = np.full(len(candidates), np.inf)
    np.divide((spans * z).sum(axis=1), area, out=distance, where=inside)
    distance[distance < nearest] = np.inf
    if not np.isfinite(distance).any():
        return None
    best = int(np.argmin(distance))
    point = origin + distance[best] * direction
    corners = candidates[best]
    gaps = np.linalg.norm(positions[corners] - point, axis=1)
    at = (float(point[0]), float(point[1]), float(point[2]))
    return Hit(int(names[best]), int(corners[np.argmin(gaps)]), at, float(distance[best]))
