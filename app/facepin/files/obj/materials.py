"""The colours of parts that an .obj file's material libraries (.mtl) give."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from facepin.core.errors import FacepinError
from facepin.core.names import listed
from facepin.core.rig_builder import PartLook
from facepin.files.obj.text import ObjText
from facepin.files.safely.reading import read_bytes

Material = dict[str, list[str]]
"""What a library says of a material: the words behind each keyword, the last one where it repeats."""


def look_like(
    looks: Sequence[PartLook], materials: Sequence[str], text: ObjText, folder: Path, told: list[str]
) -> list[PartLook]:
    """Return the looks of parts with the diffuse colour (`Kd`) and opacity (`d`, `Tr`) of their `materials`.

    `told` grows by a line for each kind of thing that is left out: libraries outside of the folder, textures.
    """
    library: dict[str, Material] = {}
    for at in text.lines_of(b"mtllib").tolist():
        line = text.line(at)[len(b"mtllib") :].decode("utf-8", "replace").strip()
        # One name, maybe with blanks in it, or several.
        names = line.split() if line.lower().count(".mtl") > 1 else [line]
        for name in names:
            try:
                library |= _read_library(folder, name)
            except FacepinError as error:
                told.append(f"materials of {text.name} are left out: {error}")
    found = [library.get(material, {}) for material in materials]
    textured = [name for name, material in zip(materials, found, strict=True) if "map_Kd" in material]
    if textured:
        told.append(f"textures of {text.name} (map_Kd) are left out, of the materials {listed(textured)}")
    return [_looking(look, material) for look, material in zip(looks, found, strict=True)]


def _read_library(folder: Path, name: str) -> dict[str, Material]:
    path = folder / name.replace("\\", "/")
    if "\0" in name or not path.resolve().is_relative_to(folder.resolve()):
        raise FacepinError(f"{name[:60]!a} is not in the folder, allowed are files inside it")
    if not path.is_file():  # most folders of shapes come without
        return {}
    materials: dict[str, Material] = {}
    current: Material = {}
    for line in read_bytes(path).decode("utf-8-sig", "replace").splitlines():
        word, *rest = line.split(maxsplit=1) or [""]
        if word == "newmtl":
            current = materials.setdefault(" ".join(rest).strip(), {})
        elif rest and not word.startswith("#"):
            current[word] = rest[0].split()
    return materials


def _looking(look: PartLook, material: Material) -> PartLook:
    """Return a look with what a material says; numbers that are none say nothing."""
    colour = _shares(material.get("Kd", []), 3)
    solid, clear = _shares(material.get("d", []), 1), _shares(material.get("Tr", []), 1)
    opacity = solid[0] if solid else 1.0 - clear[0] if clear else look.opacity
    if "map_Kd" in material or colour is None:  # the colour beside a texture is often black
        return replace(look, opacity=opacity, blends=opacity < 1)
    red, green, blue = colour
    return replace(look, colour=(red, green, blue), opacity=opacity, blends=opacity < 1)


def _shares(words: Sequence[str], count: int) -> list[float] | None:
    """Return `count` numbers 0..1, or None."""
    try:
        numbers = [float(word) for word in words[:count]]
    except ValueError:
        return None
    return numbers if len(numbers) == count and all(0 <= number <= 1 for number in numbers) else None
