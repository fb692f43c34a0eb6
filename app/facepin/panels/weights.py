"""The weights panel: the slider interface of the paper's Figure 3, live while the face is dragged."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from imgui_bundle import imgui

from facepin.core.arrays import Floats
from facepin.core.control import ShapeControl
from facepin.core.measures import active as active_shapes
from facepin.core.pose import Pose
from facepin.core.rig import Rig
from facepin.panels.theme import ACCENT, FRAME, TEXT, TEXT_DIM, WARNING, Colour, packed, pane_colours
from facepin.session.edit import Edit
from facepin.session.session import Pane

VISIBLE = 0.005
"""A weight further from zero than this is emphasised: its number shows it."""

Order = Literal["rig order", "by weight"]


@dataclass
class WeightsView:
    """How the list is shown; not part of the pose."""

    search: str = ""
    order: Order = "rig order"
    _ranked: tuple[int, ...] = ()
    """Rows by weight; kept while a gesture goes on, so that no row runs away from the mouse."""


def weights_panel(
    rig: Rig,
    control: ShapeControl,
    panes: Sequence[Pane],
    active: int,
    view: WeightsView,
    scale: float,
    *,
    in_gesture: bool,
) -> Edit | None:
    """Draw one slider per shape; return the change of weights the user makes in this frame, or None.

    Parameters
    ----------
    rig : Rig
        Its shapes are listed.
    control : ShapeControl
        Their limits.
    panes : sequence of Pane
        One bar each; with several, a shape's bars stand one under the other in the panes' colours.
    active : int
        The pane whose numbers are shown and edited.
    view : WeightsView
        Search and order, changed in place.
    scale : float
        Pixels per pixel of a 1x screen.
    in_gesture : bool
        Whether a drag or a slider is being moved.
    """
    pose = panes[active].pose
    colours = [ACCENT] if len(panes) == 1 else pane_colours([pane.choice.kind.key for pane in panes])
    poses = [pane.pose.weights for pane in panes]
    edit = _head(rig, pose, view)
    rows = _rows(rig, pose.weights, view, in_gesture)
    if not rows:
        imgui.text_disabled("No shape has that name." if view.search else "This rig has no shapes.")
        return edit
    if imgui.begin_child("rows"):
        # A row knows its width from its longest name, within reason: the slider gets at least half.
        room = imgui.get_content_region_avail().x
        widest = max(imgui.calc_text_size(rig.shape_names[j]).x for j in _samples(rig))
        names = min(widest + 10 * scale, room * 0.5)
        limits = control.limits_at(pose.weights)
        clipper = imgui.ListClipper()
        clipper.begin(len(rows))
        while clipper.step():
            for row in range(clipper.display_start, clipper.display_end):
                edit = _row(rig, pose, limits, rows[row], names, scale, poses, colours) or edit
    imgui.end_child()
    return edit


def _head(rig: Rig, pose: Pose, view: WeightsView) -> Edit | None:
    """Search, order, count and reset."""
    button = imgui.calc_text_size("Reset all").x + 2 * imgui.get_style().frame_padding.x
    gap = imgui.get_style().item_spacing.x
    order = imgui.calc_text_size("by weight").x + 3 * imgui.get_frame_height()
    imgui.set_next_item_width(max(imgui.get_content_region_avail().x - button - order - 2 * gap, 4 * gap))
    _, view.search = imgui.input_text_with_hint("##search", "Search", view.search)
    imgui.same_line()
    imgui.set_next_item_width(order)
    orders: tuple[Order, ...] = ("rig order", "by weight")
    _, chosen = imgui.combo("##order", orders.index(view.order), list(orders))
    view.order = orders[chosen]
    imgui.same_line()
    imgui.begin_disabled(not pose.weights.any())
    pressed = imgui.button("Reset all")
    imgui.end_disabled()
    imgui.text_disabled(f"{active_shapes(pose.weights)} of {rig.shape_count} shapes active")
    imgui.set_item_tooltip("Weights further than 0.05 from zero")
    return Edit("Reset all weights", True, weights=np.zeros(rig.shape_count)) if pressed else None


def _samples(rig: Rig) -> range:
    """Return some shapes to measure names by: all of a small rig, every so manieth of a big one."""
    return range(0, rig.shape_count, max(1, rig.shape_count // 60))


def _rows(rig: Rig, weights: Floats, view: WeightsView, in_gesture: bool) -> tuple[int, ...]:
    """Return the shapes to list, in order."""
    if view.order == "by weight":
        if not in_gesture or len(view._ranked) != rig.shape_count:
            view._ranked = tuple(np.argsort(-np.abs(weights), kind="stable").tolist())
        rows = view._ranked
    else:
        rows = tuple(range(rig.shape_count))
    words = view.search.lower().split()
    return tuple(j for j in rows if all(word in rig.shape_names[j].lower() for word in words))


def _row(
    rig: Rig,
    pose: Pose,
    limits: Floats,
    j: int,
    names: float,
    scale: float,
    poses: Sequence[Floats],
    colours: Sequence[Colour],
) -> Edit | None:
    """Draw name, slider and number of one shape, with a bar for each pane."""
    weight = float(pose.weights[j])
    low, high = (float(limit) for limit in limits[j])
    outside = not low - VISIBLE <= weight <= high + VISIBLE
    visible = abs(weight) > VISIBLE
    name = rig.shape_names[j]
    imgui.push_id(j)
    left = imgui.get_cursor_screen_pos()
    height = imgui.get_frame_height()
    colour = TEXT if visible else TEXT_DIM
    draw = imgui.get_window_draw_list()
    draw.push_clip_rect(left, imgui.ImVec2(left.x + names - 6 * scale, left.y + height), True)
    draw.add_text(imgui.ImVec2(left.x, left.y + imgui.get_style().frame_padding.y), packed(colour), name)
    draw.pop_clip_rect()
    imgui.invisible_button("name", imgui.ImVec2(names - 6 * scale, height))
    reset = imgui.is_item_hovered() and imgui.is_mouse_double_clicked(0)
    imgui.set_item_tooltip(f"{name}\nDouble click: back to 0\nCtrl+click the slider: type a number")
    imgui.same_line(names)
    # The range opens up for a weight outside its limits: nothing is clipped just by being shown.
    values = [float(weights[j]) for weights in poses]
    low, high = min(low, *values), max(high, *values)
    width = imgui.get_content_region_avail().x
    at = imgui.get_cursor_screen_pos()
    if len(values) == 1 and outside:
        colours = [WARNING]
    _bars(draw, at, width, height, (low, high), values, colours, scale)
    imgui.set_next_item_width(width)
    for index in (imgui.Col_.frame_bg, imgui.Col_.slider_grab, imgui.Col_.slider_grab_active):
        imgui.push_style_color(index, imgui.ImVec4(0, 0, 0, 0))
    imgui.push_style_color(imgui.Col_.frame_bg_hovered, imgui.ImVec4(1, 1, 1, 0.06))
    imgui.push_style_color(imgui.Col_.frame_bg_active, imgui.ImVec4(1, 1, 1, 0.09))
    imgui.push_style_color(imgui.Col_.text, imgui.ImVec4(*colour))
    changed, value = imgui.slider_float("##weight", weight, low, high, "%.2f" if visible else "0.00")
    imgui.pop_style_color(6)
    if imgui.is_item_hovered() and imgui.is_mouse_double_clicked(0):
        reset = True
        imgui.internal.clear_active_id()  # else the slider goes on following the mouse, away from 0
    finished = imgui.is_item_deactivated_after_edit()
    imgui.pop_id()
    if reset:
        value, changed, finished = 0.0, weight != 0.0, weight != 0.0
    if not (changed or finished):
        return None
    weights = pose.weights.copy()
    weights[j] = value
    return Edit(f"Reset {name}" if reset else f"Set {name}", finished, weights=weights)


def _bars(
    draw: imgui.ImDrawList,
    at: imgui.ImVec2,
    width: float,
    height: float,
    limits: tuple[float, float],
    values: Sequence[float],
    colours: Sequence[Colour],
    scale: float,
) -> None:
    """Draw the slider's trough, and in it a bar from zero to each value."""
    low, high = limits

    def x(value: float) -> float:
        return at.x + width * (value - low) / (high - low) if high > low else at.x

    inset = 2 * scale
    top, bottom = at.y + inset, at.y + height - inset
    draw.add_rect_filled(
        imgui.ImVec2(at.x, top), imgui.ImVec2(at.x + width, bottom), packed(FRAME), 3 * scale
    )
    zero = x(min(max(0.0, low), high))
    step = (bottom - top) / len(values)
    for number, (value, colour) in enumerate(zip(values, colours, strict=True)):
        if abs(value) <= VISIBLE:
            continue
        left, right = sorted((zero, x(value)))
        above, below = top + number * step, top + (number + 1) * step
        fill = packed(colour, 0.4 if len(values) == 1 else 0.55)
        draw.add_rect_filled(imgui.ImVec2(left, above), imgui.ImVec2(right, below), fill, 2 * scale)
        end = x(value)
        draw.add_rect_filled(
            imgui.ImVec2(end - scale, above), imgui.ImVec2(end + scale, below), packed(colour), scale
        )
    if low < -VISIBLE:
        draw.add_line(imgui.ImVec2(zero, top), imgui.ImVec2(zero, bottom), packed(TEXT_DIM, 0.6), scale)
