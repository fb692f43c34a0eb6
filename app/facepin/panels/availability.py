"""What a command is called now, whether it can do anything and if not, why; and whether it did already."""

from facepin.core.shapes.gaze import find_gaze
from facepin.panels.commands import Command
from facepin.panels.view import View
from facepin.session.session import Session

WITHOUT_FACE = frozenset(
    {
        Command.OPEN_FILE,
        Command.OPEN_FOLDER,
        Command.LOCATE_RIG,
        Command.UNSAVED_WORK,
        Command.QUIT,
        Command.RESET_LAYOUT,
        Command.PALETTE,
        Command.KEYBOARD,
        Command.GUIDE,
        Command.ABOUT,
    }
)
"""What makes sense before a face is open."""
OF_PINS = frozenset(
    {
        Command.SELECT_PINS,
        Command.LOCK_PINS,
        Command.HIDE_PINS,
        Command.DELETE_PINS,
        Command.CLEAR_PINS,
    }
)
"""What makes sense where pins are."""


def title_of(command: Command, session: Session | None) -> str:
    """Return what a menu calls a command: undo and redo say what of."""
    label = None
    if session is not None and command in (Command.UNDO, Command.REDO):
        label = session.undo_label if command is Command.UNDO else session.redo_label
    return f"{command.title}: {label}" if label else command.title


def why_not(command: Command, session: Session | None) -> str:
    """Return in a few words why a command can't do anything now; empty when it can."""
    if session is None:
        return "" if command in WITHOUT_FACE else "no face is open"
    match command:
        case Command.UNDO if session.undo_label is None:
            return "nothing to undo"
        case Command.REDO if session.redo_label is None:
            return "nothing to redo"
        case command if command in OF_PINS and not session.pose.pins:
            return "there are no pins"
        case Command.SHOW_PINS if not any(pin.hidden for pin in session.pose.pins):
            return "no pin is hidden"
        case Command.SAVE_LANDMARKS if not any(pin.name for pin in session.pose.pins):
            return "no pin has a name"
        case Command.GAZE if find_gaze(session.rig) is None:
            return "this face has no shapes that turn its eyes"
        case Command.SHOW_REFERENCE | Command.FORGET_REFERENCE if session.work.reference is None:
            return "no reference is set"
    return ""


def is_on(command: Command, view: View, active: int) -> bool:
    """Say whether what a command switches on and off is on, in the active pane where each has its own."""
    match command:
        case Command.SYMMETRY:
            return view.symmetric
        case Command.WIREFRAME:
            return view.panes[active].wireframe
        case Command.GAZE:
            return view.gaze.shown
        case Command.SKETCH_PINS:
            return view.pins.sketching
        case Command.SHOW_REFERENCE:
            return view.reference_shown
        case Command.CHART:
            return view.chart
        case Command.HISTORY:
            return view.history
        case Command.UNSAVED_WORK:
            return view.recovery.shown
    return False
