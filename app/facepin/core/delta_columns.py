"""Deltas of many shapes as the columns of one sparse matrix, checked on the way in."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csc_array, hstack

from facepin.core.arrays import Indices, Points, frozen
from facepin.core.errors import FacepinError
from facepin.core.names import clean_name

Delta = ArrayLike | tuple[ArrayLike, ArrayLike]
"""(n, 3) moves of all vertices, or the pair (s,) vertex indices and (s, 3) moves of those."""

FARTHEST = 1e9
"""Largest coordinate taken: its fourth power, met in squared normals, still fits a float32."""

MOST_SHAPES = 10_000
MOST_TWINS = 8
"""Shapes alike at first sight that one is compared with, so that no file can make it take for ever."""


@dataclass(frozen=True, eq=False)
class DeltaColumns:
    """What a sequence of shapes became."""

    names: list[str]
    """As they came."""
    matrix: csc_array
    """(3 n, k) float32, read-only, indices sorted, without zeros."""
    equal: list[tuple[int, int]]
    """Pairs of shapes that are the same."""
    still: list[int]
    """Shapes that move nothing."""


def delta_columns(
    where: str, shapes: Iterable[tuple[str, Delta]], vertices: int, kind: str = "shape"
) -> DeltaColumns:
    """Gather the deltas of `vertices` vertices as columns; messages begin with `where` and speak of `kind`.

    Raises
    ------
    FacepinError
        For deltas that do not fit or are not finite, and for too many shapes.
    """
    names: list[str] = []
    rows: list[Indices] = []
    moves: list[Points] = []
    still: list[int] = []
    equal: list[tuple[int, int]] = []
    seen: dict[tuple[int, int, float], list[int]] = {}
    for j, (raw_name, delta) in enumerate(shapes):
        if j == MOST_SHAPES:
            raise FacepinError(f"{where}: more than {MOST_SHAPES} {kind}s")
        names.append(raw_name)
        column_rows, column = _column(delta, vertices, f"{where}: {kind} {clean_name(raw_name) or j}")
        rows.append(column_rows)
        moves.append(column)
        if not len(column):
            still.append(j)
            continue
        twins = seen.setdefault((len(column), int(column_rows[0]), float(column.sum(dtype=np.float64))), [])
        for i in twins[:MOST_TWINS]:
            if np.array_equal(rows[i], column_rows) and np.array_equal(moves[i], column):
                equal.append((i, j))
                break
        else:
            twins.append(j)
    starts = np.zeros(len(names) + 1, np.int64)
    np.cumsum([len(column) for column in moves], out=starts[1:])
    if starts[-1] <= np.iinfo(np.int32).max:
        starts = starts.astype(np.int32)
    matrix = csc_array(
        (
            np.concatenate([np.zeros(0, np.float32), *moves]),
            np.concatenate([np.zeros(0, np.int32), *rows]),
            starts,
        ),
        shape=(3 * vertices, len(names)),
        copy=False,
    )
    return DeltaColumns(names, _read_only(matrix), equal, still)


def side_by_side(left: csc_array, right: csc_array) -> csc_array:
    """Return the columns of two matrices as one, read-only; `left` itself where there is nothing to add."""
    return _read_only(csc_array(hstack([left, right], "csc"))) if right.shape[1] else left


def _read_only(matrix: csc_array) -> csc_array:
    matrix.has_sorted_indices = True
    for array in (matrix.data, matrix.indices, matrix.indptr):
        array.flags.writeable = False
    return matrix


def _column(delta: Delta, vertices: int, where: str) -> tuple[Indices, Points]:
    """Return the row numbers, sorted, and the non-zero values of one shape."""
    if not isinstance(delta, tuple):
        points = checked_points(delta, where)
        if len(points) != vertices:
            raise FacepinError(f"{where} has {len(points)} vertices, the neutral has {vertices}")
        flat = points.ravel()
        kept = np.flatnonzero(flat)
        return kept.astype(np.int32), flat[kept]
    chosen, moved = np.asarray(delta[0]), np.asarray(delta[1])
    if chosen.ndim != 1 or chosen.shape != moved.shape[:1] or (len(chosen) and chosen.dtype.kind not in "iu"):
        raise FacepinError(f"{where}: {chosen.shape} vertex indices do not fit {moved.shape} moves")
    points = checked_points(moved, where, chosen)
    if not len(chosen):
        return np.zeros(0, np.int32), np.zeros(0, np.float32)
    if chosen.min() < 0 or chosen.max() >= vertices:
        wrong = chosen.min() if chosen.min() < 0 else chosen.max()
        raise FacepinError(f"{where} moves vertex {wrong}, allowed are 0 to {vertices - 1}")
    order = np.argsort(chosen, kind="stable")
    chosen = chosen[order].astype(np.int32)
    if (np.diff(chosen) == 0).any():
        raise FacepinError(
            f"{where} moves vertex {chosen[:-1][np.diff(chosen) == 0][0]} twice, allowed is once"
        )
    flat = points[order].ravel()
    kept = np.flatnonzero(flat)
    return (3 * chosen[kept // 3] + kept % 3).astype(np.int32), flat[kept]


def checked_points(values: ArrayLike, where: str, vertices: ArrayLike | None = None) -> Points:
    """Return (n, 3) float32, read-only, all finite and of a size that float32 arithmetic bears.

    `vertices` are the numbers of the rows for the message, where they are not 0, 1, 2 and so on.
    """
    array = np.asarray(values)
    if array.ndim != 2 or array.shape[1] != 3 or array.dtype.kind not in "fiu":
        raise FacepinError(f"{where} must be (n, 3) numbers, found {array.dtype} {array.shape}")
    with np.errstate(over="ignore"):
        points: Points = frozen(array, np.float32)
    with np.errstate(invalid="ignore"):
        wild = ~(np.abs(points) <= FARTHEST)
    if wild.any():
        row, axis = np.argwhere(wild)[0]
        vertex = row if vertices is None else np.asarray(vertices)[row]
        raise FacepinError(
            f"{where}: {'xyz'[axis]} of vertex {vertex} is {points[row, axis]}, "
            f"allowed are finite numbers up to {FARTHEST:.0e}"
        )
    return points
