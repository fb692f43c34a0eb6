"""Whether a command can do anything now, and if not, why."""

from facepin.panels.requests import Command
from facepin.session.session import Session

WITHOUT_FACE = frozenset(
    {
        Command.OPEN_FILE,
        Command.OPEN_FOLDER,
        Command.OPEN_BUILTIN,
        Command.QUIT,
        Command.RESET_LAYOUT,
        Command.PALETTE,
        Command.KEYBOARD,
        Command.GUIDE,
        Command.ABOUT,
    }
)
"""What makes sense before a face is open."""


def why_not(command: Command, session: Session | None) -> str:
    """Return in a few words why a command can't do anything now; empty when it can."""
    if session is None:
        return "" if command in WITHOUT_FACE else "no face is open"
    match command:
        case Command.UNDO if session.undo_label is None:
            return "nothing to undo"
        case Command.REDO if session.redo_label is None:
            return "nothing to redo"
        case (
            Command.SELECT_PINS
            | Command.DELETE_PINS
            | Command.CLEAR_PINS
            | Command.LOCK_PINS
            | Command.HIDE_PINS
        ) if not session.pose.pins:
            return "there are no pins"
        case Command.SHOW_PINS if not any(pin.hidden for pin in session.pose.pins):
            return "no pin is hidden"
        case Command.SAVE_LANDMARKS if not any(pin.name for pin in session.pose.pins):
            return "no pin has a name"
        case Command.FORGET_REFERENCE if session.work.reference is None:
            return "no reference is set"
    return ""
