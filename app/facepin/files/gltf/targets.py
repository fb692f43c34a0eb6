"""Which shape each morph target of a glTF mesh belongs to, and the weights that the file asks for."""

from collections import Counter

from facepin.files.gltf.scene import Placed
from facepin.files.safely.checked_json import JsonObject

COMBINATIONS = "facepinCombinations"
"""Where a mesh's extras list the targets whose weight is the product of two others, by numbers of targets:
`[{"target": 52, "shapes": [8, 20]}, …]`."""

ShapeKey = tuple[str | tuple[int, int], int]
"""(name, how many-eth of that name in its mesh); a target without a name has its mesh and place instead.

So shapes of several meshes (face, teeth, eyes) that bear the same name are one shape, and those without a
name are independent of each other.
"""


def shape_keys(place: Placed) -> tuple[list[ShapeKey], list[str]]:
    """Return the shape of each target of a mesh, in order, and what was odd about them."""
    counts = {len(primitive.children("targets")) for primitive in place.mesh.children("primitives")}
    count = max(counts, default=0)
    names = _target_names(place.mesh)
    odd = []
    if len(counts) > 1:
        odd.append(f"{place.mesh.where}: primitives have {sorted(counts)} targets; those missing are zero")
    if names and len(names) != count:
        odd.append(f"{place.mesh.where}: {len(names)} target names for {count} targets")
    keys: list[ShapeKey] = []
    repeated = Counter[str]()
    for j in range(count):
        name = names[j] if j < len(names) else ""
        keys.append((name, repeated[name]) if name else ((place.mesh_index, j), 0))
        repeated[name] += 1
    return keys, odd


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


def _target_names(mesh: JsonObject) -> list[str]:
    """Return the names of a mesh's targets, maybe too few: `mesh.extras`, else the first primitive's."""
    for holder in (mesh, *mesh.children("primitives")):
        extras = holder.values.get("extras")
        names = extras.get("targetNames") if isinstance(extras, dict) else None
        if isinstance(names, list) and names:
            return [name if isinstance(name, str) else "" for name in names]
    return []
