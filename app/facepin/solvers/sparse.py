"""Few active shapes within their limits."""

from dataclasses import dataclass

import numpy as np

from facepin.solvers.boxed import Price
from facepin.solvers.interface import Floats, PinSystem, Solution, Solve, SolverKind, setting
from facepin.solvers.ties import prepare_tied

RIDGE = 1e-6
"""Pull towards the start, in units of `system.scale`: picks one answer where several cost the same (two equal
shapes, say), and is too weak to be seen."""

LEAST = 1 / 3
"""A shape is priced as if it moved the face by at least this share of what shapes usually do."""


@dataclass(frozen=True)
class SparseSettings:
    """The price of motion."""

    price: float = setting(
        0.1,
        "What it costs to use a shape.",
        low=0.0,
        high=10.0,
        log=True,
        ends=("follow closely", "few shapes"),
    )


def prepare(system: PinSystem, settings: SparseSettings) -> Solve:
    """w = argmin ½‖J w - d‖² + Σ λⱼ max(wⱼ - w0ⱼ, 0) with l ≤ w ≤ u, where λⱼ = λ √scale max(mⱼ, √scale / 3).

    mⱼ (`system.sizes`) is the largest vertex move of shape j, and √scale the rms of them all; λ (`price`) has
    no unit.  So what is paid for is motion of the face, not travel of a slider: with one price for all
    weights the jaw is cheap for what it moves, and gets used for what lips and cheeks should do.  But a shape
    that hardly moves anything must not cost next to nothing, or it is put to use for the trembling of a hand.
    Measured with the study on three faces, two seeds each: every single price for all weights, from 0.03 to
    0.2, ends with a larger vertex error, the best of them by 6 to 37 %; and on a face with 100 identities
    besides its 53 expressions, E_RMS without the least price is twice as large.

    w0 is the last pose that no drag made (see `SolverKind.afresh`).  For most faces that is the neutral:
    w0 = 0, and the price is λⱼ wⱼ.  What was set by hand is not punished: lowering it costs nothing, and
    while every goal is where its vertex was at w0, the answer is w0.  Where limits allow w < 0 and w0 ≤ 0,
    going down costs as much as going up.  Shapes that move no pin keep w0.

    Notes: `steps` of the active-set method, and `optimality` (see `facepin.solvers.boxed.Minimum`).
    """
    minimise = prepare_tied(system, RIDGE * system.scale)
    unit = system.scale**0.5
    sizes = np.full(system.rows.shape[1], unit) if system.sizes is None else system.sizes
    price = settings.price * unit * np.maximum(sizes, LEAST * unit)

    def solve(displacement: Floats, start: Floats) -> Solution:
        leaving = Price(start, np.where(start >= 0, price, 0.0), np.where(start <= 0, price, 0.0))
        found = minimise(displacement, start, leaving)
        return Solution(found.weights, {"steps": float(found.steps), "optimality": found.optimality})

    return solve


KIND = SolverKind(
    key="sparse",
    title="Few shapes (sparse)",
    summary="Reaches for the pins with as few shapes as it can, never out of their limits.",
    settings=SparseSettings,
    prepare=prepare,
    obeys_limits=True,
    afresh=True,
)
