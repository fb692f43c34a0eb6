"""Where to look at a face for its expression: at the part that shapes move."""

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats
from facepin.core.look.camera import Camera, View, frame_points
from facepin.core.rig import Rig
from facepin.core.shapes.measures import REST

MARGIN = 0.14
"""Share of a picture left free on each side of the face at rest, for it to move into."""
STIRRED = 0.02
"""A picture shows the part of the face that shapes move by more than this share of its height."""


def face_camera(rig: Rig, size: tuple[int, int], view: View = "front", margin: float = MARGIN) -> Camera:
    """Return a camera that sees the part of the neutral that shapes move, in pictures of (width, height)."""
    aspect = size[0] / size[1]
    camera = frame_points(rig.neutral[rig.head], aspect, Camera(radius=0.0).looking(view))
    chosen = expressive(rig)
    return camera if chosen.all() else frame_points(rig.neutral[chosen], aspect, camera, margin)


def expressive(rig: Rig) -> NDArray[np.bool_]:
    """Return which vertices (n,) make the expression, as shapes move them; all where that is next to none.

    Shapes that move more than half of all vertices (to another build, say) count only if there are no others.
    """
    local, anywhere = np.zeros((2, rig.vertex_count), np.bool_)
    starts, rows, values = rig.deltas.indptr, rig.deltas.indices, rig.deltas.data
    for first, end in zip(starts[:-1].tolist(), starts[1:].tolist(), strict=True):
        vertices, lengths = _moves(rows[first:end] // 3, values[first:end])
        stirred = vertices[(lengths > STIRRED * rig.height) & rig.drawn[vertices]]
        anywhere[stirred] = True
        if np.count_nonzero(lengths > REST * rig.height) <= rig.vertex_count / 2:
            local[stirred] = True
    for chosen in (local & rig.head, anywhere & rig.head):
        if np.count_nonzero(chosen) > 2:
            return chosen
    return rig.head


def _moves(vertices: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, Floats]:
    """Return the vertices that a column of deltas names, (u,), and how far each is moved, (u,)."""
    if not len(vertices):
        return vertices, np.zeros(0)
    first = np.flatnonzero(np.diff(vertices, prepend=-1))  # indices are sorted: one run per vertex
    return vertices[first], np.sqrt(np.add.reduceat(values.astype(np.float64) ** 2, first))
