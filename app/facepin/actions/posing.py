"""The pose as a whole, and the way back."""

from facepin.desk.desk import Desk
from facepin.panels.commands import Command
from facepin.panels.requests import (
    CancelEdit,
    GoToStep,
    LeaveTidy,
    Refused,
    Request,
    SetControl,
    TakeTidy,
    Tidy,
)
from facepin.panels.solving.tidy import LABEL
from facepin.session.edit import Edit
from facepin.session.solving.tidying import TOLERANCE, tidied


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
        case Command.TIDY | Tidy():
            view, pane = desk.view, session.active
            session.cancel() if view.tidy is not None else session.settle()
            view.tidy = request.tolerance if isinstance(request, Tidy) else TOLERANCE
            pose = session.panes[pane].pose
            weights = tidied(session.rig, session.control, pose, view.tidy)
            session.apply(Edit(LABEL, False, weights=weights))
            desk.say(session.message)
        case TakeTidy():
            desk.view.tidy = None
            session.settle()
        case LeaveTidy():
            desk.view.tidy = None
            session.cancel()
        case SetControl(label, control):
            session.set_control(label, control)
            desk.say("")
        case CancelEdit():
            session.cancel()
            desk.say("")
        case Refused(line):
            session.cancel()
            desk.say(line, error=True)
        case _:
            return False
    return True
