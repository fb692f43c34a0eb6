"""Hair as one sculpted shell between crown and hairline."""

import numpy as np

from generator.anatomy import Ball, Colour, Hair
from generator.field import HeadField
from generator.meshes import Mesh, joined, outwards, strips
from generator.vectors import MIRROR, Array, columns, curve, mix, repeated, smoothstep, unit

AROUND, ROWS = 100, 23
AZIMUTH = ((0, 0), (0.30, 1.05), (0.72, 2.0), (1, np.pi))
"""Angle of the columns, 0 front .. pi back, over their share of the way: closest together at the temples."""
BUN_AROUND = 20
BUN_ROWS = (
    (0.62, -1.05, 0.6), (0.58, -0.80, 0.6), (0.86, -0.62, 0.8), (1.0, -0.30, 1.0), (0.99, -0.02, 0.95),
    (0.91, 0.14, 0.72), (0.92, 0.38, 1.0), (0.80, 0.62, 0.98), (0.66, 0.68, 0.72), (0.58, 0.84, 1.0),
    (0.34, 0.98, 0.98), (0, 0.96, 0.85),
)  # fmt: skip
"""(width, height, light) of the coils from the root outwards, in radii."""


def hair(field: HeadField) -> Mesh:
    """Return the hair: rings from the crown down to the hairline, the last one under the skin."""
    form = field.anatomy.hair
    centre = np.array(form.centre, float)
    k = np.arange(AROUND)
    side = np.abs((k * 2.0 / AROUND + 1) % 2 - 1)
    angle = curve(AZIMUTH, side)
    azimuth = np.where(k <= AROUND // 2, angle, -angle)
    line = curve(form.line, angle)
    lowest = np.arctan2(line - centre[1], 7.0 * np.where(angle < 1.0, 1.02, 0.92))
    fringe = np.exp(-((angle / 0.75) ** 2))
    rows = []
    locks = form.locks * (_wave(angle, 1.0) - 0.5) * smoothstep(2.6, 1.4, angle)
    for i in range(ROWS):
        t = min(i / (ROWS - 2), 1.0)
        elevation = mix(np.pi / 2, lowest + locks * smoothstep(0.5, 1, t), t**0.9)
        direction = columns(
            np.cos(elevation) * np.sin(azimuth), np.sin(elevation), np.cos(elevation) * np.cos(azimuth)
        )
        scalp = field.raycast(repeated(form.centre, AROUND), direction, 15, steps=40, lids=False)
        normal = unit(field.gradient(scalp))
        if i == ROWS - 1:
            rows.append(scalp - normal * 0.25)
            continue
        rows.append(scalp + _volume(form, normal, t, angle, fringe))
    rows[0][:] = rows[0].mean(0) * np.array([0, 1, 1])
    vertices = np.concatenate(rows)
    mirror = np.concatenate([i * AROUND + (-k) % AROUND for i in range(ROWS)])
    vertices = (vertices + vertices[mirror] * MIRROR) / 2
    starts = [vertices[i * AROUND : (i + 1) * AROUND] for i in range(ROWS)]
    vertices, triangles = strips(starts, closed=True)
    shade = np.concatenate([_shade(angle, min(i / (ROWS - 2), 1.0)) for i in range(ROWS)])
    colour = np.array(field.anatomy.colours.hair) * shade[:, None]
    shell = Mesh(vertices, outwards(vertices, triangles), colour).welded()
    if form.bun is None:
        return shell
    return joined(_bun(form.bun, centre, field.anatomy.colours.hair), shell)  # `hairline` is at the end


def _bun(form: Ball, head: Array, hair_colour: Colour) -> Mesh:
    """Return a knot of coils on the axis from the middle of the head, tied where it grows out."""
    axis = unit(np.array(form.centre, float) - head)
    forward = np.array([0, -axis[2], axis[1]])
    angle = 2 * np.pi * np.arange(BUN_AROUND) / BUN_AROUND
    across, up, along = np.array([(1, 0, 0), axis, forward]) * np.array(form.radii)[:, None]
    around = np.outer(np.sin(angle), across) + np.outer(np.cos(angle), along)
    rows = [np.array(form.centre) + size * around + height * up for size, height, _ in BUN_ROWS]
    vertices, triangles = strips(rows, closed=True)
    k = np.arange(BUN_AROUND)
    mirror = np.concatenate([i * BUN_AROUND + (-k) % BUN_AROUND for i in range(len(BUN_ROWS))])
    vertices = (vertices + vertices[mirror] * MIRROR) / 2
    colour = np.outer(np.repeat([light for *_, light in BUN_ROWS], BUN_AROUND), hair_colour)
    return Mesh(vertices, outwards(vertices, triangles), colour).welded()


def _wave(angle: Array, t: float) -> Array:
    """Return 0 in the grooves between locks, 1 on their backs."""
    return np.abs(np.sin(angle * 9 + 0.9 * np.sin(t * 3 + angle * 2) - 0.5 * t))


def _shade(angle: Array, t: float) -> Array:
    """Return how light the hair is: dark in grooves and at the hairline, with finer strands between."""
    grooves = mix(1, 0.76 + 0.34 * _wave(angle, t), smoothstep(0.1, 0.5, t))
    strands = 1 + 0.10 * np.sin(angle * 27 + 2.0 * np.sin(t * 4 + angle))
    return grooves * strands * mix(1, 0.80, smoothstep(0.90, 1, t))


def hairline(mesh: Mesh) -> Array:
    """Return (n, 3) points all along the hairline."""
    ring = mesh.vertices[-AROUND:]
    return np.concatenate([mix(ring, np.roll(ring, -1, axis=0), share) for share in (0, 0.25, 0.5, 0.75)])


def _volume(form: Hair, normal: Array, t: float, angle: Array, fringe: Array) -> Array:
    """Return the (AROUND, 3) offset of the hair from the scalp at share `t` of the way to the hairline."""
    edge = np.sqrt(np.clip((1 - t) / 0.22, 0, 1))
    temple = smoothstep(0.9, 1.5, angle) * smoothstep(0.55, 1, t)
    thick = 0.75 + 0.95 * fringe * smoothstep(0.15, 0.8, t) + 0.1 * np.cos(angle)
    thick = thick * mix(0.12, 1, edge * (2 - edge)) * (1 - 0.55 * temple)
    wave = _wave(angle, t)
    groove = 0.26 * form.grooves * (1 - wave) ** 2 * smoothstep(0.10, 0.45, t)
    swept = fringe * smoothstep(0.4, 0.95, t) * (1 - 0.6 * smoothstep(0.93, 1, t))
    offset: Array = (
        normal * (form.volume * thick * (1 - groove / 0.8))[:, None]
        + np.array([0, 0.35, 0.25]) * swept[:, None]
    )
    return offset
