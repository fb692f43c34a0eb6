"""What a glTF material says about the look of a part; glTF colours are linear, ours are sRGB."""

import numpy as np
from numpy.typing import ArrayLike

from facepin.core.arrays import Points, frozen
from facepin.core.rig_builder import PartLook
from facepin.files.gltf.document import GltfDocument
from facepin.files.safely.checked_json import JsonObject

TRANSMISSION = "KHR_materials_transmission"


def linear_to_srgb(linear: ArrayLike) -> Points:
    """Encode linear light as sRGB, both 0..1, any shape (IEC 61966-2-1)."""
    light = np.clip(np.asarray(linear, np.float64), 0.0, 1.0)
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055).astype(np.float32)


def srgb_to_linear(encoded: ArrayLike) -> Points:
    """Decode sRGB to linear light, both 0..1, any shape."""
    colour = np.clip(np.asarray(encoded, np.float64), 0.0, 1.0)
    return np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4).astype(np.float32)


def material_factor(document: GltfDocument, primitive: JsonObject) -> Points:
    """Return the linear base colour factor of a primitive's material, (3,), ones where there is none."""
    shine = shine_of(document, primitive)
    if shine is None or "baseColorFactor" not in shine:
        return np.ones(3, np.float32)
    factor = np.clip(shine.numbers("baseColorFactor", 4)[:3], 0.0, 1.0)
    return frozen(factor, np.float32)


def part_look(document: GltfDocument, primitive: JsonObject, mesh: str, at: int, count: int) -> PartLook:
    """Return name and look of the part that primitive `at` of `count` makes.

    A mesh of one primitive gives the part its name, else the material does.  A white factor says nothing
    where a texture or vertex colours carry the colour.
    """
    shine = shine_of(document, primitive)
    name = mesh if count == 1 else f"{mesh} {at}"
    if shine is None:
        return PartLook(name, double_sided=False)
    material = document.root.children("materials")[primitive.integer("material")]
    if count > 1:
        name = material.text("name", "") or name
    factor = material_factor(document, primitive)
    carried = "baseColorTexture" in shine or "COLOR_0" in primitive.child("attributes")
    red, green, blue = (float(channel) for channel in linear_to_srgb(factor))
    colour = None if carried and (factor == 1.0).all() else (red, green, blue)
    roughness = shine.number("roughnessFactor", 1.0, low=0.0, high=1.0)
    glass = material.child("extensions").child(TRANSMISSION)
    opacity, cutout = _alpha(material, shine)
    return PartLook(
        name,
        colour,
        roughness,
        cutout=cutout,
        opacity=opacity,
        blends=material.text("alphaMode", "OPAQUE") == "BLEND",
        transmission=glass.number("transmissionFactor", 0.0, low=0.0, high=1.0),
        double_sided=material.flag("doubleSided", False),
    )


def _alpha(material: JsonObject, shine: JsonObject) -> tuple[float, float | None]:
    """Return opacity and cutout of a material.

    What is meant to be blended is cut as well: order does not matter then, and cards of lashes look right.
    Without a texture there is nothing to cut along: such a surface is there as a whole or not at all.
    """
    mode = material.text("alphaMode", "OPAQUE")
    if mode == "OPAQUE":
        return 1.0, None
    factor = shine.numbers("baseColorFactor", 4)[3] if "baseColorFactor" in shine else 1.0
    opacity = min(max(factor, 0.0), 1.0)
    cutout = material.number("alphaCutoff", 0.5, low=0.0) if mode == "MASK" else 0.5
    if "baseColorTexture" in shine:
        return opacity, cutout
    return (float(opacity >= cutout) if mode == "MASK" else opacity), None


def shine_of(document: GltfDocument, primitive: JsonObject) -> JsonObject | None:
    """Return the `pbrMetallicRoughness` of a primitive's material, or None without a material.

    The older `KHR_materials_pbrSpecularGlossiness` takes its place where there is one: its diffuse colour
    is the base colour of what is no metal.
    """
    index = primitive.optional_integer("material")
    if index is None:
        return None
    material = document.root.children("materials")[index]
    older = material.child("extensions").child("KHR_materials_pbrSpecularGlossiness")
    if not older.values:
        return material.child("pbrMetallicRoughness")
    names = {"diffuseFactor": "baseColorFactor", "diffuseTexture": "baseColorTexture"}
    shine = {new: older.values[old] for old, new in names.items() if old in older}
    gloss = older.number("glossinessFactor", 1.0, low=0.0, high=1.0)
    return JsonObject({**shine, "roughnessFactor": 1.0 - gloss}, older.where)
