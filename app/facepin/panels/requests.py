"""What a menu, a key or a panel can ask for: a command, or something that needs further words."""

from dataclasses import dataclass
from pathlib import Path

from facepin.core.control import ShapeControl
from facepin.core.pose import Freedom
from facepin.panels.commands import Command
from facepin.panels.library.requests import LibraryRequest
from facepin.session.solving.solving import SolverChoice


@dataclass(frozen=True)
class OpenPath:
    """Open the rig, the scene or the pose at a path."""

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
class ClosePane:
    """Close a pane."""

    pane: int


@dataclass(frozen=True)
class KeepPane:
    """Go on with the pose of one pane alone."""

    pane: int


@dataclass(frozen=True)
class SetPins:
    """Change the pins on some vertices; what is None stays as it is."""

    vertices: frozenset[int]
    freedom: Freedom | None = None
    stiffness: float | None = None
    locked: bool | None = None
    hidden: bool | None = None
    final: bool = True
    """False while a setting is being slid."""


@dataclass(frozen=True)
class NamePin:
    """Call the pin on a vertex by another name; an empty one takes its name away."""

    vertex: int
    name: str


@dataclass(frozen=True)
class RemovePins:
    """Remove the pins on some vertices."""

    vertices: frozenset[int]


@dataclass(frozen=True)
class SelectPins:
    """Select the pins on some vertices, and no others."""

    vertices: frozenset[int]


@dataclass(frozen=True)
class Tidy:
    """Show the pose with fewer shapes."""

    tolerance: float
    """Per cent of the face height that what is held may move by."""


@dataclass(frozen=True)
class TakeTidy:
    """Take the pose that is shown."""


@dataclass(frozen=True)
class LeaveTidy:
    """Leave the pose as it was."""


@dataclass(frozen=True)
class GoToStep:
    """Undo or redo to one of the steps of the history."""

    step: int


@dataclass(frozen=True)
class RestoreWork:
    """Go on with unsaved work that a former window left over."""

    draft: Path


@dataclass(frozen=True)
class DiscardWork:
    """Throw unsaved work away that a former window left over."""

    draft: Path


@dataclass(frozen=True)
class Choose:
    """Set one of the choices of `panels.view.CHOICES`."""

    name: str
    value: object


@dataclass(frozen=True)
class PairShapes:
    """Take two shapes for each other's mirror image; None parts a shape from its twin."""

    shape: int
    twin: int | None


@dataclass(frozen=True)
class CopyShapes:
    """Put the weights of some shapes on the clipboard."""

    part: str
    """What they are shapes of."""
    shapes: tuple[int, ...]


@dataclass(frozen=True)
class PasteShapes:
    """Set some shapes to what is on the clipboard."""

    part: str
    """What they are shapes of."""
    shapes: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class SetControl:
    """Lock, mute or limit shapes."""

    label: str
    control: ShapeControl


@dataclass(frozen=True)
class CancelEdit:
    """Give up what a panel was changing: everything is as it was before."""


@dataclass(frozen=True)
class Refused:
    """Leave everything as it is, and say why."""

    line: str


@dataclass(frozen=True)
class ShadeAs:
    """Show the active pane in one of the modes of `core.shading.MODES`."""

    mode: str


@dataclass(frozen=True)
class ShowParts:
    """Show all parts of the mesh but some."""

    hidden: frozenset[str]
    """Names of those that are neither drawn nor pressed."""


@dataclass(frozen=True)
class CancelLoading:
    """Give up opening a file, or looking for the rig of a scene."""


@dataclass(frozen=True)
class UseNeutral:
    """Open the folder that waits for it with this file as the neutral."""

    name: str


@dataclass(frozen=True)
class CancelJob:
    """Give up what is being made beside the work."""


Request = (
    Command
    | OpenPath
    | UseSolver
    | AddPane
    | ClosePane
    | KeepPane
    | RandomReference
    | Tidy
    | TakeTidy
    | LeaveTidy
    | GoToStep
    | RestoreWork
    | DiscardWork
    | PairShapes
    | Choose
    | ShadeAs
    | ShowParts
    | SetPins
    | NamePin
    | RemovePins
    | SelectPins
    | SetControl
    | CancelEdit
    | CopyShapes
    | PasteShapes
    | Refused
    | CancelLoading
    | UseNeutral
    | CancelJob
    | LibraryRequest
)
