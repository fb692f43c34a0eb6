"""Left and right: which vertex and which shape is the twin of which, across the middle of the face."""

import re
from dataclasses import dataclass, replace

import numpy as np

from facepin.core.arrays import Floats, Indices, Points, frozen
from facepin.core.names import listed
from facepin.core.rig import Rig

NEAR = 0.01
"""How far from its mirrored place a twin vertex may be, as a share of the face height."""
ALIKE = 0.5
"""Least likeness (cosine) of a shape and its mirrored twin where the names say so."""
TELLING = 0.9
"""The same where nothing but the geometry says so."""
SAMPLES = 2000
"""Vertices that are compared; more do not tell more."""

_OTHER = {"left": "right", "right": "left", "l": "r", "r": "l"}
_SIDE = re.compile(
    r"""(?:(?<=[a-z0-9])|^)(?:Left|Right)(?![a-z])     # eyeBlinkLeft, LeftEye, but not Leftover
      | (?<![A-Za-z])(?:left|right|LEFT|RIGHT)(?![a-z])  # left_eye, eye.RIGHT
      | (?<![A-Za-z0-9])[LlRr](?![A-Za-z0-9])            # eyeBlink_L, l_eye, brow.R
      | (?<=[a-z])[LR](?=$|[^A-Za-z])                    # eyeBlinkL
    """,
    re.VERBOSE,
)


@dataclass(frozen=True, eq=False)
class Mirror:
    """Who is whose twin.  A twin's twin is oneself."""

    vertices: Indices
    """(n,) int32, the vertex at the mirrored place, -1 where there is none."""
    shapes: Indices
    """(k,) int32, the shape that does the same on the other side; a symmetric shape is its own twin; -1 for
    shapes that have none."""
    balance: Floats
    """(k,) float64, where a shape moves the face: 1 only on the character's left, −1 only on its right."""
    middle: float = 0.0
    """x of the plane between left and right."""
    remarks: tuple[str, ...] = ()
    """What names and geometry disagree on, one line each."""

    def paired(self, shape: int, twin: int) -> "Mirror":
        """Return the same with two shapes as each other's twins (or one as its own); old twins are parted."""
        shapes = self.shapes.copy()
        for old in {shape, twin}:
            if shapes[old] >= 0:
                shapes[shapes[old]] = -1
            shapes[old] = -1
        shapes[shape], shapes[twin] = twin, shape
        return replace(self, shapes=frozen(shapes, np.int32))

    def parted(self, shape: int) -> "Mirror":
        """Return the same with a shape that has no twin."""
        shapes = self.shapes.copy()
        if shapes[shape] >= 0:
            shapes[shapes[shape]] = -1
        shapes[shape] = -1
        return replace(self, shapes=frozen(shapes, np.int32))

    def across(self, points: Floats) -> Floats:
        """Mirror points (..., 3)."""
        points = np.asarray(points, np.float64)
        return points * (-1.0, 1.0, 1.0) + (2 * self.middle, 0.0, 0.0)

    def flipped(self, weights: Floats) -> Floats:
        """Return weights (k,) float64 of the mirrored pose; shapes without a twin keep theirs."""
        has = self.shapes >= 0
        result = np.array(weights, np.float64)
        result[has] = result[self.shapes[has]]
        return result


def find_mirror(rig: Rig) -> Mirror:
    """Find the twins of a rig: vertices by place, shapes by name as far as geometry agrees.

    Names pair shapes that say left and right (`_L`/`_R`, `Left`/`Right`, `l_`, `.L`, …).  A shape whose name
    says no side is its own twin if it moves both sides alike; shapes with names that say nothing are paired
    where one clearly is the other's mirror image.
    """
    middle = middle_of(rig)
    vertices = _twin_vertices(rig.neutral, middle, NEAR * rig.height)
    likeness, balance = _likeness(rig, vertices, middle)
    shapes, remarks = _twin_shapes(rig.shape_names, likeness)
    return Mirror(
        frozen(vertices, np.int32),
        frozen(shapes, np.int32),
        frozen(balance, np.float64),
        middle,
        tuple(remarks),
    )


def middle_of(rig: Rig) -> float:
    """Return x of the plane between left and right."""
    middle = float(np.median(rig.neutral[:, 0])) if rig.vertex_count else 0.0
    extent = np.ptp(rig.neutral[:, 0]) if rig.vertex_count else 0.0
    # Nearly all rigs stand in the middle of the world.
    return 0.0 if abs(middle) < 0.02 * extent else middle


def swapped(name: str) -> str:
    """Return a name with left and right exchanged; the same name if it says no side."""

    def other(match: re.Match[str]) -> str:
        side = match.group()
        word = _OTHER[side.lower()]
        if side.isupper():
            return word.upper()
        return word.capitalize() if side[0].isupper() else word

    return _SIDE.sub(other, name)


def _twin_vertices(points: Points, middle: float, near: float) -> Indices:
    """Return for each point the one at its mirrored place, -1 where there is none that points back."""
    from scipy.spatial import cKDTree

    across = points.astype(np.float64) * (-1.0, 1.0, 1.0) + (2 * middle, 0.0, 0.0)
    distances, nearest = cKDTree(points).query(across, distance_upper_bound=near)
    twins = np.where(np.isfinite(distances), nearest, -1).astype(np.int32)
    # Where vertices coincide (seams, lips) the way back may end on another one at the same place.
    back = np.where(twins >= 0, twins[twins], -1)
    found: Indices = np.where((back >= 0) & (points[back] == points).all(axis=1), twins, -1)
    return found


def _likeness(rig: Rig, twins: Indices, middle: float) -> tuple[Floats, Floats]:
    """Return the cosine (k, k) between each mirrored shape (rows) and each shape, and their balance (k,)."""
    count = rig.shape_count
    known = np.flatnonzero(twins >= 0)
    if not len(known) or not count:
        return np.zeros((count, count)), np.zeros(count)
    moved = np.zeros(rig.vertex_count, np.bool_)
    moved[rig.deltas.indices // 3] = True
    chosen = known[moved[known]]
    chosen = chosen[:: max(1, len(chosen) // SAMPLES)]
    chosen = np.union1d(chosen, twins[chosen])
    here = rig.rows_at(chosen.tolist())[:, :count]
    there = rig.rows_at(twins[chosen].tolist())[:, :count] * np.tile([-1.0, 1.0, 1.0], len(chosen))[:, None]
    lengths = np.linalg.norm(there, axis=0)[:, None] * np.linalg.norm(here, axis=0)[None]
    cosines: Floats = (there.T @ here) / np.where(lengths > 0, lengths, np.inf)
    moves = np.linalg.norm(here.reshape(len(chosen), 3, count), axis=1)
    total = moves.sum(axis=0)
    balance = np.sign(rig.neutral[chosen, 0] - middle) @ moves / np.where(total > 0, total, 1.0)
    return cosines, balance


def _twin_shapes(names: tuple[str, ...], likeness: Floats) -> tuple[Indices, list[str]]:
    """Return the twin of each shape or -1, and what names and geometry disagree on."""
    places = {name: j for j, name in enumerate(names)}
    twins = np.full(len(names), -1, np.int32)
    contradicted: list[str] = []
    for j, name in enumerate(names):
        other = places.get(swapped(name), -1)
        if other == j:
            twins[j] = j if likeness[j, j] >= ALIKE else -1
        elif other > j:
            if likeness[j, other] >= ALIKE:
                twins[[j, other]] = other, j
            else:
                contradicted.append(f"{name} and {names[other]}")
    remarks = []
    if contradicted:
        remarks.append(f"named as twins, but not mirror images, so not paired: {listed(contradicted)}")
    lonely = np.flatnonzero(twins < 0)
    if len(lonely) > 1:
        among = likeness[np.ix_(lonely, lonely)].copy()
        np.fill_diagonal(among, -1.0)
        best = among.argmax(axis=1)
        for at, (j, other) in enumerate(zip(lonely.tolist(), best.tolist(), strict=True)):
            if best[other] == at and among[at, other] >= TELLING:
                twins[j] = int(lonely[other])
    return twins, remarks
