"""Equation 4: the pseudo-inverse regularised towards the start (Lewis and Anjyo 2010)."""

from dataclasses import dataclass

from facepin.solvers.interface import PinSystem, Solve, SolverKind, setting
from facepin.solvers.pseudo_inverse import decompose, linear_solve


@dataclass(frozen=True)
class TikhonovSettings:
    """The strength of the regularisation, and its unit."""

    alpha: float = setting(
        0.001,
        "How strongly weights are held where they were.",
        low=0.0,
        high=1000.0,
        log=True,
        ends=("exact", "calm"),
    )
    relative: bool = setting(
        False,
        "Measures alpha against the size of the face's movements: the same on any model, in any unit.",
    )


def prepare(system: PinSystem, settings: TikhonovSettings) -> Solve:
    """w = (JᵀJ + αI)⁻¹ (Jᵀd + α w0), written as w0 + (JᵀJ + αI)⁻¹ Jᵀ r.

    The matrix is formed from the singular values s as s / (s² + α), which stays accurate where JᵀJ + αI is
    almost singular.  For α = 0 the equation turns into Eq. 3, as the paper says, with the same cut-off.

    Notes: `alpha`, in squared length units.
    """
    parts = decompose(system.rows)
    alpha = settings.alpha * (system.scale if settings.relative else 1.0)
    factors = parts.values / (parts.values**2 + alpha) if alpha > 0 else parts.inverted_values()
    return linear_solve(system.rows, parts.filtered(factors), {"alpha": alpha})


KIND = SolverKind(
    key="tikhonov",
    title="Smoothed (Tikhonov, Lewis & Anjyo 2010)",
    summary="Gives up a little of meeting the pins for smaller weights.",
    settings=TikhonovSettings,
    prepare=prepare,
)
