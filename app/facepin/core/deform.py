"""Positions of a face on every frame of a drag."""

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats, Points
from facepin.core.rig import Rig

MOST_DIRECTIONS = 8
"""Directions of weight change that are remembered; each costs one pass over the positions per frame."""
CANCELLATION = 8.0
"""How many times larger than the sum the terms of a sum may be, before float32 loses too much."""
ROUNDING = 2.0**-24
"""Relative error of one float32 operation."""
DENSE = 0.15
"""Columns with at least this share of non-zeros are multiplied faster as full rows of numbers."""
DENSE_BYTES = 2**29
"""Memory that full rows may take; the densest columns go first."""


class Deformer:
    """Evaluates f0 + B w frame after frame; one per pane.

    During a drag the weights run through a small space: a linear solver that follows one pin turns three
    numbers (where the goal is) into k weights, so all weight changes are sums of three directions q.  A
    deformer remembers the directions it has met, orthonormal, and their images B q.  When a change lies among
    them, the positions are a sum of a few images, whatever the number of shapes; otherwise the new direction
    is multiplied out and remembered.  When too many are known, or when a gesture changes far fewer weights
    than they do, it starts over from where it is: what does not move then stays put to the last bit, and its
    normals need no work.

    Nothing is accumulated from frame to frame, so nothing drifts: every answer equals `Rig.evaluate` up to
    float32 rounding, whatever was asked before.
    """

    def __init__(self, rig: Rig) -> None:
        self._begin(_Columns(rig))

    def _begin(self, columns: "_Columns") -> None:
        floats, shapes = columns.neutral.size, columns.moves.size
        self._columns = columns
        self._base: Floats = np.zeros(shapes)
        self._directions = np.zeros((MOST_DIRECTIONS, shapes))
        # Rows: positions at the base weights, then the image of each direction, and how far each can reach.
        self._images = np.zeros((1 + MOST_DIRECTIONS, floats), np.float32)
        self._reaches = np.zeros(1 + MOST_DIRECTIONS)
        self._touched = np.zeros(shapes, np.bool_)
        self._restart(self._base)
        self._weights: Floats = self._base
        self._positions: Points = columns.neutral.reshape(-1, 3)

    def twin(self) -> "Deformer":
        """Return a deformer for another pane that shares the big tables with this one."""
        twin = object.__new__(Deformer)
        twin._begin(self._columns)
        return twin

    def deform(self, weights: Floats) -> Points:
        """Posed positions for weights (k,).

        Returns
        -------
        (n, 3) float32
            Read-only.  A new array on every call, except that the same weights as in the call before return
            the same array, so that `is` tells whether something moved.
        """
        if not np.array_equal(weights, self._weights):
            mix = self._mix_of(weights)
            positions: Points = np.dot(mix.astype(np.float32), self._images[: len(mix)]).reshape(-1, 3)
            positions.flags.writeable = False
            self._weights, self._positions = weights.copy(), positions
        return self._positions

    def _mix_of(self, weights: Floats) -> Floats:
        """Multiples of the images that make the positions: 1 of the base, then one for each direction."""
        if 2 * np.count_nonzero(weights != self._weights) < np.count_nonzero(self._touched):
            return self._restart(weights)
        moves = self._columns.moves
        change = weights - self._base
        directions = self._directions[: self._known]
        parts = directions @ change
        rest = change - parts @ directions
        reach = self._columns.extent + moves @ np.abs(weights)
        if moves @ np.abs(rest) > ROUNDING * reach:
            if self._known == MOST_DIRECTIONS:
                return self._restart(weights)
            self._learn(rest)
            parts = self._directions[: self._known] @ change
        mix = np.concatenate([[1.0], parts])
        # After very large weights (an unregularised solver gives thousands) small ones need a new base.
        if self._reaches[: len(mix)] @ np.abs(mix) > CANCELLATION * reach:
            return self._restart(weights)
        return mix

    def _restart(self, weights: Floats) -> Floats:
        """Make these weights the base and forget all directions."""
        columns = self._columns
        self._base = weights.copy()
        self._images[0] = columns.neutral + columns.product(weights)
        self._reaches[0] = columns.extent + columns.moves @ np.abs(weights)
        self._known = 0
        self._touched[:] = False
        return np.ones(1)

    def _learn(self, rest: Floats) -> None:
        """Remember the direction of `rest`, which is what the known ones leave over."""
        known = self._directions[: self._known]
        direction = rest / np.linalg.norm(rest)
        direction -= (known @ direction) @ known  # a second time, for what rounding left
        direction /= np.linalg.norm(direction)
        self._touched |= direction != 0
        self._directions[self._known] = direction
        self._known += 1
        self._images[self._known] = self._columns.product(direction)
        self._reaches[self._known] = self._columns.moves @ np.abs(direction)


class _Columns:
    """B in a form that makes B w fast, for dense and sparse columns, for many and for few of them."""

    def __init__(self, rig: Rig) -> None:
        deltas = rig.deltas
        self.neutral = rig.neutral.ravel()
        self.extent = float(np.abs(self.neutral).max())
        self.moves = rig.largest_moves
        counts = np.diff(deltas.indptr)
        dense = np.argsort(-counts, kind="stable")[: DENSE_BYTES // self.neutral.nbytes]
        self._dense = np.sort(dense[counts[dense] >= DENSE * self.neutral.size])
        self._sparse = np.setdiff1d(np.arange(len(counts)), self._dense)
        self._deltas = deltas[:, self._sparse] if len(self._dense) else deltas
        self._rows = np.zeros((len(self._dense), self.neutral.size), np.float32)
        for row, j in zip(self._rows, self._dense, strict=True):
            run = slice(deltas.indptr[j], deltas.indptr[j + 1])
            row[deltas.indices[run]] = deltas.data[run]

    def product(self, weights: Floats) -> NDArray[np.float32]:
        """B w, (3n,) float32, in time that grows with the columns whose weight is not zero."""
        dense, sparse = weights[self._dense].astype(np.float32), weights[self._sparse].astype(np.float32)
        # Taking the active columns out costs about as much as multiplying them.
        active = np.flatnonzero(dense)
        if 2 * len(active) < len(dense):
            moved: NDArray[np.float32] = dense[active] @ self._rows[active]
        else:
            moved = dense @ self._rows
        active = np.flatnonzero(sparse)
        if 2 * len(active) > len(sparse):
            moved += self._deltas @ sparse
        elif len(active):
            moved += self._deltas[:, active] @ sparse[active]
        return moved
