"""Draws the lines of the weights panel: straight into the draw list, with no item of imgui for any row."""

from collections.abc import Sequence
from dataclasses import dataclass

from imgui_bundle import imgui

from facepin.core.arrays import Floats
from facepin.core.control import ShapeControl
from facepin.core.rig import Rig
from facepin.panels.icons import padlock
from facepin.panels.theme import Colour, Theme, packed
from facepin.panels.weights import icons
from facepin.panels.weights.columns import ICONS, Columns, Zone
from facepin.panels.weights.listing import Group
from facepin.panels.weights.text import Elider

VISIBLE = 0.005
"""A weight further from zero than this is emphasised: its number shows it."""
ImVec2 = imgui.ImVec2


@dataclass(frozen=True)
class Inks:
    """Colours as draw lists want them."""

    text: int
    dim: int
    faint: int
    trough: int
    beyond: int
    """Part of a slider beyond the limits."""
    mark: int
    row: int
    """Behind the row that the keyboard has."""
    warning: tuple[int, int]
    silent: tuple[int, int]
    panes: tuple[tuple[int, int], ...]
    """For bars: along, and at their end."""


def inks(theme: Theme, colours: Sequence[Colour]) -> Inks:
    """Return the colours of a frame; `colours` are the panes'."""
    along = 0.4 if len(colours) == 1 else 0.55
    return Inks(
        packed(theme.text),
        packed(theme.text_dim),
        packed(theme.text_dim, 0.5),
        packed(theme.frame),
        packed(theme.panel, 0.6),
        packed(theme.accent),
        packed(theme.frame_hovered, 0.45),
        (packed(theme.warning, 0.4), packed(theme.warning)),
        (packed(theme.text_dim, 0.25), packed(theme.text_dim)),
        tuple((packed(colour, along), packed(colour)) for colour in colours),
    )


@dataclass(frozen=True, eq=False)
class Painter:
    """What all lines of a frame have in common."""

    draw: imgui.ImDrawList
    inks: Inks
    columns: Columns
    elider: Elider
    rig: Rig
    control: ShapeControl
    limits: Floats
    """(k, 2) as they hold in the pose of the active pane."""
    weights: Sequence[Floats]
    """(k,) of each pane."""
    active: int
    marked: frozenset[int]

    def span(self, j: int) -> tuple[float, float]:
        """Return the weights from end to end of a slider: what the file and the user allow, and what is."""
        (low, high), (least, most) = self.rig.limits[j].tolist(), self.control.limits[j].tolist()
        low, high = min(low, least), max(high, most)
        values = [float(weights[j]) for weights in self.weights]
        smallest, largest = min(values), max(values)
        # What nobody can see does not open the range up.
        return (
            smallest if smallest < low - VISIBLE else low,
            largest if largest > high + VISIBLE else high,
        )

    def row(self, top: float, j: int, span: tuple[float, float], zone: Zone | None, *, focused: bool) -> None:
        """Draw a shape's name, slider and number.

        Parameters
        ----------
        top : float
            Where the row begins.
        j : int
            The shape.
        span : (float, float)
            Weights at the ends of the slider.
        zone : Zone
            What of the row is under the mouse, if anything.
        focused : bool
            Whether the keyboard moves it.
        """
        inks, at, draw = self.inks, self.columns, self.draw
        silent, locked = bool(self.control.silent[j]), bool(self.control.locked[j])
        weight = float(self.weights[self.active][j])
        visible = abs(weight) > VISIBLE
        if focused:
            draw.add_rect_filled(ImVec2(at.left, top), ImVec2(at.right, top + at.row), inks.row, 3 * at.scale)
        middle = top + at.row / 2
        text_y = middle - imgui.get_font_size() / 2
        room = at.names - self._flags(middle, j, zone)
        name = self.elider.fitted(self.rig.shape_names[j], room)
        ink = inks.dim if silent or not visible else inks.text
        if j in self.marked:
            ink = inks.mark
            draw.add_rect_filled(
                ImVec2(at.left, middle - 3 * at.scale),
                ImVec2(at.left + 3 * at.scale, middle + 3 * at.scale),
                ink,
            )
        draw.add_text(ImVec2(at.name, text_y), ink, name)
        self._slider(top, j, span, silent=silent or locked)
        number = f"{weight:.2f}" if visible else "0.00"
        x = at.right - self.elider.width(number)
        draw.add_text(ImVec2(x, text_y), inks.text if visible and not silent else inks.dim, number)

    def _flags(self, middle: float, j: int, zone: Zone | None) -> float:
        """Draw the icons that are set, and all of them under the mouse; return how wide they are."""
        flags = (self.control.solo[j], self.control.muted[j], self.control.locked[j])
        hovered = zone is not None and zone not in ("slider", "number")
        if not hovered and not any(flags):
            return 0.0
        first = len(ICONS)
        for place, (name, is_set) in enumerate(zip(ICONS, flags, strict=True)):
            if is_set or hovered:
                ink = self.inks.text if name == zone else self.inks.mark if is_set else self.inks.faint
                icon = (icons.solo, icons.mute, padlock)[place]
                icon(self.draw, self.columns.icon(place), middle, 6 * self.columns.scale, ink)
                first = min(first, place)
        return self.columns.name + self.columns.names - self.columns.icon(first) + 11 * self.columns.scale

    def _slider(self, top: float, j: int, span: tuple[float, float], *, silent: bool) -> None:
        """Draw the trough, in it what is beyond the limits, and a bar from zero to each pane's weight."""
        at, draw, inks = self.columns, self.draw, self.inks
        inset = 3.5 * at.scale
        above, below = top + inset, top + at.row - inset
        begin, end = at.slider
        draw.add_rect_filled(ImVec2(begin, above), ImVec2(end, below), inks.trough, 3 * at.scale)
        low, high = self.limits[j].tolist()
        if low > span[0] + VISIBLE:
            self._limit(begin, at.x(low, span), above, below, at.x(low, span))
        if high < span[1] - VISIBLE:
            self._limit(at.x(high, span), end, above, below, at.x(high, span))
        zero = at.x(0.0, span)
        step = (below - above) / len(self.weights)
        for number, weights in enumerate(self.weights):
            value = float(weights[j])
            if abs(value) <= VISIBLE:
                continue
            outside = not low - VISIBLE <= value <= high + VISIBLE
            along, tip = inks.panes[number]
            if silent:
                along, tip = inks.silent
            elif outside and len(self.weights) == 1:
                along, tip = inks.warning
            x = at.x(value, span)
            upper, lower = above + number * step, above + (number + 1) * step
            draw.add_rect_filled(
                ImVec2(min(zero, x), upper), ImVec2(max(zero, x), lower), along, 2 * at.scale
            )
            draw.add_rect_filled(ImVec2(x - at.scale, upper), ImVec2(x + at.scale, lower), tip)
        if span[0] < -VISIBLE:
            draw.add_rect_filled(
                ImVec2(zero - 0.5 * at.scale, above), ImVec2(zero + 0.5 * at.scale, below), inks.faint
            )

    def _limit(self, begin: float, end: float, above: float, below: float, mark: float) -> None:
        half = 0.75 * self.columns.scale
        self.draw.add_rect_filled(
            ImVec2(begin, above), ImVec2(end, below), self.inks.beyond, 3 * self.columns.scale
        )
        self.draw.add_rect_filled(ImVec2(mark - half, above), ImVec2(mark + half, below), self.inks.dim)

    def header(self, top: float, group: Group, active: int, zone: Zone | None, *, folded: bool) -> None:
        """Draw the header of a group, with how many of its shapes are active."""
        inks, at = self.inks, self.columns
        middle = top + at.row / 2
        text_y = middle - imgui.get_font_size() / 2
        marked = bool(self.marked) and not self.marked.isdisjoint(group.shapes.tolist())
        ink = inks.mark if marked else inks.dim
        icons.fold(self.draw, at.left + 4 * at.scale, middle, 6 * at.scale, ink, folded=folded)
        self.draw.add_text(
            ImVec2(at.left + 14 * at.scale, text_y),
            inks.text if active else inks.dim,
            group.name.capitalize(),
        )
        count = f"{active} / {len(group.shapes)}"
        self.draw.add_text(
            ImVec2(at.right - self.elider.width(count), text_y), inks.text if active else inks.dim, count
        )
        begin, end = at.slider
        self.draw.add_rect_filled(
            ImVec2(begin, middle - 0.5 * at.scale),
            ImVec2(end - 8 * at.scale, middle + 0.5 * at.scale),
            inks.trough,
        )
        for place, name in enumerate(ICONS):
            share = self._share(group, name)
            if share or zone is not None:
                ink = inks.text if name == zone else inks.mark if share == 1 else inks.faint
                icon = (icons.reset, icons.mute, padlock)[place]
                icon(self.draw, at.icon(place), middle, 6 * at.scale, ink)

    def _share(self, group: Group, icon: Zone) -> float:
        """Return how many of a group are muted or locked, 0..1."""
        if icon == "solo":
            return 0.0
        flags = self.control.muted if icon == "mute" else self.control.locked
        return float(flags[group.shapes].mean())
