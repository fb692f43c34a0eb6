"""Positions of a face on every frame of a drag."""

import numpy as np

from facepin.core.arrays import Floats, Points
from facepin.core.rig import Rig

MOST_DIRECTIONS = 8
"""Directions of weight change that are remembered; each costs one pass over the positions per frame."""
MOST_SHAPES = 16
"""Single shapes that are remembered where so many directions do not suffice, but few shapes change."""
CANCELLATION = 8.0
"""How many times larger than the sum the terms of a sum may be, before float32 loses too much."""
ROUNDING = 2.0**-24
"""Relative error of one float32 operation."""


class Deformer:
    """Evaluates f0 + B a frame after frame, where a are the amounts of a pose; one per pane.

    During a drag the weights run through a small space: a linear solver that follows one pin turns two or
    three numbers (where the goal is) into k weights, so all weight changes are sums of as many directions q,
    and products of weights add a few more.  A deformer remembers the directions it has met, orthonormal, and
    their images B q.  When a change lies among them, the positions are a sum of a few images, whatever the
    number of shapes; otherwise the new direction is multiplied out and remembered.  Where few amounts change,
    as with a sparse solver, whose answers bend from frame to frame, each of them is a direction.  When too
    many are known, or when a gesture changes far fewer amounts than they do, it starts over from where it is:
    what does not move then stays put to the last bit, and its normals need no work.

    Nothing is accumulated from frame to frame, so nothing drifts: every answer equals `Rig.evaluate` up to
    float32 rounding, whatever was asked before.
    """

    def __init__(self, rig: Rig) -> None:
        self._rig = rig
        self._extent = float(np.abs(rig.neutral).max())
        columns = rig.deltas.shape[1]
        self._directions = np.zeros((MOST_SHAPES, columns))
        # Rows: positions at the base weights, then the image of each direction, and how far each can reach.
        self._images = np.zeros((1 + MOST_SHAPES, rig.neutral.size), np.float32)
        self._reaches = np.zeros(1 + MOST_SHAPES)
        self._mix = np.ones(1 + MOST_SHAPES)
        self._restart(np.zeros(columns))
        self._amounts = self._base
        self._positions: Points = rig.neutral

    def twin(self) -> "Deformer":
        """Return a deformer for another pane of the same rig."""
        return Deformer(self._rig)

    def deform(self, weights: Floats) -> Points:
        """Posed positions for weights (k,).

        Returns
        -------
        (n, 3) float32
            Read-only.  A new array on every call, except that the same weights as in the call before return
            the same array, so that `is` tells whether something moved.
        """
        amounts = self._rig.amounts(weights)
        changes = int(np.count_nonzero(amounts != self._amounts))
        if changes:
            mix = self._mix_of(amounts, changes)
            positions: Points = np.dot(mix.astype(np.float32), self._images[: len(mix)]).reshape(-1, 3)
            positions.flags.writeable = False
            self._amounts, self._positions = amounts.copy(), positions
        return self._positions

    def _mix_of(self, amounts: Floats, changes: int) -> Floats:
        """Multiples of the images that make the positions: 1 of the base, then one for each direction.

        `changes` counts the amounts that are not what they were.
        """
        if 2 * changes < self._mixed:
            return self._restart(amounts)
        change = amounts - self._base
        mix = self._project(change)
        rest = change - mix[1:] @ self._directions[: self._known]
        reach = self._extent + self._reach(amounts)
        if self._reach(rest) > ROUNDING * reach:
            if not self._learn(rest, change):
                return self._restart(amounts)
            mix = self._project(change)
        # After very large weights (an unregularised solver gives thousands) small ones need a new base.
        # Asked this way round, a base that is not a number needs one too.
        if not self._reaches[: len(mix)] @ np.abs(mix) <= CANCELLATION * reach:
            return self._restart(amounts)
        return mix

    def _project(self, change: Floats) -> Floats:
        """1, then the part of a change in each known direction."""
        mix = self._mix[: 1 + self._known]
        np.dot(self._directions[: self._known], change, out=mix[1:])
        return mix

    def _restart(self, amounts: Floats) -> Floats:
        """Make these amounts the base and forget all directions."""
        self._base: Floats = amounts.copy()
        self._images[0] = self._rig.neutral.ravel() + self._rig.columns.product(amounts)
        self._reaches[0] = self._extent + self._reach(amounts)
        self._forget()
        return self._mix[:1]

    def _forget(self) -> None:
        self._known = self._mixed = 0
        """Directions known, and amounts changed by those of them that change more than one."""

    def _learn(self, rest: Floats, change: Floats) -> bool:
        """Remember the directions of `rest`, which is what the known ones leave over of a change.

        Returns
        -------
        bool
            Whether there was room.
        """
        columns = np.flatnonzero(rest)
        room = MOST_DIRECTIONS if self._known < MOST_DIRECTIONS else MOST_SHAPES
        if self._mixed and self._known == MOST_DIRECTIONS:
            self._forget()
            columns = np.flatnonzero(change)
        if not self._mixed and self._known + len(columns) <= room:
            for column in columns:
                direction = np.zeros_like(rest)
                direction[column] = 1.0
                self._remember(direction)
            return True
        if room == MOST_SHAPES:
            return False
        known = self._directions[: self._known]
        direction = rest / np.linalg.norm(rest)
        direction -= (known @ direction) @ known  # a second time, for what rounding left
        direction /= np.linalg.norm(direction)
        self._remember(direction)
        self._mixed = int(np.count_nonzero(self._directions[: self._known].any(axis=0)))
        return True

    def _remember(self, direction: Floats) -> None:
        """Multiply out one more direction, orthogonal to the known ones and of length 1."""
        self._directions[self._known] = direction
        self._known += 1
        self._images[self._known] = self._rig.columns.product(direction)
        self._reaches[self._known] = self._reach(direction)

    def _reach(self, amounts: Floats) -> float:
        """A bound on how far the amounts move any vertex."""
        return float(self._rig.reaches @ np.abs(amounts))
