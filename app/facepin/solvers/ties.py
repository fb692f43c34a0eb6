"""Least squares with limits that are other weights: a tied weight may be at most as large as another one.

For the weights a and b of a tie,  w_a - w_b ≤ s  with s = max(0, w0_a - w0_b): a pose that begins beyond the
tie may stay there.  With the price μ ≥ 0 on w_a - w_b, the minimum within limits has a gap w_a - w_b that
falls as μ rises, without jumps.  The μ that closes the gap to s gives the minimum of the tied problem, which
is convex and has but one: no approximation is made, and where no tie is in the way nothing is changed.
"""

from collections.abc import Callable
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

    def obeying(displacement: Floats, start: Floats, price: Price) -> Minimum:
        slack = np.maximum(start[tied] - start[other], 0.0)
        prices = np.zeros(len(ties))
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
                _close(partial(gap, tie), curvature)
            if len(ties) == 1 or np.abs(prices - before).max() <= CLOSE * curvature:
                break
        weights = found.weights
        # The last 1e-9 of the gap.
        weights[tied] = np.minimum(weights[tied], np.maximum(weights[other] + slack, weights[tied] - CLOSE))
        return Minimum(weights, steps, found.optimality)

    return obeying


def _close(gap: Callable[[float], float], curvature: float) -> None:
    """Find the least price ≥ 0 at which a gap, falling with it, is at most 0; ask for that one last."""
    low, above = 0.0, gap(0.0)
    if above <= CLOSE:
        return
    high = above * curvature
    while (below := gap(high)) > CLOSE and high < 1e12 * curvature:
        low, above, high = high, below, 4.0 * high
    if abs(below) <= CLOSE:
        return
    # The gap is made of straight pieces: the false position, halving an end that stays (Illinois).
    side = 0
    for _ in range(MOST_TRIES):
        middle = (low * below - high * above) / (below - above)
        value = gap(middle)
        if abs(value) <= CLOSE or high - low <= 1e-15 * high:
            return
        if value > 0:
            low, above = middle, value
            below = 0.5 * below if side > 0 else below
            side = 1
        else:
            high, below = middle, value
            above = 0.5 * above if side < 0 else above
            side = -1
