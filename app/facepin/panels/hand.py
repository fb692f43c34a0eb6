"""What the hand draws over the picture: rubber band, stroke, and what the pin under the mouse is."""

from collections.abc import Sequence

from imgui_bundle import imgui

from facepin.core.arrays import Points
from facepin.core.camera import Camera, Viewport
from facepin.core.pose import Pin
from facepin.panels.requests import Command
from facepin.panels.theme import PICTURE, packed
from facepin.session.box import Box
from facepin.session.gesture import Gesture
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
            _clip(draw, gesture.sight.viewport, pixel_ratio)
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
    _clip(draw, viewport, pixel_ratio)
    draw.add_rect_filled(
        imgui.ImVec2(corner.x - 1.5 * pad, corner.y - 0.6 * pad),
        imgui.ImVec2(corner.x + size.x + 1.5 * pad, corner.y + size.y + 0.6 * pad),
        packed((0, 0, 0, 0.6)),
        3 * scale,
    )
    draw.add_text(corner, packed(PICTURE.text), text)
    draw.pop_clip_rect()


def sketch_hint(count: int, key: str, viewport: Viewport, pixel_ratio: float) -> None:
    """Say at the bottom of the picture what the hand does while strokes are sketched."""
    text = f"Draw on the face to lay {count} pins, then drag one of them ({key} or Esc: single pins)"
    size = imgui.calc_text_size(text)
    x = (viewport.x + viewport.width / 2) / pixel_ratio - size.x / 2
    y = (viewport.y + viewport.height) / pixel_ratio - 2.2 * size.y
    draw, pad = imgui.get_background_draw_list(), 0.6 * size.y
    corner, opposite = (
        imgui.ImVec2(x - 1.5 * pad, y - 0.5 * pad),
        imgui.ImVec2(x + size.x + 1.5 * pad, y + size.y + 0.5 * pad),
    )
    draw.add_rect_filled(corner, opposite, packed((0, 0, 0, 0.5)), size.y)
    draw.add_text(imgui.ImVec2(x, y), packed(PICTURE.text), text)


def hidden_pins(count: int, viewport: Viewport, pixel_ratio: float, scale: float) -> Command | None:
    """Say in a corner of the picture that there are pins which are not seen, and offer them back."""
    corner = imgui.ImVec2(
        viewport.x / pixel_ratio + 8 * scale, (viewport.y + viewport.height) / pixel_ratio - 8 * scale
    )
    imgui.set_next_window_pos(corner, imgui.Cond_.always, imgui.ImVec2(0, 1))
    imgui.set_next_window_bg_alpha(0.72)
    flags = (
        imgui.WindowFlags_.no_decoration
        | imgui.WindowFlags_.always_auto_resize
        | imgui.WindowFlags_.no_saved_settings
        | imgui.WindowFlags_.no_docking
        | imgui.WindowFlags_.no_move
        | imgui.WindowFlags_.no_focus_on_appearing
        | imgui.WindowFlags_.no_bring_to_front_on_focus
    )
    imgui.begin("##hidden pins", None, flags)
    imgui.align_text_to_frame_padding()
    imgui.text_disabled(f"{count} pin{'' if count == 1 else 's'} hidden")
    imgui.same_line()
    asked = imgui.button("Show")
    imgui.set_item_tooltip(f"{Command.SHOW_PINS.title} ({Command.SHOW_PINS.shortcuts[0]})")
    imgui.end()
    return Command.SHOW_PINS if asked else None


def _stretches(stroke: Stroke) -> Sequence[Sequence[tuple[float, float]]]:
    stretches: list[list[tuple[float, float]]] = [[]]
    for pixel, hit in stroke.samples:
        if hit is not None:
            stretches[-1].append(pixel)
        elif stretches[-1]:
            stretches.append([])
    return [stretch for stretch in stretches if len(stretch) > 1]


def _clip(draw: imgui.ImDrawList, viewport: Viewport, pixel_ratio: float) -> None:
    left, top = viewport.x / pixel_ratio, viewport.y / pixel_ratio
    right, bottom = left + viewport.width / pixel_ratio, top + viewport.height / pixel_ratio
    draw.push_clip_rect(imgui.ImVec2(left, top), imgui.ImVec2(right, bottom))
