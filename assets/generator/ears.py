"""The left ear: rings from the outline inwards to the canal and back to the head."""

import numpy as np
from scipy.interpolate import CubicSpline

from generator.field import HeadField
from generator.meshes import Mesh, strips
from generator.vectors import mix, repeated, rotation, smoothstep

OUTLINE = (
    (0.10, 1.78), (-0.62, 1.52), (-1.05, 0.75), (-1.0, -0.1), (-0.66, -0.85), (-0.30, -1.42),
    (0.05, -1.62), (0.40, -1.32), (0.52, -0.6), (0.60, 0.2), (0.66, 1.0), (0.50, 1.58),
)  # fmt: skip
"""(forward, up), from the top over the back and the lobe."""
CANAL = (0.22, -0.22)
RINGS = (
    (1, 0, 0, 0), (0.97, 0.20, 0, 0), (0.90, 0.30, 0, 0), (0.81, 0.20, 0, 0), (0.72, 0.05, 0.08, 0),
    (0.62, 0, 0.30, 0), (0.50, 0, 0.26, 0), (0.40, 0, 0.02, -0.12), (0.26, 0, 0, -0.26),
    (0.12, 0, 0, -0.32), (0, 0, 0, -0.33),
)  # fmt: skip
"""(size, height of the helix, of the antihelix, of the concha)"""
BACK = ((0.55, -1.7), (0.70, -0.85), (0.88, -0.42), (0.98, -0.16))
"""(size, height) of the rings behind the ear, from the head outwards."""
AROUND = 32


def ear(field: HeadField) -> Mesh:
    """Return the left ear in place."""
    outline = np.array(OUTLINE)
    spline = CubicSpline(np.linspace(0, 1, len(outline) + 1), np.r_[outline, outline[:1]], bc_type="periodic")
    rim, canal = spline(np.arange(AROUND) / AROUND), np.array(CANAL)
    lobe = smoothstep(-0.5, -1.3, rim[:, 1])
    front = smoothstep(0.05, 0.60, rim[:, 0]) * (1 - lobe)
    rows = [np.c_[canal + (rim - canal) * size, np.full(AROUND, height)] for size, height in BACK]
    for size, helix, antihelix, concha in RINGS:
        height = helix * (1 - 0.75 * lobe) * (1 - 0.55 * front)
        height += antihelix * (1 - lobe) * (1 - front) * smoothstep(1.9, 1.2, rim[:, 1])
        height += concha * (1 - 0.5 * lobe) + 0.08 * lobe * smoothstep(1, 0.7, size)
        tragus = np.exp(-(((rim[:, 1] + 0.05) / 0.70) ** 2)) * np.exp(-(((size - 0.64) / 0.24) ** 2))
        rows.append(np.c_[canal + (rim - canal) * size, height + 0.36 * front * tragus])
    rows[-1][:] = rows[-1].mean(0)
    flat, triangles = strips(rows, closed=True)
    local = flat[:, [2, 1, 0]]  # (out, up, forward)
    hinge = np.array([0, 0, 0.6])
    local = (local - hinge) @ rotation((0, 1, 0), -33).T + hinge
    local = local @ rotation((1, 0, 0), -8).T @ rotation((0, 0, 1), -3).T * field.anatomy.skull.ear_size
    root = field.raycast(np.array([[0, -0.9, -0.55]]), np.array([[1.0, 0, 0]]), 12)[0]
    colour = mix(field.anatomy.colours.skin, field.anatomy.colours.cheek, 0.3)
    local = local + root + np.array([0.16, 0.05, 0.05])
    return Mesh(local, triangles, repeated(tuple(colour), len(local))).welded()
