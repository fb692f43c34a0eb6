"""Moving pins by keys, pixel by pixel; presses in quick succession are one undo step."""

from dataclasses import dataclass, field

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.events import Event, KeyPressed, KeyReleased, PointerMoved, Stirred
from facepin.core.pose import Pin
from facepin.session.edit import Edit
from facepin.session.hand.moving import amount, carried
from facepin.session.hand.sight import Sight

PAUSE = 1.0
"""Seconds without a key held after which the next press is another undo step: people tap and look."""
LEAP = 10
"""Pixels per press with Shift."""
_STUCK = 3.0
"""Seconds after which a key that is held but does not repeat is taken for released: that got lost."""

_ACROSS = {"left": (-1, 0, 0), "right": (1, 0, 0), "up": (0, 1, 0), "down": (0, -1, 0)}
_ALONG = {"page up": (0, 0, -1), "page down": (0, 0, 1)}
_ALONG_WITH_ALT = {"up": (0, 0, -1), "down": (0, 0, 1)}

Step = tuple[int, int, int]
"""Pixels right, up and towards the viewer."""


def step_of(event: Event) -> Step | None:
    """Return how far a key moves pins; None where that is not what it is for."""
    if not isinstance(event, KeyPressed) or event.modifiers.control:
        return None
    step = _ALONG.get(event.key)
    if step is None:
        step = (_ALONG_WITH_ALT if event.modifiers.alt else _ACROSS).get(event.key)
    if step is None or not event.modifiers.shift:
        return step
    right, up, back = (LEAP * pixels for pixels in step)
    return right, up, back


def goes_on(event: Event) -> bool:
    """Say whether pins that are being nudged stay in the hand over an event."""
    return isinstance(event, PointerMoved | KeyReleased | Stirred) or step_of(event) is not None


@dataclass
class Nudge:
    """Pins on their way."""

    pins: tuple[Pin, ...]
    """All pins, as they are by now."""
    vertices: frozenset[int]
    """Of those that move."""
    keys: set[str] = field(default_factory=set)
    """Keys that are held down."""
    _quiet_since: float | None = None

    def move(self, step: Step, sight: Sight) -> bool:
        """Move the pins; those on screen have no depth to be moved in.  Return whether any moved."""
        along = step[2] != 0
        vertices = frozenset(
            pin.vertex
            for pin in self.pins
            if pin.vertex in self.vertices and not (along and pin.freedom == "screen")
        )
        self._quiet_since = None
        if vertices:
            by = _length_of_pixel(self.pins, vertices, sight) * (np.array(step) @ np.stack(sight.camera.axes))
            self.pins = carried(self.pins, vertices, by, sight.camera)
        return bool(vertices)

    def release(self, key: str) -> None:
        """Let go of a key."""
        self.keys.discard(key)
        self._quiet_since = None

    def edit(self, *, final: bool) -> Edit:
        """Return what came of it so far."""
        return Edit(f"Nudge {amount(len(self.vertices))}", final, self.pins, solve=True)

    def rests(self, now: float) -> bool:
        """Say whether no key was pressed for a while; `now` is a clock in seconds."""
        if self._quiet_since is None:
            self._quiet_since = now
        return now - self._quiet_since >= (_STUCK if self.keys else PAUSE)


def _length_of_pixel(pins: tuple[Pin, ...], vertices: frozenset[int], sight: Sight) -> float:
    """Return the length in space that a pixel of a 1x screen covers where the pins are, on average."""
    camera = sight.camera
    middle: Floats = np.mean([pin.goal for pin in pins if pin.vertex in vertices], axis=0)
    depth = max(float((camera.eye - middle) @ camera.axes[2]), camera.near)
    return sight.scale * camera.pixel_size(sight.viewport) * depth / camera.distance
