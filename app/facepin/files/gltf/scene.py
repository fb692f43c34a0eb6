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
MESH = 32
"""How many vertices a mesh at a node counts for at least."""


@dataclass(frozen=True, eq=False)
class Placed:
    """A mesh at a node."""

    node: JsonObject
    mesh: JsonObject
    mesh_index: int
    matrix: Floats
    """(4, 4) from mesh to scene, acting on columns."""
    joints: Floats | None
    """(j, 4, 4) the same for each joint of its skin, which count instead; None without a skin."""

    @property
    def name(self) -> str:
        """What the mesh is called, or else its node."""
        return self.mesh.text("name", "") or self.node.text("name", "") or f"mesh {self.mesh_index}"


def placed_meshes(document: GltfDocument) -> list[Placed]:
    """Return the meshes of the scene in the order in which the node tree is walked.

    A skinned mesh does not follow its node but the joints of its skin, as they stand in the file.

    Raises
    ------
    FacepinError
        For references to what does not exist and for nodes that are their own ancestors.
    """
    root = document.root
    nodes, meshes = root.children("nodes"), root.children("meshes")
    document.check_growth(MESH * sum("mesh" in node for node in nodes), "meshes")
    world = dict(_world_matrices(root))
    placed = []
    joints: dict[int, Floats] = {}
    for index, matrix in world.items():
        node = nodes[index]
        mesh_index = node.optional_integer("mesh")
        if mesh_index is None:
            continue
        if mesh_index >= len(meshes):
            node.refuse("mesh", f"0 to {len(meshes) - 1}" if len(meshes) else "nothing, there are no meshes")
        skin = node.optional_integer("skin")
        if skin is not None and skin not in joints:
            joints[skin] = _joint_matrices(document, skin, world)
        bones = None if skin is None else joints[skin]
        placed.append(Placed(node, meshes[mesh_index], mesh_index, matrix, bones))
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
        matrix = product(parent, _local_matrix(nodes[index]), f"{nodes.where}[{index}]")
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


def _joint_matrices(document: GltfDocument, index: int, world: dict[int, Floats]) -> Floats:
    """Return what carries by each joint, (j, 4, 4) from mesh to scene; one not in it moves nothing."""
    skin = document.root.children("skins")[index]
    joints = skin.indices("joints", len(document.root.children("nodes")) - 1)
    inverse = np.broadcast_to(np.eye(4), (len(joints), 4, 4))
    binding = skin.optional_integer("inverseBindMatrices")
    if binding is not None:
        columns = read_floats(document, binding, ("MAT4",))
        if len(columns) < len(joints):
            raise FacepinError(f"{skin.where}: {len(columns)} inverseBindMatrices for {len(joints)} joints")
        inverse = columns[: len(joints)].reshape(-1, 4, 4).transpose(0, 2, 1).astype(np.float64)
    matrices = np.broadcast_to(np.eye(4), (len(joints), 4, 4)).copy()
    for at, joint in enumerate(joints):
        if joint in world:
            matrices[at] = product(world[joint], inverse[at], skin.where)
    return matrices


def product(left: Floats, right: Floats, where: str) -> Floats:
    """Return the product of two transforms; `FacepinError` where its numbers leave all bounds."""
    with np.errstate(all="ignore"):
        product: Floats = left @ right
    if not np.abs(product).max() <= LARGEST:
        raise FacepinError(f"{where}: its transform is too large to compute with")
    return product
