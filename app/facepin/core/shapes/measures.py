"""What is measured about a pose: how far it is from a reference and from its pins, and what moved unasked.

Weights are (k,), positions (n, 3).  Lengths are in the rig's unit; `percent` turns them into per cent of the
face height, the unit in which faces of different sizes are compared.
"""

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats, Points
from facepin.core.pose import Pin

ACTIVE = 0.05
"""A shape whose weight is larger than this counts as active: below, it is hard to see."""
REST = 1e-3
"""A vertex that moves by less than this share of the face height counts as resting."""
LIMIT_SLACK = 1e-6
"""How far a weight may pass its limit by rounding without counting as out of range."""


def weight_errors(weights: Floats, reference: Floats) -> Floats:
    """Return |w - w̄| of every shape, (k,): what Figure 6 of the paper draws."""
    errors: Floats = np.abs(weights - reference)
    return errors


def e_rms(weights: Floats, reference: Floats) -> float:
    """Root mean square of w - w̄ over all shapes (Eq. 9); 0 without shapes."""
    return float(np.sqrt(np.mean(weight_errors(weights, reference) ** 2))) if len(weights) else 0.0


def pin_errors(positions: Points, pins: tuple[Pin, ...]) -> Floats:
    """Return how far each pin's vertex is from its goal, (p,) lengths.

    For a `screen` pin, only what shows on its screen: the distance along its two axes.  Stiffness has no part
    in it.
    """
    goals = np.array([pin.goal for pin in pins], np.float64).reshape(-1, 3)
    missing = goals - positions[[pin.vertex for pin in pins]]
    for row, pin in zip(missing, pins, strict=True):
        if pin.freedom == "screen":
            row[:] = [*np.asarray(pin.axes, np.float64) @ row, 0.0]
    lengths: Floats = np.linalg.norm(missing, axis=1)
    return lengths


def pin_error(positions: Points, pins: tuple[Pin, ...]) -> float:
    """Return the mean of `pin_errors`, a length; 0 without pins."""
    return float(pin_errors(positions, pins).mean()) if pins else 0.0


def moves(positions: Points, origin: Points) -> Floats:
    """Return how far each vertex is from where it was, (n,) lengths: what a heat map shows."""
    lengths: Floats = np.linalg.norm(np.subtract(positions, origin, dtype=np.float64), axis=-1)
    return lengths


def resting(reference: Points, neutral: Points, height: float) -> NDArray[np.bool_]:
    """Return which vertices the reference pose leaves at rest, (n,): moved less than `REST` of the height."""
    return moves(reference, neutral) < REST * height


def far_motion(positions: Points, neutral: Points, at_rest: NDArray[np.bool_]) -> float:
    """Return the largest move of a vertex that should rest (see `resting`), a length; 0 if none should."""
    return float(np.max(moves(positions[at_rest], neutral[at_rest]), initial=0.0))


def far_from_pins(neutral: Points, pins: tuple[Pin, ...], distance: float) -> NDArray[np.bool_]:
    """Return which vertices are further than `distance` from every pin on the neutral, (n,).

    Stands in for `resting` while there is no reference pose: a drag should not be felt there.  Straight
    distance; all vertices without pins.
    """
    far = np.ones(len(neutral), bool)
    for pin in pins:
        far &= moves(neutral, neutral[pin.vertex]) > distance
    return far


def vertex_error(positions: Points, reference: Points) -> float:
    """Return the mean distance of the vertices from where the reference pose has them, a length."""
    return float(moves(positions, reference).mean()) if len(positions) else 0.0


def out_of_range(weights: Floats, limits: Floats) -> int:
    """Return how many weights are outside their limits, (k, 2) lowest and highest."""
    low, high = limits.T
    return int(np.count_nonzero((weights < low - LIMIT_SLACK) | (weights > high + LIMIT_SLACK)))


def active(weights: Floats) -> int:
    """Return how many shapes are active: |w| > `ACTIVE`."""
    return int(np.count_nonzero(np.abs(weights) > ACTIVE))


def travel(path: Floats) -> float:
    """Return the way all weights went along a path, (frames, k): the sum of |change| over shapes and frames.

    Compared with |last - first|, it tells how much they jittered.
    """
    return float(np.abs(np.diff(path, axis=0)).sum())


def percent(length: float, height: float) -> float:
    """Return a length in per cent of the face height."""
    return 100.0 * length / height
