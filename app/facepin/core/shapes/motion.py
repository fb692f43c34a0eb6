"""Where single shapes move the face, and which shapes move a place of it."""

from dataclasses import dataclass

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.rig import Rig

NOTABLE = 0.02
"""Share of the strongest move at a vertex below which a shape does not count there."""


def shape_moves(rig: Rig, shape: int) -> Floats:
    """Return how far a shape at weight 1 moves each vertex, (n,) float64 lengths."""
    run = slice(rig.deltas.indptr[shape], rig.deltas.indptr[shape + 1])
    squares = rig.deltas.data[run].astype(np.float64) ** 2
    lengths: Floats = np.sqrt(np.bincount(rig.deltas.indices[run] // 3, squares, rig.vertex_count))
    return lengths


def movers(rig: Rig, vertex: int) -> list[tuple[int, float]]:
    """Return the shapes that move a vertex, strongest first, each with its move at weight 1 as a length.

    Those that move it by less than `NOTABLE` of the strongest one are left out.
    """
    lengths = np.linalg.norm(rig.rows_at([vertex])[:, : rig.shape_count], axis=0)
    least = max(NOTABLE * lengths.max(initial=0.0), np.finfo(np.float64).tiny)
    strongest = np.argsort(-lengths, kind="stable")[: np.count_nonzero(lengths >= least)]
    return [(int(j), float(lengths[j])) for j in strongest]


@dataclass(frozen=True, eq=False)
class ShapePlaces:
    """Where the k shapes of a rig move the face, weighted by the square of the move; NaN for empty shapes."""

    left: Floats
    """(k,) share of the motion at x above the middle of the face, 0..1."""
    out: Floats
    """(k,) mean distance from the middle, a length."""
    height: Floats
    """(k,) mean y."""
    depth: Floats
    """(k,) mean z."""
    spread: Floats
    """(k,) standard deviation of y: small for a lip, large for a whole head."""


def shape_places(rig: Rig) -> ShapePlaces:
    """Measure where each shape moves the face; some tenths of a second for a hundred dense shapes."""
    x, y, z = rig.neutral.astype(np.float64).T
    x = x - (x.min() + x.max()) / 2
    measured = np.stack([np.ones(len(x)), x > 0, np.abs(x), y, z, y * y])
    sums = np.array([measured @ shape_moves(rig, j) ** 2 for j in range(rig.shape_count)]).reshape(-1, 6)
    with np.errstate(invalid="ignore", divide="ignore"):
        left, out, height, depth, squares = (sums[:, 1:] / sums[:, :1]).T
    return ShapePlaces(left, out, height, depth, np.sqrt(np.maximum(squares - height**2, 0.0)))
