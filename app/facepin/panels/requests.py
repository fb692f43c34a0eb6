"""What a menu, a key or a panel can ask of the main loop."""

from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from facepin.core.camera import View
from facepin.core.control import ShapeControl
from facepin.core.events import KeyPressed
from facepin.core.pose import Freedom
from facepin.session.solving import SolverChoice


class Command(Enum):
    """Everything that needs no further word: (title, shortcuts).  Menus and keys share this one table."""

    OPEN_FILE = "Open file…", ("Ctrl+O",)
    OPEN_FOLDER = "Open folder of OBJ files…", ("Ctrl+Shift+O",)
    OPEN_BUILTIN = "Open the built-in face", ()
    LOAD_POSE = "Load pose…", ("Ctrl+L",)
    SAVE_POSE = "Save pose…", ("Ctrl+S",)
    EXPORT = "Export model…", ("Ctrl+E",)
    SCREENSHOT = "Save picture", ("F12",)
    QUIT = "Quit", ("Ctrl+Q",)
    UNDO = "Undo", ("Ctrl+Z",)
    REDO = "Redo", ("Ctrl+Shift+Z", "Ctrl+Y")
    RESET_POSE = "Reset the pose", ("Home",)
    DELETE_PINS = "Remove selected pins", ("Delete", "Backspace")
    CLEAR_PINS = "Remove all pins", ()
    FRAME = "Frame the face", ("F",)
    FRONT = "Front", ("1", "Numpad 1")
    LEFT = "Character's left", ("3", "Numpad 3")
    RIGHT = "Character's right", ("Ctrl+3",)
    THREE_QUARTER = "Three-quarter", ("7", "Numpad 7")
    HEAT = "Heat map of the move", ("H",)
    WIREFRAME = "Wireframe", ("W",)
    GHOST = "Ghost: none, neutral, reference", ("G",)
    RESET_LAYOUT = "Reset the panel layout", ()
    REFERENCE_FROM_POSE = "Take this pose as the reference", ()
    REFERENCE_FROM_FILE = "Reference from a file…", ()
    CHART = "Chart of weights and errors", ("F4",)
    SAVE_CHART = "Save the chart", ()
    FORGET_REFERENCE = "Forget the reference", ()

    @property
    def title(self) -> str:
        """What a menu calls it."""
        return str(self.value[0])

    @property
    def shortcuts(self) -> tuple[str, ...]:
        """Keys that ask for it; the first one stands in the menu."""
        return tuple(self.value[1])


VIEW_COMMANDS: dict[Command, View] = {
    Command.FRONT: "front",
    Command.LEFT: "left",
    Command.RIGHT: "right",
    Command.THREE_QUARTER: "three-quarter",
}


def command_for(event: KeyPressed) -> Command | None:
    """Return the command a key asks for, or None."""
    keys = (
        ["ctrl"] * event.modifiers.control + ["shift"] * event.modifiers.shift + ["alt"] * event.modifiers.alt
    )
    pressed = "+".join([*keys, event.key])
    for command in Command:
        if any(shortcut.lower() == pressed for shortcut in command.shortcuts):
            return command
    return None


@dataclass(frozen=True)
class OpenPath:
    """Open the rig at a path."""

    path: Path


@dataclass(frozen=True)
class UseSolver:
    """Solve a pane's pins with another solver or other settings."""

    pane: int
    choice: SolverChoice
    final: bool = True
    """False while a setting is being slid."""


@dataclass(frozen=True)
class AddPane:
    """Solve the same drags with one more solver."""

    choice: SolverChoice


@dataclass(frozen=True)
class RandomReference:
    """Measure the panes against a random pose."""

    shapes: int


@dataclass(frozen=True)
class SelectPane:
    """Show and edit the numbers of a pane."""

    pane: int


@dataclass(frozen=True)
class ClosePane:
    """Close a pane."""

    pane: int


@dataclass(frozen=True)
class KeepPane:
    """Go on with the pose of one pane alone."""

    pane: int


@dataclass(frozen=True)
class SetPin:
    """Change what the pin at a vertex constrains."""

    vertex: int
    freedom: Freedom | None = None
    stiffness: float | None = None
    remove: bool = False
    final: bool = True


@dataclass(frozen=True, eq=False)
class SetControl:
    """Lock, mute or limit shapes."""

    label: str
    control: ShapeControl
    final: bool = True


@dataclass(frozen=True)
class CancelEdit:
    """Give up what a panel was changing: everything is as it was before."""


@dataclass(frozen=True)
class CancelLoading:
    """Give up opening a file."""


Request = (
    Command
    | OpenPath
    | UseSolver
    | AddPane
    | SelectPane
    | ClosePane
    | KeepPane
    | RandomReference
    | SetPin
    | SetControl
    | CancelEdit
    | CancelLoading
)
