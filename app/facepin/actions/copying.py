"""Poses to the system's clipboard and from it: within a window, to another one, onto another rig."""

import numpy as np
from imgui_bundle import imgui

from facepin.core.errors import FacepinError
from facepin.desk.desk import Desk
from facepin.files.work.pose_text import part_text, pasted, pose_text
from facepin.panels.commands import Command
from facepin.panels.requests import CopyShapes, PasteShapes, Request
from facepin.session.edit import Edit
from facepin.session.session import Session


def act(request: Request, desk: Desk) -> bool:
    """Carry out what copies and pastes."""
    session = desk.session
    if session is None:
        return False
    match request:
        case Command.COPY_POSE:
            imgui.set_clipboard_text(pose_text(session.rig, session.pose))
            desk.say("Copied the pose: paste it here, in another window, or as text into a file")
        case CopyShapes(part, shapes):
            imgui.set_clipboard_text(part_text(session.rig, session.pose, shapes, part))
            desk.say(f"Copied {len(shapes)} shape{'' if len(shapes) == 1 else 's'} of {part}")
        case Command.PASTE_POSE:
            _paste(desk, session, "Paste the pose", range(session.rig.shape_count))
        case PasteShapes(part, shapes):
            _paste(desk, session, f"Paste into {part}", shapes)
        case _:
            return False
    return True


def _paste(desk: Desk, session: Session, label: str, shapes: "range | tuple[int, ...]") -> None:
    """Put what was copied on some shapes, as one step; pins stay, and what does not match is said.

    Raises
    ------
    FacepinError
        When nothing was copied that is a pose, or nothing of it is for these shapes.
    """
    text = imgui.get_clipboard_text()
    if not text.strip():
        raise FacepinError("there is no text on the clipboard: copy a pose first (Ctrl+C)")
    found = pasted(text, session.rig)
    meant = np.zeros(session.rig.shape_count, np.bool_)
    meant[list(shapes)] = True
    meant &= found.named
    if not meant.any():
        why = found.report or "others are named"
        raise FacepinError(f"nothing on the clipboard is for these shapes: {why}")
    weights = np.where(meant, found.weights, session.pose.weights)
    desk.apply(Edit(label, True, weights=weights))
    remarks = "; ".join(line for line in (found.report, session.message) if line)
    desk.say(f"Pasted; {remarks}" if remarks else "Pasted", error=bool(session.message))
