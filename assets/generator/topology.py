"""The quad grid of the left half of the head, with rings of quads round the eye and the mouth.

Rows run from the crown to the neck, columns from the middle of the face to the middle of the back.  The grid
has two rectangular holes; each is filled with rings that share their outermost loop with the grid.  Ring 0
is the margin of the opening, higher rings lie outside, negative rings inside (lid lining, mouth bag).
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from generator.vectors import Array, Ints

ROWS, COLUMNS = 71, 38
EYE_COLUMNS, EYE_ROWS = (6, 16), (17, 27)
MOUTH_COLUMNS, MOUTH_ROWS = 10, (39, 47)
EYE_RINGS, EYE_LINING = 9, 3
MOUTH_RINGS, MOUTH_BAG = 10, 10
LIP_RINGS = 6
"""Rings 0..5 are the red of the lip."""
EYE_LOOP = 2 * (EYE_COLUMNS[1] - EYE_COLUMNS[0]) + 2 * (EYE_ROWS[1] - EYE_ROWS[0])
MOUTH_LOOP = 2 * MOUTH_COLUMNS + (MOUTH_ROWS[1] - MOUTH_ROWS[0]) + 1


@dataclass(frozen=True, eq=False)
class HalfGrid:
    """Connectivity of the left half."""

    count: int
    grid: Ints
    """(ROWS + 1, COLUMNS + 1) vertex indices, -1 inside the holes."""
    places: Ints
    """(g, 2) row and column of the vertices that lie on the grid; they come first."""
    quads: Ints
    """(q, 4) counter-clockwise; a triangle repeats its last corner."""
    eye_rings: dict[int, Ints]
    mouth_rings: dict[int, Ints]
    bag_centre: int
    """The vertex that closes the mouth bag."""


def _in_eye(i: int, j: int) -> bool:
    return EYE_ROWS[0] <= i < EYE_ROWS[1] and EYE_COLUMNS[0] <= j < EYE_COLUMNS[1]


def _in_mouth(i: int, j: int) -> bool:
    return MOUTH_ROWS[0] <= i < MOUTH_ROWS[1] and j < MOUTH_COLUMNS


def _number_grid() -> tuple[Ints, list[tuple[int, int]]]:
    """Return vertex indices of the grid and the (row, column) of each vertex; the crown is one vertex."""
    grid = -np.ones((ROWS + 1, COLUMNS + 1), int)
    places: list[tuple[int, int]] = [(0, 0)]
    grid[0] = 0
    for i in range(1, ROWS + 1):
        for j in range(COLUMNS + 1):
            inside_eye = EYE_ROWS[0] < i < EYE_ROWS[1] and EYE_COLUMNS[0] < j < EYE_COLUMNS[1]
            inside_mouth = MOUTH_ROWS[0] < i < MOUTH_ROWS[1] and j < MOUTH_COLUMNS
            if not (inside_eye or inside_mouth):
                grid[i, j] = len(places)
                places.append((i, j))
    return grid, places


def _eye_hole(grid: Ints) -> Ints:
    """Return the loop of the eye hole, from the middle of its inner side over the top."""
    (c0, c1), (r0, r1) = EYE_COLUMNS, EYE_ROWS
    middle = (r0 + r1) // 2
    return np.concatenate(
        [
            grid[middle:r0:-1, c0],
            grid[r0, c0:c1],
            grid[r0:r1, c1],
            grid[r1, c1:c0:-1],
            grid[r1:middle:-1, c0],
        ]
    )


def _mouth_hole(grid: Ints) -> Ints:
    """Return the open loop of the mouth hole, from the middle over the upper lip to the middle below."""
    c, (r0, r1) = MOUTH_COLUMNS, MOUTH_ROWS
    return np.concatenate([grid[r0, :c], grid[r0:r1, c], grid[r1, c::-1]])


def half_grid() -> HalfGrid:
    """Return the connectivity of the left half; it is the same for every character."""
    grid, places = _number_grid()
    quads: list[tuple[int, ...]] = []
    for i in range(ROWS):
        for j in range(COLUMNS):
            if not (_in_eye(i, j) or _in_mouth(i, j)):
                a, b, c, d = grid[i, j], grid[i + 1, j], grid[i + 1, j + 1], grid[i, j + 1]
                quads.append((a, b, c, d) if i else (a, b, c, c))
    count = len(places)
    eye_rings, mouth_rings = {EYE_RINGS: _eye_hole(grid)}, {MOUTH_RINGS: _mouth_hole(grid)}
    for rings, outermost, innermost, size in (
        (eye_rings, EYE_RINGS - 1, -EYE_LINING, EYE_LOOP),
        (mouth_rings, MOUTH_RINGS - 1, -MOUTH_BAG, MOUTH_LOOP),
    ):
        for k in range(outermost, innermost - 1, -1):
            rings[k] = np.arange(count, count + size)
            count += size
    for k in range(-EYE_LINING, EYE_RINGS):
        inner, outer = eye_rings[k], eye_rings[k + 1]
        quads += zip(inner, np.roll(inner, -1), np.roll(outer, -1), outer, strict=True)
    for k in range(-MOUTH_BAG, MOUTH_RINGS):
        inner, outer = mouth_rings[k], mouth_rings[k + 1]
        quads += zip(inner[:-1], inner[1:], outer[1:], outer[:-1], strict=True)
    last = mouth_rings[-MOUTH_BAG]
    quads += ((count, b, a, a) for a, b in pairwise(last))
    return HalfGrid(count + 1, grid, np.array(places), np.array(quads), eye_rings, mouth_rings, count)


def triangulated(quads: Ints, vertices: Array) -> Ints:
    """Return (m, 3) triangles: every quad cut along its shorter diagonal."""
    triangles: list[tuple[int, int, int]] = []
    for a, b, c, d in quads:
        if c == d:
            triangles.append((a, b, c))
        elif np.linalg.norm(vertices[a] - vertices[c]) <= np.linalg.norm(vertices[b] - vertices[d]):
            triangles += [(a, b, c), (a, c, d)]
        else:
            triangles += [(a, b, d), (b, c, d)]
    return np.array(triangles)
