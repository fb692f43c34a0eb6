"""Where the eyes look: which shapes turn them, by how much, and the weights that make them look elsewhere."""

import re
from dataclasses import dataclass
from functools import lru_cache
from math import cos, radians, sin
from typing import Literal, get_args

import numpy as np

from facepin.core.arrays import Floats, Indices, frozen
from facepin.core.control import ShapeControl
from facepin.core.mesh.pieces import Eyeball, eyeballs, pieces, turn_of
from facepin.core.rig import Rig
from facepin.core.shapes.answering import MISFIT, TURN, gaze_shapes
from facepin.core.shapes.motion import shape_moves
from facepin.core.shapes.regions import words_of

__all__ = ["Gaze", "aimed", "find_gaze", "gaze_shapes", "look"]

Way = Literal["left", "right", "up", "down"]
Side = Literal["left", "right"]
WAYS: tuple[Way, ...] = get_args(Way)
SIDES: tuple[Side, ...] = get_args(Side)

CUSTOMARY: dict[Way, float] = {
    "left": radians(30),
    "right": radians(30),
    "up": radians(25),
    "down": radians(30),
}
"""How far ARKit's shapes turn an eye at weight 1, about; taken where no eyeball turns that could be told."""
IN_FRONT = 0.4
"""How far before the eyes their handle is, as a share of the height of the model."""

_SIDE: dict[str, Side] = {"left": "left", "l": "left", "right": "right", "r": "right"}
_RUN_TOGETHER = re.compile(r"(?:eyes?)?(look|gaze)s?(in|out|up|down|left|right)?(left|right|l|r)?")


@dataclass(frozen=True, eq=False)
class Gaze:
    """The eyes of a rig, and what turns them.  The left eye is the character's."""

    eyes: Floats
    """(2, 3) float64, their middles: left, right."""
    shapes: Indices
    """(2, 4) int32, shapes that turn each eye to the character's left and right, up and down; −1 for none.
    Both eyes have the same where one shape turns both."""
    angles: Floats
    """(2, 4) float64, how far these turn the eye at weight 1, in radians."""
    forward: int
    """1 for a face that looks along +z, −1 along −z."""
    reach: float
    """How far before the middle of the eyes their handle is, a length."""

    @property
    def middle(self) -> Floats:
        """Point (3,) between the eyes."""
        middle: Floats = self.eyes.mean(axis=0)
        return middle

    def direction(self, yaw: float, pitch: float) -> Floats:
        """Return the unit vector (3,) that an eye looks along; yaw to the character's left, pitch upwards."""
        ahead, aside = self.forward * cos(pitch), self.forward * cos(pitch)
        return np.array([aside * sin(yaw), sin(pitch), ahead * cos(yaw)])

    def angles_to(self, point: Floats) -> tuple[float, float]:
        """Return yaw and pitch, in radians, of a point (3,) seen from between the eyes."""
        x, y, z = point - self.middle
        return float(np.arctan2(x * self.forward, z * self.forward)), float(np.arctan2(y, np.hypot(x, z)))

    def handle(self, weights: Floats) -> Floats:
        """Return where the handle is, (3,): before the eyes, where both look in the mean."""
        yaw, pitch = look(self, weights).mean(axis=0).tolist()
        return self.middle + self.reach * self.direction(yaw, pitch)


@lru_cache(maxsize=2)
def find_gaze(rig: Rig) -> Gaze | None:
    """Find the shapes that turn the eyes, by their names, and measure them; None for a rig without.

    Remembered for the last few rigs.
    """
    turning: dict[tuple[Side, Way], int] = {}
    for shape, name in enumerate(rig.shape_names):
        for key in named_turns(name):
            turning.setdefault(key, shape)
    ways = {way for _, way in turning}
    if not (ways >= {"left", "right"} or ways >= {"up", "down"}):
        return None
    balls = eyeballs(rig, pieces(rig))
    sides = [_middle_of(rig, sorted({j for (side, _), j in turning.items() if side == one})) for one in SIDES]
    same = {j for (side, _), j in turning.items() if side == "left"} & {
        j for (side, _), j in turning.items() if side == "right"
    }
    forward = -1 if not same and sides[0][0] < sides[1][0] else 1
    eyes: tuple[Eyeball | None, ...] = balls[::forward] if balls else (None, None)
    if balls:
        middles = np.array([ball.centre for ball in balls[::forward]])
    elif same:
        middles = _halves(rig, sorted(same))[::forward]
    else:
        middles = np.array(sides)
    shapes = np.full((2, 4), -1)
    angles = np.tile([CUSTOMARY[way] for way in WAYS], (2, 1))
    for (side, way), shape in turning.items():
        at = SIDES.index(side), WAYS.index(way)
        shapes[at] = shape
        angles[at] = _turn(rig, eyes[at[0]], shape, way) or angles[at]
    return Gaze(
        frozen(middles, np.float64),
        frozen(shapes, np.int32),
        frozen(angles, np.float64),
        forward,
        IN_FRONT * rig.height,
    )


def named_turns(name: str) -> list[tuple[Side, Way]]:
    """Return which eyes a shape turns which way, by its name; empty for other shapes.

    eyeLookIn_L turns the left eye to the right, lookLeft turns both to the left.  Corrections, whose names go
    on after that, are none.
    """
    words: list[str] = []
    for word in words_of(name.rpartition(".")[2] or name):
        found = _RUN_TOGETHER.fullmatch(word)
        words += [part for part in found.groups() if part] if found else [word]
    at = next((at for at, word in enumerate(words) if word in ("look", "looks", "gaze")), None)
    if at is None and len(words) == 2 and words[0] == "eyes":
        at = 0  # eyesUp
    if at is None or len(words) == at + 1:
        return []
    way, behind = words[at + 1], words[at + 2 :]
    before = _SIDE.get(words[0]) if at > 0 else None
    side = _SIDE.get(behind[0]) if behind else before
    if len(behind) > 1 or (behind and side is None):
        return []
    if way in ("in", "out"):
        if side is None:
            return []
        return [(side, side if way == "out" else SIDES[1 - SIDES.index(side)])]
    turned = next((each for each in WAYS if each == way), None)
    return [] if turned is None else [(each, turned) for each in ((side,) if side else SIDES)]


def look(gaze: Gaze, weights: Floats) -> Floats:
    """Return where the eyes look in a pose (k,): (2, 2) yaw and pitch of left and right eye, in radians."""
    turns = np.where(gaze.shapes >= 0, weights[gaze.shapes] * gaze.angles, 0.0)
    return turns[:, 0::2] - turns[:, 1::2]


def aimed(gaze: Gaze, weights: Floats, yaw: float, pitch: float, control: ShapeControl) -> Floats:
    """Return weights (k,) with which both eyes look in one direction, as far as limits and locks let them.

    Parameters
    ----------
    gaze : Gaze
    weights : (k,) float64
        What all other shapes keep.
    yaw, pitch : float
        To the character's left and upwards, in radians.
    control : ShapeControl
        A locked shape stays; the opposite one makes up for it where it can.
    """
    result = weights.copy()
    for eye in range(2):
        for axis, angle in enumerate((yaw, pitch)):
            pair = slice(2 * axis, 2 * axis + 2)
            ways = list(zip(gaze.shapes[eye, pair].tolist(), gaze.angles[eye, pair], (1, -1), strict=True))
            free = [(j, turn, sign) for j, turn, sign in ways if j >= 0 and not control.locked[j]]
            fixed = sum(sign * turn * weights[j] for j, turn, sign in ways if j >= 0 and control.locked[j])
            for j, turn, sign in free:
                low, high = control.limits[j]
                result[j] = np.clip(max(sign * (angle - fixed), 0.0) / turn, low, high) + 0.0  # no -0
    return result


def _turn(rig: Rig, eye: Eyeball | None, shape: int, way: Way) -> float | None:
    """Measure by which angle a shape turns an eyeball; None where it doesn't."""
    if eye is None:
        return None
    rest = rig.neutral[eye.vertices].astype(np.float64)
    rotation, misfit = turn_of(
        eye, rest, rest + rig.deltas[:, [shape]].toarray().reshape(-1, 3)[eye.vertices]
    )
    angle = abs(float(rotation[1 if way in SIDES else 0]))
    return angle if angle >= TURN and misfit <= MISFIT else None


def _middle_of(rig: Rig, shapes: list[int]) -> Floats:
    """Return the middle (3,) of what some shapes move."""
    squares = sum((shape_moves(rig, j) ** 2 for j in shapes), np.zeros(rig.vertex_count))
    middle: Floats = squares @ rig.neutral / max(float(squares.sum()), np.finfo(float).tiny)
    return middle


def _halves(rig: Rig, shapes: list[int]) -> Floats:
    """Return the middles (2, 3) of what some shapes move at larger and at smaller x than their middle."""
    middle = _middle_of(rig, shapes)
    squares = sum((shape_moves(rig, j) ** 2 for j in shapes), np.zeros(rig.vertex_count))
    halves = []
    for side in (rig.neutral[:, 0] >= middle[0], rig.neutral[:, 0] < middle[0]):
        share = squares * side
        halves.append(share @ rig.neutral / share.sum() if share.any() else middle)
    return np.array(halves)
