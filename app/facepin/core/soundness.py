"""What is odd about a mesh and its shapes though every number in them is allowed."""

from collections.abc import Sequence

import numpy as np

from facepin.core.arrays import Indices, Points
from facepin.core.delta_columns import DeltaColumns
from facepin.core.names import listed

FAR = 5.0
"""Faces do not move by more than this many times their own size: a shape that does has other units."""


def motion_remarks(
    neutral: Points, corners: Indices, columns: DeltaColumns, names: Sequence[str]
) -> list[str]:
    """Return one line for each kind of oddity.

    Parameters
    ----------
    neutral : (n, 3) float32
    corners : (c,) int32
        Vertices that faces have.
    columns : DeltaColumns
        The deltas of the shapes.
    names : sequence of str
        Of the shapes.
    """
    drawn = np.zeros(len(neutral), np.bool_)
    drawn[corners] = True
    size = float(np.ptp(neutral[drawn], axis=0).max())
    remarks = []
    if size == 0:
        remarks.append("all faces of the neutral are in one point, so nothing of it can be seen")
    far, unseen = [], []
    starts = columns.matrix.indptr.tolist()
    for name, first, end in zip(names, starts, starts[1:], strict=False):
        if first == end:
            continue
        seen = drawn[columns.matrix.indices[first:end] // 3]
        if not seen.any():
            unseen.append(name)
        elif size and np.abs(columns.matrix.data[first:end][seen]).max() > FAR * size:
            far.append(name)
    if far:
        what = f"shapes that move farther than {FAR:g} times the size of the face, as in another unit"
        remarks.append(f"{what}: {listed(far)}")
    if unseen:
        remarks.append(f"shapes that move only vertices in no face, so nothing is seen: {listed(unseen)}")
    return remarks
