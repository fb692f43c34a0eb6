"""Moving the camera with the mouse: the habits of Maya and of Blender, as one table."""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import pi

from facepin.core.camera import Camera, Viewport
from facepin.core.events import (
    Button,
    Event,
    Modifiers,
    PointerMoved,
    PointerPressed,
    PointerReleased,
    Scrolled,
)

Motion = Callable[[Camera, float, float, Viewport], Camera]
"""(camera, dx, dy in pixels, viewport) -> camera."""


def orbit(camera: Camera, dx: float, dy: float, viewport: Viewport) -> Camera:
    """Turn about the face: half a turn per height of the viewport."""
    turn = pi / max(viewport.height, 1)
    return camera.orbited(-dx * turn, dy * turn)


def pan(camera: Camera, dx: float, dy: float, viewport: Viewport) -> Camera:
    """Shift the view with the mouse."""
    return camera.panned(dx, dy, viewport)


def dolly(camera: Camera, dx: float, dy: float, viewport: Viewport) -> Camera:
    """Come closer when the mouse goes right or up."""
    return camera.zoomed(1.006 ** (dx - dy))


MOTIONS: dict[tuple[Button, Modifiers], Motion] = {
    # Maya
    ("left", Modifiers(alt=True)): orbit,
    ("middle", Modifiers(alt=True)): pan,
    ("right", Modifiers(alt=True)): dolly,
    # Blender
    ("middle", Modifiers()): orbit,
    ("middle", Modifiers(shift=True)): pan,
    ("middle", Modifiers(control=True)): dolly,
    # Whoever has neither habit: drag beside the face to turn it, right button to shift it.
    ("left", Modifiers()): orbit,
    ("right", Modifiers()): pan,
}
"""What a drag with a button does when no pin and no skin is under the mouse (with Alt: wherever it is)."""

WHEEL = 1.12
"""Enlargement per step of the wheel."""


@dataclass
class Navigator:
    """Holds the motion from press to release."""

    _motion: Motion | None = None
    _button: Button = "left"
    _at: tuple[float, float] = (0.0, 0.0)
    _viewport: Viewport = field(default_factory=lambda: Viewport(0, 0, 1, 1))

    @property
    def holding(self) -> bool:
        """Whether a camera drag is going on: it then gets all pointer events until the release."""
        return self._motion is not None

    def handle(self, event: Event, camera: Camera, viewport: Viewport) -> Camera:
        """Take one event in a viewport; return the camera after it (the same object when nothing moved)."""
        match event:
            case PointerPressed(x, y, button, modifiers) if self._motion is None:
                self._motion = MOTIONS.get((button, modifiers))
                self._button, self._at, self._viewport = button, (x, y), viewport
            case PointerMoved(x, y) if self._motion is not None:
                dx, dy = x - self._at[0], y - self._at[1]
                self._at = (x, y)
                return self._motion(camera, dx, dy, self._viewport)
            case PointerReleased(button=button) if button == self._button:
                self._motion = None
            case Scrolled(x, y, steps):
                return camera.zoomed(WHEEL**steps, (x, y), viewport)
        return camera
