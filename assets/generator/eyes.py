"""Eyeballs: rings round the line of sight, so that pupil, iris and limbal ring lie on edges."""

import numpy as np

from generator.anatomy import Colours, Eye
from generator.meshes import Mesh, strips
from generator.vectors import Array, mix, repeated, smoothstep

MERIDIANS = 36
PUPIL: tuple[float, float, float] = (0.012, 0.011, 0.012)
SCLERA = ((0.92, 0.915, 0.905), (0.74, 0.62, 0.58))
"""White of the eye: in front, and towards the sides."""


def eyeball(eye: Eye, colours: Colours) -> Mesh:
    """Return the left eyeball, looking along z."""
    fixed = (0.31, 0.39, 0.46, eye.iris - 0.055, eye.iris - 0.01, eye.iris + 0.02)
    outer = (0.64, 0.80, 1.05, 1.40, 1.90, np.pi)
    angles = np.array([0, 0.10, 0.19, eye.pupil - 0.012, eye.pupil + 0.012, *fixed, *outer])
    around = 2 * np.pi * np.arange(MERIDIANS) / MERIDIANS
    rows, paint = [], []
    for i, angle in enumerate(angles):
        cornea = 1 + 0.012 * np.exp(-((angle / 0.42) ** 4))
        x, y = np.sin(angle) * np.cos(around), np.sin(angle) * np.sin(around)
        row = eye.radius * np.stack([x, y, np.full(MERIDIANS, np.cos(angle) * cornea)], 1)
        lid_shadow = mix(1, 0.80, smoothstep(0.35, 1.05, row[:, 1] / 1.2))
        rows.append(row)
        paint.append(_ring_colour(i, angle, around, eye, colours) * lid_shadow[:, None])
    rows[0][:], rows[-1][:] = rows[0][0], rows[-1][0]
    vertices, triangles = strips(rows, closed=True)
    return Mesh(vertices + np.array(eye.centre), triangles, np.concatenate(paint)).welded()


def _ring_colour(ring: int, angle: float, around: Array, eye: Eye, colours: Colours) -> Array:
    """Return (MERIDIANS, 3) colours of one ring: pupil, iris with fibres and a lit lower half, or white."""
    if ring <= 3:
        return repeated(PUPIL, MERIDIANS)
    if ring > 9:
        return mix(*SCLERA, 0.75 * smoothstep(0.60, 1.15, angle)) + np.zeros((MERIDIANS, 3))
    k = np.arange(MERIDIANS)
    fibres = 0.5 * np.sin(7.13 * k) + 0.5 * np.sin(3.7 * k + 1)
    low = 0.5 - 0.5 * np.sin(around)
    u = (angle - eye.pupil) / (eye.iris - eye.pupil)
    light = 0.60 + 0.95 * low**1.5 * np.sin(np.pi * np.clip(u, 0.05, 1)) ** 0.7
    colour = np.clip(
        np.array(colours.iris)
        * (light * (1 + 0.22 * fibres * (1 - u) + 0.10 * (k % 2 - 0.5)))[:, None]
        * 1.15,
        0,
        1,
    )
    colour = mix(colour, colour * 0.22, smoothstep(0.62, 1, u))
    return colour * 0.55 if u < 0.12 else colour
