"""Few active shapes within their limits."""

from dataclasses import dataclass

import numpy as np

from facepin.solvers.boxed import prepare_boxed
from facepin.solvers.interface import Floats, PinSystem, Solution, Solve, SolverKind, setting

RIDGE = 1e-6
"""Pull towards the start, in units of `system.scale`: picks one answer where several cost the same (two equal
shapes, say), and is too weak to be seen."""


@dataclass(frozen=True)
class SparseSettings:
    """The price of a weight."""

    price: float = setting(
        0.03,
        "What it costs to use a shape: more leaves fewer shapes active, less brings the pins closer.",
        low=0.0,
        high=10.0,
        log=True,
    )


def prepare(system: PinSystem, settings: SparseSettings) -> Solve:
    """w = argmin ½‖J w - d‖² + λ Σ |w| with l ≤ w ≤ u; λ (`price`) in units of `system.scale`.

    With the usual limits, 0 and up, Σ |w| is Σ w.  Shapes that move no pin keep their weight.

    Notes: `steps` of the active-set method, and `optimality` (see `facepin.solvers.boxed.Minimum`).
    """
    minimise = prepare_boxed(system, RIDGE * system.scale, settings.price * system.scale)
    zero = np.zeros(system.rows.shape[1])

    def solve(displacement: Floats, start: Floats) -> Solution:
        found = minimise(displacement, start, zero)
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
