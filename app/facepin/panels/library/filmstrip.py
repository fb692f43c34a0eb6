"""The filmstrip: the steps of the work so far as pictures with their labels (the paper's Figure 8)."""

from collections.abc import Callable, Sequence

from imgui_bundle import imgui

from facepin.core.arrays import Floats
from facepin.panels.commands import Command
from facepin.panels.tiles import Tile, draw_tile, shortened
from facepin.session.filmstrip import Still

TITLE = "Filmstrip"
SIDE, LEAST = 132.0, 48.0
"""Of a picture, at 1x scale: at most, and where the window is low."""


def filmstrip_window(
    stills: Sequence[Still], tile: Callable[[Floats], Tile | None], scale: float
) -> tuple[bool, Command | None]:
    """Draw the filmstrip; return whether it stays open, and what the user asks for.

    Parameters
    ----------
    stills : sequence of Still
        One or more, the oldest first.
    tile : callable
        Gives the picture of weights (k,), or None before it is made.
    scale : float
        Pixels per pixel of a 1x screen.
    """
    size = imgui.ImVec2(6 * (SIDE * scale + imgui.get_style().item_spacing.x), strip_height(scale))
    imgui.set_next_window_size(size, imgui.Cond_.first_use_ever)
    opened, stays = imgui.begin(TITLE, True)
    asked: Command | None = None
    if opened:
        imgui.begin_disabled(len(stills) < 2)
        if imgui.button("Save"):
            asked = Command.SAVE_FILMSTRIP
        imgui.end_disabled()
        imgui.set_item_tooltip("As one image: every step as the viewport shows it, with its label")
        imgui.same_line()
        if len(stills) < 2:
            imgui.text_disabled("Pose the face: every step that changes it appears here.")
        else:
            imgui.text_disabled(f"{len(stills) - 1} step{'' if len(stills) == 2 else 's'} to this pose")
        room = imgui.get_content_region_avail().y - imgui.get_style().scrollbar_size - _strip_height(0.0)
        side = min(max(room, LEAST * scale), SIDE * scale)
        if imgui.begin_child("strip", imgui.ImVec2(0, 0), 0, imgui.WindowFlags_.horizontal_scrollbar):
            _strip(stills, tile, side, scale)
        imgui.end_child()
    imgui.end()
    return bool(stays), asked


def strip_height(scale: float) -> float:
    """Return the height of the window at which its pictures have their full size, in imgui units."""
    style = imgui.get_style()
    around = imgui.get_frame_height() + imgui.get_frame_height_with_spacing() + 2 * style.window_padding.y
    return around + _strip_height(SIDE * scale) + style.scrollbar_size


def _strip(stills: Sequence[Still], tile: Callable[[Floats], Tile | None], side: float, scale: float) -> None:
    """Draw the pictures in one row; those out of sight are not asked for."""
    draw = imgui.get_window_draw_list()
    step = side + imgui.get_style().item_spacing.x
    height = _strip_height(side)
    left = imgui.get_cursor_screen_pos()
    first = max(int(imgui.get_scroll_x() // step), 0)
    last = min(int((imgui.get_scroll_x() + imgui.get_window_width()) // step) + 1, len(stills))
    for number in range(first, last):
        still = stills[number]
        at = imgui.ImVec2(left.x + number * step, left.y)
        corner = imgui.ImVec2(at.x + side, at.y + side)
        draw_tile(draw, tile(still.pose.weights), at, corner, 4 * scale)
        newest = number == len(stills) - 1
        if newest:
            draw.add_rect(at, corner, imgui.get_color_u32(imgui.Col_.check_mark), 4 * scale, 1.5 * scale)
        text = shortened(still.label if number == 0 else f"{number}  {still.label}", side)
        ink = imgui.get_color_u32(imgui.Col_.text if newest else imgui.Col_.text_disabled)
        draw.add_text(imgui.ImVec2(at.x, corner.y + 2 * scale), ink, text)
        imgui.set_cursor_screen_pos(at)
        imgui.dummy(imgui.ImVec2(side, height))
        imgui.set_item_tooltip(f"{still.label}\n{len(still.pose.pins)} pins")
    imgui.set_cursor_screen_pos(imgui.ImVec2(left.x, left.y))
    imgui.dummy(imgui.ImVec2(len(stills) * step, height))
    if imgui.get_scroll_x() >= imgui.get_scroll_max_x():  # new steps stay in sight until one scrolls back
        imgui.set_scroll_x(len(stills) * step)


def _strip_height(side: float) -> float:
    """Of a picture and its label."""
    return side + 1.3 * imgui.get_text_line_height()
