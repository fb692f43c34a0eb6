"""The gesture of the hand that holds pins: a click, or a drag of all that are selected."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from facepin.core.mesh.geodesic import geodesic_distances
from facepin.core.pose import Pin
from facepin.session.edit import Edit
from facepin.session.hand.moving import amount, carried, movable
from facepin.session.hand.sight import Pixel, Sight

WIDEST = 0.5
"""Largest radius of a soft drag, as a share of the face height."""
RADIUS_STEP = 0.02
"""What a step of the wheel makes of it."""


@dataclass
class Hold:
    """Pins in the user's hand; see `Gesture`."""

    pin: Pin
    """The one that was pressed."""
    pins: tuple[Pin, ...]
    """All pins as they were when the gesture began, the pressed one among them."""
    placed: bool
    """The press made it."""
    pressed: Pixel
    sight: Sight
    selected: frozenset[int]
    clicked: frozenset[int]
    """What is selected after a mere click."""
    remark: str = ""
    moved: bool = False
    radius: float = 0.0
    """How far along the skin other pins are carried along, as a share of the face height."""
    vertices: frozenset[int] = field(init=False)
    """Of the pins that move with the mouse: all that are selected, unless the pressed one can't."""

    def __post_init__(self) -> None:
        vertices = movable(self.pins, self.selected)
        self.vertices = vertices if self.pin.vertex in vertices else frozenset()

    @property
    def along(self) -> dict[int, float]:
        """The share of the way, 0..1, that each other pin is carried along, by vertex."""
        if not self.vertices or self.radius <= 0:
            return {}
        shares = {vertex: 1 - (away / self.radius) ** 2 for vertex, away in self._away.items()}
        return {vertex: share * share for vertex, share in shares.items() if share > 0}

    @cached_property
    def _away(self) -> dict[int, float]:
        """How far each other pin is from those in the hand along the skin, as a share of the face height."""
        height = self.sight.rig.height
        others = movable(self.pins, {pin.vertex for pin in self.pins} - self.vertices)
        if self.sight.mirror is not None:  # the other side follows as the twin of this one
            sides = self.sight.places.sides
            others = frozenset(v for v in others if sides[v] * sides[self.pin.vertex] >= 0)
        away = geodesic_distances(self.sight.rig, sorted(self.vertices), WIDEST * height) / height
        return {vertex: float(away[vertex]) for vertex in others}

    def widen(self, steps: float) -> None:
        """Make the radius of what is carried along larger, or smaller, down to none."""
        self.radius = min(max(self.radius + steps * RADIUS_STEP, 0.0), WIDEST)

    def move(self, pixel: Pixel) -> Edit | None:
        """Drag the pins, once the mouse has left the place where a click would be."""
        if not self.moved:
            if not self.sight.apart(pixel, self.pressed):
                return None
            self.moved = True
            self.remark = _refusal(self.pin, self.sight)
        return self._dragged(pixel, final=False)

    def release(self, pixel: Pixel) -> Edit | None:
        """Let go."""
        if self.moved:
            return self._dragged(pixel, final=True)
        self.selected = self.clicked
        return Edit("Place pin", True, self.pins) if self.placed else None

    def _dragged(self, pixel: Pixel, *, final: bool) -> Edit | None:
        """Move the goals as far in the plane that faces the camera as the mouse went since the press."""
        if not self.vertices:
            return None
        camera, viewport = self.sight.camera, self.sight.viewport
        start = np.array(self.pin.goal)
        here = camera.plane_point(pixel, start, viewport)
        there = camera.plane_point(self.pressed, start, viewport)
        pins, along = carried(self.pins, self.vertices, here - there, camera), self.along
        for vertex, share in along.items():
            pins = carried(pins, {vertex}, share * (here - there), camera)
        return Edit(f"Drag {amount(len(self.vertices) + len(along))}", final, pins, solve=True)


def take(vertex: int, pressed: Pixel, sight: Sight, selected: frozenset[int], *, adds: bool) -> Hold:
    """Take the pin on a vertex in the hand; place one where there is none.

    Parameters
    ----------
    vertex : int
        What was pressed.
    pressed : (x, y)
        Where.
    sight : Sight
        As it was seen at the press.
    selected : set of int
        Vertices of the pins selected so far; they stay so if the pressed one is among them.
    adds : bool
        Add the pin to them, or take it out with a mere click (Shift).
    """
    pins = sight.pose.pins
    pin = next((pin for pin in pins if pin.vertex == vertex), None)
    placed = pin is None
    if pin is None:
        pin = sight.new_pin(vertex)
        pins = (*pins, pin)
    one = frozenset({vertex})
    if vertex in selected:
        return Hold(pin, pins, placed, pressed, sight, selected, selected - one if adds else one)
    now = selected | one if adds else one
    if pin.hidden:
        return Hold(pin, pins, placed, pressed, sight, selected, selected, remark=_refusal(pin, sight))
    return Hold(pin, pins, placed, pressed, sight, now, now)


def _refusal(pin: Pin, sight: Sight) -> str:
    """Say why a pin doesn't move; nothing where it does."""
    if pin.hidden:
        return f"A hidden pin holds this point ({sight.title(pin)}): show hidden pins to drag it"
    if pin.locked:
        return f"This pin is locked ({sight.title(pin)}): unlock it to drag it (right click, or L)"
    return ""
