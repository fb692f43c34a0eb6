"""Lays the rings of the lids, from the margin on the lid sphere up to the skin, with the crease above."""

import numpy as np

from generator.anatomy import Anatomy, Eye
from generator.openings import lid_margin
from generator.topology import EYE_LOOP, EYE_RINGS, HalfGrid
from generator.vectors import Array, mix, smoothstep, unit

CREASE = {4: 0.15, 5: -1.0, 6: 0.50, 7: 0.55, 8: 0.25}
"""Height of the lid rings at the crease of the upper lid."""
LID_SLOPE = 5
"""Ring up to which the lids rise."""


def place_eye_rings(vertices: Array, half: HalfGrid, anatomy: Anatomy) -> None:
    """Put the margin and four rings on the lid sphere, the lining behind it, and blend out to the grid."""
    eye = anatomy.eye
    centre, radius = np.array(eye.centre), eye.radius * eye.lid_radius
    margin = lid_margin(eye)
    middle = unit(margin.mean(0) + np.array([0, 0.02, 0]))
    away = unit(margin - (margin @ middle)[:, None] * middle)
    opening = np.arccos(np.clip(margin @ middle, -1, 1))
    upper = np.arange(EYE_LOOP) <= EYE_LOOP // 2
    side = np.abs(np.linspace(-1, 1, EYE_LOOP // 2 + 1))
    side = np.concatenate([side, side[::-1][1:-1]])

    def at(angle: Array, distance: float) -> Array:
        return centre + distance * (np.cos(angle)[:, None] * middle + np.sin(angle)[:, None] * away)

    vertices[half.eye_rings[0]] = centre + radius * margin
    width = np.where(upper, 0.36, 0.30) * (1 - 0.35 * side**4)
    for k in range(1, EYE_RINGS):
        on_lid = at(opening + width * (k / 5) ** 1.15, radius)
        share = (k - 4) / (EYE_RINGS - 4) if k > 4 else 0
        vertices[half.eye_rings[k]] = mix(on_lid, vertices[half.eye_rings[EYE_RINGS]], share)
    for k, extra in {-1: -0.012, -2: 0.10, -3: 0.30}.items():
        vertices[half.eye_rings[k]] = at(opening + extra, eye.radius * 1.012)


def ease_lids(vertices: Array, half: HalfGrid, anatomy: Anatomy) -> None:
    """Spread the lids evenly between margin and skin, without a fold where the skin stands out."""
    centre = np.array(anatomy.eye.centre)
    margin, skin = (vertices[half.eye_rings[k]] - centre for k in (0, LID_SLOPE))
    lowest = anatomy.eye.radius * anatomy.eye.lid_radius
    out = np.maximum(np.linalg.norm(skin, axis=1), lowest)
    for k in range(1, LID_SLOPE):
        share = k / LID_SLOPE
        length = mix(lowest, out, share**1.6)
        vertices[half.eye_rings[k]] = centre + unit(mix(unit(margin), unit(skin), share)) * length[:, None]


def fold_upper_lid(vertices: Array, half: HalfGrid, anatomy: Anatomy) -> None:
    """Press the crease into the upper lid and let the skin above it hang over a little."""
    centre = np.array(anatomy.eye.centre)
    for k, height in crease_heights(anatomy.eye).items():
        ring = half.eye_rings[k][: len(height)]
        vertices[ring] += unit(vertices[ring] - centre) * height[:, None]


def crease_heights(eye: Eye) -> dict[int, Array]:
    """Return ring -> heights of the crease along the upper lid, which runs out softly at the inner corner."""
    along = np.linspace(-1, 1, EYE_LOOP // 2 + 1)
    share = smoothstep(-0.8, 0.15, along) * (1 - np.abs(along) ** 4)
    return {k: height * eye.crease * share for k, height in CREASE.items()}
