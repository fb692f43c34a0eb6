"""The drag tool: turns presses, moves and releases on the mesh into edits of the pins."""

from dataclasses import dataclass, field, replace
from math import hypot

import numpy as np

from facepin.core.arrays import Indices, Points
from facepin.core.camera import Camera, Viewport
from facepin.core.events import Event, KeyPressed, PointerMoved, PointerPressed, PointerReleased
from facepin.core.picking import pick
from facepin.core.pose import Freedom, Pin, Pose, as_vector
from facepin.core.rig import Rig
from facepin.session.edit import Edit

GRAB_RADIUS = 9.0
"""How near to a pin's marker a press takes the pin, in pixels at 1x scale."""
DEAD_ZONE = 3.0
"""How far the mouse moves before a click becomes a drag, in pixels at 1x scale."""
HIDDEN_DEPTH = 0.15
"""How far behind the skin a pin can be and still be pressed, as a share of the face height."""


@dataclass(frozen=True, eq=False)
class Sight:
    """What the tool needs to know of the pane under the mouse: what is seen there and how."""

    rig: Rig
    triangles: Indices
    """(t, 3) those that are drawn: what is not seen can't be pressed."""
    pose: Pose
    """As it is at the last undo step when a gesture begins, as it is shown while one goes on."""
    positions: Points
    """(n, 3) as drawn."""
    camera: Camera
    viewport: Viewport
    scale: float = 1.0
    """Framebuffer pixels per pixel of a 1x screen."""
    freedom: Freedom = "space"
    """What new pins constrain."""


@dataclass(frozen=True)
class _Hold:
    """A pin in the user's hand."""

    vertex: int
    pins: tuple[Pin, ...]
    """All pins as they were when the gesture began, the held one among them."""
    placed: bool
    """The press made this pin."""
    pressed: tuple[float, float]
    sight: Sight
    moved: bool = False


@dataclass
class DragTool:
    """Holds what lasts from press to release, and which pins are selected or under the mouse."""

    selected: frozenset[int] = frozenset()
    """Vertices of the selected pins."""
    hovered: int | None = None
    """Vertex of the pin under the mouse."""
    _hold: _Hold | None = field(default=None)

    @property
    def holding(self) -> bool:
        """Whether a gesture is going on: it then gets all pointer events until the release."""
        return self._hold is not None

    @property
    def held(self) -> int | None:
        """Vertex of the pin in the hand."""
        return self._hold.vertex if self._hold else None

    def handle(self, event: Event, sight: Sight) -> Edit | None:
        """Take one event; return what it changes, or None.

        A press on nothing takes no hold, so that the caller can give it to the camera.  Esc ends a gesture;
        the caller then cancels the session's.
        """
        match event:
            case PointerPressed(button="left") if self._hold is None:
                return self._press(event, sight)
            case PointerMoved() if self._hold is not None:
                return self._move(self._hold, (event.x, event.y))
            case PointerMoved():
                self.hovered = pin_at(sight, (event.x, event.y))
            case PointerReleased(button="left") if self._hold is not None:
                return self._release(self._hold, (event.x, event.y))
            case KeyPressed(key="escape"):
                self._hold = None
        return None

    def _press(self, event: PointerPressed, sight: Sight) -> Edit | None:
        pixel = (event.x, event.y)
        vertex = pin_at(sight, pixel)
        if vertex is not None:
            self._take(_Hold(vertex, sight.pose.pins, False, pixel, sight), event)
            return None
        hit = pick(sight.positions, sight.triangles, sight.camera, sight.viewport, pixel)
        if hit is None:
            self.selected = frozenset()
            return None
        if any(pin.vertex == hit.vertex for pin in sight.pose.pins):
            self._take(_Hold(hit.vertex, sight.pose.pins, False, pixel, sight), event)
            return None
        goal = as_vector(sight.positions[hit.vertex].astype(np.float64))
        right, up, _ = sight.camera.axes
        pin = Pin(hit.vertex, goal, sight.freedom, (as_vector(right), as_vector(up)))
        pins = (*sight.pose.pins, pin)
        self._take(_Hold(hit.vertex, pins, True, pixel, sight), event)
        return Edit("Place pin", False, pins)

    def _take(self, hold: _Hold, event: PointerPressed) -> None:
        self._hold = hold
        if event.modifiers.shift:
            self.selected = self.selected ^ {hold.vertex}
        else:
            self.selected = frozenset({hold.vertex})

    def _move(self, hold: _Hold, pixel: tuple[float, float]) -> Edit | None:
        if not hold.moved:
            if hypot(pixel[0] - hold.pressed[0], pixel[1] - hold.pressed[1]) < DEAD_ZONE * hold.sight.scale:
                return None
            self._hold = replace(hold, moved=True)
        return self._dragged(hold, pixel, final=False)

    def _release(self, hold: _Hold, pixel: tuple[float, float]) -> Edit | None:
        self._hold = None
        if hold.moved:
            return self._dragged(hold, pixel, final=True)
        return Edit("Place pin", True, hold.pins) if hold.placed else None

    def _dragged(self, hold: _Hold, pixel: tuple[float, float], *, final: bool) -> Edit:
        """Move the held goal as far in the plane that faces the camera as the mouse went since the press."""
        sight = hold.sight
        (pin,) = (pin for pin in hold.pins if pin.vertex == hold.vertex)
        start = np.array(pin.goal)
        here = sight.camera.plane_point(pixel, start, sight.viewport)
        there = sight.camera.plane_point(hold.pressed, start, sight.viewport)
        right, up, _ = sight.camera.axes
        moved = replace(pin, goal=as_vector(start + here - there), axes=(as_vector(right), as_vector(up)))
        pins = tuple(moved if pin.vertex == hold.vertex else pin for pin in hold.pins)
        return Edit("Drag pin", final, pins, solve=True)


def pin_at(sight: Sight, pixel: tuple[float, float]) -> int | None:
    """Return the vertex of the pin whose marker lies under a pixel (the nearest one), or None."""
    pins = sight.pose.pins
    if not pins or not sight.viewport.contains(*pixel):
        return None
    at = np.concatenate([sight.positions[[pin.vertex for pin in pins]], [pin.goal for pin in pins]])
    x, y, depth = sight.camera.project(at, sight.viewport).T
    gaps = np.hypot(x - pixel[0], y - pixel[1])
    gaps = np.where(np.isfinite(gaps), gaps, np.inf)
    nearest = int(np.argmin(gaps))
    if gaps[nearest] > GRAB_RADIUS * sight.scale:
        return None
    # A pin on the far side of the head is seen dimly, and must not be in the way of the skin before it.
    hit = pick(sight.positions, sight.triangles, sight.camera, sight.viewport, pixel)
    behind = hit is not None and depth[nearest] > hit.distance + HIDDEN_DEPTH * sight.rig.height
    return None if behind else pins[nearest % len(pins)].vertex
