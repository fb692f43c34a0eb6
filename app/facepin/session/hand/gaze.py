"""The hand on the handle of the eyes."""

from dataclasses import dataclass, replace
from math import hypot, isfinite

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.control import ShapeControl
from facepin.core.look.camera import Camera, Viewport
from facepin.core.names import listed
from facepin.core.shapes.gaze import Gaze, aimed
from facepin.session.edit import Edit
from facepin.session.hand.sight import Pixel, Sight

GRAB_RADIUS = 12.0
"""How near to the handle a press takes it, in pixels at 1x scale."""
BEHIND = -0.2
"""Cosine between the gaze and the way to the camera below which the head hides the handle."""


@dataclass
class GazeHold:
    """A drag of the handle: the eyes look where it is.

    The handle moves on a ball around the middle of the eyes, so that it stays under the mouse in every view.
    Its distance means nothing: both eyes look in one direction.
    """

    gaze: Gaze
    control: ShapeControl
    sight: Sight
    """As it was at the press."""
    pressed: Pixel
    selected: frozenset[int]
    """The selected pins, which stay so."""
    remark: str = ""
    _begun: bool = False
    _turned: bool = False
    """The eyes have moved: they may have to go back to where they were."""

    @property
    def vertices(self) -> frozenset[int]:
        """No pin is in the hand."""
        return frozenset()

    def move(self, pixel: Pixel) -> Edit | None:
        """Return the weights with which the eyes look where the handle is now."""
        self._begun = self._begun or self.sight.apart(self.pressed, pixel)
        return self._edit(pixel, final=False) if self._begun else None

    def release(self, pixel: Pixel) -> Edit | None:
        """Return the same as one undo step; nothing after a mere click."""
        return self._edit(pixel, final=True) if self._begun else None

    def _edit(self, pixel: Pixel, *, final: bool) -> Edit | None:
        weights = self.sight.pose.weights
        yaw, pitch = self.gaze.angles_to(self._place(pixel))
        looking = aimed(self.gaze, weights, yaw, pitch, self.control)
        unlocked = replace(self.control, locked=np.zeros(len(weights), np.bool_))
        held = np.flatnonzero(
            self.control.breaks_lock(aimed(self.gaze, weights, yaw, pitch, unlocked), weights)
        )
        if len(held):
            names = listed([self.sight.rig.shape_names[j] for j in held])
            self.remark = f"Locked, and stays as it is: {names}"
        if np.array_equal(looking, weights) and not self._turned:
            return None
        self._turned = True
        return Edit("Move the gaze", final, weights=looking)

    def _place(self, pixel: Pixel) -> Floats:
        """Return the point (3,) of the handle's ball that is under the mouse, or nearest to it."""
        start = self.gaze.handle(self.sight.pose.weights)
        x, y, _ = self.sight.camera.project(start, self.sight.viewport)[0].tolist()
        at = (x + pixel[0] - self.pressed[0], y + pixel[1] - self.pressed[1])
        origin, direction = self.sight.camera.ray(at, self.sight.viewport)
        middle, radius = self.gaze.middle, self.gaze.reach
        nearest = origin + ((middle - origin) @ direction) * direction
        gap = float(np.linalg.norm(nearest - middle))
        if gap >= radius:
            return middle + (nearest - middle) * (radius / gap)
        depth = (radius**2 - gap**2) ** 0.5
        front, back = nearest - depth * direction, nearest + depth * direction
        # In a side view the handle may be on the half of the ball that is turned away.
        closer: Floats = min(front, back, key=lambda point: float(np.linalg.norm(point - start)))
        return closer


def handle_pixel(gaze: Gaze, weights: Floats, camera: Camera, viewport: Viewport) -> Pixel | None:
    """Return where the handle is seen in a pose (k,), or None where the head is before it."""
    point = gaze.handle(weights)
    if (point - gaze.middle) @ camera.axes[2] < BEHIND * gaze.reach:
        return None
    x, y, _ = camera.project(point, viewport)[0].tolist()
    return (x, y) if isfinite(x) else None


def is_on_handle(gaze: Gaze, sight: Sight, pixel: Pixel) -> bool:
    """Say whether a press at a pixel takes the handle."""
    at = handle_pixel(gaze, sight.pose.weights, sight.camera, sight.viewport)
    return at is not None and hypot(at[0] - pixel[0], at[1] - pixel[1]) <= GRAB_RADIUS * sight.scale


def straightened(gaze: Gaze, weights: Floats, control: ShapeControl) -> Edit:
    """Return the edit that lets both eyes look straight ahead."""
    return Edit("Look straight ahead", True, weights=aimed(gaze, weights, 0.0, 0.0, control))
