"""What the hand draws over the picture: rubber band, stroke, and what the pin under the mouse is."""

from collections.abc import Sequence

import numpy as np
from imgui_bundle import imgui

from facepin.core.arrays import Points
from facepin.core.look.camera import Camera, Viewport
from facepin.core.pose import Pin
from facepin.core.shapes.places import Places
from facepin.panels import layout
from facepin.panels.commands import Command, key_of
from facepin.panels.help.key_caps import caps_width, draw_caps
from facepin.panels.theme import PICTURE, VEIL, packed, pop_picture_colours, push_picture_colours, tinted
from facepin.session.hand.aim import Aim
from facepin.session.hand.box import Box
from facepin.session.hand.course import Axis
from facepin.session.hand.gesture import Gesture
from facepin.session.hand.hold import Hold
from facepin.session.hand.sight import Pixel
from facepin.session.hand.stroke import Stroke
from facepin.session.navigation import Habit

RING = 7.0
"""Radius of the ring round what a press would take, at 1x scale."""


def draw_gesture(gesture: Gesture | None, pixel_ratio: float, scale: float) -> None:
    """Draw a rubber band or a stroke as far as it goes; other gestures show in the pins themselves.

    Parameters
    ----------
    gesture : Gesture
        What is going on, if anything.
    pixel_ratio, scale : float
        Framebuffer pixels per imgui unit, imgui units per pixel of a 1x screen.
    """
    draw = imgui.get_background_draw_list()
    match gesture:
        case Box() if gesture.drawn:
            first, last = (
                imgui.ImVec2(x / pixel_ratio, y / pixel_ratio) for x, y in (gesture.pressed, gesture.corner)
            )
            low = imgui.ImVec2(min(first.x, last.x), min(first.y, last.y))
            high = imgui.ImVec2(max(first.x, last.x), max(first.y, last.y))
            clip(draw, gesture.sight.viewport, pixel_ratio)
            draw.add_rect_filled(low, high, packed(PICTURE.accent, 0.10))
            draw.add_rect(low, high, packed(PICTURE.accent, 0.9), 0.0, scale)
            draw.pop_clip_rect()
        case Stroke():
            # One line per stretch on the face: across the wall behind it there is none.
            for stretch in _stretches(gesture):
                points: list[imgui.ImVec2Like] = [(x / pixel_ratio, y / pixel_ratio) for x, y in stretch]
                for colour, width in ((packed((0, 0, 0, 0.5)), 5.0), (packed(PICTURE.accent), 2.5)):
                    draw.add_polyline(points, colour, width * scale, 0)
        case _:
            pass


def aim_ring(
    aim: Aim,
    places: Places,
    positions: Points,
    camera: Camera,
    viewport: Viewport,
    pixel_ratio: float,
    scale: float,
) -> None:
    """Draw a ring round the vertex that a press would take, what it is called, and how to get at another."""
    x, y, _ = (camera.project(positions[[aim.vertices[0]]], viewport)[0] / pixel_ratio).tolist()
    if x != x:
        return
    draw = imgui.get_background_draw_list()
    clip(draw, viewport, pixel_ratio)
    for colour, width in ((packed((0, 0, 0, 0.55)), 3.5), (packed(PICTURE.text), 1.5)):
        draw.add_circle(imgui.ImVec2(x, y), RING * scale, colour, 0, width * scale)
    draw.pop_clip_rect()
    text = places.title(aim.vertices[0])
    if len(aim.vertices) > 1:
        text += f"   Tab: {places.region(aim.vertices[1])}"
    _label(text, x, y, viewport, pixel_ratio, scale)


def soft_ring(hold: Hold, positions: Points, pixel_ratio: float, scale: float) -> None:
    """Draw how far round the pin in the hand others are carried along."""
    camera, viewport = hold.sight.camera, hold.sight.viewport
    point = positions[hold.pin.vertex].astype(np.float64)
    rim = point + hold.radius * hold.sight.rig.height * camera.axes[0]
    (x, y, _), (edge, *_) = (camera.project(np.stack([point, rim]), viewport) / pixel_ratio).tolist()
    if x != x or edge != edge:
        return
    draw = imgui.get_background_draw_list()
    clip(draw, viewport, pixel_ratio)
    for colour, width in ((packed((0, 0, 0, 0.35)), 3.0), (packed(PICTURE.accent, 0.9), 1.25)):
        draw.add_circle(imgui.ImVec2(x, y), edge - x, colour, 0, width * scale)
    draw.pop_clip_rect()
    count = len(hold.along)
    text = f"{hold.radius:.0%} of the face, {count} pin{'' if count == 1 else 's'} carried along"
    _label(text, edge, y, viewport, pixel_ratio, scale)


def axis_line(axis: Axis, pressed: Pixel, viewport: Viewport, pixel_ratio: float, scale: float) -> None:
    """Draw the line through the press that a drag is kept on."""
    x, y = pressed[0] / pixel_ratio, pressed[1] / pixel_ratio
    left, top = viewport.x / pixel_ratio, viewport.y / pixel_ratio
    right, bottom = left + viewport.width / pixel_ratio, top + viewport.height / pixel_ratio
    ends = ((left, y), (right, y)) if axis == "x" else ((x, top), (x, bottom))
    draw = imgui.get_background_draw_list()
    for colour, width in ((packed((0, 0, 0, 0.35)), 3.0), (packed(PICTURE.accent, 0.9), 1.0)):
        draw.add_line(imgui.ImVec2(*ends[0]), imgui.ImVec2(*ends[1]), colour, width * scale)


def pin_label(
    pin: Pin,
    title: str,
    positions: Points,
    camera: Camera,
    viewport: Viewport,
    pixel_ratio: float,
    scale: float,
    why: str = "",
) -> None:
    """Write beside a pin what it is called, what is not usual about it, and `why` it is not at its goal."""
    words = [title]
    words += [f"stiffness {pin.stiffness:.3g}"] * (pin.stiffness != 1.0)
    words += ["on screen"] * (pin.freedom == "screen") + ["locked"] * pin.locked + [why] * bool(why)
    x, y, _ = (camera.project(positions[[pin.vertex]], viewport)[0] / pixel_ratio).tolist()
    if x != x:
        return
    _label("   ".join(words), x, y, viewport, pixel_ratio, scale)


def goal_label(
    pin: Pin,
    why: str,
    camera: Camera,
    viewport: Viewport,
    pixel_ratio: float,
    scale: float,
) -> None:
    """Write beside the goal of the pin in the hand, or near it, why the face stays behind."""
    x, y, _ = (camera.project(np.array([pin.goal]), viewport)[0] / pixel_ratio).tolist()
    if not why or x != x:
        return
    width, line = imgui.calc_text_size(why).x + 26 * scale, imgui.get_text_line_height()
    left, top = viewport.x / pixel_ratio, viewport.y / pixel_ratio
    right, bottom = left + viewport.width / pixel_ratio, top + viewport.height / pixel_ratio
    x, y = min(max(x, left), right - width), min(max(y, top + line), bottom - line)
    _label(why, x, y, viewport, pixel_ratio, scale)


def _label(text: str, x: float, y: float, viewport: Viewport, pixel_ratio: float, scale: float) -> None:
    """Write beside a place, on a dark ground."""
    pad = 4 * scale
    size = imgui.calc_text_size(text)
    corner = imgui.ImVec2(x + 14 * scale, y - size.y / 2)
    draw = imgui.get_background_draw_list()
    clip(draw, viewport, pixel_ratio)
    draw.add_rect_filled(
        imgui.ImVec2(corner.x - 1.5 * pad, corner.y - 0.6 * pad),
        imgui.ImVec2(corner.x + size.x + 1.5 * pad, corner.y + size.y + 0.6 * pad),
        packed((0, 0, 0, 0.6)),
        3 * scale,
    )
    draw.add_text(corner, packed(PICTURE.text), text)
    draw.pop_clip_rect()


def sketch_hint(count: int, habit: Habit, viewport: Viewport, pixel_ratio: float, scale: float) -> None:
    """Say at the bottom of the picture how a stroke is laid, and how to get back to single pins."""
    key = key_of(Command.SKETCH_PINS, habit)
    text = f"Draw on the face: {count} pins are laid along the line, drag one to move them all"
    line = imgui.get_text_line_height()
    wide = caps_width(key, scale) + 0.7 * line + imgui.calc_text_size(text).x
    left = (viewport.x + viewport.width / 2) / pixel_ratio - wide / 2
    middle = (viewport.y + viewport.height) / pixel_ratio - 1.9 * line
    draw = imgui.get_background_draw_list()
    corner = imgui.ImVec2(left - 0.9 * line, middle - 1.1 * line)
    opposite = imgui.ImVec2(left + wide + 0.9 * line, middle + 1.1 * line)
    draw.add_rect_filled(corner, opposite, packed(tinted(PICTURE.popup, VEIL)), 1.1 * line)
    draw_caps(draw, left, middle, key, PICTURE, scale)
    x = left + caps_width(key, scale) + 0.7 * line
    draw.add_text(imgui.ImVec2(x, middle - line / 2), packed(PICTURE.text), text)


def symmetry_button(
    on: bool, habit: Habit, viewport: Viewport, pixel_ratio: float, scale: float
) -> Command | None:
    """Draw a button in a corner of the picture that says whether both sides do the same, and changes it."""
    corner = imgui.ImVec2(
        (viewport.x + viewport.width) / pixel_ratio - 8 * scale,
        (viewport.y + viewport.height) / pixel_ratio - 8 * scale,
    )
    imgui.set_next_window_pos(corner, imgui.Cond_.always, imgui.ImVec2(1, 1))
    imgui.set_next_window_bg_alpha(VEIL)
    push_picture_colours()
    imgui.push_style_var(imgui.StyleVar_.window_padding, imgui.ImVec2(4 * scale, 4 * scale))
    imgui.push_style_var(imgui.StyleVar_.window_rounding, 4 * scale)
    imgui.push_style_var(imgui.StyleVar_.window_border_size, 0.0)
    imgui.begin("##symmetry", None, layout.SIGN)
    imgui.pop_style_var(3)
    text = f"Symmetry {'on' if on else 'off'}"
    wing = 0.55 * imgui.get_text_line_height()
    pad = imgui.get_style().frame_padding
    start = imgui.get_cursor_screen_pos()
    width = imgui.calc_text_size("Symmetry off").x + 2.6 * wing + 3 * pad.x
    asked = imgui.button("##symmetry", imgui.ImVec2(width, imgui.get_frame_height()))
    key = key_of(Command.SYMMETRY, habit)
    imgui.set_item_tooltip(f"{Command.SYMMETRY.help}\n{key}")
    draw = imgui.get_window_draw_list()
    x, y = start.x + pad.x + 1.3 * wing, start.y + imgui.get_frame_height() / 2
    colour = packed(PICTURE.accent) if on else imgui.get_color_u32(imgui.Col_.text_disabled)
    for side in (-1, 1):
        near, far = x + side * 0.35 * wing, x + side * 1.2 * wing
        upper, lower = imgui.ImVec2(far, y - 0.7 * wing), imgui.ImVec2(far, y + 0.7 * wing)
        if on:
            draw.add_triangle_filled(imgui.ImVec2(near, y), upper, lower, colour)
        else:
            draw.add_triangle(imgui.ImVec2(near, y), upper, lower, colour, scale)
    draw.add_line(imgui.ImVec2(x, y - 0.8 * wing), imgui.ImVec2(x, y + 0.8 * wing), colour, scale)
    ink = imgui.get_color_u32(imgui.Col_.text if on else imgui.Col_.text_disabled)
    at = imgui.ImVec2(start.x + 2.6 * wing + 2 * pad.x, start.y + pad.y)
    draw.add_text(at, ink, text)
    imgui.end()
    pop_picture_colours()
    return Command.SYMMETRY if asked else None


def hidden_pins(
    count: int, habit: Habit, viewport: Viewport, pixel_ratio: float, scale: float
) -> Command | None:
    """Say in a corner of the picture that there are pins which are not seen, and offer them back."""
    corner = imgui.ImVec2(
        viewport.x / pixel_ratio + 8 * scale, (viewport.y + viewport.height) / pixel_ratio - 8 * scale
    )
    imgui.set_next_window_pos(corner, imgui.Cond_.always, imgui.ImVec2(0, 1))
    imgui.set_next_window_bg_alpha(VEIL)
    push_picture_colours()
    imgui.push_style_var(imgui.StyleVar_.window_padding, imgui.ImVec2(8 * scale, 4 * scale))
    imgui.push_style_var(imgui.StyleVar_.window_rounding, 4 * scale)
    imgui.push_style_var(imgui.StyleVar_.window_border_size, 0.0)
    imgui.begin("##hidden pins", None, layout.SIGN)
    imgui.pop_style_var(3)
    imgui.align_text_to_frame_padding()
    key = key_of(Command.SHOW_PINS, habit)
    imgui.text_disabled(f"{count} pin{'' if count == 1 else 's'} hidden")
    imgui.same_line()
    asked = imgui.button(f"Show ({key})" if key else "Show")
    imgui.end()
    pop_picture_colours()
    return Command.SHOW_PINS if asked else None


def _stretches(stroke: Stroke) -> Sequence[Sequence[tuple[float, float]]]:
    stretches: list[list[tuple[float, float]]] = [[]]
    for pixel, hit in stroke.samples:
        if hit is not None:
            stretches[-1].append(pixel)
        elif stretches[-1]:
            stretches.append([])
    return [stretch for stretch in stretches if len(stretch) > 1]


def clip(draw: imgui.ImDrawList, viewport: Viewport, pixel_ratio: float) -> None:
    """Draw nothing beside a pane until `pop_clip_rect`."""
    left, top = viewport.x / pixel_ratio, viewport.y / pixel_ratio
    right, bottom = left + viewport.width / pixel_ratio, top + viewport.height / pixel_ratio
    draw.push_clip_rect(imgui.ImVec2(left, top), imgui.ImVec2(right, bottom))
