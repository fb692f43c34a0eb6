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
however many shapes there are.  Newton's method with an active set finds it in a few steps: a pull at its full
force κ stays on the sphere of its directions, and how far to go is where the slope along the step ends, which
is cheap to know since every shape's answer is a line in pieces.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from facepin.solvers.interface import Floats

TOLERANCE = 1e-12
"""Gap between the two objectives, as a share of the work that the pulls would do, at which forces balance."""
CLOSE, IDLE, MOST_IDLE = 1e-4, 0.1, 3
"""From this gap on a step is idle that closes less than this share of it, and after so many in a row it is
good: where a shape is just about to move under a stiff row, steps go to and fro about nothing."""
MOST_STEPS = 80
LEAST_STEP = 1e-3
"""Share of a Newton step below which going on that way is given up."""
FLAT = 0.05
"""Share of the slope at the beginning of a step that is flat enough to end it."""
MOST_LOOKS = 16
"""Places along a step that are looked at."""
FULL = 1.0 - 1e-9
"""Share of its full force from which on a pull is taken to have it."""


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
        wanted = self._wanted(work)
        change = np.minimum(np.maximum(wanted, self.low), self.high)
        return change, (change == wanted) & (wanted != 0.0)

    def change(self, work: Floats) -> Floats:
        """Return the changes x (k,) alone."""
        return np.minimum(np.maximum(self._wanted(work), self.low), self.high)

    def _wanted(self, work: Floats) -> Floats:
        """Return what shapes would do without their limits: nothing until the work is worth the price."""
        idle = np.minimum(np.maximum(work, -self.lowering), self.raising)
        wanted: Floats = (work - idle) / self.stiffness
        return wanted

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
    steps = idle = 0
    while True:
        gap = (here.cost + problem.pulled(here.missing) - here.value) / scale
        if gap <= TOLERANCE or steps == MOST_STEPS:
            break
        steps += 1
        there = problem.improved(here)
        if there is None:  # rounding is all that is left
            break
        idle = idle + 1 if gap < CLOSE and there.value - here.value < IDLE * gap * scale else 0
        here = there
        if idle == MOST_IDLE:
            break
    return Balance(here.change, here.forces, steps, gap)


@dataclass(frozen=True, eq=False)
class _State:
    forces: Floats
    work: Floats
    """g = Kᵀ y (k,)"""
    value: float
    """Of the dual objective."""
    change: Floats
    free: NDArray[np.bool_]
    missing: Floats
    """b - K x (r,)"""
    slope: Floats
    """Of the dual objective, (r,)."""
    cost: float


class _Problem:
    """The concave function of the forces, and its Newton steps."""

    def __init__(self, pulls: Pulls, springs: Springs, wanted: Floats) -> None:
        self._pulls, self._springs, self._wanted = pulls, springs, wanted
        sizes = np.diff(np.append(pulls.starts, len(wanted)))
        self._group = np.repeat(np.arange(len(sizes)), sizes)
        self._damping = (pulls.slacks / pulls.strengths)[self._group]
        self._one_sided = pulls.one_sided[self._group]
        self._supple = pulls.rows / springs.stiffness
        single = np.flatnonzero(sizes == 1)
        self._single = pulls.starts[single]
        self._highest = pulls.strengths[single]
        self._lowest = np.where(pulls.one_sided[single], 0.0, -self._highest)
        self._round = [(size, np.flatnonzero(sizes == size)) for size in (2, 3) if np.any(sizes == size)]

    def state(self, forces: Floats) -> _State:
        """Evaluate the dual objective, b·y - Σ δ|y|²/2κ - Σ φ*(g)."""
        work = forces @ self._pulls.rows
        change, free = self._springs.answer(work)
        missing, cost = self.missing(change), self._springs.cost(change)
        damped = self._damping * forces
        value = float(forces @ (missing - 0.5 * damped)) + cost
        return _State(forces, work, value, change, free, missing, missing - damped, cost)

    def missing(self, change: Floats) -> Floats:
        """Return what the rows miss, b - K x (r,)."""
        missing: Floats = self._wanted - self._pulls.rows @ change
        return missing

    def pulled(self, missing: Floats) -> float:
        """Return Σ κ ρ(r) for what rows miss (r,); a one-sided row with more than it wants misses nothing."""
        pulls = self._pulls
        lengths = self._lengths(np.where(self._one_sided, np.maximum(missing, 0.0), missing))
        inside = np.minimum(lengths, pulls.slacks)
        # |r| - δ/2 beyond δ and |r|² / 2δ within, as one formula.
        return float(pulls.strengths @ (lengths - inside + inside * inside / (2.0 * pulls.slacks)))

    def projected(self, forces: Floats) -> Floats:
        """Return the nearest forces (r,) that the groups can have."""
        forces = np.where(self._one_sided, np.maximum(forces, 0.0), forces)
        lengths = self._lengths(forces)
        return forces * np.minimum(1.0, self._pulls.strengths / np.maximum(lengths, 1e-200))[self._group]

    def improved(self, here: _State) -> _State | None:
        """Return a state of a higher value, or None where none is to be found."""
        direction = self._newton(here)
        share = self._far_enough(here, direction)
        while share >= LEAST_STEP:
            there = self.state(self.projected(here.forces + share * direction))
            if there.value > here.value + 1e-4 * max(float(here.slope @ (there.forces - here.forces)), 0.0):
                return there
            share *= 0.5
        # Newton's step leads nowhere where it jumps between pieces; uphill is always right.
        curvature = float(np.einsum("ij,ij->", self._supple, self._pulls.rows) + self._damping.max())
        share = 64.0 / curvature
        while share >= 0.25 / curvature:
            there = self.state(self.projected(here.forces + share * here.slope))
            if there.value > here.value:
                return there
            share *= 0.25
        return None

    def _lengths(self, rows: Floats) -> Floats:
        return np.sqrt(np.add.reduceat(rows * rows, self._pulls.starts))

    def _far_enough(self, here: _State, direction: Floats) -> float:
        """Return the share of a step, at most 1, after which the objective rises hardly any more.

        Its slope along the step is a falling line in pieces, one for every shape that comes into play or to a
        stop; regula falsi and halving find where it ends.
        """
        work = direction @ self._pulls.rows
        damped = self._damping * direction
        wanted, damping = float(direction @ self._wanted - damped @ here.forces), float(damped @ direction)

        def slope(share: float) -> float:
            change = self._springs.change(here.work + share * work)
            return wanted - share * damping - float(work @ change)

        low, high = 0.0, 1.0
        at_low = first = float(direction @ here.slope)
        if first <= 0.0 or (at_high := slope(high)) >= -FLAT * first:
            return 1.0
        wide = np.inf
        for _ in range(MOST_LOOKS):
            share = (low * at_high - high * at_low) / (at_high - at_low)
            if high - low > 0.5 * wide:  # one end hardly moves: a kink is near the other
                share = 0.5 * (low + high)
            wide = high - low
            at_share = slope(share)
            if abs(at_share) < FLAT * first:
                return share
            if at_share > 0.0:
                low, at_low = share, at_share
            else:
                high, at_high = share, at_share
        return low or share

    def _newton(self, here: _State) -> Floats:
        """Return the change of forces (r,) at which the slope would be level, were the objective quadratic.

        A pull with its full force that would like more of it only turns: it moves in the plane that touches
        the sphere of its directions, where the sphere bends away as much as the slope presses against it
        (Newton's method on a manifold).  A single row goes to where it would go alone at most.
        """
        rows, free = self._pulls.rows, np.flatnonzero(here.free)
        matrix = self._supple[:, free] @ rows[:, free].T
        matrix.flat[:: len(matrix) + 1] += self._damping
        right = here.slope.copy()
        if len(self._single):
            at = self._single
            alone = here.forces[at] + right[at] / matrix[at, at]
            force = np.minimum(np.maximum(alone, self._lowest), self._highest)
            stopped = force != alone
            at = at[stopped]
            matrix[at] = 0.0
            matrix[at, at] = 1.0
            right[at] = force[stopped] - here.forces[at]
        starts, full = self._pulls.starts, self._pulls.strengths
        pressing = np.add.reduceat(here.forces * here.slope, starts)
        turning = (self._lengths(here.forces) >= FULL * full) & (pressing > 0.0)
        for size, groups in self._round:
            groups = groups[turning[groups]]
            if not len(groups):
                continue
            at = starts[groups][:, None] + np.arange(size)
            outward = here.forces[at] / full[groups][:, None]
            block = matrix[at]
            block -= outward[:, :, None] * (outward[:, None, :] @ block)
            matrix[at] = block
            bend = pressing[groups] / full[groups] ** 2
            damping = self._damping[at[:, 0]]
            matrix[at[:, :, None], at[:, None, :]] += (
                bend[:, None, None] * np.eye(size)
                + damping[:, None, None] * outward[:, :, None] * outward[:, None, :]
            )
            right[at] -= outward * np.sum(outward * right[at], axis=1, keepdims=True)
        try:
            return np.asarray(np.linalg.solve(matrix, right), np.float64)
        except np.linalg.LinAlgError:
            return here.slope
