"""What mouse and keyboard do in the list of the weights panel."""

from collections.abc import Sequence

from imgui_bundle import imgui

from facepin.core.arrays import Floats
from facepin.panels.requests import CancelEdit
from facepin.panels.weights.columns import Zone
from facepin.panels.weights.explain import explain
from facepin.panels.weights.gesture import FINE, Gesture, Wish, begun
from facepin.panels.weights.listing import Group, Line
from facepin.panels.weights.menu import group_reset
from facepin.panels.weights.nudges import keys, wheel
from facepin.panels.weights.painter import Painter
from facepin.panels.weights.place import NOWHERE, Place, place_of_mouse
from facepin.panels.weights.restraints import toggled
from facepin.panels.weights.view import WeightsView
from facepin.session.edit import Edit
from facepin.session.hand.nudge import PAUSE
from facepin.session.hand.sliding import slid

CLICK = 0.18
"""Seconds that a click on a slider waits for a second one: less than the main loop waits to look again."""


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
    place = place_of_mouse(painter.columns, lines) if imgui.is_item_hovered() and not sliding else NOWHERE
    wish: Wish = None
    pressed = imgui.is_mouse_clicked(0) or view.late_press
    # What keys do ends with a press elsewhere, which then acts on what they led to: in the next frame.
    by_keys = view.gesture is not None and view.gesture.hand in ("typing", "keys")
    view.late_press = by_keys and pressed and place.line is not None
    if view.gesture is not None:
        wish = _go_on(painter, view.gesture, place, view)
    elif place.line is not None and pressed:
        wish = _press(painter, place.line, place.zone, weights, view)
    elif place.line is not None and imgui.is_mouse_clicked(1):
        view.menu, view.menu_opens = place.line, True
    if wish is None:
        wish = wheel(painter, place, weights, view) or keys(painter, lines, weights, view)
    elif by_keys and view.gesture is None:
        keys(painter, lines, weights, view)  # what ended the taps walks on, or begins to type
    busy = view.gesture is not None or imgui.is_mouse_down(0)
    explain(painter, NOWHERE if busy else place, view)
    return place, wish


def _press(painter: Painter, line: Line, zone: Zone, weights: Floats, view: WeightsView) -> Wish:
    """Take what a press on a line means."""
    if isinstance(line, Group):
        return _press_header(painter, line, zone, weights, view)
    view.focus = line
    name = painter.rig.shape_names[line]
    if zone in ("solo", "mute", "lock"):
        return toggled(painter.control, zone, [line], name)
    twice, control_key = imgui.is_mouse_double_clicked(0), imgui.get_io().key_ctrl
    if (zone == "number" and twice) or (zone in ("slider", "number") and control_key):
        view.gesture = begun("typing", line, weights, painter.span(line))
        return None
    if twice:
        return Edit(f"Reset {name}", True, weights=slid(weights, {line: 0.0})) if weights[line] else None
    if zone == "slider":
        view.gesture = begun("mouse", line, weights, painter.span(line))
        view.gesture.reach = painter.columns.value(imgui.get_mouse_pos().x, view.gesture.span)
        return view.gesture.edit(painter.rig, painter.control, final=False)
    return None


def _press_header(painter: Painter, group: Group, zone: Zone, weights: Floats, view: WeightsView) -> Wish:
    if zone in ("mute", "lock"):
        return toggled(painter.control, zone, group.shapes.tolist(), group.name)
    if zone == "solo":  # where rows have it, headers have their reset
        return group_reset(painter.control, weights, group) if weights[group.shapes].any() else None
    view.folded = view.folded ^ {group.name}
    return None


def _go_on(painter: Painter, gesture: Gesture, place: Place, view: WeightsView) -> Wish:
    """Follow a gesture that began in an earlier frame, or end it."""
    if gesture.hand == "typing":
        return None
    if imgui.is_key_pressed(imgui.Key.escape):
        view.gesture = None
        return CancelEdit()
    if gesture.hand == "mouse":
        return _slide(painter, gesture, view)
    io = imgui.get_io()
    if gesture.hand == "wheel":
        over = place.line != gesture.shape or not (io.key_ctrl or io.key_alt)
    else:
        over = _taps_are_over(gesture)
    if not over:
        return None
    view.gesture = None
    return gesture.edit(painter.rig, painter.control, final=True)


def _taps_are_over(gesture: Gesture) -> bool:
    """Say whether arrow keys have moved a slider for good: they rest, or something else is done."""
    if imgui.is_key_down(imgui.Key.left_arrow) or imgui.is_key_down(imgui.Key.right_arrow):
        gesture.keyed = imgui.get_time()
    others = (imgui.Key.up_arrow, imgui.Key.down_arrow, imgui.Key.enter)
    elsewhere = any(imgui.is_mouse_clicked(button) for button in range(3)) or not imgui.is_window_focused()
    return (
        elsewhere
        or any(imgui.is_key_pressed(key) for key in others)
        or imgui.get_time() - gesture.keyed >= PAUSE
    )


def _slide(painter: Painter, gesture: Gesture, view: WeightsView) -> Wish:
    """Follow the mouse.  A click waits for a second one: the two mean a reset, and are one undo step."""
    io, j = imgui.get_io(), gesture.shape
    if imgui.is_mouse_double_clicked(0) and not gesture.moved:
        view.gesture = None
        label = f"Reset {painter.rig.shape_names[j]}"
        return Edit(label, True, weights=slid(gesture.base, {j: 0.0})) if gesture.start else CancelEdit()
    gesture.moved = gesture.moved or bool(io.mouse_delta.x or io.mouse_delta.y)
    if imgui.is_mouse_down(0):
        if not io.mouse_delta.x:
            return None
        low, high = gesture.span
        begin, end = painter.columns.slider
        gesture.digits = 3 if io.key_shift else 2
        speed = FINE if io.key_shift else 1.0
        gesture.reach += speed * io.mouse_delta.x * (high - low) / max(end - begin, 1.0)
        return gesture.edit(painter.rig, painter.control, final=False)
    if not gesture.moved and imgui.get_time() - gesture.began < CLICK:
        return None
    view.gesture = None
    return gesture.edit(painter.rig, painter.control, final=True)
