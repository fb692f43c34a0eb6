"""The pose as a whole, and the way back."""

from facepin.desk.desk import Desk
from facepin.panels.commands import Command
from facepin.panels.requests import CancelEdit, GoToStep, Request, SetControl


def act(request: Request, desk: Desk) -> bool:
    """Carry out what concerns the whole pose."""
    session = desk.session
    if session is None:
        return False
    match request:
        case Command.UNDO:
            label = session.undo_label
            desk.say(f"Undone: {label}" if session.undo() else "Nothing to undo")
        case Command.REDO:
            label = session.redo_label
            desk.say(f"Redone: {label}" if session.redo() else "Nothing to redo")
        case GoToStep(step):
            if session.go_to(step):
                desk.say(f"Went to step {step}: {session.steps[step].label}")
        case Command.RESET_POSE:
            session.reset()
            desk.say(session.message)
        case SetControl(label, control):
            session.set_control(label, control)
            desk.say("")
        case CancelEdit():
            session.cancel()
            desk.say("")
        case _:
            return False
    return True
