"""The way of the mouse during a drag, as the goal is to follow it: steadied, finer, or along a line."""

from dataclasses import dataclass
from math import hypot
from typing import Literal

from facepin.session.hand.sight import Pixel

Axis = Literal["x", "y"]
"""Across the picture, or up and down in it."""

FINE = 0.2
"""How fast the goal follows while Shift is held."""
SLACK = 1.0
"""How far the mouse trembles without the goal moving, in pixels at 1x scale: as far as the goal then lags."""


@dataclass
class Course:
    """Where the goal has been led to since the press."""

    pressed: Pixel
    slack: float = 0.0
    """In pixels: as on a string of that length, the goal is drawn along once the string is tight."""
    coarse: bool = False
    """Shift is down since the press, where it selects: it makes nothing finer before it was let go."""
    axis: Axis | None = None
    """The line through the press that the goal is kept on."""

    def __post_init__(self) -> None:
        self._drawn = self._at = self.pressed
        self._fine = False

    def lead(self, mouse: Pixel, *, fine: bool | None = None) -> Pixel:
        """Take where the mouse is now; return where the goal goes.

        `fine` says whether Shift is held, None that it is as before; to change it alone moves nothing.
        """
        if fine is not None:
            self.coarse = self.coarse and fine
            self._fine = fine and not self.coarse
        dx, dy = mouse[0] - self._drawn[0], mouse[1] - self._drawn[1]
        away = hypot(dx, dy)
        if away > self.slack:
            share = 1 - self.slack / away
            dx, dy = share * dx, share * dy
            speed = FINE if self._fine else 1.0
            self._drawn = self._drawn[0] + dx, self._drawn[1] + dy
            self._at = self._at[0] + speed * dx, self._at[1] + speed * dy
        return self.pixel

    @property
    def pixel(self) -> Pixel:
        """Where the goal goes."""
        match self.axis:
            case "x":
                return self._at[0], self.pressed[1]
            case "y":
                return self.pressed[0], self._at[1]
        return self._at
