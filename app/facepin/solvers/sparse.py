"""Few active shapes within their limits."""

from dataclasses import dataclass

import numpy as np

from facepin.solvers.boxed import Price, prepare_boxed
from facepin.solvers.interface import Floats, PinSystem, Solution, Solve, SolverKind, setting

RIDGE = 1e-6
"""Pull towards the start, in units of `system.scale`: picks one answer where several cost the same (two equal
shapes, say), and is too weak to be seen."""


@dataclass(frozen=True)
class SparseSettings:
    """The price of a weight, and what becomes of the weights that are there already."""

    price: float = setting(
        0.03,
        "What it costs to use a shape: more leaves fewer shapes active, less brings the pins closer.",
        low=0.0,
        high=10.0,
        log=True,
    )
    fresh: bool = setting(
        False, "Judges the whole face anew: shapes that no pin asks for fade away, also those set by hand."
    )


def prepare(system: PinSystem, settings: SparseSettings) -> Solve:
    """w = argmin ½‖J w - d‖² + λ Σ w with l ≤ w ≤ u; λ (`price`) in units of `system.scale`.

    That is for w0 = 0.  Later in a pose the price is relative to the drag like everything else: using a shape
    more than at the start costs λ, using it less costs nothing, λ Σ max(w - w0, 0).  So at the press, when
    every goal is where its vertex is, the answer is w0 and nothing jumps.  With `fresh` the sum is over w
    whatever w0 is: a weight that no pin holds up is gone with the first frame.  Where limits allow w < 0, |w|
    takes the place of w.  Shapes that move no pin keep their weight in either case.

    Notes: `steps` of the active-set method, and `optimality` (see `facepin.solvers.boxed.Minimum`).
    """
    minimise = prepare_boxed(system, RIDGE * system.scale)
    price = np.full(system.rows.shape[1], settings.price * system.scale)
    everywhere = Price(np.zeros_like(price), price, price)

    def solve(displacement: Floats, start: Floats) -> Solution:
        growth = Price(start, np.where(start >= 0, price, 0.0), np.where(start <= 0, price, 0.0))
        found = minimise(displacement, start, everywhere if settings.fresh else growth)
        return Solution(found.weights, {"steps": float(found.steps), "optimality": found.optimality})

    return solve


KIND = SolverKind(
    key="sparse",
    title="Sparse",
    summary="Reaches for the pins with as few shapes as it can, never out of their limits.",
    settings=SparseSettings,
    prepare=prepare,
    obeys_limits=True,
)
