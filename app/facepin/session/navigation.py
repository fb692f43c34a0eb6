"""Moving the camera with the mouse: our own habits, those of Maya and those of Blender, as tables."""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import pi
from typing import Literal

from numpy.typing import ArrayLike

from facepin.core.events import (
    Button,
    Event,
    Modifiers,
    PointerMoved,
    PointerPressed,
    PointerReleased,
    Scrolled,
)
from facepin.core.look.camera import Camera, Viewport

Motion = Callable[[Camera, float, float, Viewport], Camera]
"""(camera, dx, dy in pixels, viewport) -> camera."""
Motions = dict[tuple[Button, Modifiers], Motion]
"""What a drag with a button does."""


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


Surface = Callable[[tuple[float, float]], ArrayLike | None]
"""pixel -> point (3,) of the face there, None beside it."""

Habit = Literal["facepin", "maya", "blender"]
"""Whose way of moving the camera the user's hand knows."""


@dataclass(frozen=True)
class Preset:
    """One habit: what it is called, and what a drag with a button does."""

    title: str
    motions: Motions
    """With Alt wherever the mouse is, else where no pin and no skin is under it."""


_ALT: Motions = {
    ("left", Modifiers(alt=True)): orbit,
    ("middle", Modifiers(alt=True)): pan,
    ("right", Modifiers(alt=True)): dolly,
}
_MIDDLE: Motions = {
    ("middle", Modifiers()): orbit,
    ("middle", Modifiers(shift=True)): pan,
    ("middle", Modifiers(control=True)): dolly,
}
_BESIDE: Motions = {
    ("left", Modifiers()): orbit,
    ("right", Modifiers()): pan,
}
_TWO_BUTTONS: Motions = {
    ("left", Modifiers(alt=True)): orbit,
    ("left", Modifiers(shift=True, alt=True)): pan,
    ("left", Modifiers(control=True, alt=True)): dolly,
}

PRESETS: dict[Habit, Preset] = {
    # Drag beside the face to turn it; whoever has one of the other habits finds most of it here too.
    "facepin": Preset("Facepin", {**_BESIDE, **_MIDDLE, **_ALT}),
    # The mouse alone belongs to pins and selection, the camera has Alt.
    "maya": Preset("Maya", _ALT),
    # The middle button, or Alt and the left one for a mouse or tablet that has no middle.
    "blender": Preset("Blender", {**_MIDDLE, **_TWO_BUTTONS}),
}
"""The wheel comes closer in all of them."""

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

    def handle(
        self,
        event: Event,
        camera: Camera,
        viewport: Viewport,
        preset: Preset,
        surface: Surface | None = None,
    ) -> Camera:
        """Take one event in a viewport; return the camera after it (the same object when nothing moved).

        With the `surface` of what is seen, panning follows what is under the mouse, and coming closer ends
        before it.
        """
        match event:
            case PointerPressed(x, y, button, modifiers) if self._motion is None:
                self._motion = preset.motions.get((button, modifiers))
                self._button, self._at, self._viewport = button, (x, y), viewport
                if self._motion is pan:
                    return _focused(camera, (x, y), surface)
                if self._motion is dolly:  # straight ahead
                    middle = viewport.x + viewport.width / 2, viewport.y + viewport.height / 2
                    return _focused(camera, middle, surface)
            case PointerMoved(x, y) if self._motion is not None:
                dx, dy = x - self._at[0], y - self._at[1]
                self._at = (x, y)
                return self._motion(camera, dx, dy, self._viewport)
            case PointerReleased(button=button) if button == self._button:
                self._motion = None
            case Scrolled(x, y, steps):
                return _focused(camera, (x, y), surface).zoomed(WHEEL**steps, (x, y), viewport)
        return camera


def _focused(camera: Camera, pixel: tuple[float, float], surface: Surface | None) -> Camera:
    """Return the camera with its target as deep as what is seen at a pixel."""
    point = None if surface is None else surface(pixel)
    return camera if point is None else camera.focused(point)
