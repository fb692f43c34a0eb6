"""The lines of a wireframe."""

from collections.abc import Iterable

import numpy as np

from facepin.core.arrays import Indices, frozen
from facepin.core.mesh.cells import paired
from facepin.core.mesh.topology import weld_map
from facepin.core.rig import Part, Rig

FOLDED = 0.88
"""Cosine of the angle (28 degrees) by which a quad may be folded along its diagonal."""


def outlines(rig: Rig, parts: Iterable[Part]) -> Indices:
    """Return the edges of the faces of some parts, each once.

    Pairs of triangles that are plainly one quad cut in two go without their diagonal: most files hold
    triangles only.  Edges along a seam that splits vertices are one.

    Returns
    -------
    (e, 2) int32
        Vertex indices, those of an edge from low to high, edges sorted.
    """
    wanted = np.zeros(len(rig.face_sizes), np.bool_)
    for part in parts:
        wanted[part.faces.start : part.faces.stop] = True
    sizes = rig.face_sizes[wanted]
    corners = rig.corners[np.repeat(wanted, rig.face_sizes)].astype(np.intp)
    starts = np.cumsum(sizes) - sizes
    following = np.arange(1, len(corners) + 1)
    following[starts + sizes - 1] = starts

    is_triangle = np.repeat(sizes == 3, sizes)
    quads, triangles = paired(corners[is_triangle].reshape(-1, 3).T, rig.neutral, FOLDED)
    loops = [
        np.stack([cells, np.roll(cells, -1, axis=0)], axis=-1).reshape(-1, 2) for cells in (quads, triangles)
    ]
    others = np.stack([corners, corners[following]], axis=1)[~is_triangle]

    ends = weld_map(rig)[np.concatenate([*loops, others])]
    keys = ends.min(axis=1).astype(np.int64) * rig.vertex_count + ends.max(axis=1)
    edges = np.stack(np.divmod(np.unique(keys), rig.vertex_count), axis=1)
    return frozen(edges[edges[:, 0] != edges[:, 1]], np.int32)
