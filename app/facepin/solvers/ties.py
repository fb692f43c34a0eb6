"""Least squares with limits that are other weights: a tied weight may be at most as large as another one.

For the weights a and b of a tie,  w_a - w_b ≤ s  with s = max(0, w0_a - w0_b): a pose that begins beyond the
tie may stay there.  So the start obeys every tie, however many there are.

Most answers do without any thought of them; these are taken as they are.  For the others each tie becomes a
stiff spring with a force y of its own and a slack t ≥ 0,

    ½ ρ (w_a - w_b + t - s + y / ρ)²,

which is one more row and one more weight for the solver within limits.  The force is what the spring was
stretched by, again and again (the method of multipliers): nothing is left of the stretch after a few rounds,
and no approximation of the answer.  Ties may share shapes, follow one another or run in a circle.
"""

from dataclasses import replace

import numpy as np

from facepin.solvers.boxed import (
    MOST_STEPS,
    SMALLEST_RIDGE,
    TOLERANCE,
    Minimise,
    Minimum,
    Price,
    prepare_boxed,
)
from facepin.solvers.interface import Floats, PinSystem

CLOSE = 1e-9
"""How near a gap has to come to its bound."""
STIFF = 1e3
"""Stiffness of a spring next to all that pulls at weights: how much less of the stretch each round leaves."""
LOOSE = 1e-12
"""Pull of a slack towards where it was, as a share of its spring: it makes the slack unique, and is gone
when the slack comes to rest."""
AT_REST = 1e-6
"""Move of a slack in a round up to which it is at rest."""
MOST_ROUNDS = 30


def prepare_tied(system: PinSystem, ridge: float) -> Minimise:
    """Prepare the minimisation of `boxed` with α = `ridge` ≥ 0, for a system that may have ties.

    An answer obeys limits and ties in any case.  Where steps or rounds run out before it is found, it is the
    nearest found that does, and its `optimality` says so.
    """
    if not system.ties:
        return prepare_boxed(system, ridge)
    return _Tied(system, ridge).minimise


class _Tied:
    """The ties of a system, and the forces that held in the last frame."""

    def __init__(self, system: PinSystem, ridge: float) -> None:
        self._plain = prepare_boxed(system, ridge)
        self._system, self._ridge = system, ridge
        self._moves = system.rows.any(axis=0)
        self._tied, self._other = np.array(system.ties, np.intp).T
        self._springs: _Springs | None = None

    def minimise(self, displacement: Floats, start: Floats, price: Price) -> Minimum:
        """Find the minimum, as `Minimise`."""
        slack = np.maximum(start[self._tied] - start[self._other], 0.0)
        found = self._plain(displacement, start, price)
        if not (self._gaps(found.weights, slack) > 0.0).any():
            return found
        pulling = self._pulling(displacement, start, price)
        springs = self._springs
        if springs is None or not springs.fit(start, pulling):
            guess = self._within(found.weights, start, slack)
            springs = _Springs(self._system, self._ridge, start, STIFF * pulling, slack, guess, springs)
            self._springs = springs
        tied, left = springs.minimise(displacement, start, price)
        weights = self._within(tied.weights, start, slack)
        return Minimum(weights, found.steps + tied.steps, max(tied.optimality, left))

    def _gaps(self, weights: Floats, slack: Floats) -> Floats:
        """Return how far each tie is overstepped, (t,)."""
        return np.asarray(weights[self._tied] - weights[self._other] - slack)

    def _within(self, weights: Floats, start: Floats, slack: Floats) -> Floats:
        """Return weights (k,) near these that overstep no tie: rounding, or what a search left over."""
        if not (self._gaps(weights, slack) > 0.0).any():
            return weights
        ties = list(zip(self._tied, self._other, slack, strict=True))
        lowest = np.where(self._moves, np.minimum(self._system.limits[:, 0], start), start)
        for _ in ties:  # they may follow one another
            for tied, other, room in ties:
                lowest[other] = min(max(lowest[other], lowest[tied] - room), start[other])
        nearer = np.maximum(weights, lowest)
        for _ in ties:
            for tied, other, room in ties:
                nearer[tied] = max(min(nearer[tied], nearer[other] + room), lowest[tied])
        return nearer

    def _pulling(self, displacement: Floats, start: Floats, price: Price) -> float:
        """Return the most that anything pulls at a weight within limits, per unit of weight."""
        rows = self._system.rows
        squares = float(np.einsum("ij,ij->j", rows, rows).max(initial=0.0))
        missing = float(np.linalg.norm(rows @ start - displacement))
        prices = float(np.abs(price.raising).max(initial=0.0) + np.abs(price.lowering).max(initial=0.0))
        return float(squares + self._ridge + prices + squares**0.5 * missing)


class _Springs:
    """The system with a row and a slack for every tie between two shapes that move pins."""

    def __init__(
        self,
        system: PinSystem,
        ridge: float,
        start: Floats,
        stiffness: float,
        slack: Floats,
        guess: Floats,
        before: "_Springs | None",
    ) -> None:
        tied, other = np.array(system.ties, np.intp).T
        moves = np.asarray(system.rows.any(axis=0), np.bool_)
        limits = system.limits.copy()
        # Shapes that move no pin keep their start, so ties with them are limits of the others.
        for a, b, room in zip(tied, other, slack, strict=True):
            if not moves[b]:
                limits[a, 1] = min(limits[a, 1], start[b] + room)
            if not moves[a]:
                limits[b, 0] = max(limits[b, 0], start[a] - room)
        both = moves[tied] & moves[other]
        self._tied, self._other, self._slack = tied[both], other[both], slack[both]
        self._start, self._stiffness, self._moves = start, stiffness, moves
        count, ties = len(start), int(np.count_nonzero(both))
        root = stiffness**0.5
        squares = np.einsum("ij,ij->j", system.rows, system.rows)
        ridge = max(ridge, SMALLEST_RIDGE * float(squares.max(initial=0.0)))
        springs = np.zeros((ties, count + ties))
        at = np.arange(ties)
        springs[at, self._tied] += root
        springs[at, self._other] -= root
        springs[at, count + at] = root
        rows = np.concatenate([np.pad(system.rows, ((0, 0), (0, ties))), springs])
        self._slacks = np.maximum(-self._gaps(guess), 0.0)
        known = None if before is None else before.forces
        self.forces: Floats = np.zeros(ties) if known is None or len(known) != ties else known
        self._minimise = prepare_boxed(
            replace(
                system,
                rows=rows,
                limits=np.concatenate([limits, np.tile([0.0, np.inf], (ties, 1))]),
                ties=(),
                guess=np.concatenate([guess, self._slacks]),
            ),
            np.concatenate([np.full(count, ridge), np.full(ties, LOOSE * stiffness)]),
            np.concatenate([squares, np.full(ties, stiffness)]),
        )

    def fit(self, start: Floats, pulling: float) -> bool:
        """Say whether these springs are stiff enough, and not too stiff, for a pull from a start (k,)."""
        near = STIFF * pulling <= self._stiffness * 10 and self._stiffness <= STIFF * pulling * 100
        return near and np.array_equal(start, self._start)

    def minimise(self, displacement: Floats, start: Floats, price: Price) -> tuple[Minimum, float]:
        """Return the minimum, and how far springs and slacks are from rest: 0 where they are."""
        root, count, ties = self._stiffness**0.5, len(start), len(self._slack)
        none = np.zeros(ties)
        prices = Price(
            np.concatenate([price.centre, none]),
            np.concatenate([price.raising, none]),
            np.concatenate([price.lowering, none]),
        )
        steps = 0
        for _ in range(MOST_ROUNDS):
            goals = np.concatenate([displacement, root * self._slack - self.forces / root])
            found = self._minimise(goals, np.concatenate([start, self._slacks]), prices)
            steps += found.steps
            weights, slacks = found.weights[:count], found.weights[count:]
            stretch = self._gaps(weights) + slacks
            moved = float(np.abs(slacks - self._slacks).max(initial=0.0))
            left = float(np.abs(stretch).max(initial=0.0))
            self.forces, self._slacks = self.forces + self._stiffness * stretch, slacks
            settled = left <= CLOSE and moved <= AT_REST
            if settled or found.optimality > TOLERANCE or steps >= MOST_STEPS:
                break
        return Minimum(weights, steps, found.optimality), 0.0 if settled else max(left, moved)

    def _gaps(self, weights: Floats) -> Floats:
        return np.asarray(weights[self._tied] - weights[self._other] - self._slack)
