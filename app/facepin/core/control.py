"""How the user restrains shapes: limits, locks, and what is shown of them."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats, frozen
from facepin.core.errors import FacepinError
from facepin.core.rig import Rig

Flags = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class ShapeControl:
    """What holds for each of the k shapes of a rig; arrays are read-only.

    Change one with `dataclasses.replace`.

    Raises
    ------
    FacepinError
        For limits that are not finite or not in order.
    """

    limits: Floats
    """(k, 2) float64, lowest and highest weight of each shape."""
    locked: Flags
    """(k,) bool, shapes whose weight nothing changes: no solver, no slider, no loaded pose."""
    muted: Flags
    """(k,) bool, shapes that keep their weight but don't move the face."""
    solo: Flags
    """(k,) bool, while any is set the face is moved by these shapes alone."""
    ties: tuple[tuple[int, int], ...] = ()
    """Pairs (a, b) of shapes: the weight of a should be at most that of b."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "limits", frozen(self.limits, np.float64))
        for name in ("locked", "muted", "solo"):
            object.__setattr__(self, name, frozen(getattr(self, name), np.bool_))
        count = len(self.locked)
        if self.limits.shape != (count, 2) or not len(self.muted) == len(self.solo) == count:
            raise ValueError("limits, locked, muted and solo must be of the same shapes")
        if not np.isfinite(self.limits).all() or (self.limits[:, 0] > self.limits[:, 1]).any():
            raise FacepinError("limits of a shape must be two finite numbers, the lowest first")

    @staticmethod
    def of(rig: Rig) -> "ShapeControl":
        """Return the rig's own limits and ties, and nothing restrained."""
        nothing = np.zeros(rig.shape_count, np.bool_)
        return ShapeControl(rig.limits, nothing, nothing, nothing, rig.ties)

    @cached_property
    def silent(self) -> Flags:
        """(k,) which shapes don't move the face: the muted ones, and while any is solo, all others."""
        return self.muted | ~self.solo if self.solo.any() else self.muted

    @cached_property
    def held(self) -> Flags:
        """(k,) which shapes are none of a solver's business: locked or silent."""
        return self.locked | self.silent

    @cached_property
    def free(self) -> NDArray[np.intp]:
        """The shapes that solvers may use, ascending."""
        return np.flatnonzero(~self.held)

    def heard(self, weights: Floats) -> Floats:
        """Return the weights (k,) that the face is evaluated with: 0 for silent shapes.

        The same array where that changes nothing.
        """
        return np.where(self.silent, 0.0, weights) if weights[self.silent].any() else weights

    def keeping_locked(self, weights: Floats, current: Floats) -> Floats:
        """Return new weights (k,) with those of locked shapes as they are in `current`.

        The same array where that changes nothing.
        """
        return (
            np.where(self.locked, current, weights) if self.breaks_lock(weights, current).any() else weights
        )

    def breaks_lock(self, weights: Floats, current: Floats) -> Flags:
        """Return which locked shapes (k,) would get another weight than in `current`."""
        broken: Flags = self.locked & (weights != current)
        return broken

    def limits_at(self, weights: Floats) -> Floats:
        """Return the limits (k, 2) that hold in a pose (k,): a tied shape goes as far as the other one does.

        What counts is what is shown: a silent shape goes nowhere, and being tied does not matter to it.  The
        array `limits` itself without ties.
        """
        if not self.ties:
            return self.limits
        limits, heard = self.limits.copy(), self.heard(weights)
        for tied, other in self.ties:
            if not self.silent[tied]:
                limits[tied, 1] = min(limits[tied, 1], max(float(heard[other]), limits[tied, 0]))
        return limits

    def limits_beside_locks(self, weights: Floats) -> Floats:
        """Return the limits (k, 2) of what is free beside tied shapes that are held at their weights (k,).

        A tie between two free shapes does not show in them.  Silent ones count as `limits_at` has it.
        """
        limits, heard = self.limits.copy(), self.heard(weights)
        for tied, other in self.ties:
            if self.silent[tied]:
                continue
            if self.held[other]:
                limits[tied, 1] = min(limits[tied, 1], max(float(heard[other]), limits[tied, 0]))
            elif self.held[tied]:
                limits[other, 0] = max(limits[other, 0], min(float(weights[tied]), limits[other, 1]))
        return limits

    def clipped(self, weights: Floats, start: Floats) -> Floats:
        """Return weights (k,) within limits and ties; what was beyond at the `start` (k,) may stay there."""
        low, high = self.limits_beside_locks(start).T
        clipped: Floats = np.clip(weights, np.minimum(low, start), np.maximum(high, start))
        for tied, other in self.ties:
            if not self.held[tied] and not self.held[other]:
                most = clipped[other] + max(float(start[tied] - start[other]), 0.0)
                clipped[tied] = min(clipped[tied], max(most, min(low[tied], start[tied])))
        return clipped
