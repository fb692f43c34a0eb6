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
    """The price of motion."""

    price: float = setting(
        0.1,
        "What it costs to use a shape: more leaves fewer shapes active, less brings the pins closer.",
        low=0.0,
        high=10.0,
        log=True,
    )


def prepare(system: PinSystem, settings: SparseSettings) -> Solve:
    """w = argmin ½‖J w - d‖² + Σ λⱼ max(wⱼ - w0ⱼ, 0) with l ≤ w ≤ u, and λⱼ = λ mⱼ √scale.

    mⱼ (`system.sizes`) is the largest vertex move of shape j, so what is paid for is motion of the face, not
    travel of a slider: a shape that moves the face by a millimetre may go all the way for what a tenth of a
    centimetre costs.  λ (`price`) has no unit; √scale is the rms of all mⱼ.

    w0 is the last pose that no drag made (see `SolverKind.afresh`).  For most faces that is the neutral:
    w0 = 0, and the price is λⱼ wⱼ.  What was set by hand is not punished: lowering it costs nothing, and
    while every goal is where its vertex was at w0, the answer is w0.  Where limits allow w < 0 and w0 ≤ 0,
    going down costs as much as going up.  Shapes that move no pin keep w0.

    Notes: `steps` of the active-set method, and `optimality` (see `facepin.solvers.boxed.Minimum`).
    """
    minimise = prepare_boxed(system, RIDGE * system.scale)
    unit = system.scale**0.5
    sizes = np.full(system.rows.shape[1], unit) if system.sizes is None else system.sizes
    price = settings.price * unit * sizes

    def solve(displacement: Floats, start: Floats) -> Solution:
        leaving = Price(start, np.where(start >= 0, price, 0.0), np.where(start <= 0, price, 0.0))
        found = minimise(displacement, start, leaving)
        return Solution(found.weights, {"steps": float(found.steps), "optimality": found.optimality})

    return solve


KIND = SolverKind(
    key="sparse",
    title="Sparse",
    summary="Reaches for the pins with as few shapes as it can, never out of their limits.",
    settings=SparseSettings,
    prepare=prepare,
    obeys_limits=True,
    afresh=True,
)
