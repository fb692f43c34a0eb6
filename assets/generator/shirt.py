"""The collar and shoulders that end the bust."""

import numpy as np

from generator.anatomy import Colours, Skull
from generator.meshes import Mesh, strips, vertex_normals
from generator.vectors import MIRROR, mix, repeated

AROUND = 36
ROWS = (
    (2.8, -13.6, 0), (3.0, -12.6, 0), (3.28, -12.3, 0), (3.56, -12.55, 0),
    (3.68, -13.3, 0.1), (4.5, -13.95, 0.5), (6.1, -14.45, 1.0), (7.5, -15.05, 1.25), (8.15, -16.0, 1.3),
    (7.7, -16.4, 1.3), (0, -16.4, 1.3),
)  # fmt: skip
"""(radius, height, how much it is shoulder) from the inside of the collar outwards to the closed base."""


def shirt(skull: Skull, colours: Colours) -> Mesh:
    """Return the shirt; its collar fits the neck."""
    width = skull.neck.radii[0] / 2.95
    angle = 2 * np.pi * np.arange(AROUND) / AROUND
    rows = []
    for size, height, shoulder in ROWS:
        radius = size * mix(width, 1, min(shoulder, 1))
        tilt = 0.55 * np.cos(angle) * (1 - 0.3 * shoulder) if shoulder < 0.9 else 0 * angle
        x = radius * np.sin(angle) * (1 + 0.22 * shoulder)
        rows.append(np.c_[x, height - tilt, -2.55 + radius * np.cos(angle) * (1.04 - 0.22 * shoulder)])
    vertices, triangles = strips(rows, closed=True)
    k = np.arange(AROUND)
    mirror = np.concatenate([i * AROUND + (-k) % AROUND for i in range(len(ROWS))])
    vertices = (vertices + vertices[mirror] * MIRROR) / 2
    if vertex_normals(vertices, triangles)[3 * AROUND, 2] < 0:
        triangles = triangles[:, [0, 2, 1]]
    colour = repeated(colours.shirt, len(vertices))
    colour[: 4 * AROUND] *= 0.9
    return Mesh(vertices, triangles, colour).welded()
