"""Where the meshes of a glTF stand: the node tree walked, transforms baked."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats
from facepin.core.errors import FacepinError
from facepin.files.gltf.accessors import read_floats
from facepin.files.gltf.document import GltfDocument
from facepin.files.safely.checked_json import JsonObject

LARGEST = 1e30


@dataclass(frozen=True, eq=False)
class Placed:
    """A mesh at a node."""

    node: JsonObject
    mesh: JsonObject
    mesh_index: int
    matrix: Floats
    """(4, 4) from mesh to scene, acting on columns."""


def placed_meshes(document: GltfDocument) -> list[Placed]:
    """Return the meshes of the scene in the order in which the node tree is walked.

    A skinned mesh does not follow its node.  At rest all its bones give one and the same matrix, so that of
    the first bone places it.

    Raises
    ------
    FacepinError
        For references to what does not exist and for nodes that are their own ancestors.
    """
    root = document.root
    nodes, meshes = root.children("nodes"), root.children("meshes")
    world = dict(_world_matrices(root))
    placed = []
    for index, matrix in world.items():
        node = nodes[index]
        mesh_index = node.optional_integer("mesh")
        if mesh_index is None:
            continue
        if mesh_index >= len(meshes):
            node.refuse("mesh", f"0 to {len(meshes) - 1}" if len(meshes) else "nothing, there are no meshes")
        if "skin" in node:
            matrix = _skin_matrix(document, node.integer("skin"), world)
        placed.append(Placed(node, meshes[mesh_index], mesh_index, matrix))
    return placed


def avatar_front(document: GltfDocument) -> tuple[float, float, float] | None:
    """Return which way the face of an avatar looks, None where the file is not said to be one.

    VRM 0 looks along -z, VRM 1 along z; y is up in both.  That glTF itself has the front at z binds few.
    """
    extensions = document.root.child("extensions")
    if "VRMC_vrm" in extensions:
        return 0.0, 0.0, 1.0
    return (0.0, 0.0, -1.0) if "VRM" in extensions else None


def _world_matrices(root: JsonObject) -> Iterator[tuple[int, Floats]]:
    """Walk from the roots of the scene (of all nodes, where there is no scene) down, parents first."""
    nodes = root.children("nodes")
    last = len(nodes) - 1
    scenes = root.children("scenes")
    children = [node.indices("children", last) for node in nodes]
    if len(scenes):
        roots = scenes[root.integer("scene", 0)].indices("nodes", last)
    else:
        with_parent = {child for group in children for child in group}
        roots = [index for index in range(len(nodes)) if index not in with_parent]
        if len(nodes) and not roots:
            raise FacepinError(f"{nodes.where} form a cycle, allowed is a tree")
    waiting: list[tuple[int, Floats]] = [(index, np.eye(4)) for index in reversed(roots)]
    seen = set[int]()
    while waiting:
        index, parent = waiting.pop()
        if index in seen:
            raise FacepinError(
                f"{nodes.where}[{index}] is reached twice: a cycle or two parents, allowed is a tree"
            )
        seen.add(index)
        matrix = _product(parent, _local_matrix(nodes[index]), f"{nodes.where}[{index}]")
        yield index, matrix
        waiting += [(child, matrix) for child in reversed(children[index])]


def _local_matrix(node: JsonObject) -> Floats:
    """Return a node's own transform, (4, 4) float64, from its matrix or its translation, rotation, scale."""
    if "matrix" in node:
        return np.array(node.numbers("matrix", 16)).reshape(4, 4).T
    matrix = np.eye(4)
    if "rotation" in node:
        matrix[:3, :3] = _rotation(node)
    if "scale" in node:
        matrix[:3, :3] *= node.numbers("scale", 3)
    if "translation" in node:
        matrix[:3, 3] = node.numbers("translation", 3)
    return matrix


def _rotation(node: JsonObject) -> NDArray[np.float64]:
    quaternion = np.array(node.numbers("rotation", 4))
    length = np.abs(quaternion).max()
    if length == 0.0:
        node.refuse("rotation", "a quaternion other than zero")
    quaternion = quaternion / length
    x, y, z, w = quaternion / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def _skin_matrix(document: GltfDocument, index: int, world: dict[int, Floats]) -> Floats:
    skin = document.root.children("skins")[index]
    joints = skin.indices("joints", len(document.root.children("nodes")) - 1)
    if not joints or joints[0] not in world:
        return np.eye(4)
    matrix = world[joints[0]]
    binding = skin.optional_integer("inverseBindMatrices")
    if binding is not None:
        inverse = read_floats(document, binding, ("MAT4",))[0].reshape(4, 4).T.astype(np.float64)
        matrix = _product(matrix, inverse, skin.where)
    return matrix


def _product(left: Floats, right: Floats, where: str) -> Floats:
    with np.errstate(all="ignore"):
        product: Floats = left @ right
    if not np.abs(product).max() <= LARGEST:
        raise FacepinError(f"{where}: its transform is too large to compute with")
    return product
