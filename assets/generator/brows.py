"""Brows and upper lashes of the left side."""

import numpy as np

from generator.field import HeadField
from generator.meshes import Mesh, outwards, strip_triangles, strips
from generator.skin import Skin
from generator.topology import EYE_LINING, EYE_LOOP
from generator.vectors import Array, Ints, curve, mix, repeated, smoothstep, unit

SECTIONS, AROUND = 24, 10


def brow(field: HeadField) -> Mesh:
    """Return the left brow: a tapered roll that lies on the skin, SECTIONS rings and two end points."""
    form = field.anatomy.brow
    t = np.linspace(0, 1, SECTIONS)
    x = curve(form.x, t)
    y = curve(form.y, t)
    line = np.c_[x, y, field.front(x, y)]
    along = unit(np.gradient(line, axis=0))
    out = unit(field.gradient(line))
    out = unit(out - (out * along).sum(1)[:, None] * along)
    up = np.cross(out, along)
    up *= np.sign(up[:, 1:2])
    start, end = np.clip((t + 0.006) / 0.18, 0, 1) ** 0.5, np.clip((1.01 - t) / 0.03, 0, 1) ** 0.5
    height = form.thickness * start * (1 - 0.82 * smoothstep(0.45, 1.02, t)) * end
    angle = 2 * np.pi * np.arange(AROUND) / AROUND
    rounded = np.sign(np.cos(angle)) * np.abs(np.cos(angle)) ** 0.9
    rows = []
    for i in range(SECTIONS):
        lift = 0.05 + 0.14 * height[i] / form.thickness * np.sin(angle)
        rows.append(line[i] + out[i] * lift[:, None] + up[i] * (height[i] * rounded)[:, None])
    count = SECTIONS * AROUND
    triangles = strip_triangles(np.arange(count).reshape(SECTIONS, AROUND), closed=True)
    j = np.arange(AROUND)
    k, last = (j + 1) % AROUND, count - AROUND
    caps = np.r_[np.c_[0 * j + count, j, k], np.c_[0 * j + count + 1, last + k, last + j]]
    vertices = np.r_[np.concatenate(rows), [rows[0].mean(0)], [rows[-1].mean(0)]]
    section, place = np.divmod(np.arange(len(vertices)), AROUND)
    colour = np.array(field.anatomy.colours.brow) * (1 + 0.07 * np.sin(section * 2.4 + place * 1.1))[:, None]
    return Mesh(vertices, outwards(vertices, np.r_[triangles, caps]), colour)


def lashes(skin: Skin, field: HeadField) -> tuple[Mesh, Ints]:
    """Return the upper left lashes, a ribbon of five rows, and the skin vertex each vertex grows from."""
    count = EYE_LOOP // 2 + 1
    root, lining = skin.eye_rings[0][:count], skin.eye_rings[-EYE_LINING + 2][:count]
    margin, inside = skin.vertices[root], skin.vertices[lining]
    outward = unit(margin - np.array(field.anatomy.eye.centre))
    t = np.linspace(0, 1, count)
    length = mix(0.02, 0.46, smoothstep(0.05, 0.75, t)) * np.clip(((1 - t) / 0.45) ** 1.4, 0.02, 1)
    thick = np.clip(length / 0.30, 0.2, 1)[:, None]
    tip = unit(outward + np.array([0.18, 0.55, 0.25]) + np.c_[0.5 * t, 0 * t, 0 * t])
    up = unit(np.cross(unit(np.gradient(margin, axis=0)), outward))
    up *= np.sign(up[:, 1:2])

    def along(share: Array | float) -> Array:
        return tip * (length * share)[:, None]

    rows = [
        inside + outward * 0.02 - up * 0.01,
        margin + outward * 0.035 * thick**0.5 + up * 0.05 * thick,
        margin + outward * (0.035 * thick**0.5 + 0.025 * thick) + along(0.55) + up * 0.015,
        margin + along(1) + up * 0.25 * length[:, None],
        margin + outward * 0.02 * thick**0.5 + along(0.5) - up * 0.03 * thick,
    ]
    vertices, _ = strips(rows)
    grid = np.arange(len(vertices)).reshape(len(rows), count)
    triangles = strip_triangles(np.r_[grid, grid[:1]])
    roots = np.concatenate([lining] + [root] * 4)
    return Mesh(vertices, triangles, repeated(field.anatomy.colours.lash, len(vertices))), roots
