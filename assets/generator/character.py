"""A character without its shapes: all parts in place, joined into one mesh."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from generator.anatomy import Anatomy
from generator.brows import brow, lashes
from generator.colours import PART_GLOSS, paint_skin, shade_hairline
from generator.ears import ear
from generator.eyes import eyeball
from generator.field import HeadField
from generator.hair import hair, hairline
from generator.meshes import Mesh, joined
from generator.mouth_parts import dental_arch, tongue
from generator.shirt import shirt
from generator.skin import Skin, build_skin
from generator.vectors import MIRROR, Array, Ints

MATERIALS = {
    "skin": (0.50, 1.0, 0.75),
    "eyeL": (0.09, 0.15, 1.0),
    "eyeR": (0.09, 0.15, 1.0),
    "teethUpper": (0.22, 0.35, 0.9),
    "teethLower": (0.22, 0.35, 0.9),
    "gums": (0.28, 0.6, 0.9),
    "tongue": (0.35, 0.8, 0.8),
    "browL": (0.6, 0.0, 0.5),
    "browR": (0.6, 0.0, 0.5),
    "lashL": (0.75, 0.0, 0.4),
    "lashR": (0.75, 0.0, 0.4),
    "earL": (0.50, 1.0, 0.75),
    "earR": (0.50, 1.0, 0.75),
    "hair": (0.48, 0.0, 0.7),
    "shirt": (0.75, 0.0, 0.35),
}
"""Parts in the order of their faces: (roughness, translucency, specular)."""


@dataclass(frozen=True, eq=False)
class Character:
    """Everything about a character that does not move."""

    anatomy: Anatomy
    field: HeadField
    skin: Skin
    vertices: Array
    triangles: Ints
    colours: Array
    gloss: Array
    part: Ints
    """(n,) index into MATERIALS."""
    lash_roots: Ints
    """Skin vertex that each vertex of the left lashes grows from."""
    upper_gum_count: int
    """The first vertices of the gums; they stay when the jaw opens."""

    def at(self, part: str) -> Ints:
        """Return the vertices of a part."""
        return np.flatnonzero(self.part == list(MATERIALS).index(part))

    def place(self, part: str) -> Array:
        """Return the (n, 3) neutral positions of a part."""
        return self.vertices[self.at(part)]

    def mirror(self) -> Ints:
        """Return (n,) for every vertex the one at the mirrored place."""
        result = np.arange(len(self.vertices))
        for name in MATERIALS:
            here = self.at(name)
            other = swapped(name)
            if name == "skin":
                result[here] = self.skin.mirror
            elif other != name:
                result[here] = self.at(other)
            elif len(here):
                result[here] = here[cKDTree(self.vertices[here]).query(self.vertices[here] * MIRROR)[1]]
        return result


def swapped(name: str) -> str:
    """Return the name of a part or shape with its sides exchanged."""
    if "Left" in name or "Right" in name:
        return name.replace("Left", "#").replace("Right", "Left").replace("#", "Right")
    if name[:-1] in ("eye", "brow", "lash", "ear"):
        return name[:-1] + {"L": "R", "R": "L"}[name[-1]]
    return name


def build_character(anatomy: Anatomy) -> Character:
    """Return the neutral character for an anatomy."""
    field = HeadField(anatomy)
    skin = build_skin(field)
    colour, gloss = paint_skin(skin, field)
    colours, mouth, locks = anatomy.colours, anatomy.mouth, hair(field)
    colour = shade_hairline(colour, skin, hairline(locks), colours.hair)
    teeth_z = skin.vertices[skin.mouth_rings[0]][0, 2] - 0.54
    upper_teeth, upper_gum = dental_arch(teeth_z, mouth.height - 0.22, True, colours)
    lower_teeth, lower_gum = dental_arch(teeth_z - 0.24, mouth.height - 0.02, False, colours)
    left_lashes, roots = lashes(skin, field)
    left = {"eye": eyeball(anatomy.eye, colours), "brow": brow(field), "lash": left_lashes, "ear": ear(field)}
    parts = {
        "skin": Mesh(skin.vertices, skin.triangles, colour),
        "teethUpper": upper_teeth,
        "teethLower": Mesh(lower_teeth.vertices, lower_teeth.triangles, lower_teeth.colours * 0.97),
        "gums": joined(upper_gum, lower_gum),
        "tongue": tongue(teeth_z, mouth.height - 0.85, colours),
        "hair": locks,
        "shirt": shirt(anatomy.skull, colours),
    }
    for name, mesh in left.items():
        parts[name + "L"], parts[name + "R"] = mesh, mesh.mirrored()
    meshes = [parts[name] for name in MATERIALS]
    counts = [len(mesh.vertices) for mesh in meshes]
    starts = np.cumsum([0, *counts[:-1]])
    return Character(
        anatomy=anatomy,
        field=field,
        skin=skin,
        vertices=np.concatenate([mesh.vertices for mesh in meshes]),
        triangles=np.concatenate([m.triangles + start for m, start in zip(meshes, starts, strict=True)]),
        colours=np.clip(np.concatenate([mesh.colours for mesh in meshes]), 0, 1),
        gloss=np.r_[gloss, np.full(sum(counts) - len(gloss), PART_GLOSS)],
        part=np.repeat(np.arange(len(meshes)), counts),
        lash_roots=roots,
        upper_gum_count=len(upper_gum.vertices),
    )
