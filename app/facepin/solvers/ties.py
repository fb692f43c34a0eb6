"""Least squares with limits that are other weights: a tied weight may be at most as large as another one.

For the weights a and b of a tie,  w_a - w_b ≤ s  with s = max(0, w0_a - w0_b): a pose that begins beyond the
tie may stay there.  With the price μ ≥ 0 on w_a - w_b, the minimum within limits has a gap w_a - w_b that
falls as μ rises, without jumps.  The μ that closes the gap to s gives the minimum of the tied problem, which
is convex and has but one: no approximation is made, and where no tie is in the way nothing is changed.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from facepin.solvers.boxed import Minimise, Minimum, Price, prepare_boxed
from facepin.solvers.interface import Floats, PinSystem

CLOSE = 1e-9
"""How near a gap has to come to its bound."""
MOST_TRIES = 100
MOST_SWEEPS = 30
"""Times that each of several ties is looked at again; a single one needs no second look."""


def prepare_tied(system: PinSystem, ridge: float) -> Minimise:
    """Prepare the minimisation of `boxed` with α = `ridge` ≥ 0, for a system that may have ties."""
    minimise, ties = prepare_boxed(system, ridge), system.ties
    if not ties:
        return minimise
    tied, other = np.array(ties).T
    # The largest second derivative along one weight tells where to look for μ.
    curvature = float(np.einsum("ij,ij->j", system.rows, system.rows).max(initial=0.0)) + ridge
    known = [_Known(0.0, -1.0 / curvature if curvature > 0 else -1.0) for _ in ties]

    def obeying(displacement: Floats, start: Floats, price: Price) -> Minimum:
        slack = np.maximum(start[tied] - start[other], 0.0)
        prices = np.array([each.price for each in known])
        steps = 0
        found: Minimum

        def gap(tie: int, value: float) -> float:
            nonlocal found, steps
            prices[tie] = value
            extra = np.zeros_like(start)
            np.add.at(extra, tied, prices)
            np.subtract.at(extra, other, prices)
            found = minimise(
                displacement, start, Price(price.centre, price.raising + extra, price.lowering - extra)
            )
            steps += found.steps
            return float(found.weights[tied[tie]] - found.weights[other[tie]] - slack[tie])

        for _ in range(MOST_SWEEPS):
            before = prices.copy()
            for tie in range(len(ties)):
                known[tie] = _close(partial(gap, tie), known[tie])
            if len(ties) == 1 or np.abs(prices - before).max() <= CLOSE * curvature:
                break
        weights = found.weights
        # The last 1e-9 of the gap.
        weights[tied] = np.minimum(weights[tied], np.maximum(weights[other] + slack, weights[tied] - CLOSE))
        return Minimum(weights, steps, found.optimality)

    return obeying


@dataclass(frozen=True)
class _Known:
    """What is known of a tie from the frame before: where to begin."""

    price: float
    slope: float
    """How its gap changes with its price, < 0."""


def _close(gap: Callable[[float], float], known: _Known) -> _Known:
    """Find the least price ≥ 0 at which a gap, falling with it, is at most 0; ask for that one last.

    The gap is made of straight pieces, so the secant is right once both its ends are on the right piece.
    Where it leads out of what is known, or every few times in case it creeps, the middle is taken instead.
    """
    low, high = -1.0, np.inf  # the gap is open at `low` (if that is ≥ 0) and closed at `high`
    price, slope = known.price, known.slope
    value = gap(price)
    for tries in range(1, MOST_TRIES):
        if abs(value) <= CLOSE or (price == 0.0 and value < 0.0):
            break
        low, high = (price, high) if value > 0 else (low, price)
        wanted = max(price - value / slope, 0.0)
        if not low < wanted < high or (tries % 4 == 0 and high < np.inf):
            wanted = 0.5 * (max(low, 0.0) + high) if high < np.inf else 4.0 * price
        if wanted == price:
            break
        before = price, value
        price, value = wanted, gap(wanted)
        secant = (value - before[1]) / (price - before[0])
        slope = secant if secant < 0.0 else slope
    return _Known(price, slope)
