"""What the hand draws over the picture: rubber band, stroke, and what the pin under the mouse is."""

from collections.abc import Sequence

from imgui_bundle import imgui

from facepin.core.arrays import Points
from facepin.core.camera import Camera, Viewport
from facepin.core.pose import Pin
from facepin.panels import layout
from facepin.panels.commands import Command, key_of
from facepin.panels.key_caps import caps_width, draw_caps
from facepin.panels.theme import PICTURE, VEIL, packed, pop_picture_colours, push_picture_colours, tinted
from facepin.session.box import Box
from facepin.session.gesture import Gesture
from facepin.session.navigation import Habit
from facepin.session.stroke import Stroke


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


def pin_label(
    pin: Pin, positions: Points, camera: Camera, viewport: Viewport, pixel_ratio: float, scale: float
) -> None:
    """Write beside a pin what it is called and what is not usual about it; nothing where nothing is."""
    words = [pin.name] * bool(pin.name)
    words += [f"stiffness {pin.stiffness:.3g}"] * (pin.stiffness != 1.0)
    words += ["on screen"] * (pin.freedom == "screen") + ["locked"] * pin.locked
    x, y, _ = (camera.project(positions[[pin.vertex]], viewport)[0] / pixel_ratio).tolist()
    if not words or x != x:
        return
    text, pad = "   ".join(words), 4 * scale
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


def symmetry_sign(viewport: Viewport, pixel_ratio: float, scale: float) -> None:
    """Say in a corner of the picture that what is done to one side is done to both."""
    text = "Symmetry"
    size, pad = imgui.calc_text_size(text), 8 * scale
    right = (viewport.x + viewport.width) / pixel_ratio - 8 * scale
    bottom = (viewport.y + viewport.height) / pixel_ratio - 8 * scale
    # Two wings and the line between them.
    wing = 0.55 * size.y
    wide = size.x + 2.6 * wing + 3 * pad
    corner = imgui.ImVec2(right - wide, bottom - size.y - 2 * pad)
    draw = imgui.get_background_draw_list()
    draw.add_rect_filled(corner, imgui.ImVec2(right, bottom), packed(tinted(PICTURE.popup, VEIL)), 4 * scale)
    x, y = corner.x + pad + 1.3 * wing, bottom - pad - size.y / 2
    accent = packed(PICTURE.accent)
    for side in (-1, 1):
        near, far = x + side * 0.35 * wing, x + side * 1.2 * wing
        upper, lower = imgui.ImVec2(far, y - 0.7 * wing), imgui.ImVec2(far, y + 0.7 * wing)
        draw.add_triangle_filled(imgui.ImVec2(near, y), upper, lower, accent)
    draw.add_line(imgui.ImVec2(x, y - 0.8 * wing), imgui.ImVec2(x, y + 0.8 * wing), accent, scale)
    draw.add_text(imgui.ImVec2(right - pad - size.x, bottom - pad - size.y), packed(PICTURE.text), text)


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
