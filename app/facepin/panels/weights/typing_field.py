"""The field that a slider turns into while a number is typed."""

from collections.abc import Sequence

from imgui_bundle import imgui

from facepin.panels.number_field import number_field
from facepin.panels.requests import CancelEdit, Refused
from facepin.panels.weights.listing import Line
from facepin.panels.weights.painter import Painter
from facepin.panels.weights.view import WeightsView
from facepin.session.edit import Edit

DIGITS = 4
"""Of a weight, as it is shown to be typed over."""


def typing_field(
    painter: Painter, lines: Sequence[Line], view: WeightsView
) -> Edit | CancelEdit | Refused | None:
    """Draw the field over the slider of a shape that is being typed, if any; return what it changes."""
    gesture = view.gesture
    if gesture is None or gesture.hand != "typing":
        return None
    if gesture.shape not in lines:  # searched or folded away
        view.gesture = None
        return CancelEdit()
    columns = painter.columns
    begin, _ = columns.slider
    y = columns.y(lines.index(gesture.shape)) + (columns.row - imgui.get_frame_height()) / 2
    imgui.set_cursor_screen_pos(imgui.ImVec2(begin, y))
    imgui.set_next_item_width(columns.right - begin)
    if gesture.began == imgui.get_time():
        imgui.set_keyboard_focus_here()
    typed = number_field("##typed", gesture.reach, DIGITS)
    if imgui.is_key_pressed(imgui.Key.escape):
        view.gesture = None
        return CancelEdit()
    if not imgui.is_item_deactivated():
        return None
    view.gesture = None
    if isinstance(typed, Refused):
        return typed
    if typed is not None:
        gesture.reach = typed
    return gesture.edit(painter.rig, painter.control, final=True)
