"""What icons and menus of the weights panel change of the control over shapes, each with its label."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.control import Flags, ShapeControl
from facepin.core.rig_builder import LARGEST_WEIGHT
from facepin.panels.requests import SetControl

Flag = Literal["lock", "mute", "solo"]

FLAGS: tuple[Flag, ...] = ("lock", "mute", "solo")
_OPPOSITES = {"lock": "Unlock", "mute": "Unmute", "solo": "End solo of"}


def flags_of(control: ShapeControl, flag: Flag) -> Flags:
    """Return which shapes (k,) are locked, muted or solo."""
    return {"lock": control.locked, "mute": control.muted, "solo": control.solo}[flag]


def _with_flags(control: ShapeControl, flag: Flag, flags: Flags) -> ShapeControl:
    match flag:
        case "lock":
            return replace(control, locked=flags)
        case "mute":
            return replace(control, muted=flags)
        case "solo":
            return replace(control, solo=flags)


def toggled(control: ShapeControl, flag: Flag, shapes: Sequence[int], what: str) -> SetControl:
    """Lock, mute or solo shapes, called `what`; undo it if it holds for all of them."""
    flags = flags_of(control, flag).copy()
    on = not flags[list(shapes)].all()
    flags[list(shapes)] = on
    verb = flag.capitalize() if on else _OPPOSITES[flag]
    return SetControl(f"{verb} {what}", _with_flags(control, flag, flags))


def freed(control: ShapeControl, flag: Flag) -> SetControl:
    """Take all locks, mutes or solos away."""
    nothing = np.zeros(len(control.locked), np.bool_)
    return SetControl(f"{_OPPOSITES[flag]} all shapes", _with_flags(control, flag, nothing))


def limited(control: ShapeControl, shape: int, limits: Sequence[float], name: str) -> SetControl:
    """Give a shape other limits; where they cross, the second one follows the first."""
    low, high = (float(np.clip(limit, -LARGEST_WEIGHT, LARGEST_WEIGHT)) for limit in limits)
    changed: Floats = control.limits.copy()
    if low > high:
        low, high = (low, low) if low != control.limits[shape, 0] else (high, high)
    changed[shape] = low, high
    return SetControl(f"Limit {name}", replace(control, limits=changed))
