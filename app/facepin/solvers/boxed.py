"""Exact least squares within limits, with an optional price on raising and lowering weights.

Minimises  ½‖J w - d‖² + ½ α ‖w - w0‖² + Σ λ⁺ max(w - c, 0) + Σ λ⁻ max(c - w, 0)
over  l ≤ w ≤ u,  with α > 0.

An active-set method.  Every weight either rests against a wall of its current linear piece (a limit, or the
kink at its centre) or is free; the free ones are solved for together, and weights leave a wall when the
objective falls that way.  It falls with every step and there are finitely many faces, so the search ends at
the minimum up to rounding.  The problem being strictly convex, there is one minimum: where the search began
does not show in it.  From the last frame's answer it takes a step or two, where projected gradients take
hundreds.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from facepin.solvers.interface import Floats, PinSystem

TOLERANCE = 1e-9
"""Stop when no weight would move further than this if it were optimised alone."""
ROUNDING = 4 * float(np.finfo(np.float64).eps)
"""Share of all that adds up to a pull which may be an error of arithmetic."""
MOST_STEPS = 300
"""Of one answer: a frame does not wait for more.  Random systems of 53 shapes need 61 at most, mostly one."""
BOLD_STEPS = 50
"""Steps that may run into several walls at once; then come careful ones, which cannot go on for ever."""
SMALLEST_RIDGE = 1e-10
"""Least α, as a share of the largest squared column of J: keeps the problem convex despite rounding."""


@dataclass(frozen=True, eq=False)
class Minimum:
    """What the search found."""

    weights: Floats
    """(k,)"""
    steps: int
    optimality: float
    """Largest move any one weight would still make if it were optimised alone; at most `TOLERANCE` unless the
    search ran out of steps: then these are the best weights that it came by, within limits."""


@dataclass(frozen=True, eq=False)
class Price:
    """What it costs a weight to be away from a centre, in squared length units per unit of weight."""

    centre: Floats
    """(k,) c"""
    raising: Floats
    """(k,) λ⁺ ≥ -λ⁻"""
    lowering: Floats
    """(k,) λ⁻; negative where lowering is paid for."""


Minimise = Callable[[Floats, Floats, Price], Minimum]
"""(displacement d (r,), start w0 (k,), price) -> minimum."""


def prepare_boxed(system: PinSystem, ridge: float | Floats, squares: Floats | None = None) -> Minimise:
    """Prepare the minimisation for α = `ridge` ≥ 0, in squared length units.

    Shapes that move no pin are not part of it: they keep their start, whatever they cost.  A weight that
    starts outside its limits may stay there: nothing is clipped behind the user's back.

    Parameters
    ----------
    ridge : float or (k,)
        One for all, or one > 0 for each weight.
    squares : (k,), optional
        Curvature along each weight that its tolerance is measured with, where it is not that of the rows.
    """
    seen = np.flatnonzero(system.rows.any(axis=0))
    rows = np.ascontiguousarray(system.rows[:, seen])
    lowest, highest = system.limits[seen].T.copy()
    own_squares = np.einsum("ij,ij->j", rows, rows)
    squares = own_squares if squares is None else squares[seen]
    if isinstance(ridge, float):
        ridge = max(ridge, SMALLEST_RIDGE * float(squares.max(initial=0.0)))
    else:
        ridge = ridge[seen]
    face = _Face(rows, ridge)
    own = squares + ridge
    sizes = np.abs(rows)
    last = None if system.guess is None else system.guess[seen]

    def minimise(displacement: Floats, start: Floats, price: Price) -> Minimum:
        nonlocal last
        weights, origin = start.copy(), start[seen]
        low, high = np.minimum(lowest, origin), np.maximum(highest, origin)
        begin = origin if last is None else np.minimum(np.maximum(last, low), high)
        raising, lowering = price.raising[seen], price.lowering[seen]
        kink = np.where(raising + lowering > 0, np.clip(price.centre[seen], low, high), low)
        asked, steps = np.abs(displacement), 0
        while True:
            missing = rows @ begin - displacement
            gradient = missing @ rows + ridge * (begin - origin)
            tolerance = np.maximum(TOLERANCE * own, ROUNDING * ((sizes @ np.abs(begin) + asked) @ sizes))
            piece = _choose_piece(begin, gradient, raising, lowering, kink, low, high, tolerance)
            if piece.settled or steps == MOST_STEPS:
                break
            begin = face.step(begin, piece, bold=steps < BOLD_STEPS)
            steps += 1
        last = weights[seen] = begin
        left = float(np.max(piece.urge / own, initial=0.0))
        left = min(left, TOLERANCE) if piece.settled else left  # more is rounding
        return Minimum(weights, steps, left)

    return minimise


@dataclass(frozen=True, eq=False)
class _Piece:
    """The linear piece on which each weight may move in one step, all (k,)."""

    low: Floats
    high: Floats
    slope: Floats
    """Derivative of the objective on the piece."""
    free: NDArray[np.bool_]
    urge: Floats
    """Size of the slope along which the objective still falls."""
    settled: bool
    """No urge is above its tolerance."""


def _choose_piece(
    weights: Floats,
    gradient: Floats,
    raising: Floats,
    lowering: Floats,
    kink: Floats,
    low: Floats,
    high: Floats,
    tolerance: Floats,
) -> _Piece:
    """Decide which weights move next: those inside their piece, and once these are settled those on walls."""
    above, below = weights > kink, weights < kink
    # Slope of the objective when a weight goes up, and when it goes down: it should go where it is negative.
    up = np.where(weights < high, gradient + np.where(below, -lowering, raising), np.inf)
    down = np.where(weights > low, np.where(above, -raising, lowering) - gradient, np.inf)
    urge = np.maximum(-np.minimum(up, down), 0.0)
    wants = urge > tolerance
    upper = above | ((up < down) & ~below)
    piece_low, piece_high = np.where(upper, kink, low), np.where(upper, high, kink)
    inside = (weights > piece_low) & (weights < piece_high)
    # Weights on walls wait until the inner ones are settled: before that, most would be called for nothing.
    free = inside if np.any(inside & wants) else inside | wants
    slope = gradient + np.where(upper, raising, -lowering)
    return _Piece(piece_low, piece_high, slope, free, urge, settled=not wants.any())


@dataclass(frozen=True, eq=False)
class _Face:
    """Solves for the free weights, the others held."""

    rows: Floats
    ridge: float | Floats
    """α, one for all or (k,)."""

    def step(self, weights: Floats, piece: _Piece, bold: bool) -> Floats:
        """Move the free weights towards their joint minimum, as far as walls allow; the objective falls."""
        at = np.flatnonzero(piece.free)
        while True:
            part, here, low, high = self.rows[:, at], weights[at], piece.low[at], piece.high[at]
            ridge = self.ridge if isinstance(self.ridge, float) else self.ridge[at]
            move = _newton(part, ridge, -piece.slope[at])
            goal = np.minimum(np.maximum(here + move, low), high)
            hit = np.flatnonzero(goal != here + move)
            if not len(hit) or (bold and _falls(part, ridge, piece.slope[at], goal - here)):
                break
            share = (goal[hit] - here[hit]) / move[hit]
            if share.min() > 0.0:
                # Careful: go until the first wall.
                first = hit[np.argmin(share)]
                nearest = goal[first]
                goal = np.minimum(np.maximum(here + share.min() * move, low), high)
                goal[first] = nearest
                break
            at = np.delete(at, hit[share <= 0.0])
        moved = weights.copy()
        moved[at] = goal
        return moved


def _newton(part: Floats, ridge: float | Floats, right: Floats) -> Floats:
    """Solve (PᵀP + αI) x = right for the columns P (r, f), in whichever of f and r is smaller."""
    r, f = part.shape
    if f <= r or not isinstance(ridge, float):
        return _solve_shifted(part.T @ part, ridge, right)
    inner = _solve_shifted(part @ part.T, ridge, part @ right)
    return (right - inner @ part) / ridge


def _falls(part: Floats, ridge: float | Floats, slope: Floats, change: Floats) -> bool:
    """Return whether the objective is lower after `change`, which stays on the piece."""
    moved = part @ change
    return float(change @ slope + 0.5 * (moved @ moved + change @ (ridge * change))) < 0.0


def _solve_shifted(square: Floats, shift: float | Floats, right: Floats) -> Floats:
    """Solve (square + shift I) x = right; `square` is overwritten."""
    square.flat[:: len(square) + 1] += shift
    return np.asarray(np.linalg.solve(square, right), np.float64)
