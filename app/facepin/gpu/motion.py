"""Which triangles of a face move, and which are as good as still."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Indices, Points
from facepin.core.mesh.topology import weld_map
from facepin.core.rig import Rig
from facepin.gpu.materials import Run

VISIBLE = 0.25
"""Largest move, in pixels, of what counts as still: shapes in files move a little what they need not."""
SLIGHT = 0.6
"""Share of that from which on a vertex counts as moving when triangles are sorted anew: it will move more."""
WORTHWHILE = 0.8
"""Share of moving triangles above which sorting them out is not worth it."""

Mask = NDArray[np.bool_]


class Motion:
    """Sorts the triangles of one face, looked at from one place, as it goes from pose to pose."""

    def __init__(self, rig: Rig, triangles: Indices, runs: tuple[Run, ...]) -> None:
        """Prepare for `runs` of `triangles` (t, 3)."""
        self._runs = runs
        self._triangles = triangles
        self._weld = weld_map(rig).astype(np.intp)
        self._corners = [self._weld[corner] for corner in triangles.T]
        self.forget(0.0)

    def forget(self, pixel: float) -> None:
        """Begin anew, for pixels of this size where the face is nearest."""
        self.moving: tuple[Run, ...] = self._runs
        self.still: tuple[Run, ...] = ()
        """Runs of `triangles`, as `moving`; while there are none of these, nothing is sorted."""
        self.triangles: Indices = self._triangles
        """(t, 3), those that move and those that are still apart within each run."""
        self._pixel = pixel
        self._reference: Points | None = None
        self._moved: Mask = np.zeros(len(self._weld), np.bool_)
        self._fixed: NDArray[np.intp] = np.arange(len(self._weld))
        """Vertices that count as still, and (their number, 3) where they are drawn."""
        self._places: Points = np.zeros((len(self._weld), 3), np.float32)
        self._hopeless = False

    def follow(self, positions: Points) -> bool:
        """Go on to another pose.

        Parameters
        ----------
        positions : (n, 3) float32
            Not changed afterwards.

        Returns
        -------
        bool
            Whether the triangles are sorted in another way now.
        """
        if self._reference is None:
            self._reference = positions
        if self._hopeless or positions is self._reference:
            return False
        if self.still:
            strayed = np.abs(positions.take(self._fixed, axis=0) - self._places)
            if not (strayed > VISIBLE * self._pixel).any():
                return False
        moves = np.abs(positions - self._reference)
        self._moved |= (moves > SLIGHT * VISIBLE * self._pixel).any(axis=1)
        self._sort()
        self._reference, self._places = positions, positions.take(self._fixed, axis=0)
        return True

    def settled(self, positions: Points) -> Points:
        """Return positions (n, 3) with still vertices exactly where they were: nothing gapes beside them."""
        if not self.still or positions is self._reference:
            return positions
        settled = positions.copy()
        settled[self._fixed] = self._places
        return settled

    def _sort(self) -> None:
        """Sort by what has moved so far."""
        moved = np.zeros(len(self._weld), np.bool_)
        moved[self._weld[self._moved]] = True
        # The light changes at all corners of a triangle that moves, so those that share one are drawn too.
        lit = moved.copy()
        touched = self._touched(moved)
        for corner in self._corners:
            lit[corner[touched]] = True
        moving = self._touched(lit)
        self._fixed = np.flatnonzero(~lit[self._weld])
        self._hopeless = not self._runs or bool(np.count_nonzero(moving) > WORTHWHILE * len(moving))
        if self._hopeless:
            self.moving, self.still, self.triangles = self._runs, (), self._triangles
            return
        order: list[Indices] = []
        runs: tuple[list[Run], list[Run]] = [], []
        first = 0
        for run in self._runs:
            part = slice(run.first // 3, (run.first + run.count) // 3)
            for kind, chosen in zip(runs, (moving[part], ~moving[part]), strict=True):
                piece = self._triangles[part][chosen]
                if len(piece):
                    kind.append(replace(run, first=first, count=piece.size))
                    order.append(piece)
                    first += piece.size
        self.moving, self.still = tuple(runs[0]), tuple(runs[1])
        self.triangles = np.concatenate(order)

    def _touched(self, vertices: Mask) -> Mask:
        """Triangles (t,) with a corner among `vertices` (n,); of coincident ones only the first counts."""
        a, b, c = (vertices[corner] for corner in self._corners)
        touched: Mask = a | b | c
        return touched
