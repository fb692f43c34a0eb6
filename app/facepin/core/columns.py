"""The columns of B, stored so that products with them are fast."""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from facepin.core.arrays import Floats

DENSE = 0.15
"""Columns with at least this share of non-zeros are multiplied faster with the zeros written out."""
DENSE_BYTES = 2**29
"""Memory that written-out columns may take; the densest go first."""


WORTH_IT = 0.25
"""Least share of all non-zeros in such columns, for setting them apart copies the others."""


class Columns:
    """Products with B, fast for dense and sparse columns, for many and for few of them.

    Real rigs mix both: an expression moves a tenth or a half of a face, an identity moves all of it.  Columns
    with many non-zeros are written out (a dense product reads 4 bytes per entry, in order; a sparse one
    reads 8 per non-zero and scatters), the others stay sparse.
    """

    def __init__(self, deltas: csc_array) -> None:
        size, self._count = deltas.shape
        self._starts, self._indices, self._data = deltas.indptr, deltas.indices, deltas.data
        filled = np.diff(deltas.indptr)
        densest = np.argsort(-filled, kind="stable")[: DENSE_BYTES // (4 * size)]
        densest = densest[filled[densest] >= DENSE * size]
        worth_it = filled[densest].sum() >= WORTH_IT * filled.sum()
        self._dense = np.sort(densest) if worth_it else densest[:0]
        self._sparse = np.setdiff1d(np.arange(self._count), self._dense)
        self._written = np.zeros((len(self._dense), size), np.float32)
        for row, j in zip(self._written, self._dense, strict=True):
            run = slice(self._starts[j], self._starts[j + 1])
            row[self._indices[run]] = self._data[run]
        self._rest = deltas[:, self._sparse] if len(self._dense) else deltas

    def product(self, weights: Floats) -> NDArray[np.float32]:
        """Return B w, (3n,) float32, in time that grows with the columns whose weight (k,) is not zero."""
        dense, sparse = weights[self._dense].astype(np.float32), weights[self._sparse].astype(np.float32)
        # Taking the active columns out costs about as much as multiplying them.
        active = np.flatnonzero(dense)
        if 2 * len(active) < len(dense):
            moved: NDArray[np.float32] = dense[active] @ self._written[active]
        else:
            moved = dense @ self._written
        active = np.flatnonzero(sparse)
        if 2 * len(active) > len(sparse):
            moved += self._rest @ sparse
        elif len(active):
            moved += self._rest[:, active] @ sparse[active]
        return moved

    def rows(self, wanted: NDArray[np.intp]) -> Floats:
        """Return some rows (r,) of B, (r, k) float64."""
        rows = np.zeros((len(wanted), self._count))
        rows[:, self._dense] = self._written[:, wanted].T
        for j in self._sparse.tolist():
            start, stop = self._starts[j], self._starts[j + 1]
            if start < stop:
                at = np.minimum(start + self._indices[start:stop].searchsorted(wanted), stop - 1)
                rows[:, j] = np.where(self._indices[at] == wanted, self._data[at], 0.0)
        return rows

    def largest_moves(self) -> Floats:
        """Return the length of the largest vertex move of each column, (k,) float64."""
        squared = np.zeros(self._count)
        for j, column in zip(self._dense, self._written, strict=True):
            x, y, z = column.reshape(-1, 3).T
            squared[j] = np.max(x * x + y * y + z * z)
        for j in self._sparse.tolist():
            run = slice(self._starts[j], self._starts[j + 1])
            moves = np.bincount(self._indices[run] // 3, self._data[run].astype(np.float64) ** 2)
            squared[j] = moves.max(initial=0.0)
        return np.sqrt(squared)
