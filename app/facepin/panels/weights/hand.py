"""What mouse and keyboard do in the list of the weights panel."""

from collections.abc import Sequence
from dataclasses import dataclass

from imgui_bundle import imgui

from facepin.core.arrays import Floats
from facepin.panels.requests import CancelEdit, SetControl
from facepin.panels.weights.columns import Zone
from facepin.panels.weights.gesture import FINE, LEAP, STEP, Gesture
from facepin.panels.weights.listing import Group, Line
from facepin.panels.weights.menu import group_reset
from facepin.panels.weights.painter import Painter
from facepin.panels.weights.restraints import toggled
from facepin.panels.weights.view import WeightsView
from facepin.session.edit import Edit
from facepin.session.sliding import slid

Wish = Edit | SetControl | CancelEdit | None

TOOLTIPS: dict[Zone, str] = {
    "solo": "Solo: only this and other solo shapes move the face",
    "mute": "Mute: keeps its weight, but doesn't move the face",
    "lock": "Lock: no solver and no slider changes it",
    "number": "Double click to type",
}


@dataclass(frozen=True)
class Place:
    """What of the list is under the mouse."""

    line: int
    """Its number, -1 for none."""
    zone: Zone


NOWHERE = Place(-1, "name")


def hand(painter: Painter, lines: Sequence[Line], weights: Floats, view: WeightsView) -> tuple[Place, Wish]:
    """Let mouse and keyboard act on the list, which is the last item; return where the mouse is, and a wish.

    Parameters
    ----------
    painter : Painter
        Knows where things are, and what is restrained.
    lines : sequence of Line
        What is listed.
    weights : (k,)
        Of the active pane.
    view : WeightsView
        Changed in place.
    """
    sliding = view.gesture is not None and view.gesture.hand == "mouse"
    place = _place(painter, lines) if imgui.is_item_hovered() and not sliding else NOWHERE
    wish: Wish = None
    if view.gesture is not None:
        wish = _go_on(painter, view.gesture, place, lines, view)
    elif place.line >= 0:
        wish = _press(painter, lines[place.line], place.zone, weights, view)
    if view.gesture is None or view.gesture.hand in ("wheel", "keys"):
        wish = _wheel(painter, lines, place, weights, view) or _keys(painter, lines, weights, view) or wish
    busy = view.gesture is not None or imgui.is_mouse_down(0)
    _rest(painter, lines, NOWHERE if busy else place, view)
    return place, wish


def _place(painter: Painter, lines: Sequence[Line]) -> Place:
    mouse = imgui.get_mouse_pos()
    line = painter.columns.line(mouse.y)
    return Place(line, painter.columns.zone(mouse.x)) if 0 <= line < len(lines) else NOWHERE


def _press(painter: Painter, line: Line, zone: Zone, weights: Floats, view: WeightsView) -> Wish:
    """Take what a press of a button on a line means."""
    if imgui.is_mouse_clicked(1):
        view.menu, view.menu_opens = line, True
        return None
    if not imgui.is_mouse_clicked(0):
        return None
    if isinstance(line, Group):
        return _press_header(painter, line, zone, weights, view)
    view.focus = line
    name = painter.rig.shape_names[line]
    if zone in ("solo", "mute", "lock"):
        return toggled(painter.control, zone, [line], name)
    twice, control_key = imgui.is_mouse_double_clicked(0), imgui.get_io().key_ctrl
    if (zone == "number" and twice) or (zone in ("slider", "number") and control_key):
        view.gesture = Gesture("typing", line, weights, painter.span(line), float(weights[line]))
        return None
    if twice:
        return Edit(f"Reset {name}", True, weights=slid(weights, {line: 0.0})) if weights[line] else None
    if zone == "slider":
        span = painter.span(line)
        reach = painter.columns.value(imgui.get_mouse_pos().x, span)
        view.gesture = Gesture("mouse", line, weights, span, reach)
        return view.gesture.edit(painter.rig, painter.control, final=False)
    return None


def _press_header(painter: Painter, group: Group, zone: Zone, weights: Floats, view: WeightsView) -> Wish:
    if zone in ("mute", "lock"):
        return toggled(painter.control, zone, group.shapes.tolist(), group.name)
    if zone == "solo":  # where rows have it, headers have their reset
        return group_reset(painter.control, weights, group) if weights[group.shapes].any() else None
    view.folded = view.folded ^ {group.name}
    return None


def _go_on(
    painter: Painter, gesture: Gesture, place: Place, lines: Sequence[Line], view: WeightsView
) -> Wish:
    """Follow a gesture that began in an earlier frame, or end it."""
    if gesture.hand == "typing":
        return None
    if imgui.is_key_pressed(imgui.Key.escape):
        view.gesture = None
        return CancelEdit()
    io = imgui.get_io()
    if gesture.hand == "mouse":
        low, high = gesture.span
        begin, end = painter.columns.slider
        gesture.digits = 3 if io.key_shift else 2
        speed = FINE if io.key_shift else 1.0
        gesture.reach += speed * io.mouse_delta.x * (high - low) / max(end - begin, 1.0)
        over = not imgui.is_mouse_down(0)
    elif gesture.hand == "wheel":
        here = place.line >= 0 and lines[place.line] == gesture.shape
        over = not here or not (io.key_ctrl or io.key_alt)
    else:
        over = not (imgui.is_key_down(imgui.Key.left_arrow) or imgui.is_key_down(imgui.Key.right_arrow))
    if over:
        view.gesture = None
    elif gesture.hand != "mouse" or not io.mouse_delta.x:
        return None
    return gesture.edit(painter.rig, painter.control, final=over)


def _step(painter: Painter, j: int, by: float, weights: Floats, view: WeightsView, gesture: Gesture) -> Wish:
    """Move a slider by a step, as part of a gesture that may have begun with an earlier one."""
    view.gesture = gesture
    # The next step starts from what the last one led to, not from beyond the limits.
    gesture.reach = gesture.weight(painter.control) + by
    gesture.reach = gesture.weight(painter.control)
    return gesture.edit(painter.rig, painter.control, final=False)


def _wheel(painter: Painter, lines: Sequence[Line], place: Place, weights: Floats, view: WeightsView) -> Wish:
    """Turn the slider under the mouse by the wheel with Ctrl or Alt; alone, the wheel scrolls the list."""
    io = imgui.get_io()
    if place.line < 0 or place.zone not in ("slider", "number") or not (io.key_ctrl or io.key_alt):
        return None
    imgui.set_item_key_owner(imgui.Key.mouse_wheel_y)
    j = lines[place.line]
    if not io.mouse_wheel or isinstance(j, Group):
        return None
    gesture = view.gesture
    if gesture is None:
        gesture = Gesture("wheel", j, weights, painter.span(j), float(weights[j]))
    return _step(painter, j, io.mouse_wheel * (LEAP if io.key_shift else STEP), weights, view, gesture)


def _keys(painter: Painter, lines: Sequence[Line], weights: Floats, view: WeightsView) -> Wish:
    """Walk along the list with up and down, move the slider of the row with left and right."""
    if not imgui.is_window_focused() or imgui.get_io().want_text_input or view.focus is None:
        return None
    imgui.set_next_frame_want_capture_keyboard(True)
    pressed = imgui.is_key_pressed
    down = int(pressed(imgui.Key.down_arrow)) - int(pressed(imgui.Key.up_arrow))
    if down and view.gesture is None:
        _walk(painter, lines, down, view)
        return None
    right = int(pressed(imgui.Key.right_arrow)) - int(pressed(imgui.Key.left_arrow))
    j = view.focus
    if view.gesture is None and pressed(imgui.Key.enter, False):
        view.gesture = Gesture("typing", j, weights, painter.span(j), float(weights[j]))
        return None
    if not right:
        return None
    gesture = view.gesture
    if gesture is None:
        gesture = Gesture("keys", j, weights, painter.span(j), float(weights[j]))
    return _step(painter, j, right * (LEAP if imgui.get_io().key_shift else STEP), weights, view, gesture)


def _walk(painter: Painter, lines: Sequence[Line], down: int, view: WeightsView) -> None:
    """Give the keyboard to the next shape, and scroll there."""
    shapes = [number for number, line in enumerate(lines) if not isinstance(line, Group)]
    at = next((place for place, number in enumerate(shapes) if lines[number] == view.focus), None)
    if not shapes:
        return
    number = shapes[0] if at is None else shapes[min(max(at + down, 0), len(shapes) - 1)]
    line = lines[number]
    view.focus = line if not isinstance(line, Group) else view.focus
    row = painter.columns.row
    height, scrolled = imgui.get_window_height(), imgui.get_scroll_y()
    if number * row < scrolled:
        imgui.set_scroll_y(number * row)
    elif (number + 1) * row > scrolled + height:
        imgui.set_scroll_y((number + 1) * row - height)


def _rest(painter: Painter, lines: Sequence[Line], place: Place, view: WeightsView) -> None:
    """Explain what the mouse rests on: a name shows on the face what its shape moves."""
    line = lines[place.line] if place.line >= 0 else None
    thing = None if line is None or isinstance(line, Group) else (line, place.zone)
    if not view.rest.on(thing) or thing is None:
        return
    j, zone = thing
    if zone == "name":
        view.explained = j
    text = _about(painter, j) if zone == "name" else TOOLTIPS.get(zone)
    if text:
        _tooltip(painter, text, painter.columns.y(place.line))


def _tooltip(painter: Painter, text: str, y: float) -> None:
    """Draw a tooltip left of the list where there is room, so that the rows below can be read."""
    left = painter.columns.left - 3 * imgui.get_style().window_padding.x
    if left - imgui.calc_text_size(text).x > imgui.get_main_viewport().pos.x:
        imgui.set_next_window_pos(imgui.ImVec2(left, y), imgui.Cond_.always, imgui.ImVec2(1.0, 0.0))
    imgui.set_tooltip(text)


def _about(painter: Painter, j: int) -> str:
    """Return what there is to know of a shape."""
    rig, control = painter.rig, painter.control
    low, high = control.limits[j].tolist()
    move = 100 * rig.largest_moves[j] / rig.height
    lines = [rig.shape_names[j], f"Moves up to {move:.2g} % of the face height; limits {low:g} to {high:g}"]
    lines += [f"Should stay at or below {rig.shape_names[b]}" for a, b in control.ties if a == j]
    return "\n".join([*lines, "Double click: back to 0", "Right click: lock, mute, solo, limits"])
