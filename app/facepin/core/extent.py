"""How large the face is: the part of a mesh that shapes move, of a head, a bust or a whole body."""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from facepin.core.arrays import Points

STIRS = 0.1
"""A shape stirs what it moves by more than this share of its largest move."""
SHARED = 0.15
"""What is stirred by fewer shapes than this share of those at the busiest vertex is not the face: a shape
for another build moves the body too."""
BODY = 0.2
"""A mesh is more than a head and a bust when the face is less than this share of its height."""
HEAD = 1.5, 1.3
"""Height of a head in heights, and in widths, of what shapes move in it: chin to brows, or a jaw only."""
AROUND = 0.9
"""How far a head reaches from the middle of what moves, in its heights."""


def face_height(neutral: Points, deltas: csc_array, drawn: NDArray[np.bool_]) -> float:
    """Return the height of the head along y, never zero: that of the mesh, unless most of it is no head.

    Parameters
    ----------
    neutral : (n, 3) float32
        Rest positions.
    deltas : (3n, k) float32
        Moves of the shapes.
    drawn : (n,) bool
        Vertices that count: those of triangles.
    """
    extent = np.ptp(neutral[drawn], axis=0) if drawn.any() else np.zeros(3)
    whole = float(extent[1] or extent.max() or 1.0)
    face = neutral[busy_vertices(deltas) & drawn]
    wide, tall, _ = np.ptp(face, axis=0).tolist() if len(face) > 2 else (0.0, 0.0, 0.0)
    if not 0.0 < tall < BODY * whole:
        return whole
    return min(max(HEAD[0] * tall, HEAD[1] * wide), whole)


def busy_vertices(deltas: csc_array) -> NDArray[np.bool_]:
    """Return which vertices many shapes (columns of (3n, k)) move, (n,) bool; none where none moves.

    Shapes that move more than half of all vertices (to another build, say) count only if there are no others.
    """
    count = deltas.shape[0] // 3
    local, anywhere = np.zeros((2, count), np.int32)
    starts, rows, values = deltas.indptr, deltas.indices, deltas.data
    for first, end in zip(starts[:-1].tolist(), starts[1:].tolist(), strict=True):
        moves = np.abs(values[first:end])
        stirred = np.zeros(count, np.bool_)
        stirred[rows[first:end][moves > STIRS * moves.max(initial=0.0)] // 3] = True
        anywhere += stirred
        if np.count_nonzero(stirred) <= count / 2:
            local += stirred
    stirring = local if local.any() else anywhere
    most = int(stirring.max(initial=0))
    return stirring > SHARED * most if most else np.zeros(count, np.bool_)


def head_vertices(
    neutral: Points, deltas: csc_array, drawn: NDArray[np.bool_], height: float
) -> NDArray[np.bool_]:
    """Return which vertices are the head, (n,) bool: all `drawn` ones, unless the mesh is a body.

    See `face_height`.
    """
    busy = neutral[busy_vertices(deltas) & drawn]
    if not len(busy) or height >= float(np.ptp(neutral[drawn, 1])):
        return drawn
    middle = (busy.min(axis=0) + busy.max(axis=0)) / 2
    head: NDArray[np.bool_] = (np.abs(neutral - middle) <= AROUND * height).all(axis=1) & drawn
    return head
