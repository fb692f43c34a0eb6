"""Poses and pins for pictures: by the names of shapes, and where a camera sees them."""

from collections.abc import Mapping, Sequence

import numpy as np

from facepin.core.arrays import Floats, Points
from facepin.core.mesh.picking import first_hit
from facepin.core.pose import Freedom, Pin
from facepin.core.rig import Rig
from facepin.core.shapes import measures
from facepin.figures.study.animator import SPACING, most_moved
from facepin.files.work.shape_spelling import match_shapes

DELIGHT = {"jawOpen": 0.5, "mouthSmileLeft": 0.8, "mouthSmileRight": 0.8, "browInnerUp": 0.9}
"""An expression that faces with ARKit's shapes can make."""
HIDDEN = 0.003
"""A vertex that lies deeper than this share of the face height behind what is seen is hidden."""


def named_weights(rig: Rig, amounts: Mapping[str, float]) -> Floats:
    """Return weights (k,) with shapes set by name, in any spelling.

    Where a rig has a left and a right shape instead of one, both are set; shapes it lacks are left out.
    """
    weights = np.zeros(rig.shape_count)
    for name, amount in amounts.items():
        (place,) = match_shapes([name], rig.shape_names)
        halves = match_shapes([f"{name}Left", f"{name}Right"], rig.shape_names) if place is None else [place]
        weights[[half for half in halves if half is not None]] = amount
    return weights


def handles(rig: Rig, weights: Floats) -> tuple[int, ...]:
    """Return one vertex per shape of a pose: of those seen from the front, the one that it moves most."""
    vertices: list[int] = []
    for shape in np.flatnonzero(weights).tolist():
        alone = np.zeros(rig.shape_count)
        alone[shape] = weights[shape]
        vertices += most_moved_in_sight(rig, rig.evaluate(alone), 1)
    return tuple(dict.fromkeys(vertices))


def most_moved_in_sight(rig: Rig, wanted: Points, count: int) -> tuple[int, ...]:
    """Choose up to `count` vertices that a pose moves most, seen from the front and not too close together.

    As `animator.most_moved`, but only where a mouse could press, if there is such a place.
    """
    moved = measures.moves(wanted, rig.neutral)
    moved[measures.resting(wanted, rig.neutral, rig.height)] = 0.0
    chosen: list[int] = []
    while len(chosen) < count and moved.any():
        vertex = int(np.argmax(moved))
        if not in_sight(rig, vertex):
            moved[vertex] = 0.0
            continue
        chosen.append(vertex)
        moved[measures.moves(rig.neutral, rig.neutral[vertex]) <= SPACING * rig.height] = 0.0
    return tuple(chosen) or most_moved(rig, wanted, count)


def in_sight(rig: Rig, vertex: int) -> bool:
    """Say whether nothing of the neutral lies before a vertex, seen from straight in front."""
    place = rig.neutral[vertex].astype(np.float64)
    away = float(rig.neutral[:, 2].max()) - place[2] + rig.height
    hit = first_hit(
        rig.neutral, rig.triangles, place + np.array([0.0, 0.0, away]), np.array([0.0, 0.0, -1.0])
    )
    return hit is not None and hit.distance > away - HIDDEN * rig.height


def dragged(rig: Rig, vertices: Sequence[int], wanted: Points, freedom: Freedom = "space") -> tuple[Pin, ...]:
    """Return pins dragged in front view to where a pose has their vertices: x and y of the pose.

    A mouse gives two numbers: depth stays as it was grabbed, on the neutral.
    """
    pins = []
    for vertex in vertices:
        x, y, _ = wanted[vertex].tolist()
        pins.append(Pin(vertex, (x, y, float(rig.neutral[vertex, 2])), freedom))
    return tuple(pins)
