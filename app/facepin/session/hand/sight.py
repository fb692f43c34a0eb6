"""What a pane shows, as far as the hand in it is concerned: what lies under a pixel."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import hypot

import numpy as np

from facepin.core.arrays import Indices, Points
from facepin.core.look.camera import Camera, Viewport
from facepin.core.mesh.picking import Hit, Presence, pick
from facepin.core.pose import Freedom, Pin, Pose, as_vector
from facepin.core.rig import Rig
from facepin.core.shapes.mirror import Mirror
from facepin.core.shapes.places import Places, find_places, titles

Pixel = tuple[float, float]

GRAB_RADIUS = 9.0
"""How near to a pin's marker a press takes the pin, in pixels at 1x scale."""
DEAD_ZONE = 3.0
"""How far the mouse moves before a click becomes a drag, in pixels at 1x scale."""
HIDDEN_DEPTH = 0.15
"""How far behind the skin a pin can be and still be pressed, as a share of the face height."""


@dataclass(frozen=True, eq=False)
class Sight:
    """What the tool needs to know of a pane: what is seen there and how."""

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
    stroke: int | None = None
    """How many pins are laid along a stroke; None where a press on the skin places a single pin."""
    beside: bool = False
    """Whether a drag beside the face selects with a rubber band; else it is left to the camera."""
    mirror: Mirror | None = None
    """Left and right of the rig, where twins of pins move along."""

    steady: bool = False
    """Whether the goal is to stay where the hand but trembles."""
    find_places: Callable[[Rig], Places] = find_places
    """Names the places of the rig; whoever has them already gives them."""
    present: Presence | None = None
    """Tells where triangles are there to be pressed; None for everywhere."""

    @cached_property
    def places(self) -> Places:
        """What the places of the face are called."""
        return self.find_places(self.rig)

    def title(self, pin: Pin) -> str:
        """Return what a pin is called among all."""
        pins = self.pose.pins
        return titles(self.places, pins if pin in pins else (*pins, pin))[pin.vertex]

    @property
    def shown_pins(self) -> tuple[Pin, ...]:
        """The pins that are seen."""
        return tuple(pin for pin in self.pose.pins if not pin.hidden)

    def hit(self, pixel: Pixel) -> Hit | None:
        """Return where the ray through a pixel meets the face."""
        return pick(self.positions, self.triangles, self.camera, self.viewport, pixel, present=self.present)

    def apart(self, pixel: Pixel, other: Pixel) -> bool:
        """Say whether two pixels are further apart than a click lets the hand move."""
        return hypot(pixel[0] - other[0], pixel[1] - other[1]) >= DEAD_ZONE * self.scale

    def new_pin(self, vertex: int) -> Pin:
        """Return a pin that holds a vertex where it is seen."""
        right, up, _ = self.camera.axes
        goal = as_vector(self.positions[vertex].astype(np.float64))
        return Pin(vertex, goal, self.freedom, (as_vector(right), as_vector(up)))


def pin_at(sight: Sight, pixel: Pixel) -> int | None:
    """Return the vertex of the pin whose marker lies under a pixel (the nearest one), or None."""
    pins = sight.shown_pins
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
    hit = sight.hit(pixel)
    behind = hit is not None and depth[nearest] > hit.distance + HIDDEN_DEPTH * sight.rig.height
    return None if behind else pins[nearest % len(pins)].vertex
