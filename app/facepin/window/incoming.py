"""What happened and was not told yet: a frame's worth at a time, to the program and to imgui alike."""

from collections import deque
from collections.abc import Callable

from facepin.core.events import Event, PointerMoved, PointerPressed, PointerReleased


class Incoming:
    """Events in the order in which they happened.

    What the mouse is over is known a frame after it came there.  A pen, a finger or a remote desktop brings
    the first move together with the press: told in one frame, the press would go to what was under the mouse
    before.  So a button has a frame of its own after a move, and what follows a button has the next one.
    """

    def __init__(self) -> None:
        self._waiting: deque[tuple[Event | None, Callable[[], object] | None]] = deque()

    def __bool__(self) -> bool:
        """Whether anything has not been told yet."""
        return bool(self._waiting)

    def add(self, event: Event | None, tell_imgui: Callable[[], object] | None = None) -> None:
        """Take what happened.

        Parameters
        ----------
        event : Event
            As the program is told it; None for what concerns imgui alone.
        tell_imgui : callable
            Tells imgui the same, if it is to know.
        """
        self._waiting.append((event, tell_imgui))

    def take(self) -> list[Event]:
        """Tell imgui what belongs to the next frame, and return it for the program."""
        events: list[Event] = []
        while self._waiting and not _waits(self._waiting[0][0], events):
            event, tell_imgui = self._waiting.popleft()
            if tell_imgui is not None:
                tell_imgui()
            if event is not None:
                events.append(event)
        return events


def _waits(event: Event | None, before: list[Event]) -> bool:
    """Say whether an event has to wait for another frame than that of the events before it."""
    buttons = PointerPressed | PointerReleased
    if isinstance(event, buttons):
        return any(isinstance(other, PointerMoved | PointerPressed | PointerReleased) for other in before)
    return isinstance(event, PointerMoved) and any(isinstance(other, buttons) for other in before)
