"""Moving a slider in small steps: by the wheel, and by the arrow keys, which also walk along the list."""

from collections.abc import Sequence

from imgui_bundle import imgui

from facepin.core.arrays import Floats
from facepin.panels.weights.gesture import LEAP, STEP, Gesture, Wish, begun
from facepin.panels.weights.listing import Line
from facepin.panels.weights.painter import Painter
from facepin.panels.weights.place import Place
from facepin.panels.weights.view import WeightsView


def wheel(painter: Painter, place: Place, weights: Floats, view: WeightsView) -> Wish:
    """Turn the slider under the mouse by the wheel with Ctrl or Alt; alone, the wheel scrolls the list."""
    io, gesture = imgui.get_io(), view.gesture
    if gesture is not None and gesture.hand != "wheel":
        return None
    j = place.line
    if not isinstance(j, int) or place.zone not in ("slider", "number") or not (io.key_ctrl or io.key_alt):
        return None
    imgui.set_item_key_owner(imgui.Key.mouse_wheel_y)
    if not io.mouse_wheel:
        return None
    view.gesture = gesture or begun("wheel", j, weights, painter.span(j))
    return _step(painter, view.gesture, io.mouse_wheel * (LEAP if io.key_shift else STEP))


def keys(painter: Painter, lines: Sequence[Line], weights: Floats, view: WeightsView) -> Wish:
    """Walk along the list with up and down, move the slider of the row with left and right."""
    gesture = view.gesture
    if gesture is not None and gesture.hand != "keys":
        return None
    if not imgui.is_window_focused() or imgui.get_io().want_text_input or view.focus is None:
        return None
    imgui.set_next_frame_want_capture_keyboard(True)
    pressed = imgui.is_key_pressed
    down = int(pressed(imgui.Key.down_arrow)) - int(pressed(imgui.Key.up_arrow))
    if down and gesture is None:
        _walk(painter, lines, down, view)
        return None
    right = int(pressed(imgui.Key.right_arrow)) - int(pressed(imgui.Key.left_arrow))
    j = view.focus
    if gesture is None and pressed(imgui.Key.enter, False):
        view.gesture = begun("typing", j, weights, painter.span(j))
        return None
    if not right:
        return None
    view.gesture = gesture or begun("keys", j, weights, painter.span(j))
    return _step(painter, view.gesture, right * (LEAP if imgui.get_io().key_shift else STEP))


def _step(painter: Painter, gesture: Gesture, by: float) -> Wish:
    """Move a slider by a step, as part of a gesture that may have begun with an earlier one."""
    # The next step starts from what the last one led to, not from beyond the limits.
    gesture.reach = gesture.weight(painter.control) + by
    gesture.reach = gesture.weight(painter.control)
    return gesture.edit(painter.rig, painter.control, final=False)


def _walk(painter: Painter, lines: Sequence[Line], down: int, view: WeightsView) -> None:
    """Give the keyboard to the next shape, and scroll there."""
    numbers = [number for number, line in enumerate(lines) if isinstance(line, int)]
    if not numbers:
        return
    at = next((place for place, number in enumerate(numbers) if lines[number] == view.focus), None)
    number = numbers[0 if at is None else min(max(at + down, 0), len(numbers) - 1)]
    line = lines[number]
    assert isinstance(line, int)
    view.focus = line
    row = painter.columns.row
    height, scrolled = imgui.get_window_height(), imgui.get_scroll_y()
    if number * row < scrolled:
        imgui.set_scroll_y(number * row)
    elif (number + 1) * row > scrolled + height:
        imgui.set_scroll_y((number + 1) * row - height)
