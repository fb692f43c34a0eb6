"""What a mesh is made of: edges, coincident vertices, closed surfaces, and a good order to draw it in."""

from dataclasses import dataclass
from math import pi
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats, Indices, Points, frozen
from facepin.core.rig import Rig

Labels = NDArray[np.intp]

HOLES = 0.25
"""Largest share of a surface that its holes may have for its inside to count as never seen."""
MISFITS = 0.01
"""Largest share of edges whose triangles may disagree on which side is out, or are not two."""
FLATTEST = 1e-4
"""Least volume, of that of a ball with the same surface, for which its sign can be trusted."""

Side = Literal["back", "front"]
SIDES: tuple[Side | None, ...] = ("front", None, "back")


@dataclass(frozen=True)
class DrawRun:
    """Neighbouring triangles of a draw order that belong to one part and are seen from the same sides."""

    part: int
    triangles: range
    """Places in the draw order."""
    hidden: Side | None
    """The side of its triangles that is inside a closed surface, or None: both sides may be seen.  "front" is
    hidden where a file winds its triangles inside out."""


@dataclass(frozen=True, eq=False)
class DrawOrder:
    """An order of the triangles that is kind to graphics cards.  Winding and vertices stay as in the file."""

    triangles: Indices
    """(t, 3) int32, those of the rig in another order."""
    names: Indices
    """(t,) int32, number of each in `rig.triangles`."""
    runs: tuple[DrawRun, ...]
    """Cover all triangles, in the order of the parts."""


def draw_order(rig: Rig) -> DrawOrder:
    """Sort triangles by part, then by which side is hidden, then into compact patches.

    Neighbours in a patch share vertices, so a card (or llvmpipe) shades each vertex hardly more than once.
    """
    part = np.repeat(np.arange(len(rig.parts)), [len(part.triangles) for part in rig.parts])
    hidden = hidden_sides(rig)
    a, b, c = rig.triangles.T
    codes = morton_codes(rig.neutral[a] + rig.neutral[b] + rig.neutral[c])
    run_of = 3 * part + hidden + 1
    names = np.argsort(run_of << 30 | codes, kind="stable")
    run_numbers, starts = np.unique(run_of[names], return_index=True)
    stops = [*starts[1:].tolist(), len(names)]
    runs = tuple(
        DrawRun(number // 3, range(start, stop), SIDES[number % 3])
        for number, start, stop in zip(run_numbers.tolist(), starts.tolist(), stops, strict=True)
    )
    return DrawOrder(frozen(rig.triangles[names], np.int32), frozen(names, np.int32), runs)


def edge_count(rig: Rig) -> int:
    """Count the undirected edges of the faces (not of the triangles they are cut into)."""
    ends = np.cumsum(rig.face_sizes, dtype=np.intp)
    following = np.arange(1, len(rig.corners) + 1)
    following[ends - 1] = ends - rig.face_sizes
    low, high = _ordered(rig.corners, rig.corners[following])
    return len(np.unique((low * rig.vertex_count + high)[low != high]))


def weld_map(rig: Rig) -> Indices:
    """First vertex that each vertex always coincides with, (n,) int32; itself for most.

    Files split vertices at texture seams and between materials.  Two are one if they are at the same place in
    the neutral and every shape moves them alike.
    """
    result = np.arange(rig.vertex_count, dtype=np.int32)
    _, place, uses = np.unique(_mixed(rig.neutral), return_inverse=True, return_counts=True)
    shared = np.flatnonzero(uses[place] > 1)
    if not len(shared):
        return result
    # One random mixture stands for all columns: equal rows give equal sums, bit for bit.
    weights = np.random.default_rng(1).uniform(1, 2, rig.deltas.shape[1]).astype(np.float32)
    moved = (rig.deltas @ weights).reshape(-1, 3)[shared]
    keys = np.stack([_mixed(rig.neutral[shared]), _mixed(moved)], axis=1)
    _, first, group = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    result[shared] = shared[first[group.ravel()]]
    return result


def _mixed(points: Points) -> Floats:
    """One number (m,) float64 for each point (m, 3): equal for equal points, and hardly ever for others."""
    x, y, z = points.astype(np.float64).T
    mixed: Floats = x + np.pi * y + np.e * z
    return mixed


def hidden_sides(rig: Rig) -> NDArray[np.int8]:
    """Which side of every triangle is inside a closed surface: (t,) int8, 1 back, −1 front, 0 neither.

    A surface is what hangs together through shared (or welded) vertices.  It counts as closed if the flat
    caps that would close its holes add up to at most a quarter of its area: a bust with an open neck does,
    half a mask, eyelashes and other sheets do not.
    """
    triangles = weld_map(rig)[rig.triangles].astype(np.intp)
    label = connected(rig.vertex_count, triangles[:, :2], triangles[:, 1:])
    _, surface = np.unique(label[triangles[:, 0]], return_inverse=True)
    count = int(surface.max(initial=-1)) + 1

    points = rig.neutral.astype(np.float64)
    a, b, c = (points[corner] for corner in triangles.T)
    areas = np.cross(b - a, c - a) / 2
    size = np.linalg.norm(areas, axis=1)
    total = np.maximum(np.bincount(surface, size, count), np.finfo(float).tiny)
    middle = (a + b + c) / 3
    centre = np.stack([np.bincount(surface, size * x, count) / total for x in middle.T], axis=1)
    volume = np.bincount(surface, ((middle - centre[surface]) * areas).sum(axis=1) / 3, count)
    ball = total**1.5 / (6 * pi**0.5)

    edges = _edges(triangles, rig.vertex_count)
    of_edge = surface[edges.triangle]
    misfits = np.bincount(of_edge, edges.misfit, count) / np.maximum(np.bincount(of_edge, minlength=count), 1)
    holes = _hole_areas(points, edges, of_edge, count) / total
    closed = (holes <= HOLES) & (misfits <= MISFITS) & (np.abs(volume) >= FLATTEST * ball)
    sides: NDArray[np.int8] = np.where(closed, np.sign(volume), 0).astype(np.int8)[surface]
    return sides


def connected(count: int, *pairs: Labels) -> Labels:
    """Label (count,) of each of `count` things: the lowest number among all it hangs together with.

    Parameters
    ----------
    count : int
        Number of things.
    *pairs : (m, 2) int
        Things that hang together.
    """
    # Hook every root to its lowest neighbour, then flatten; halves the roots each round.  scipy has this in
    # csgraph, whose import takes longer than all our analysis.
    label = np.arange(count)
    u, v = np.concatenate(pairs).T
    while len(u):
        np.minimum.at(label, u, v)
        np.minimum.at(label, v, u)
        while not np.array_equal(label, flatter := label[label]):
            label = flatter
        u, v = label[u], label[v]
        apart = u != v
        u, v = u[apart], v[apart]
    return label


def morton_codes(points: Points) -> NDArray[np.uint32]:
    """Place of each point (m, 3) on a curve that fills space and keeps near points together, (m,) uint32."""
    columns = points.T - np.array([column.min(initial=np.inf) for column in points.T])[:, None]
    extent = float(columns.max(initial=0.0))
    cells = (columns * (1023 / extent if extent > 0 else 0.0)).astype(np.uint32)
    # Spread the ten bits of each coordinate three apart.
    for shift, mask in ((16, 0x030000FF), (8, 0x0300F00F), (4, 0x030C30C3), (2, 0x09249249)):
        cells = (cells | cells << np.uint32(shift)) & np.uint32(mask)
    codes: NDArray[np.uint32] = cells[0] | cells[1] << np.uint32(1) | cells[2] << np.uint32(2)
    return codes


@dataclass(frozen=True, eq=False)
class _Edges:
    """Undirected edges of a triangle mesh, e of them."""

    triangle: Labels
    """(e,) one triangle at each."""
    ends: Labels
    """(e, 2) from and to, as that triangle runs through it."""
    border: NDArray[np.bool_]
    """(e,) only one triangle is there."""
    misfit: NDArray[np.bool_]
    """(e,) not one or two triangles, or two that run through it the same way."""


def _edges(triangles: Labels, vertices: int) -> _Edges:
    start = triangles.ravel()
    end = np.roll(triangles, -1, axis=1).ravel()
    low, high = _ordered(start, end)
    _, first, edge, uses = np.unique(
        low * vertices + high, return_index=True, return_inverse=True, return_counts=True
    )
    balance = np.bincount(edge, np.where(start == low, 1.0, -1.0))
    border = uses == 1
    return _Edges(
        first // 3, np.stack([start, end], axis=1)[first], border, ~border & ((uses != 2) | (balance != 0))
    )


def _hole_areas(points: Floats, edges: _Edges, of_edge: Labels, count: int) -> Floats:
    """Area of the caps that would close the holes of each surface, (count,) float64."""
    start, end = edges.ends[edges.border].T
    rim = connected(len(points), np.stack([start, end], axis=1))[start]
    # The area vector of a closed loop is half the sum of p × q over its edges, from wherever it is measured;
    # from a point on the loop the sums stay small.
    spans = np.cross(points[start] - points[rim], points[end] - points[rim]) / 2
    caps = np.stack([np.bincount(rim, x, len(points)) for x in spans.T], axis=1)
    _, one = np.unique(rim, return_index=True)
    cap = np.linalg.norm(caps[rim[one]], axis=1)
    areas: Floats = np.bincount(of_edge[edges.border][one], cap, count).astype(np.float64)
    return areas


def _ordered(start: NDArray[np.integer], end: NDArray[np.integer]) -> tuple[Labels, Labels]:
    return np.minimum(start, end).astype(np.intp), np.maximum(start, end).astype(np.intp)
