"""The gesture of a rubber band drawn round pins to select them."""

from dataclasses import dataclass

import numpy as np

from facepin.session.edit import Edit
from facepin.session.hand.sight import Pixel, Sight, pin_at


@dataclass
class Box:
    """A rubber band from one corner to the other; see `Gesture`."""

    pressed: Pixel
    sight: Sight
    before: frozenset[int]
    """What was selected."""
    adds: bool
    """Whether that stays so."""
    clicked: frozenset[int]
    """What is selected after a mere click on nothing."""
    selected: frozenset[int]
    corner: Pixel
    """Where the mouse is."""
    remark: str = ""

    @property
    def drawn(self) -> bool:
        """Whether it is a box by now, and not a click."""
        return self.sight.apart(self.pressed, self.corner)

    def move(self, pixel: Pixel) -> Edit | None:
        """Select what is inside."""
        self.corner = pixel
        if self.drawn:
            kept: frozenset[int] = self.before if self.adds else frozenset()
            self.selected = kept | self._inside()
        return None

    def release(self, pixel: Pixel) -> Edit | None:
        """Select what is inside; a mere click adds the pin under it, or takes it out."""
        self.move(pixel)
        if not self.drawn:
            vertex = pin_at(self.sight, self.pressed)
            self.selected = self.clicked if vertex is None else self.before ^ {vertex}
        return None

    def _inside(self) -> frozenset[int]:
        pins = self.sight.shown_pins
        vertices = np.array([pin.vertex for pin in pins], np.intp)
        x, y, _ = self.sight.camera.project(self.sight.positions[vertices], self.sight.viewport).T
        (left, right), (top, bottom) = (sorted(pair) for pair in zip(self.pressed, self.corner, strict=True))
        # What is behind the eye has no pixel, and NaN is in no box.
        return frozenset(vertices[(left <= x) & (x <= right) & (top <= y) & (y <= bottom)].tolist())


def span(pressed: Pixel, sight: Sight, selected: frozenset[int], *, adds: bool, keeps: bool = True) -> Box:
    """Begin a rubber band.

    Parameters
    ----------
    pressed : (x, y)
        Its first corner.
    sight : Sight
        As it was seen at the press.
    selected : set of int
        Vertices of the pins selected so far.
    adds : bool
        Add what is inside to them, instead of selecting it alone.
    keeps : bool
        Keep them after a mere click on nothing.
    """
    return Box(pressed, sight, selected, adds, selected if keeps else frozenset(), selected, pressed)
