"""Equation 8: pseudo-inverse and transposition, mixed by γ."""

from dataclasses import dataclass

import numpy as np

from facepin.solvers.interface import Floats, PinSystem, Solution, Solve, SolverKind, setting
from facepin.solvers.pseudo_inverse import decompose
from facepin.solvers.transpose import STEP_HELP, STEPS, step_length


@dataclass(frozen=True)
class HybridSettings:
    """The mixture, and the transposition's step."""

    automatic: bool = setting(True, "Takes gamma from the pins: nearer 1 with few, nearer 0 with many.")
    gamma: float = setting(
        0.1,
        "The mixture: 0 is the transposition, 1 the pseudo-inverse.",
        low=0.0,
        high=1.0,
        when=("automatic", False),
        ends=("shared", "exact"),
    )
    step: str = setting("exact", STEP_HELP, choices=STEPS)


def prepare(system: PinSystem, settings: HybridSettings) -> Solve:
    """w = w0 + (γ J⁺ + (1 - γ) τ Jᵀ) r (Eq. 8 for w0 = 0, τ = 1).

    The automatic γ is the smallest of the min(r, k) singular values of Jᵀ (section 4, "Parametrization of the
    hybrid approach"), clipped to 0..1.  It has the unit of the rig: that is the paper's definition.

    Notes: `gamma` and `step`.
    """
    rows = system.rows
    parts = decompose(rows)
    inverse = parts.filtered(parts.inverted_values())
    length = step_length(rows, settings.step)
    smallest = float(np.min(parts.values, initial=1.0))
    gamma = smallest if settings.automatic else settings.gamma

    def solve(displacement: Floats, start: Floats) -> Solution:
        missing = displacement - rows @ start
        direction = missing @ rows
        step = length(direction, missing)
        change = gamma * (inverse @ missing) + (1.0 - gamma) * step * direction
        return Solution(start + change, {"gamma": gamma, "step": step})

    return solve


KIND = SolverKind(
    key="hybrid",
    title="Shared and exact (hybrid, Cetinaslan 2017)",
    summary="Meets few pins exactly, shares the pull of many.",
    settings=HybridSettings,
    prepare=prepare,
)
