"""Paints the skin: blush, lips, lids, and baked occlusion of the sky in folds."""

import numpy as np
from scipy.spatial import cKDTree

from generator.anatomy import Colour
from generator.field import HeadField
from generator.landmarks import FaceMap
from generator.meshes import vertex_normals
from generator.skin import Skin
from generator.topology import EYE_LINING, EYE_LOOP, LIP_RINGS, MOUTH_BAG
from generator.vectors import Array, blob, mix, repeated, smoothstep

LID_TINT: Colour = (0.884, 0.725, 0.718)
"""Share of the skin's colour that thin lids reflect."""
LID_CREASE = {4: 0.10, 5: 0.45, 6: 0.15}
"""Share of the lid tint in the rings about the crease."""
LID_LINING: tuple[Colour, Colour] = ((0.94, 0.80, 0.855), (0.55, 0.36, 0.38))
"""The same for the lining, at the margin and deep inside."""
MOUTH_DARK: Colour = (0.33, 0.075, 0.075)
CORNER_DARK = 0.72
"""What the corners of the mouth are multiplied by where the lips meet."""
THROAT: Colour = (0.2, 0.04, 0.04)
OCCLUDED: Colour = (0.92, 0.83, 0.80)
"""Skin that sees no sky is multiplied by this: dark and warm."""
PROBES = ((0.15, 0.30), (0.4, 0.30), (0.9, 0.28), (1.7, 0.25))
HAIRLINE_SHADE, HAIRLINE_WIDTH = 0.75, 0.75
PART_GLOSS = -1.0
"""Gloss of vertices that take their roughness from their part."""


def paint_skin(skin: Skin, field: HeadField) -> tuple[Array, Array]:
    """Return (n, 3) colours and (n,) roughness overrides (PART_GLOSS for none)."""
    colours, v = field.anatomy.colours, skin.vertices
    side = FaceMap(field.anatomy).to_reference(v)
    side[:, 0] = np.abs(side[:, 0])
    colour = repeated(colours.skin, len(v))
    lid = np.array(colours.skin) * LID_TINT
    for share, centre, radii in (
        (0.50, (3.9, -2.4, 5.5), (1.7, 1.25, 2.5)),
        (0.38, (0, -2.6, 8.7), (1.25, 0.8, 1.2)),
        (0.12, (0, -8.8, 6.5), (1.5, 0.9, 2)),
    ):
        colour = mix(colour, colours.cheek, share * blob(side, centre, radii)[:, None])
    for k, share in enumerate((0.40, 0.26, 0.20, 0.16, 0.10, 0.05)):
        ring = skin.both_sides(skin.eye_rings[k])
        colour[ring] = mix(colour[ring], lid, share)
    for k, share in LID_CREASE.items():
        count = EYE_LOOP // 2 + 1
        across = 1 - np.abs(np.linspace(-1, 1, count)) ** 4
        for ring in (skin.eye_rings[k][:count], skin.mirror[skin.eye_rings[k][:count]]):
            colour[ring] = mix(colour[ring], lid, (share * across * (field.anatomy.eye.crease > 0))[:, None])
    colour *= _occlusion(skin, field, side)
    gloss = _paint_mouth(colour, skin, field)
    for k in range(-EYE_LINING, 0):
        colour[skin.both_sides(skin.eye_rings[k])] = colours.skin * mix(*LID_LINING, (-k - 1) / 2)
    return colour, gloss


def shade_hairline(colour: Array, skin: Skin, line: Array, hair: Colour) -> Array:
    """Return skin colours that take on some of the hair's along its edge, as short hair would give them."""
    distance, _ = cKDTree(line).query(skin.vertices)
    share = HAIRLINE_SHADE * np.exp(-((np.asarray(distance) / HAIRLINE_WIDTH) ** 2))
    return mix(colour, colour * mix(1, hair, 0.7), share[:, None])


def _occlusion(skin: Skin, field: HeadField, side: Array) -> Array:
    """Return (n, 3) factors of baked occlusion, weaker at the inner corner of the eye and under the nose."""
    is_open = field.occlusion(skin.vertices, vertex_normals(skin.vertices, skin.triangles), PROBES)
    shade = 1 - np.clip(is_open, 0.25, 1)
    shade *= 1 - 0.72 * blob(side, (2.0, 0.9, 6.2), (1.8, 1.5, 2.0))
    shade *= 1 - 0.60 * blob(side, (4.2, 0.6, 5.0), (2.0, 2.2, 2.6))
    nostril = blob(side, (0.5, -3.15, 7.65), (0.28, 0.35, 0.36))
    shade *= 1 - 0.50 * blob(side, (0.5, -3.6, 7.0), (1.6, 0.7, 1.2)) * (1 - 0.55 * nostril)
    return mix(OCCLUDED, (1, 1, 1), (1 - shade)[:, None])


def _paint_mouth(colour: Array, skin: Skin, field: HeadField) -> Array:
    """Paint lips and the inside of the mouth; return the roughness overrides."""
    lip, half_width = field.anatomy.colours.lip, field.anatomy.mouth.half_width
    gloss = np.full(len(colour), PART_GLOSS)
    for k, share in zip(range(LIP_RINGS), (0.97, 0.97, 0.95, 0.93, 0.88, 0.42), strict=True):
        ring = skin.both_sides(skin.mouth_rings[k])
        corner = smoothstep(0.84, 0.98, np.abs(skin.vertices[ring, 0]) / half_width)
        colour[ring] = mix(colour[ring], lip, (share * (1 - 0.45 * corner))[:, None])
        colour[ring] *= mix(1, CORNER_DARK, corner * (1 - k / LIP_RINGS))[:, None]
        gloss[ring] = mix(0.33 if k < LIP_RINGS - 1 else 0.40, 0.95, corner)
    darkness = {-1: 0.15, -2: 0.5, -3: 0.85}
    for k in range(-MOUTH_BAG, 0):
        ring = skin.both_sides(skin.mouth_rings[k])
        colour[ring] = mix(np.array(lip) * 0.95, MOUTH_DARK, darkness.get(k, 1.0))
        if k < -1:
            gloss[ring] = 0.6
    colour[skin.bag_centre] = THROAT
    return gloss
