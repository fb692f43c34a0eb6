"""What goes on between the press of a button and its release."""

from typing import Protocol

from facepin.session.edit import Edit
from facepin.session.hand.sight import Pixel


class Gesture(Protocol):
    """Gets all moves of the mouse from the press to the release, and the release.

    It begins on the pins as they are at the press; what it returns is made of these alone, so that it may be
    dropped at any time.
    """

    selected: frozenset[int]
    """Vertices of the pins that are selected by it, as it stands."""
    remark: str
    """What the last event gave reason to say; mostly empty."""

    def move(self, pixel: Pixel) -> Edit | None:
        """Return what the mouse's being here changes."""

    def release(self, pixel: Pixel) -> Edit | None:
        """Return what remains of it."""
