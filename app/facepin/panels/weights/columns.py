"""Where things stand in the list of the weights panel, and what of them a point is on."""

from dataclasses import dataclass
from functools import cached_property
from math import floor
from typing import Literal

Zone = Literal["name", "solo", "mute", "lock", "slider", "number"]

ROW = 24.0
"""Height of a row at 1x scale."""
ICON = 17.0
"""Width of an icon's place."""
NUMBER = 40.0
"""Width of a number with what is left free before it."""
GAP = 8.0
INSET = 7.0
"""What names are indented by."""
ICONS: tuple[Zone, ...] = ("solo", "mute", "lock")


@dataclass(frozen=True)
class Columns:
    """Lengths and places in imgui units; y counts from the top of the list, which may be scrolled away."""

    left: float
    right: float
    top: float
    names: float
    """Width of names with their icons."""
    scale: float

    @staticmethod
    def fitted(left: float, right: float, top: float, widest: float, scale: float) -> "Columns":
        """Return columns in which names have what the widest needs and icons too, but sliders have enough."""
        room = right - left - (INSET + GAP + NUMBER) * scale
        wanted = max(widest + ICON * scale, (len(ICONS) + 2) * ICON * scale)
        return Columns(left, right, top, min(wanted, 0.56 * room), scale)

    @cached_property
    def row(self) -> float:
        """Height of a row."""
        return ROW * self.scale

    @cached_property
    def name(self) -> float:
        """Where names begin."""
        return self.left + INSET * self.scale

    @cached_property
    def slider(self) -> tuple[float, float]:
        """Where sliders begin and end."""
        return self.name + self.names + GAP * self.scale, self.right - NUMBER * self.scale

    def icon(self, place: int) -> float:
        """Return the middle of an icon's place, counted from the left of three."""
        return self.name + self.names - (len(ICONS) - place - 0.5) * ICON * self.scale

    def y(self, line: int) -> float:
        """Return the top of a line."""
        return self.top + line * self.row

    def line(self, y: float) -> int:
        """Return the number of the line at y; there may be none of that number."""
        return floor((y - self.top) / self.row)

    def zone(self, x: float) -> Zone:
        """Return what of a row is at x."""
        begin, end = self.slider
        if x >= end:
            return "number"
        if x >= begin - 0.5 * GAP * self.scale:
            return "slider"
        place = floor((x - self.icon(0)) / (ICON * self.scale) + 0.5)
        return ICONS[min(place, len(ICONS) - 1)] if place >= 0 else "name"

    def value(self, x: float, span: tuple[float, float]) -> float:
        """Return the weight that a slider with a span has at x, also beside it."""
        begin, end = self.slider
        return span[0] + (span[1] - span[0]) * (x - begin) / max(end - begin, 1.0)

    def x(self, value: float, span: tuple[float, float]) -> float:
        """Return where on a slider a weight is, within the slider."""
        begin, end = self.slider
        share = (value - span[0]) / (span[1] - span[0]) if span[1] > span[0] else 0.0
        return begin + (end - begin) * min(max(share, 0.0), 1.0)
