"""Why a pin is not where it should be, in a word."""

import numpy as np

from facepin.core.control import ShapeControl
from facepin.core.pose import Pin, pin_displacement, pin_rows
from facepin.core.rig import Rig
from facepin.session.work import Pane

SHORT = 0.01
"""A pin that is nearer to its goal than this share of the face height is there."""
HELPS = 0.1
"""A shape that would carry the pin over this share of what is missing could help."""
SPENT = 0.02
"""A shape with less than this share of its range to go is at its end."""
TOGETHER = 0.5
"""A shape that moves another pin by this share of what it moves the pin is kept back by that one."""
PULLED_BACK = 0.05
"""Force on the rest of the face, next to the hand's, that keeps the pin back."""

NOTHING = "no shape moves it there"
LOCKED = "what would move it is locked"
ENDS = "its shapes are at their ends"
OTHER = "another pin holds it"
REST = "the rest of the face would go along"
UNSUITED = "what could still move it suits less"
HALFWAY = "this solver goes part of the way"


def reason(rig: Rig, control: ShapeControl, pane: Pane, pin: Pin) -> str:
    """Return why a solver left `pin` short of its goal; empty where it did not, or no solver was at work.

    The shapes are asked one by one which way they would move the pin from the pose as it is, how far they may
    still go, and what else they would move.
    """
    pose = pane.pose
    if pane.solved is None:
        return ""
    rows, heard = pin_rows(rig, (pin,)), control.heard(pose.weights)
    missing = pin_displacement(rig, (pin,)) - rows @ rig.amounts(heard)
    length = float(np.linalg.norm(missing))
    if length <= SHORT * rig.height * pin.stiffness**0.5:
        return ""
    nearer = missing @ rig.slopes(rows, heard) / length
    low, high = control.limits_at(pose.weights).T
    ability = np.abs(nearer) * (high - low)
    room = np.maximum(np.where(nearer > 0, high - pose.weights, pose.weights - low), 0.0)
    open_to = np.zeros(rig.shape_count, np.bool_)
    open_to[control.free] = True
    helps = np.abs(nearer) * room >= HELPS * length
    if not np.any(ability >= HELPS * length):
        return NOTHING
    if room[np.argmax(ability)] < SPENT * (high - low)[np.argmax(ability)] or not np.any(helps):
        return ENDS
    if not np.any(helps & open_to):
        return LOCKED
    if pane.choice.kind.grasps and pane.solved.notes.get("held_back", 0.0) > PULLED_BACK:
        return REST
    best = int(np.argmax(np.abs(nearer) * room * open_to))
    others = tuple(other for other in pose.pins if other.vertex != pin.vertex)
    if others:
        moved = np.linalg.norm(
            rig.slopes(rig.rows_at([other.vertex for other in others]), heard)[:, best].reshape(-1, 3), axis=1
        )
        if moved.max() * pin.stiffness**0.5 >= TOGETHER * abs(nearer[best]):
            return OTHER
    return UNSUITED if pane.choice.kind.grasps else HALFWAY
