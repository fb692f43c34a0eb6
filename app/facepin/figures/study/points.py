"""Where on a face a study drags: places that are seen from the front and that shapes move."""

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.errors import FacepinError
from facepin.core.rig import Rig
from facepin.core.shapes import measures
from facepin.core.shapes.motion import shape_moves
from facepin.figures.posing import in_sight

MOVED = 0.01
"""A place counts if some shape at weight 1 moves it by at least this share of the face height."""
POOL = 6
"""Places drawn by chance for each one that is chosen: the choice is even, and another with every seed."""


def movable_vertices(rig: Rig) -> np.ndarray:
    """Return the vertices that some shape moves by at least `MOVED` of the face height, ascending."""
    largest: Floats = np.zeros(rig.vertex_count)
    for shape in range(rig.shape_count):
        np.maximum(largest, shape_moves(rig, shape), out=largest)
    return np.flatnonzero(largest >= MOVED * rig.height)


def spread_points(rig: Rig, count: int, seed: int) -> tuple[int, ...]:
    """Choose up to `count` vertices, each as far as can be from those before it, straight through the face.

    There are fewer where fewer are seen from the front and moved by shapes.

    Raises
    ------
    FacepinError
        When there is none.
    """
    random = np.random.default_rng([seed, 0])
    pool = random.permutation(movable_vertices(rig))[: POOL * count]
    gaps = np.full(len(pool), np.inf)
    chosen: list[int] = []
    while len(chosen) < count and (gaps > 0).any():
        at = int(np.argmax(gaps))
        vertex = int(pool[at])
        gaps[at] = 0.0
        if in_sight(rig, vertex):
            chosen.append(vertex)
            gaps = np.minimum(gaps, measures.moves(rig.neutral[pool], rig.neutral[vertex]))
    if not chosen:
        raise FacepinError(
            f"{rig.name}: no point is seen from the front and moved by a shape by {MOVED:.0%} of the face's "
            "height, so there is nothing to drag"
        )
    return tuple(chosen)
