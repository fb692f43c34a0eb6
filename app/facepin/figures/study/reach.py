"""How far the shapes of a rig can carry a point of it: what no solver within limits can better."""

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.pose import FRONT_AXES, Pin, as_vector, pin_rows
from facepin.core.rig import Rig
from facepin.core.shapes.answering import answering
from facepin.solvers.boxed import Price
from facepin.solvers.interface import PinSystem
from facepin.solvers.ties import prepare_tied

LEFT_OVER = 0.1
"""A drag can be reached if less than this share of it is left over by the shapes' best."""
HALVINGS = 14
"""The end of the reach is found to 1 / 2^14 of what all shapes together could do."""
RIDGE = 1e-9
"""In units of the largest squared column: least squares, but for rounding."""


class Reach:
    """What the shapes can do for one vertex seen from the front, from the neutral, within limits and ties."""

    def __init__(self, rig: Rig, vertex: int) -> None:
        pin = Pin(vertex, as_vector(rig.neutral[vertex]), "screen", FRONT_AXES)
        none = np.zeros(rig.shape_count)
        self._rows = rig.slopes(pin_rows(rig, (pin,)), none)
        squares = np.einsum("ij,ij->j", self._rows, self._rows)
        # Eyes and tongue are none of the skin's business: what they would do to it is not within its reach.
        self._rows = np.where(answering(rig, [vertex]), self._rows, 0.0)
        system = PinSystem(self._rows, rig.limits, ties=rig.ties)
        self._minimise = prepare_tied(system, RIDGE * float(squares.max(initial=0.0)))
        self._start, self._price = none, Price(none, none, none)
        self._most = float(np.sqrt(squares) @ np.abs(rig.limits).max(axis=1, initial=0.0))

    def missed(self, move: Floats) -> float:
        """Return how far the best weights stay from a move (2,) of the vertex, a length."""
        weights = self._minimise(move, self._start, self._price).weights
        return float(np.linalg.norm(move - self._rows @ weights))

    def far(self, direction: Floats) -> float:
        """Return the length up to which drags along a unit vector (2,) can be reached; 0 if none can.

        The share that is left over grows with the length: what the weights can do is a convex set.
        """
        low, high = 0.0, self._most / (1 - LEFT_OVER)
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            if self.missed(middle * direction) < LEFT_OVER * middle:
                low = middle
            else:
                high = middle
        return low
