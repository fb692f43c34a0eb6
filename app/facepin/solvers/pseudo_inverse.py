"""Equation 3: the pseudo-inverse of the pin rows, and the decomposition it shares with its relatives."""

from dataclasses import dataclass

import numpy as np

from facepin.solvers.interface import Floats, PinSystem, Solution, Solve, SolverKind

CUTOFF = 1e-15
"""Singular values below this share of the largest count as zero.  The default of `numpy.linalg.pinv`, on
purpose: it is what "classic" means in the paper, and what makes the method unstable."""


@dataclass(frozen=True, eq=False)
class Decomposition:
    """J = left diag(values) right with orthonormal columns and rows, q = min(r, k)."""

    left: Floats
    """(r, q)"""
    values: Floats
    """(q,) singular values, largest first."""
    right: Floats
    """(q, k)"""

    def inverted_values(self) -> Floats:
        """Return (q,) 1 / values, and 0 where a value is below the cut-off."""
        kept = self.values > CUTOFF * self.values.max(initial=0.0)
        return np.divide(1.0, self.values, out=np.zeros_like(self.values), where=kept)

    def filtered(self, factors: Floats) -> Floats:
        """Return right.T diag(factors) left.T, (k, r): the pseudo-inverse when the factors are 1 / values."""
        product: Floats = self.right.T @ (factors[:, None] * self.left.T)
        return product


def decompose(rows: Floats) -> Decomposition:
    """Thin singular value decomposition of the pin rows, (r, k)."""
    return Decomposition(*np.linalg.svd(rows, full_matrices=False))


def linear_solve(rows: Floats, inverse: Floats, notes: dict[str, float]) -> Solve:
    """Return the solver w0 + inverse (d - J w0) for a fixed (k, r) matrix."""

    def solve(displacement: Floats, start: Floats) -> Solution:
        return Solution(start + inverse @ (displacement - rows @ start), notes)

    return solve


@dataclass(frozen=True)
class PseudoInverseSettings:
    """Nothing to set."""


def prepare(system: PinSystem, settings: PseudoInverseSettings) -> Solve:
    """w = w0 + J⁺ r, with J⁺ as `numpy.linalg.pinv` computes it (Eq. 3 for w0 = 0).

    Notes: `rank`, the singular values kept, and `smallest`, the smallest of them.
    """
    parts = decompose(system.rows)
    inverted = parts.inverted_values()
    rank = np.count_nonzero(inverted)
    notes = {"rank": float(rank), "smallest": float(parts.values[rank - 1]) if rank else 0.0}
    return linear_solve(system.rows, parts.filtered(inverted), notes)


KIND = SolverKind(
    key="pseudo_inverse",
    title="Exact (pseudo-inverse)",
    summary="Meets the pins as exactly as the shapes allow, at the price of moving the rest of the face.",
    settings=PseudoInverseSettings,
    prepare=prepare,
)
