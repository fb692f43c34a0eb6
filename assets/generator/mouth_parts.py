"""Teeth, gums and tongue."""

import numpy as np

from generator.anatomy import Colours
from generator.meshes import Mesh, outwards, strip_triangles, strips
from generator.vectors import Array, mix, repeated, smoothstep

TEETH, STEPS = 12, 4
TOOTH_ROWS = (
    (-0.12, 1.0), (0.0, 0.92), (0.07, 0.6), (0.04, 0.22),
    (-0.02, 0.05), (-0.12, 0.0), (-0.26, 0.10), (-0.36, 0.9),
)  # fmt: skip
"""(outwards, share of the height) of the rows of a dental arch, from the gum over the edge to the back."""
TOOTH_SHADE = (0.80, 0.9, 1, 1, 1, 0.95, 0.8, 0.6)
GUM_ROWS = ((-0.04, -0.05), (0.05, 0.06), (0.07, 0.3), (-0.02, 0.75), (-0.35, 1.1))
"""(outwards, away from the teeth)"""


def dental_arch(front: float, edge: float, upper: bool, colours: Colours) -> tuple[Mesh, Mesh]:
    """Return teeth and gum of one jaw.

    Parameters
    ----------
    front : float
        z of the incisors.
    edge : float
        y of the biting edge.
    upper : bool
        Which jaw; the lower arch is a little narrower.
    colours : Colours
        For teeth and gum.
    """
    up = 1 if upper else -1
    half_width, depth = (2.85, 2.95) if upper else (2.64, 2.75)
    u = np.linspace(-1, 1, TEETH * STEPS + 1)
    x, z = half_width * np.sin(1.16 * u), front - depth + depth * np.cos(1.16 * u)
    out_x, out_z = np.sin(1.16 * u) / half_width, np.cos(1.16 * u) / depth
    length = np.hypot(out_x, out_z)
    out_x, out_z = out_x / length, out_z / length
    between = np.abs(((u + 1) / 2 * TEETH) % 1 - 0.5) * 2
    between[[0, -1]] = 1
    gap = np.clip((between - 0.4) / 0.6, 0, 1) ** 2
    height = (0.95 if upper else 0.80) * (1 - 0.10 * u**2)
    rows = []
    for out, share in TOOTH_ROWS:
        notch = 0.08 * gap * (1 if share < 0.9 else 0.4) if out > -0.2 else 0 * gap
        y = edge + up * height * share + up * 0.07 * gap * (share < 0.3)
        rows.append(np.c_[x + out_x * (out - notch), y, z + out_z * (out - notch)])
    vertices, triangles = strips(rows)
    shade = (1 - 0.12 * np.tile(gap, 8)) * np.repeat(TOOTH_SHADE, len(u))
    tint = mix((1, 0.97, 0.93), (1, 1, 1), np.tile(1 - gap, 8)[:, None])
    teeth = Mesh(
        vertices, triangles if upper else triangles[:, [0, 2, 1]], colours.teeth * shade[:, None] * tint
    )

    root = edge + up * height * 0.80
    gum_rows = []
    for out, away in GUM_ROWS:
        y = root + up * away - (up * 0.10 * gap if away < 0.1 else 0)
        gum_rows.append(np.c_[x + out_x * out, y, z + out_z * out][::2])
    vertices, triangles = strips(gum_rows)
    gum = Mesh(
        vertices, triangles[:, [0, 2, 1]] if upper else triangles, repeated(colours.gum, len(vertices))
    )
    return teeth, gum


def _rounded(t: float) -> float:
    """Return a quarter circle from 0 to 1."""
    return float(np.sqrt(np.clip(1 - (1 - np.clip(t, 0, 1)) ** 2, 0, 1)))


def tongue(front: float, height: float, colours: Colours) -> Mesh:
    """Return the tongue behind teeth at z = `front`, its body at y = `height`."""
    sections, around = 18, 15
    rows: list[Array] = []
    for t in np.linspace(0, 1, sections):
        s = 2 * np.pi * np.arange(around) / around + np.pi / 2
        width = 1.48 * _rounded(1.55 * t + 0.01) * (1 - 0.05 * t) + 0.02
        thick = 0.42 * _rounded(3.2 * t + 0.05) * (1 + 0.35 * t) + 0.01
        x, top = width * np.cos(s), np.maximum(np.sin(s), 0)
        y = thick * np.sin(s) - 0.16 * np.exp(-((x / 0.28) ** 2)) * top * smoothstep(0, 0.25, t)
        arch = 0.22 * np.sin(0.9 * np.pi * t) + 0.15 * (x / 1.4) ** 2
        rows.append(np.c_[x, height + y + arch, np.full(around, front - 0.75 - 4.3 * t)])
    vertices = np.concatenate(rows)
    tip = len(vertices)
    triangles = strip_triangles(np.arange(tip).reshape(sections, around), closed=True)
    cap = [(tip, (j + 1) % around, j) for j in range(around)]
    vertices = np.r_[vertices, [rows[0].mean(0) + np.array([0, 0, 0.02])]]
    triangles = outwards(vertices, np.r_[triangles, cap])
    return Mesh(vertices, triangles, repeated(colours.tongue, len(vertices)))
