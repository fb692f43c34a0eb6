"""Whether the vertices of two .obj files are the same ones: their faces tell, their number alone does not."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats
from facepin.files.obj.text import ObjFaces

NEAR = 0.02
"""How far from the neutral another version of the same face is, as a share of the neutral's extent."""
AS_LARGE = 0.7
"""Least extent of another version of the same face, as a share of the neutral's, along every axis."""


@dataclass(frozen=True, eq=False)
class Likeness:
    """How the vertices of a file go with those of the neutral."""

    order: NDArray[np.int64] | None = None
    """The vertex of the file for each of the neutral, where the order is another one; None for the same."""
    strange_face: int | None = None
    """The first face of the file that joins other vertices than the neutral does, if no order is known."""


def likeness(neutral: ObjFaces, other: ObjFaces, vertices: int) -> Likeness:
    """Compare two meshes of as many `vertices` each by their faces.

    The same vertices may be joined by faces in another order, cut into triangles, or by some faces only; no
    faces at all are no contradiction.  A vertex that has other neighbours is another vertex.  Where all are,
    but the faces follow each other as in the neutral, these tell which vertex is which.
    """
    strange = _strange_vertices(neutral, other, vertices)
    if not strange.any():
        return Likeness()
    order = _order_by_faces(neutral, other, vertices)
    if order is not None:
        return Likeness(order)
    at = int(np.argmax(strange[other.corners]))
    return Likeness(strange_face=int(np.searchsorted(np.cumsum(other.sizes), at, side="right")))


def covers(neutral: Floats, other: Floats) -> bool:
    """Say whether a mesh (m, 3) is another version of the neutral (n, 3), and no eye or hat beside it."""
    from scipy.spatial import cKDTree

    extent = np.ptp(neutral, axis=0)
    if (np.ptp(other, axis=0) < AS_LARGE * extent).any():
        return False
    distances, _ = cKDTree(neutral).query(other)
    return bool(np.median(distances) <= NEAR * extent.max())


def _strange_vertices(neutral: ObjFaces, other: ObjFaces, vertices: int) -> NDArray[np.bool_]:
    """Return which vertices have mostly other neighbours in one mesh than in the other, where both have."""
    here, there = _edges(neutral, vertices), _edges(other, vertices)
    counts = [_ends(edges, vertices) for edges in (here, there)]
    common = _ends(np.intersect1d(here, there, assume_unique=True), vertices)
    fewer = np.minimum(*counts)
    strange: NDArray[np.bool_] = 2 * common < fewer
    return strange


def _edges(faces: ObjFaces, vertices: int) -> NDArray[np.int64]:
    """Return the edges as one number each, ascending and unique."""
    starts = np.cumsum(faces.sizes) - faces.sizes
    following = np.arange(len(faces.corners)) + 1
    following[starts + faces.sizes - 1] = starts
    ends = np.sort([faces.corners, faces.corners[following]], axis=0)
    return np.unique(ends[0] * vertices + ends[1])


def _ends(edges: NDArray[np.int64], vertices: int) -> NDArray[np.int64]:
    """Return how many of the edges end at each vertex."""
    first, second = np.divmod(edges, vertices)
    counts: NDArray[np.int64] = np.bincount(first, minlength=vertices) + np.bincount(
        second, minlength=vertices
    )
    return counts


def _order_by_faces(neutral: ObjFaces, other: ObjFaces, vertices: int) -> NDArray[np.int64] | None:
    """Return the vertex of `other` for each of the neutral if their faces go one by one, else None."""
    if not np.array_equal(neutral.sizes, other.sizes):
        return None
    order = np.full(vertices, -1, np.int64)
    order[neutral.corners] = other.corners
    back = np.full(vertices, -1, np.int64)
    back[other.corners] = neutral.corners
    if (order[neutral.corners] != other.corners).any() or (back[other.corners] != neutral.corners).any():
        return None
    # A vertex in no face is seen nowhere: any of those that are left will do.
    order[order < 0] = np.flatnonzero(back < 0)
    return order
