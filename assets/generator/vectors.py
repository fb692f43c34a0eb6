"""Small vector arithmetic shared by the generator."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import PchipInterpolator

Array = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]
Vector = tuple[float, float, float]

MIRROR: Array = np.array([-1.0, 1.0, 1.0])
"""Factor that takes a point to the other side of the face."""


def smoothstep(start: float, stop: float, x: ArrayLike) -> Array:
    """Return 0 before `start`, 1 after `stop`, a smooth cubic between (also for start > stop)."""
    t = np.clip((np.asarray(x, float) - start) / (stop - start), 0, 1)
    result: Array = t * t * (3 - 2 * t)
    return result


def mix(a: ArrayLike, b: ArrayLike, t: ArrayLike) -> Array:
    """Return a at t = 0 and b at t = 1, linear between."""
    start = np.asarray(a, float)
    result: Array = start + (np.asarray(b, float) - start) * np.asarray(t, float)
    return result


def unit(vectors: Array) -> Array:
    """Return (..., 3) vectors scaled to length one; a zero vector stays zero."""
    result: Array = vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12)
    return result


def bump(x: ArrayLike, centre: float, width: float) -> Array:
    """Return the bell exp(-((x - centre) / width)^2)."""
    result: Array = np.exp(-(((np.asarray(x, float) - centre) / width) ** 2))
    return result


def blob(points: Array, centre: Sequence[float], radii: Sequence[float]) -> Array:
    """Return the (n,) values of a three-dimensional bell at (n, 3) points."""
    result: Array = np.exp(-(((points - np.array(centre, float)) / np.array(radii, float)) ** 2).sum(1))
    return result


def beside_line(places: Array, line: Array) -> tuple[Array, Array, Array]:
    """Return where (n, 2) places lie about the polyline through (k, 2) points.

    The three (n,) arrays are the share of the way along it (0..1), the distance from it (positive on the left
    of its direction), and how far beyond its ends they lie.
    """
    start, along = line[:-1], np.diff(line, axis=0)
    share = np.clip(((places[:, None] - start) * along).sum(2) / (along**2).sum(1), 0, 1)
    away = places[:, None] - start - share[..., None] * along
    nearest = np.linalg.norm(away, axis=2).argmin(1)
    every = np.arange(len(places))
    away, share, along = away[every, nearest], share[every, nearest] + nearest, along[nearest]
    left = unit(np.c_[-along[:, 1], along[:, 0]])
    across: Array = (away * left).sum(1)
    beyond: Array = np.linalg.norm(away - across[:, None] * left, axis=1)
    return share / len(start), across, beyond


def rotation(axis: Sequence[float], degrees: float) -> Array:
    """Return the (3, 3) matrix of a right-handed turn about `axis`; it acts on columns."""
    x, y, z = unit(np.array(axis, float))
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.radians(degrees)
    result: Array = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return result


def turn(points: Array, axes: Array, angles: Array) -> Array:
    """Return (n, 3) points turned about (n, 3) unit axes by (n,) angles in radians (Rodrigues)."""
    cos, sin = np.cos(angles)[:, None], np.sin(angles)[:, None]
    along = (axes * points).sum(1)[:, None]
    result: Array = points * cos + np.cross(axes, points) * sin + axes * along * (1 - cos)
    return result


def curve(knots: ArrayLike, x: ArrayLike) -> Array:
    """Return the monotone cubic through (x, y) knots at `x`."""
    places, values = np.asarray(knots, float).T
    result: Array = PchipInterpolator(places, values)(np.asarray(x, float))
    return result


def columns(*parts: ArrayLike) -> Array:
    """Return scalars and (n,) arrays side by side as one (n, len(parts)) array."""
    result: Array = np.stack(np.broadcast_arrays(*(np.asarray(p, float) for p in parts)), axis=-1)
    return result


def repeated(colour: Sequence[float], count: int) -> Array:
    """Return one colour or point as (count, 3) rows."""
    return np.tile(np.array(colour, float), (count, 1))
