"""Places that stand for the whole face when it is asked how far a pose moves any of it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from facepin.core.arrays import Floats, Points
from facepin.core.columns import Columns

CELL = 0.035
"""Edge of the cells of space that have one place each, as a share of the face height."""
PER_SHAPE = 3
"""Places in which a single shape is looked at, those that it moves most."""
EVERY = 5
"""Of the other places, every fifth is looked at too: motions add up where no single one is largest."""
MOST = 300
"""Places that are looked at, about: with very many shapes there is less need for several of each."""


@dataclass(frozen=True, eq=False)
class Sentinels:
    """Vertices spread over what moves of a face, and how the columns of the rig's deltas move them."""

    places: Points
    """(s, 3) float32, at rest."""
    rows: NDArray[np.float32]
    """(s, 3, k + c), rows of the deltas."""
    lengths: Floats
    """(s, k) float64, lengths of the moves of single shapes."""
    likeness: Floats
    """(k, k) float64, cosines between the motions of shapes at these places, 0 for empty shapes."""

    def telling(self, away: NDArray[np.bool_]) -> NDArray[np.intp]:
        """Choose among the places that `away` (s,) marks those that show most of what happens there.

        Returns
        -------
        (t,) ascending
        """
        among = np.flatnonzero(away)
        per_shape = max(1, min(PER_SHAPE, MOST // max(self.lengths.shape[1], 1), len(among)))
        if not len(among):
            return among
        lengths = self.lengths[among]
        most = np.argpartition(lengths, len(among) - per_shape, axis=0)[len(among) - per_shape :]
        moved = lengths[most, np.arange(lengths.shape[1])] > 0.0
        return np.union1d(among[np.unique(most[moved])], among[::EVERY])


def find_sentinels(
    deltas: csc_array, columns: Columns, neutral: Points, shapes: int, height: float
) -> Sentinels:
    """Choose a place in every cell of space where something moves: the one that moves most.

    Parameters
    ----------
    deltas : (3n, k + c) csc_array
    columns
        The same, stored for fast products.
    neutral : (n, 3) float32
    shapes : int
        k, the columns that are shapes and not combinations.
    height : float
        Face height.
    """
    run = slice(0, deltas.indptr[shapes])
    motion = np.bincount(deltas.indices[run] // 3, deltas.data[run].astype(np.float64) ** 2, len(neutral))
    cells = np.floor(neutral / (CELL * height)).astype(np.int64)
    order = np.lexsort((-motion, *cells.T))
    _, first = np.unique(cells[order], axis=0, return_index=True)
    chosen = np.sort(order[first])
    chosen = chosen[motion[chosen] > 0.0]
    wanted = (3 * chosen[:, None] + np.arange(3)).ravel()
    rows = columns.rows(wanted).reshape(len(chosen), 3, -1)
    alone = rows[:, :, :shapes]
    flat = alone.reshape(3 * len(chosen), shapes)
    norms = np.sqrt(np.einsum("ij,ij->j", flat, flat))
    scale = np.divide(1.0, norms, out=np.zeros(shapes), where=norms > 0)
    likeness = (flat.T @ flat) * scale * scale[:, None]
    return Sentinels(
        neutral[chosen], rows.astype(np.float32), np.sqrt(np.einsum("sij,sij->sj", alone, alone)), likeness
    )
