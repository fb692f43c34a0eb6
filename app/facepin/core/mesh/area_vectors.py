"""Area vectors of quads and triangles whose corners move."""

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Points

BLOCK = 8192
"""Cells computed at a time: what comes between their corners and their area vectors stays in near memory."""

Numbers = NDArray[np.intp]


class AreaVectors:
    """Twice the area vectors of m cells, computed again whenever their corners have moved.

    On every frame of a drag the processor comes back from drawing, with neither data nor code at hand: few
    steps through little memory are what is fast then.  So all arrays are made once and used again.
    """

    def __init__(self, vertices: int, diagonals: Numbers, values: Points | None = None) -> None:
        """Prepare for cells of a mesh.

        Parameters
        ----------
        vertices : int
            Number of vertices n.
        diagonals : (2, 2, m) int
            The two ends of one diagonal of each cell, and of the other; of a triangle, of two sides.
        values : (m, 4) float32
            Where to put the area vectors; a new array when None.
        """
        count = diagonals.shape[2]
        self.values: Points = np.zeros((count, 4), np.float32) if values is None else values
        """(m, 4) float32, for the last points: x, y and z, then a number that means nothing."""
        # In the order y, z, x, y a cross product is the same formula all along a row of numbers.  And four
        # numbers are gathered as fast as one, once they pass for a single number of 16 bytes.
        turned = np.zeros((vertices, 4), np.float32)
        self._columns = turned.T
        self._points = turned.view(np.complex128)[:, 0]
        room = np.zeros(5 * min(count, BLOCK), np.complex128)
        self._blocks = [
            _Block(diagonals[:, :, first : first + BLOCK], self.values[first : first + BLOCK], room)
            for first in range(0, count, BLOCK)
        ]

    def of(self, points: Points) -> Points:
        """Return `values`, from now on those for vertices at `points` (n, 3) float32."""
        x, y, z = points.T
        for column, coordinates in zip(self._columns, (y, z, x, y), strict=True):
            column[:] = coordinates
        for block in self._blocks:
            block.compute(self._points)
        return self.values


class _Block:
    """Some of the cells, and room for what comes between."""

    def __init__(self, diagonals: Numbers, values: Points, room: NDArray[np.complex128]) -> None:
        size = len(values)
        # The ends of both diagonals, then their starts.
        self._corners = np.ascontiguousarray(diagonals[:, ::-1].swapaxes(0, 1)).reshape(4, size)
        self._gathered = room[: 4 * size].reshape(4, size)
        self._sides, self._starts = self._gathered.view(np.float32).reshape(2, 2, 4 * size)
        u, v = self._sides
        self._factors = (u[:-1], v[1:]), (u[1:], v[:-1])
        self._cross = values.reshape(-1)[:-1]
        self._other = room[4 * size :].view(np.float32)[: 4 * size - 1]

    def compute(self, points: NDArray[np.complex128]) -> None:
        """Compute the area vectors from points (n,) of four numbers each."""
        # Clipping never happens; asking for it spares numpy a check of every index.
        points.take(self._corners, mode="clip", out=self._gathered)
        np.subtract(self._sides, self._starts, out=self._sides)
        (u, v), (u_next, v_next) = self._factors
        np.multiply(u, v, out=self._cross)
        np.multiply(u_next, v_next, out=self._other)
        np.subtract(self._cross, self._other, out=self._cross)
