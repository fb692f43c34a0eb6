"""The head of the weights panel: search, arrangement, what is active and restrained, gain, reset."""

import numpy as np
from imgui_bundle import imgui

from facepin.core.arrays import Floats
from facepin.core.control import ShapeControl
from facepin.core.rig import Rig
from facepin.core.shapes.measures import active as active_shapes
from facepin.panels.icons import padlock
from facepin.panels.requests import CancelEdit
from facepin.panels.weights import icons
from facepin.panels.weights.gesture import Wish
from facepin.panels.weights.listing import ARRANGEMENTS
from facepin.panels.weights.restraints import FLAGS, Flag, flags_of, freed
from facepin.panels.weights.view import WeightsView
from facepin.session.edit import Edit
from facepin.session.hand.sliding import gained, reset

MOST_GAIN = 2.0
GAIN_SPEED = 0.005
"""Gain per pixel of the mouse at 1x scale."""
MEANINGS: dict[Flag, str] = {
    "lock": "locked: no solver and no slider changes {}",
    "mute": "muted: {} no part in moving the face",
    "solo": "solo: all others have no part in moving the face",
}
ImVec2 = imgui.ImVec2


def head(rig: Rig, control: ShapeControl, weights: Floats, view: WeightsView, scale: float) -> Wish:
    """Draw two lines above the list; return what the user changes in this frame, or None."""
    wish: Wish = None
    button = imgui.calc_text_size("Reset all").x + 2 * imgui.get_style().frame_padding.x
    gap = imgui.get_style().item_spacing.x
    order = imgui.calc_text_size("by weight").x + 3 * imgui.get_frame_height()
    imgui.set_next_item_width(max(imgui.get_content_region_avail().x - button - order - 2 * gap, 4 * gap))
    _, view.search = imgui.input_text_with_hint("##search", "Search", view.search)
    imgui.same_line()
    imgui.set_next_item_width(order)
    if imgui.begin_combo("##arrangement", view.arrangement):
        for arrangement in ARRANGEMENTS:
            if imgui.selectable(arrangement, arrangement == view.arrangement)[0]:
                view.arrangement = arrangement
        imgui.end_combo()
    imgui.same_line()
    imgui.begin_disabled(not weights.any())
    if imgui.button("Reset all"):
        wish = Edit("Reset all weights", True, weights=reset(control, weights))
    imgui.end_disabled()

    imgui.align_text_to_frame_padding()
    imgui.text_disabled(f"{active_shapes(weights)} of {rig.shape_count} active")
    imgui.set_item_tooltip("Weights further than 0.05 from zero")
    for flag in FLAGS:
        count = int(np.count_nonzero(flags_of(control, flag)))
        if count:
            imgui.same_line()
            if _counter(flag, count, scale):
                wish = freed(control, flag)
    return _gain(control, weights, view, scale) or wish


def _counter(flag: Flag, count: int, scale: float) -> bool:
    """Draw how many shapes are locked, muted or solo; return whether it was clicked."""
    height = imgui.get_frame_height()
    at = imgui.get_cursor_screen_pos()
    text = str(count)
    clicked = imgui.invisible_button(flag, ImVec2(16 * scale + imgui.calc_text_size(text).x, height))
    ink = imgui.get_color_u32(imgui.Col_.check_mark if imgui.is_item_hovered() else imgui.Col_.text_disabled)
    draw = imgui.get_window_draw_list()
    icon = {"lock": padlock, "mute": icons.mute, "solo": icons.solo}[flag]
    icon(draw, at.x + 6 * scale, at.y + height / 2, 6 * scale, ink)
    draw.add_text(ImVec2(at.x + 14 * scale, at.y + imgui.get_style().frame_padding.y), ink, text)
    many = "it" if count == 1 else "them"
    subject = f"{count} shape{'s' if count > 1 else ''}"
    has = "it has" if count == 1 else "they have"
    meaning = MEANINGS[flag].format(many if flag == "lock" else has)
    imgui.set_item_tooltip(f"{subject} {meaning}\nClick to end that for all")
    return clicked


def _gain(
    control: ShapeControl, weights: Floats, view: WeightsView, scale: float
) -> Edit | CancelEdit | None:
    """Draw the gain: a slider that scales the whole pose while it is held, and then is back at 1."""
    width = min(0.4 * imgui.get_window_width(), 120 * scale)
    imgui.same_line(imgui.get_cursor_pos().x + imgui.get_content_region_avail().x - width)
    imgui.set_next_item_width(width)
    gain = 1.0 if view.gain is None else view.gain[1]
    imgui.begin_disabled(not weights.any())
    at = imgui.get_cursor_screen_pos()
    changed, gain = imgui.drag_float("##gain", gain, GAIN_SPEED / scale, 0.0, MOST_GAIN, "gain %.2f")
    imgui.end_disabled()
    _fill(at, width, gain, scale)
    imgui.set_item_tooltip("Drag to scale all weights that are not locked\nCtrl+click to type how much")
    if imgui.is_item_activated():
        view.gain = weights, 1.0
    if view.gain is None:
        return None
    base = view.gain[0]
    if imgui.is_item_active() and imgui.is_key_pressed(imgui.Key.escape):
        imgui.internal.clear_active_id()
        view.gain = None
        return CancelEdit()
    view.gain = base, gain
    if imgui.is_item_active():
        return Edit("Scale the pose", False, weights=gained(control, base, gain)) if changed else None
    view.gain = None
    final = gained(control, base, gain)
    return CancelEdit() if np.array_equal(final, base) else Edit("Scale the pose", True, weights=final)


def _fill(at: imgui.ImVec2, width: float, gain: float, scale: float) -> None:
    """Draw how far the gain is from 1, which is in the middle."""
    if gain == 1.0:
        return
    height = imgui.get_frame_height()
    middle, end = at.x + width / 2, at.x + width * min(gain, MOST_GAIN) / MOST_GAIN
    begin, end = min(middle, end) - scale, max(middle, end) + scale
    ink = imgui.get_color_u32(imgui.Col_.check_mark)
    corner = ImVec2(end, at.y + height)
    imgui.get_window_draw_list().add_rect_filled(ImVec2(begin, at.y + height - 2 * scale), corner, ink)
