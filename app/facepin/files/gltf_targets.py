"""Which shape each morph target of a glTF mesh belongs to, and the weights that the file asks for."""

from collections import Counter

from facepin.files.checked_json import JsonObject
from facepin.files.gltf_scene import Placed

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
