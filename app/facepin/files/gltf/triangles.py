"""Triangles of glTF primitives: lists, strips and fans."""

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats
from facepin.files.gltf.accessors import read_indices
from facepin.files.gltf.document import GltfDocument
from facepin.files.safely.checked_json import JsonObject

TRIANGLES, STRIP, FAN = 4, 5, 6


def has_triangles(primitive: JsonObject) -> bool:
    """Say whether a primitive is a surface, not points or lines."""
    return primitive.integer("mode", TRIANGLES, high=FAN) in (TRIANGLES, STRIP, FAN)


def read_triangles(document: GltfDocument, primitive: JsonObject, vertices: int) -> NDArray[np.int64]:
    """Return (t, 3) vertex indices below `vertices`.

    Raises
    ------
    FacepinError
        For indices of vertices that are not there.
    """
    index = primitive.optional_integer("indices")
    indices: NDArray[np.int64] = (
        np.arange(vertices) if index is None else read_indices(document, index, vertices).astype(np.int64)
    )
    mode = primitive.integer("mode", TRIANGLES)
    if mode == TRIANGLES:
        return indices[: len(indices) // 3 * 3].reshape(-1, 3)
    middle, last = indices[1:-1], indices[2:]
    first = indices[:-2] if mode == STRIP else np.repeat(indices[:1], len(last))
    triangles = np.stack([first, middle[: len(last)], last], axis=1)
    if mode == STRIP:
        triangles[1::2] = triangles[1::2, [1, 0, 2]]
    return triangles


def outward(triangles: NDArray[np.int64], linear: Floats | None) -> NDArray[np.int64]:
    """Return triangles facing outwards also where (3, 3), or each vertex's (n, 3, 3), mirrors them."""
    if linear is None:
        return triangles
    with np.errstate(all="ignore"):
        mirrored = np.linalg.det(linear) < 0
    flipped = triangles[:, [0, 2, 1]]
    if linear.ndim == 2:
        return flipped if mirrored else triangles
    return np.where(mirrored[triangles[:, 0], None], flipped, triangles)
