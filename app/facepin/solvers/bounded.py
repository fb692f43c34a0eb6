"""Least squares within the limits of the shapes, held near the start."""

from dataclasses import dataclass

import numpy as np

from facepin.solvers.boxed import Price
from facepin.solvers.interface import Floats, PinSystem, Solution, Solve, SolverKind, setting
from facepin.solvers.ties import prepare_tied


@dataclass(frozen=True)
class BoundedSettings:
    """The strength of the regularisation."""

    alpha: float = setting(
        0.1,
        "How strongly weights are held near the pose that was set by hand.",
        low=1e-6,
        high=10.0,
        log=True,
        ends=("exact", "calm"),
    )


def prepare(system: PinSystem, settings: BoundedSettings) -> Solve:
    """w = argmin ½‖J w - d‖² + ½ α ‖w - w0‖² with l ≤ w ≤ u; α in units of `system.scale`.

    w0 is the last pose that no drag made (see `SolverKind.afresh`), mostly the neutral.  Were it the weights
    at the press, what a drag brought in by mistake would stay: in the study that makes all errors larger, by
    half to several times, on every face tried and for any α.

    Notes: `steps` of the active-set method, and `optimality` (see `facepin.solvers.boxed.Minimum`).
    """
    minimise = prepare_tied(system, settings.alpha * system.scale)
    nothing = np.zeros(system.rows.shape[1])
    free = Price(nothing, nothing, nothing)

    def solve(displacement: Floats, start: Floats) -> Solution:
        found = minimise(displacement, start, free)
        return Solution(found.weights, {"steps": float(found.steps), "optimality": found.optimality})

    return solve


KIND = SolverKind(
    key="bounded",
    title="Many shapes (bounded)",
    summary="Spreads the work over many shapes, a little each, never out of their limits.",
    settings=BoundedSettings,
    prepare=prepare,
    obeys_limits=True,
    afresh=True,
)
