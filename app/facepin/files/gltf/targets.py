"""Which shape each morph target of a glTF mesh belongs to, and the weights that the file asks for."""

from collections.abc import Sequence

from facepin.files.gltf.document import GltfDocument
from facepin.files.gltf.scene import Placed
from facepin.files.gltf.shape_names import NamedMesh, ShapeKey, same_shapes, target_names

COMBINATIONS = "facepinCombinations"
"""Where a mesh's extras list the targets whose weight is the product of two others, by numbers of targets:
`[{"target": 52, "shapes": [8, 20]}, …]`."""


def shape_keys(
    document: GltfDocument, placed: Sequence[Placed]
) -> tuple[dict[int, list[ShapeKey]], list[str]]:
    """Return the shape of each target of each mesh, in order, and what was odd about them."""
    meshes: dict[int, NamedMesh] = {}
    odd = []
    for place in placed:
        if place.mesh_index in meshes:
            continue
        counts = {len(primitive.children("targets")) for primitive in place.mesh.children("primitives")}
        names, given = target_names(document, place.mesh)
        if len(counts) > 1:
            odd.append(
                f"{place.mesh.where}: primitives have {sorted(counts)} targets; those missing are zero"
            )
        if given and given != len(names):
            odd.append(f"{place.mesh.where}: {given} target names for {len(names)} targets")
        meshes[place.mesh_index] = NamedMesh(place.name, tuple(names))
    keys, remarks = same_shapes(meshes)
    return keys, odd + remarks


def combined_targets(place: Placed, keys: list[ShapeKey]) -> dict[ShapeKey, tuple[ShapeKey, ShapeKey]]:
    """Return which targets of a mesh are combinations, as `write_glb` notes them, and of which two shapes.

    Raises
    ------
    FacepinError
        When what is noted does not fit the targets.
    """
    if not isinstance(place.mesh.values.get("extras"), dict):
        return {}
    entries = [
        (entry.integer("target", high=len(keys) - 1), entry.indices("shapes", len(keys) - 1), entry)
        for entry in place.mesh.child("extras").children(COMBINATIONS)
    ]
    targets = {target for target, _, _ in entries}
    for _, shapes, entry in entries:
        if len(shapes) != 2 or shapes[0] == shapes[1] or targets & {*shapes}:
            entry.refuse("shapes", "numbers of two different targets that are no combinations")
    return {keys[target]: (keys[shapes[0]], keys[shapes[1]]) for target, shapes, _ in entries}


def rest_weights(place: Placed, count: int) -> tuple[list[float], list[str]]:
    """Return `count` weights, the node's or else the mesh's, and what was odd about them."""
    holder = place.node if "weights" in place.node else place.mesh
    if "weights" not in holder:
        return [0.0] * count, []
    weights = holder.numbers("weights")
    if len(weights) == count:
        return weights, []
    odd = f"{holder.where}.weights has {len(weights)} entries for {count} targets"
    return (weights + [0.0] * count)[:count], [odd]
