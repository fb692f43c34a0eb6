"""Quarter turns: how a face lies here, compared with its file.  y is up here, and the face looks along z."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csc_array

from facepin.core.arrays import Points, frozen

Turn = tuple[int, int, int]
"""For x, y and z here the axis of the file, 1 to 3, with its sign.  Turning back gives every bit back."""

AS_IN_FILE: Turn = (1, 2, 3)
QUARTERS: dict[str, Turn] = {"x": (1, -3, 2), "y": (3, 2, -1), "z": (-2, 1, 3)}
"""A quarter turn about each axis, counter-clockwise as seen from its tip."""


def after(turn: Turn, then: Turn) -> Turn:
    """Return the turn that is one turn and `then` another."""
    x, y, z = (turn[abs(axis) - 1] * (1 if axis > 0 else -1) for axis in then)
    return x, y, z


def back(turn: Turn) -> Turn:
    """Return the turn that undoes a turn."""
    found = [0, 0, 0]
    for here, axis in enumerate(turn, start=1):
        found[abs(axis) - 1] = here if axis > 0 else -here
    x, y, z = found
    return x, y, z


def facing(up: ArrayLike, front: ArrayLike) -> Turn | None:
    """Return the turn after which `up` (3,) is y and `front` (3,) is z, each along an axis; None if not."""
    y, z = _axis(up), _axis(front)
    if y is None or z is None or abs(y) == abs(z):
        return None
    across = np.cross(_vector(y), _vector(z))
    x = _axis(across)
    assert x is not None, "two axes have a third"
    return x, y, z


def turn_points(points: ArrayLike, turn: Turn) -> Points:
    """Return points (m, 3) as they lie after a turn, read-only float32."""
    columns = [np.asarray(points)[..., abs(axis) - 1] * np.float32(np.sign(axis)) for axis in turn]
    turned: Points = frozen(np.stack(columns, axis=-1), np.float32)
    return turned


def turn_deltas(deltas: csc_array, turn: Turn) -> csc_array:
    """Return moves (3n, k) as they are after a turn, with sorted indices."""
    vertex, axis = np.divmod(deltas.indices, 3)
    here = np.array([abs(of) - 1 for of in back(turn)], deltas.indices.dtype)
    signs = np.array([np.sign(of) for of in back(turn)], deltas.data.dtype)
    moved = (deltas.data * signs[axis], 3 * vertex + here[axis], deltas.indptr.copy())
    turned = csc_array(moved, shape=deltas.shape)
    turned.has_sorted_indices = False
    turned.sort_indices()
    for array in (turned.data, turned.indices, turned.indptr):
        array.flags.writeable = False
    return turned


def parse_turn(text: str) -> Turn:
    """Read a turn: "file" for none, or quarter turns one after the other, such as "x90,y180".

    Raises
    ------
    ValueError
        For anything else.
    """
    turn = AS_IN_FILE
    for word in [] if text == "file" else text.split(","):
        axis, degrees = word[:1].lower(), word[1:]
        if axis not in QUARTERS or degrees not in ("90", "180", "270", "-90"):
            raise ValueError(f"found '{text}', allowed: file, or turns such as x90 or x-90,y180")
        for _ in range(int(degrees) // 90 % 4):
            turn = after(turn, QUARTERS[axis])
    return turn


def _axis(vector: ArrayLike) -> int | None:
    """Return the signed number of the axis that a vector lies along, None for one that lies between."""
    found = np.asarray(vector, np.float64)
    at = int(np.argmax(np.abs(found)))
    length = float(np.linalg.norm(found))
    if not length or abs(found[at]) < 0.85 * length:
        return None
    return (at + 1) * (1 if found[at] > 0 else -1)


def _vector(axis: int) -> np.ndarray:
    found = np.zeros(3)
    found[abs(axis) - 1] = np.sign(axis)
    return found
