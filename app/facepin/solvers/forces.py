"""The balance of forces between hands that pull at rows of a face and shapes that resist as springs.

Minimises over x (k,), the change of the weights,

    Σ κᵢ ρ(bᵢ - Kᵢ x) + Σ max(cⱼ⁺ xⱼ, -cⱼ⁻ xⱼ) + ½ Σ qⱼ xⱼ²,   l ≤ x ≤ u,

where the rows K (r, k) come in groups, ρ(r) = |r| - δ/2 beyond δ and |r|² / 2δ within: a pull of force κ
at most, whose direction and not whose length counts.  A one-sided row pulls only while b - K x > 0.

It is solved for the forces y (r,).  A shape answers to the work that forces do along it, g = Kᵀ y, alone:

    xⱼ = clip((gⱼ - cⱼ⁺)₊ / qⱼ - (-gⱼ - cⱼ⁻)₊ / qⱼ, lⱼ, uⱼ).

This is the paper's transposition w = Jᵀ m (Eq. 6 and 7) with forces for m and with a price, a spring and
a stop at every shape; what is looked for are the forces that are in balance with what the pins then miss.
They are the maximum of a concave function of as many numbers as there are rows, two or three for a pin,
however many shapes there are.  Newton's method with an active set finds it in a few steps, from the last
frame's forces in one or two.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from facepin.solvers.interface import Floats

TOLERANCE = 1e-12
"""Gap between the two objectives, as a share of the work that the pulls would do, at which forces balance."""
MOST_STEPS = 200
LEAST_STEP = 1e-3
"""Share of a Newton step below which going on that way is given up."""


@dataclass(frozen=True, eq=False)
class Springs:
    """How shapes resist being changed.  Forces are pure numbers, so work is a length; all (k,)."""

    raising: Floats
    """c⁺ ≥ 0, lengths per unit of weight: the work it takes to raise a weight at all."""
    lowering: Floats
    """c⁻ ≥ 0, the same for lowering it."""
    stiffness: Floats
    """q > 0, lengths per squared unit of weight."""
    low: Floats
    """l ≤ 0"""
    high: Floats
    """u ≥ 0"""

    def answer(self, work: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        """Return the changes x (k,) for the work g (k,) along each shape, and which are free to move."""
        wanted = (
            np.maximum(work - self.raising, 0.0) - np.maximum(-work - self.lowering, 0.0)
        ) / self.stiffness
        change = np.minimum(np.maximum(wanted, self.low), self.high)
        return change, (change == wanted) & (wanted != 0.0)

    def cost(self, change: Floats) -> float:
        """Return what a change (k,) costs."""
        priced = np.maximum(self.raising * change, -self.lowering * change)
        return float(priced.sum() + 0.5 * (self.stiffness * change) @ change)


@dataclass(frozen=True, eq=False)
class Pulls:
    """Rows of the face that are pulled at, in groups of one, two or three."""

    rows: Floats
    """K (r, k)"""
    starts: NDArray[np.intp]
    """(p,) first row of each group, ascending."""
    strengths: Floats
    """κ (p,) > 0"""
    slacks: Floats
    """δ (p,) > 0, lengths within which a pull fades."""
    one_sided: NDArray[np.bool_]
    """(p,) groups of a single row that pull one way only."""


@dataclass(frozen=True, eq=False)
class Balance:
    """What the pulls lead to."""

    change: Floats
    """x (k,)"""
    forces: Floats
    """y (r,), of each group at most κ long."""
    steps: int
    gap: float
    """How far the objective can at most be above its minimum, as a share of the work of the pulls."""


def balance(pulls: Pulls, springs: Springs, wanted: Floats, guess: Floats) -> Balance:
    """Find the forces that balance.

    Parameters
    ----------
    pulls, springs
        Who pulls where, and what resists.
    wanted : (r,) float64
        b, the moves of the rows that are asked for.
    guess : (r,) float64
        Forces to begin with, e.g. the last frame's; the answer does not depend on them.
    """
    problem = _Problem(pulls, springs, wanted)
    here = problem.state(problem.projected(guess))
    scale = problem.pulled(problem.missing(np.zeros(len(springs.low)))) or 1.0
    steps = 0
    while True:
        gap = (here.cost + problem.pulled(here.missing) - here.value) / scale
        if gap <= TOLERANCE or steps == MOST_STEPS:
            break
        steps += 1
        there = problem.improved(here)
        if there is None:  # rounding is all that is left
            break
        here = there
    return Balance(here.change, here.forces, steps, gap)


@dataclass(frozen=True, eq=False)
class _State:
    forces: Floats
    value: float
    """Of the dual objective."""
    change: Floats
    free: NDArray[np.bool_]
    missing: Floats
    """b - K x (r,)"""
    cost: float


class _Problem:
    """The concave function of the forces, and its Newton steps."""

    def __init__(self, pulls: Pulls, springs: Springs, wanted: Floats) -> None:
        self._pulls, self._springs, self._wanted = pulls, springs, wanted
        sizes = np.diff(np.append(pulls.starts, len(wanted)))
        self._sizes = sizes
        self._group = np.repeat(np.arange(len(sizes)), sizes)
        self._damping = (pulls.slacks / pulls.strengths)[self._group]
        self._one_sided = pulls.one_sided[self._group]
        self._supple = pulls.rows / springs.stiffness

    def state(self, forces: Floats) -> _State:
        """Evaluate the dual objective, b·y - Σ δ|y|²/2κ - Σ φ*(g)."""
        change, free = self._springs.answer(forces @ self._pulls.rows)
        missing, cost = self.missing(change), self._springs.cost(change)
        value = float(forces @ (missing - 0.5 * self._damping * forces)) + cost
        return _State(forces, value, change, free, missing, cost)

    def missing(self, change: Floats) -> Floats:
        """Return what the rows miss, b - K x (r,)."""
        missing: Floats = self._wanted - self._pulls.rows @ change
        return missing

    def pulled(self, missing: Floats) -> float:
        """Return Σ κ ρ(r) for what rows miss (r,); a one-sided row with more than it wants misses nothing."""
        pulls = self._pulls
        lengths = self._lengths(np.where(self._one_sided, np.maximum(missing, 0.0), missing))
        inside = lengths <= pulls.slacks
        halves = 0.5 * pulls.slacks
        pulled = np.where(inside, lengths**2 / (2.0 * pulls.slacks), lengths - halves)
        return float(pulls.strengths @ pulled)

    def projected(self, forces: Floats) -> Floats:
        """Return the nearest forces (r,) that the groups can have."""
        forces = np.where(self._one_sided, np.maximum(forces, 0.0), forces)
        lengths = self._lengths(forces)
        return forces * np.minimum(1.0, self._pulls.strengths / np.maximum(lengths, 1e-300))[self._group]

    def improved(self, here: _State) -> _State | None:
        """Return a state of a higher value, or None where none is to be found."""
        slope = here.missing - self._damping * here.forces
        share, direction = 1.0, self._newton(here)
        while share >= LEAST_STEP:
            there = self.state(self.projected(here.forces + share * direction))
            if there.value > here.value + 1e-4 * max(float(slope @ (there.forces - here.forces)), 0.0):
                return there
            share *= 0.5
        # Newton's step leads nowhere where it jumps between pieces; uphill is always right.
        curvature = float(np.einsum("ij,ij->", self._supple, self._pulls.rows) + self._damping.max())
        share = 64.0 / curvature
        while share >= 0.25 / curvature:
            there = self.state(self.projected(here.forces + share * slope))
            if there.value > here.value:
                return there
            share *= 0.25
        return None

    def _lengths(self, rows: Floats) -> Floats:
        return np.sqrt(np.add.reduceat(rows * rows, self._pulls.starts))

    def _newton(self, here: _State) -> Floats:
        """Solve for the change of forces at which all conditions hold, were they linear.

        A pull that misses less than its slack is a spring, y = κ (b - K x) / δ; one that misses more has
        its full force, y = κ r / |r|, and turns with r.
        """
        pulls, missing = self._pulls, here.missing
        yielding = (self._supple * here.free) @ pulls.rows.T
        matrix = yielding.copy()
        matrix.flat[:: len(matrix) + 1] += self._damping
        right = missing - self._damping * here.forces
        # Where each group would go alone tells whether it has its full force, none, or something between.
        alone = here.forces + right / matrix.diagonal()
        lengths = self._lengths(missing)
        for group in np.flatnonzero((self._lengths(alone) > pulls.strengths) | pulls.one_sided):
            start, full = pulls.starts[group], pulls.strengths[group]
            if self._sizes[group] == 1:
                force = min(max(alone[start], 0.0 if pulls.one_sided[group] else -full), full)
                if force != alone[start]:
                    matrix[start] = 0.0
                    matrix[start, start] = 1.0
                    right[start] = force - here.forces[start]
                continue
            if lengths[group] <= pulls.slacks[group]:
                continue
            rows = slice(start, start + self._sizes[group])
            way = missing[rows] / lengths[group]
            turn = lengths[group] / full
            across = np.eye(self._sizes[group]) - np.outer(way, way)
            matrix[rows] = across @ yielding[rows]
            matrix[rows, rows] += turn * np.eye(self._sizes[group])
            right[rows] = missing[rows] - turn * here.forces[rows]
        try:
            return np.asarray(np.linalg.solve(matrix, right), np.float64)
        except np.linalg.LinAlgError:
            return missing - self._damping * here.forces
