"""What of the list of the weights panel the mouse is on."""

from collections.abc import Sequence
from dataclasses import dataclass

from imgui_bundle import imgui

from facepin.panels.weights.columns import Columns, Zone
from facepin.panels.weights.listing import Line


@dataclass(frozen=True, eq=False)
class Place:
    """A zone of a line."""

    number: int
    """Of the line in the list, -1 for nowhere."""
    line: Line | None
    zone: Zone


NOWHERE = Place(-1, None, "name")


def place_of_mouse(columns: Columns, lines: Sequence[Line]) -> Place:
    """Return what the mouse is on."""
    mouse = imgui.get_mouse_pos()
    number = columns.line(mouse.y)
    return Place(number, lines[number], columns.zone(mouse.x)) if 0 <= number < len(lines) else NOWHERE
