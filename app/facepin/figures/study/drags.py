"""Single drags of single points: how far the skin lags, what else moves, how calmly the weights follow.

Every drag begins at the neutral, with the pin where its vertex is, and is seen straight from the front.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from math import ceil, pi

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.errors import FacepinError
from facepin.core.pose import FRONT_AXES, Freedom, Pin, as_vector
from facepin.core.rig import Rig
from facepin.core.shapes import measures
from facepin.session.solving.solving import PinSolver, SolverChoice

DIRECTIONS = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
"""Right, up, left and down on the screen."""
PIXEL = 1 / 720
"""A pixel as a share of the face height: in a window of 1280 x 720 whose height the face fills."""
FAR = 0.25
"""A vertex further than this share of the face height from the pin, on the neutral, is far from it."""
OVERDRAG = 6.0
"""How many times further than there is anything to reach the mouse goes on."""

Method = tuple[SolverChoice, Freedom]


@dataclass(frozen=True, eq=False)
class PointDrags:
    """What came of dragging one point: (sizes, directions) figures each."""

    lag: Floats
    """What remains on the screen between vertex and goal, as a share of the drag."""
    far: Floats
    """Largest move of a vertex that is `FAR` from the pin, as a share of the drag."""
    active: Floats
    """Active shapes."""
    per_pixel: Floats
    """Largest change of a weight per pixel of mouse motion, out and on a circle round the press."""
    overdrag: Floats
    """Largest change of a weight from the end of the reach to `OVERDRAG` times as far."""
    seconds: float
    """Median of the solves."""


class Grip:
    """One pin in the hand, its goal moved over the screen frame by frame, as the window solves it."""

    def __init__(self, rig: Rig, method: Method, vertex: int) -> None:
        choice, freedom = method
        self._solver = PinSolver(rig, choice)
        self._rest = rig.neutral[vertex].astype(np.float64)
        self._pin = Pin(vertex, as_vector(self._rest), freedom, FRONT_AXES)
        # At the press, and the last pose made by hand: solvers that start from either start here.
        self._start = np.zeros(rig.shape_count)
        self.seconds: list[float] = []
        self.press()

    def press(self) -> None:
        """Begin a drag at the neutral."""
        self._weights = self._start

    def pull(self, move: Floats) -> Floats:
        """Move the goal to `move` (2,) from the press; return the weights (k,).

        A solver that fails leaves the face as it is, here as in the window.
        """
        goal = self._rest + np.append(move, 0.0)
        with suppress(FacepinError):
            solved = self._solver.solve((replace(self._pin, goal=as_vector(goal)),), self._start)
            self._weights = solved.weights
            self.seconds.append(solved.seconds)
        return self._weights

    def steepest(self, path: Floats) -> float:
        """Follow the mouse along a path (m, 2) of one length per step; return the largest change per length.

        The first of its places is where the mouse is already.
        """
        weights = np.array([self._weights, *map(self.pull, path[1:])])
        step = float(np.linalg.norm(path[1] - path[0]))
        return float(np.abs(np.diff(weights, axis=0)).max(initial=0.0)) / step


def drag_point(rig: Rig, method: Method, vertex: int, reach: Floats, sizes: Sequence[float]) -> PointDrags:
    """Drag one vertex in four directions, by every size.

    Parameters
    ----------
    reach : (4,) float64
        How far the shapes can carry it in each direction, lengths.
    sizes : sequence of float
        Lengths of the drags, in per cent of the face height.
    """
    grip = Grip(rig, method, vertex)
    rows = rig.rows_at([vertex])[:2]
    far_away = measures.moves(rig.neutral, rig.neutral[vertex]) > FAR * rig.height
    pixel = PIXEL * rig.height
    found = np.zeros((5, len(sizes), len(DIRECTIONS)))
    for place, percent in enumerate(sizes):
        size = percent / 100 * rig.height
        turning = 0.0
        for at, direction in enumerate(DIRECTIONS):
            grip.press()
            steepest = grip.steepest(straight(size, pixel) * direction)
            weights = grip.pull(size * direction)
            amounts = rig.amounts(weights)
            missing = size * direction - rows @ amounts
            moved = rig.columns.product(amounts).reshape(-1, 3)[far_away]
            if at == 0:  # the answer depends on where the mouse is, so one way round is every way round
                turning = grip.steepest(circle(size, pixel))
            edge = max(size, float(reach[at])) * direction
            within = grip.pull(edge)
            over = np.abs(grip.pull(OVERDRAG * edge) - within).max(initial=0.0)
            found[:, place, at] = (
                np.linalg.norm(missing) / size,
                np.linalg.norm(moved, axis=1).max(initial=0.0) / size,
                measures.active(weights),
                steepest * pixel,
                over,
            )
        found[3, place] = np.maximum(found[3, place], turning * pixel)
    seconds = float(np.median(grip.seconds)) if grip.seconds else np.nan
    lag, far, active, per_pixel, overdrag = found
    return PointDrags(lag, far, active, per_pixel, overdrag, seconds)


def straight(size: float, pixel: float) -> Floats:
    """Return distances (m, 1) from 0 to `size` in even steps of a pixel at most."""
    return np.linspace(0.0, size, ceil(size / pixel - 1e-9) + 1)[:, None]


def circle(size: float, pixel: float) -> Floats:
    """Return places (m, 2) once round the press, from its right, in even steps of a pixel at most."""
    angles = np.linspace(0.0, 2 * pi, max(ceil(2 * pi * size / pixel), 8) + 1)
    return size * np.stack([np.cos(angles), np.sin(angles)], axis=1)
