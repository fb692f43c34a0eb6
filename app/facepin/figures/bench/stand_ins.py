"""Made-up faces with exactly as many vertices, edges, faces and shapes as the five of the paper's Table 1."""

from dataclasses import dataclass
from math import pi

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.rig import Rig
from facepin.core.rig_builder import build_rig

NARROWEST, WIDEST = 0.25, 0.9
"""Radius of what a made-up shape moves, as a share of the head's half height: a lip corner to a jaw."""


@dataclass(frozen=True)
class TableRow:
    """A row of Table 1 of the paper.  Times in seconds."""

    name: str
    vertices: int
    edges: int
    faces: int
    shapes: int
    t_pin: float
    t_edit: float


TABLE_1 = (
    TableRow("Face 1", 6720, 19984, 13264, 40, 0.15, 0.0099),
    TableRow("Face 2", 9562, 28416, 18848, 18, 0.03, 0.0099),
    TableRow("Face 3", 11926, 35576, 23648, 36, 0.13, 0.0099),
    TableRow("Face 4", 5692, 11282, 5584, 127, 1.75, 0.015),
    TableRow("Face 5", 5792, 11625, 5834, 136, 1.46, 0.019),
)


def stand_in_name(row: TableRow) -> str:
    """Return the name of the rig that stands in for a row."""
    return f"stand-in for {row.name}"


def stand_in(row: TableRow) -> Rig:
    """Return a rig with the counts of a row of the table; shape and motion are made up.

    Raises
    ------
    ValueError
        When no mesh of this construction has these counts.
    """
    points, faces = _mesh(row)
    random = np.random.default_rng(row.vertices)
    shapes = []
    for j in range(row.shapes):
        middle = points[random.choice(np.flatnonzero(points[:, 2] > 0.3))]
        distance = np.linalg.norm(points - middle, axis=1) / random.uniform(NARROWEST, WIDEST)
        amount = np.clip(1 - distance**2, 0, None) ** 2  # smooth, and nothing at all further away
        shapes.append((f"shape{j + 1}", amount[:, None] * random.uniform(-0.2, 0.2, 3)))
    corners = [vertex for face in faces for vertex in face]
    return build_rig(stand_in_name(row), points, corners, [len(face) for face in faces], shapes)


def _mesh(row: TableRow) -> tuple[Floats, list[list[int]]]:
    """Return points (n, 3) and faces.

    A ball of `rings` times `sides` vertices and two poles, and a strip of triangles for the vertices left
    over, have almost the right counts.  Holes (rows of quads taken out) mend the Euler characteristic, and
    take an edge with every quad but the first of each.  Cutting a quad in two adds an edge and a face.
    """
    sides = round(row.vertices**0.5)
    rings, left = divmod(row.vertices - 2, sides)
    if 0 < left < 3:  # too few for a triangle
        rings, left = rings - 1, left + sides
    holes = 2 + (left > 0) - (row.vertices - row.edges + row.faces)
    edges = sides * (2 * rings + 1) + (2 * left - 3 if left else 0)
    cuts, joins = max(row.edges - edges, 0), max(edges - row.edges, 0)
    lengths = [1 + joins // holes + (i < joins % holes) for i in range(holes)] if holes > 0 else []
    quads = sides * (rings - 1) - sum(lengths)
    if (
        holes < 0
        or (joins and not holes)
        or cuts > quads
        or 2 * holes > rings - 3
        or max(lengths, default=0) >= sides
    ):
        raise ValueError(
            f"no ball with holes has {row.vertices} vertices, {row.edges} edges, {row.faces} faces"
        )

    points = np.vstack([_ball(rings, sides), _strip(left)])
    at = 1 + np.arange(rings * sides).reshape(rings, sides)
    beside = np.roll(at, -1, axis=1)
    bodies = np.stack([at[:-1], at[1:], beside[1:], beside[:-1]], axis=-1)
    kept = np.ones(bodies.shape[:2], bool)
    for i, length in enumerate(lengths):
        kept[1 + (rings - 3) * i // holes, :length] = False
    whole = bodies[kept].tolist()
    faces: list[list[int]] = []
    for a, b, c, d in whole[:cuts]:
        faces += [[a, b, c], [a, c, d]]
    faces += whole[cuts:]
    last = rings * sides + 1
    faces += [[0, int(a), int(b)] for a, b in zip(at[0], beside[0], strict=True)]
    faces += [[last, int(b), int(a)] for a, b in zip(at[-1], beside[-1], strict=True)]
    faces += [[last + 1 + i, last + 2 + i, last + 3 + i] for i in range(left - 2)]
    return points, faces


def _ball(rings: int, sides: int) -> Floats:
    """North pole, rings from north to south, south pole; as tall as 2, narrower than tall."""
    tilt = pi * np.arange(1, rings + 1)[:, None] / (rings + 1)
    turn = 2 * pi * np.arange(sides) / sides
    x, y, z = 0.7 * np.sin(tilt) * np.sin(turn), np.cos(tilt) + 0 * turn, 0.85 * np.sin(tilt) * np.cos(turn)
    body = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    return np.vstack([[0.0, 1.0, 0.0], body, [0.0, -1.0, 0.0]])


def _strip(count: int) -> Floats:
    """A zigzag of points in the head: a row of teeth, so to speak."""
    along = np.linspace(-0.3, 0.3, count)
    return np.stack([along, -0.4 - 0.05 * (np.arange(count) % 2), np.full(count, 0.5)], axis=1)
