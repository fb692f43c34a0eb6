"""Skins: where the joints of a face, as they stand in the file, carry each of its vertices."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats, Points
from facepin.core.errors import FacepinError
from facepin.files.gltf.accessors import read_floats, read_quadruples
from facepin.files.gltf.document import GltfDocument
from facepin.files.safely.checked_json import JsonObject

MOST_SETS = 8
"""Sets of four joints for each vertex that are asked for."""
NEARLY = 1e-5
"""Share of the size of a mesh within which two transforms do the same."""


def vertex_transforms(
    document: GltfDocument, primitive: JsonObject, joints: Floats, points: Points
) -> Floats | None:
    """Return (n, 3, 4) transforms of the vertices of a skinned primitive, from mesh to scene.

    One (3, 4) where it is the same for all of them, None where the primitive is bound to no joints.  Shapes
    are added before a skin moves anything, so it turns their deltas as it turns the positions.

    Parameters
    ----------
    joints : (j, 4, 4)
        Of the joints of the skin.
    points : (n, 3)
        Positions of the vertices, as the file has them.

    Raises
    ------
    FacepinError
        For joints that are not there, or not as many as there are vertices.
    """
    numbers, weights = _bindings(document, primitive, len(points))
    if numbers is None or not len(joints):
        return None
    numbers = np.where(weights > 0, numbers, 0)
    if numbers.max() >= len(joints):
        raise FacepinError(f"{primitive.where}: joint {numbers.max()}, allowed are 0 to {len(joints) - 1}")
    transforms = joints[:, :3]
    used = np.unique(numbers[weights > 0])
    if not _differ(transforms[used], points):
        first = transforms[used[0]]
        still = np.eye(3, 4)
        return first if _differ(np.stack([first, still]), points) else still
    result = np.zeros((len(points), 3, 4))
    for column in range(numbers.shape[1]):
        result += weights[:, column, None, None] * transforms[numbers[:, column]]
    return result


def _bindings(
    document: GltfDocument, primitive: JsonObject, count: int
) -> tuple[NDArray[Any] | None, Floats]:
    """Return joints and weights, (count, 4 s) each; weights are 0 or more, those of a vertex sum up to 1."""
    attributes = primitive.child("attributes")
    numbers, weights = [], []
    for at in range(MOST_SETS):
        keys = f"JOINTS_{at}", f"WEIGHTS_{at}"
        if not all(key in attributes for key in keys):
            break
        numbers.append(read_quadruples(document, attributes.integer(keys[0])).astype(np.int64))
        weights.append(read_floats(document, attributes.integer(keys[1]), ("VEC4",)).astype(np.float64))
        for key, table in ((keys[0], numbers[-1]), (keys[1], weights[-1])):
            if len(table) != count:
                raise FacepinError(
                    f"{primitive.where}: {key} has {len(table)} elements, POSITION has {count}"
                )
    if not numbers:
        return None, np.zeros((count, 0))
    joined = np.concatenate(weights, axis=1)
    joined = np.clip(np.where(np.isfinite(joined), joined, 0.0), 0.0, 1e6)
    joined[joined.sum(axis=1) == 0.0, 0] = 1.0
    return np.concatenate(numbers, axis=1), joined / joined.sum(axis=1, keepdims=True)


def _differ(transforms: Floats, points: Points) -> bool:
    """Say whether transforms (j, 3, 4) carry the box around points (n, 3) to different places."""
    ends = np.stack([points.min(axis=0), points.max(axis=0)]).astype(np.float64)
    corners = np.stack([ends[[i, j, k], [0, 1, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    size = float(np.linalg.norm(ends[1] - ends[0]))
    with np.errstate(all="ignore"):
        carried = np.einsum("jab,cb->jca", transforms[:, :, :3], corners) + transforms[:, None, :, 3]
        apart = np.abs(carried - carried[0]).max()
        scale = np.abs(transforms[0, :, :3]).max()
    return not apart <= NEARLY * size * scale
