"""What a face is put together from: loose surfaces, and which of them are eyeballs."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats
from facepin.core.mesh.topology import connected, weld_map
from facepin.core.rig import Rig

FEWEST = 24
"""Vertices of a ball; fewer fit one by chance."""
ROUND = 0.06
"""How far, as a share of the radius, the vertices of an eyeball may be from a ball (root mean square)."""
SMALLEST, LARGEST = 0.015, 0.12
"""Radius of an eyeball as a share of the height of the model: 0.05 to 0.07 on busts, less on whole bodies."""
ALIKE = 0.15
"""How far the second eye may be from where a mirror shows the first, as a share of the radius."""


@dataclass(frozen=True, eq=False)
class Eyeball:
    """A ball among the pieces of a face, and what is wrapped around it."""

    centre: Floats
    """(3,) float64."""
    radius: float
    vertices: NDArray[np.intp]
    """(m,) all vertices of it."""


def pieces(rig: Rig) -> NDArray[np.intp]:
    """Number of the piece each vertex belongs to, (n,): a part of the file, or a loose surface inside one.

    Vertices without a triangle are of the piece −1.
    """
    same = weld_map(rig)
    triangles = same[rig.triangles].astype(np.intp)
    surface = connected(rig.vertex_count, triangles[:, :2], triangles[:, 1:])[same]
    part = np.repeat(np.arange(len(rig.parts)), [len(part.triangles) for part in rig.parts])
    keys = np.full(rig.vertex_count, -1, np.intp)
    keys[rig.triangles] = (part[:, None] * rig.vertex_count) + surface[rig.triangles]
    _, numbers = np.unique(np.append(keys, -1), return_inverse=True)
    return np.asarray(numbers[:-1] - 1, np.intp)


def eyeballs(rig: Rig, numbers: NDArray[np.intp]) -> tuple[Eyeball, ...]:
    """Find the eyeballs among the `pieces`: two balls of one size beside each other, or none.

    Returns
    -------
    tuple of Eyeball
        Empty, or the one with the larger x (the character's left) first.
    """
    low, high = SMALLEST * rig.height, LARGEST * rig.height
    neutral = rig.neutral.astype(np.float64)
    order = np.argsort(numbers, kind="stable")
    order = order[np.searchsorted(numbers[order], 0) :]
    groups = np.split(order, np.flatnonzero(np.diff(numbers[order])) + 1)
    balls = []
    for vertices in groups:
        extent = np.ptp(neutral[vertices], axis=0) if len(vertices) >= FEWEST else np.zeros(3)
        if not (extent.min() >= 1.2 * low and extent.max() <= 2.4 * high):
            continue
        centre, radius, misfit = fit_ball(neutral[vertices])
        # A shell over the front of an eye fits a ball as well, but is not as deep as one.
        if low <= radius <= high and misfit <= ROUND * radius and extent.min() >= 1.2 * radius:
            balls.append(Eyeball(centre, radius, vertices))
    middle = (neutral[:, 0].min() + neutral[:, 0].max()) / 2 if len(neutral) else 0.0
    for left in sorted(balls, key=lambda ball: -ball.radius):
        shown = left.centre * (-1, 1, 1) + (2 * middle, 0, 0)
        for right in balls:
            apart = np.linalg.norm(right.centre - shown)
            if left.centre[0] > right.centre[0] + left.radius and apart <= ALIKE * left.radius:
                return _with_shells(left, balls), _with_shells(right, balls)
    return ()


def turn_of(eye: Eyeball, points: Floats, moved: Floats) -> tuple[Floats, float]:
    """Fit a rotation around the middle of an eyeball to a motion of it.

    Parameters
    ----------
    eye : Eyeball
    points, moved : (m, 3) float64
        Its vertices, and where they are moved to.

    Returns
    -------
    rotation : (3,) float64
        Its axis times its angle in radians.
    misfit : float
        Share of the motion that is no rotation: 0 none of it, 1 all.
    """
    away, after = points - eye.centre, moved - eye.centre
    left, _, right = np.linalg.svd(away.T @ after)
    turn = right.T @ np.diag((1.0, 1.0, np.sign(np.linalg.det(right.T @ left.T)))) @ left.T
    axis = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    sine, cosine = np.linalg.norm(axis) / 2, (np.trace(turn) - 1) / 2
    motion = float(((after - away) ** 2).sum())
    if not motion or not sine:
        return np.zeros(3), 1.0 if motion else 0.0
    off = float(((after - away @ turn.T) ** 2).sum())
    return axis / (2 * sine) * np.arctan2(sine, cosine), min((off / motion) ** 0.5, 1.0)


def fit_ball(points: Floats) -> tuple[Floats, float, float]:
    """Fit a ball to points (m, 3): middle (3,), radius, and the root mean square of what is off it."""
    origin = points.mean(axis=0)
    away = points - origin
    # |p|² = 2 p·c + (r² − |c|²) is linear in the middle c.
    system = np.concatenate([2 * away, np.ones((len(away), 1))], axis=1)
    middle = np.linalg.lstsq(system, (away**2).sum(axis=1), rcond=None)[0][:3]
    distances = np.linalg.norm(away - middle, axis=1)
    return origin + middle, float(distances.mean()), float(distances.std())


def _with_shells(ball: Eyeball, balls: list[Eyeball]) -> Eyeball:
    """Return a ball with all others around the same middle: white and cornea are often two."""
    same = [
        other.vertices for other in balls if np.linalg.norm(other.centre - ball.centre) <= 0.5 * ball.radius
    ]
    return Eyeball(ball.centre, ball.radius, np.sort(np.concatenate(same)))
