"""Equations 6 and 7: the transposition, the paper's own method."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from facepin.solvers.interface import Floats, PinSystem, Solution, Solve, SolverKind, setting

STEPS = ("exact", "spectral", "unit")
STEP_HELP = (
    "Length of the step: exact goes as far as brings the pins closer, spectral is the safe fixed length, "
    "unit is the paper's letter and overshoots on faces in centimetres."
)

StepLength = Callable[[Floats, Floats], float]
"""(direction g (k,), missing r (r,)) -> τ."""


@dataclass(frozen=True)
class TransposeSettings:
    """How far, and how often, to step along the transposition's direction."""

    step: str = setting("exact", STEP_HELP, choices=STEPS)
    iterations: int = setting(
        1,
        "Steps per frame: one is the paper's, many approach the exact answer.",
        low=1,
        high=200,
        log=True,
        ends=("calm", "exact"),
    )
    radius: float = setting(
        0.0,
        "Prefers shapes that move the face near the pins: how far that reaches over the skin, in % of the "
        "face height; 0 treats all alike.",
        low=0.0,
        high=100.0,
    )


def step_length(rows: Floats, step: str) -> StepLength:
    """Return how far to go along g = Jᵀr, for one of the `STEPS`.

    `exact` minimises ‖r - τ J g‖, so τ = gᵀg / ‖J g‖²; `spectral` is 1 / σmax²; `unit` is 1.
    The paper prints 1 and names the step as future work (section 5).
    """
    if step == "unit":
        return lambda direction, missing: 1.0
    if step == "spectral":
        largest = float(np.linalg.norm(rows, 2)) if rows.size else 0.0
        fixed = 1.0 / largest**2 if largest > 0 else 0.0
        return lambda direction, missing: fixed
    # What is left of g when the pins are as close as they get is rounding: a step along it would be random.
    noise = np.finfo(np.float64).eps * float(np.linalg.norm(rows))

    def exact(direction: Floats, missing: Floats) -> float:
        squared = float(direction @ direction)
        moved = rows @ direction
        curvature = float(moved @ moved)
        if squared <= noise**2 * float(missing @ missing) or curvature == 0.0:
            return 0.0
        return squared / curvature

    return exact


def prepare(system: PinSystem, settings: TransposeSettings) -> Solve:
    """w = w0 + τ Jᵀ r, repeated `iterations` times with the r that is left (Eq. 6 for w0 = 0, τ = 1).

    With a `radius`, each weight is measured in units of √sⱼ, sⱼ being how much of shape j happens within it
    (`system.locality`): w = w0 + S^½ y, where y is found as above with J S^½ for J.  Shapes that only touch
    the pins in passing are then hardly used.  Confining edits to geodesic circles is an idea of Cetinaslan
    and Orvalho (2018); this weighting is ours.

    Notes: `step`, the τ of the last repetition.
    """
    scales = np.ones(system.rows.shape[1])
    if settings.radius > 0 and system.locality is not None:
        scales = np.sqrt(system.locality)
    rows = system.rows * scales
    length = step_length(rows, settings.step)

    def solve(displacement: Floats, start: Floats) -> Solution:
        missing, change, step = displacement - system.rows @ start, np.zeros_like(start), 0.0
        for _ in range(settings.iterations):
            left = missing - rows @ change
            direction = left @ rows
            step = length(direction, left)
            change = change + step * direction
            if step == 0.0:
                break
        return Solution(start + scales * change, {"step": step})

    return solve


KIND = SolverKind(
    key="transpose",
    title="Share the pull (transposition, Cetinaslan 2017)",
    summary="Moves each shape as much as it helps the pins: calm and local; pins may stay a little behind.",
    settings=TransposeSettings,
    prepare=prepare,
)
