"""What the user's hands did: frozen values, positions in framebuffer pixels."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

Button = Literal["left", "middle", "right"]


@dataclass(frozen=True)
class Modifiers:
    """Keys held while something else happened."""

    shift: bool = False
    control: bool = False
    alt: bool = False


NONE = Modifiers()


@dataclass(frozen=True)
class PointerPressed:
    """A mouse button went down at (x, y)."""

    x: float
    y: float
    button: Button = "left"
    modifiers: Modifiers = NONE


@dataclass(frozen=True)
class PointerMoved:
    """The mouse is now at (x, y)."""

    x: float
    y: float
    modifiers: Modifiers = NONE


@dataclass(frozen=True)
class PointerReleased:
    """A mouse button went up at (x, y)."""

    x: float
    y: float
    button: Button = "left"


@dataclass(frozen=True)
class Scrolled:
    """The wheel turned by `steps` (up is positive) with the mouse at (x, y)."""

    x: float
    y: float
    steps: float


@dataclass(frozen=True)
class KeyPressed:
    """A key went down.  `key` is its lower-case name: "a", "1", "numpad 1", "delete", "left", "f12"."""

    key: str
    modifiers: Modifiers = NONE


@dataclass(frozen=True)
class KeyReleased:
    """A key that does something as long as it is held went up: an arrow key, x, y."""

    key: str


@dataclass(frozen=True)
class FilesDropped:
    """Files or folders were dropped on the window."""

    paths: tuple[Path, ...]


@dataclass(frozen=True)
class Stirred:
    """What is shown may be another now: the window was resized or uncovered, or a character was typed."""


@dataclass(frozen=True)
class CloseRequested:
    """The window manager asked the window to close."""


Event = (
    PointerPressed
    | PointerMoved
    | PointerReleased
    | Scrolled
    | KeyPressed
    | KeyReleased
    | FilesDropped
    | Stirred
    | CloseRequested
)
