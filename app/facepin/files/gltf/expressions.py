"""The expressions of an avatar (VRM 0 and 1): poses that its file brings."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from facepin.core.arrays import Floats, frozen
from facepin.core.errors import FacepinError
from facepin.core.names import clean_name
from facepin.core.rig_builder import LARGEST_WEIGHT
from facepin.files.gltf.document import GltfDocument
from facepin.files.gltf.shape_names import ShapeKey
from facepin.files.safely.checked_json import JsonObject

Bind = tuple[int, int, float]
"""Mesh, target, and weight of a target."""


def expressions(
    document: GltfDocument, keys: Mapping[int, Sequence[ShapeKey]], places: Mapping[ShapeKey, int]
) -> tuple[tuple[tuple[str, Floats], ...], list[str]]:
    """Return titles and weights (k,) of the expressions that move anything, and a line for each faulty one.

    Parameters
    ----------
    keys
        For each mesh of the rig, the shape of each of its targets.
    places
        Of the shapes in the rig.
    """
    found: dict[str, Floats] = {}
    faults = []
    for title, entry in _entries(document):
        try:
            weights = np.zeros(len(places))
            for mesh, target, weight in _binds(document, entry):
                shapes = keys.get(mesh, ())
                if target < len(shapes) and shapes[target] in places:
                    at = places[shapes[target]]  # of all its meshes, one shape has the largest weight
                    weights[at] = weight if abs(weight) > abs(weights[at]) else weights[at]
        except FacepinError as error:
            faults.append(f"the expression {title} is left out: {error}")
            continue
        if weights.any():
            found.setdefault(title, frozen(weights, np.float64))
    return tuple(found.items()), faults


def _entries(document: GltfDocument) -> Iterator[tuple[str, JsonObject]]:
    """Yield title and entry of each expression."""
    avatar = document.root.child("extensions")
    for entry in avatar.child("VRM").child("blendShapeMaster").children("blendShapeGroups"):
        title = clean_name(entry.text("name", "")) or clean_name(entry.text("presetName", ""))
        yield title or "expression", entry
    for kind in ("preset", "custom"):
        group = avatar.child("VRMC_vrm").child("expressions").child(kind)
        for name in group.values:
            yield clean_name(name) or "expression", group.child(name)


def _binds(document: GltfDocument, entry: JsonObject) -> Iterator[Bind]:
    """Yield what an expression does to targets: VRM 0 counts meshes and to 100, VRM 1 nodes and to 1."""
    for bind in entry.children("binds"):
        weight = bind.number("weight", low=-LARGEST_WEIGHT, high=LARGEST_WEIGHT)
        yield bind.integer("mesh", low=-1), bind.integer("index"), weight / 100
    nodes = document.root.children("nodes")
    for bind in entry.children("morphTargetBinds"):
        weight = bind.number("weight", low=-LARGEST_WEIGHT, high=LARGEST_WEIGHT)
        yield nodes[bind.integer("node")].integer("mesh"), bind.integer("index"), weight
