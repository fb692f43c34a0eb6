"""Left and right: which vertex and which shape is the twin of which, across the middle of the face."""

import re
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats, Indices, frozen
from facepin.core.names import listed
from facepin.core.rig import Rig
from facepin.core.shapes.symmetry import across, middle_of, twin_vertices

NEAR = 0.01
"""How far from its mirrored place a twin vertex may be, as a share of the face height."""
ALIKE = 0.5
"""Least likeness (cosine) of a shape and its mirrored twin where the names say so."""
TELLING = 0.9
"""The same where nothing but the geometry says so."""
SAMPLES = 2000
"""Vertices that are compared; more do not tell more."""
HEARD = 0.5
"""Least share of a shape's motion at vertices with a twin for geometry to have a say in who its twin is."""

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
        return across(np.asarray(points, np.float64), self.middle)

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
    where one clearly is the other's mirror image.  On a mesh that is not symmetric names alone decide.
    """
    middle = middle_of(rig)
    vertices = twin_vertices(rig, middle, NEAR * rig.height)
    likeness, balance = _likeness(rig, vertices, middle)
    shapes, remarks = _twin_shapes(rig.shape_names, likeness, _heard(rig, vertices))
    return Mirror(
        frozen(vertices, np.int32),
        frozen(shapes, np.int32),
        frozen(balance, np.float64),
        middle,
        tuple(remarks),
    )


def swapped(name: str) -> str:
    """Return a name with left and right exchanged; the same name if it says no side."""

    def other(match: re.Match[str]) -> str:
        side = match.group()
        word = _OTHER[side.lower()]
        if side.isupper():
            return word.upper()
        return word.capitalize() if side[0].isupper() else word

    return _SIDE.sub(other, name)


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


def _heard(rig: Rig, twins: Indices) -> NDArray[np.bool_]:
    """Return for which shapes (k,) geometry has a say: those that move mostly vertices with a twin."""
    columns = rig.deltas[:, : rig.shape_count].astype(np.float64).power(2)
    total = np.asarray(columns.sum(axis=0)).ravel()
    known = np.repeat(twins >= 0, 3).astype(np.float64) @ columns
    heard: NDArray[np.bool_] = known >= HEARD * total
    return heard


def _twin_shapes(
    names: tuple[str, ...], likeness: Floats, heard: NDArray[np.bool_]
) -> tuple[Indices, list[str]]:
    """Return the twin of each shape or -1, and what names and geometry disagree on.

    Names alone decide on pairs for which geometry is not `heard` (k,).
    """
    places = {name: j for j, name in enumerate(names)}
    twins = np.full(len(names), -1, np.int32)
    contradicted: list[str] = []
    for j, name in enumerate(names):
        other = places.get(swapped(name), -1)
        if other == j:
            twins[j] = j if likeness[j, j] >= ALIKE else -1
        elif other > j:
            if likeness[j, other] >= ALIKE or not (heard[j] and heard[other]):
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
