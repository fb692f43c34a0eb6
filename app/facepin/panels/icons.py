"""Small signs for which the font has no letters."""

from math import pi

from imgui_bundle import imgui


def padlock(
    draw: imgui.ImDrawList, x: float, y: float, half: float, colour: int, *, closed: bool = True
) -> None:
    """Draw a padlock with its middle at (x, y), `half` its height."""
    width, top = 0.72 * half, y - 0.05 * half
    body = imgui.ImVec2(x - width, top), imgui.ImVec2(x + width, y + 0.9 * half)
    draw.add_rect_filled(*body, colour, 0.15 * half)
    if not closed:
        x += 0.9 * half
    draw.path_line_to(imgui.ImVec2(x - 0.45 * half, top))
    draw.path_arc_to(imgui.ImVec2(x, y - 0.45 * half), 0.45 * half, -pi, 0.0)
    if closed:
        draw.path_line_to(imgui.ImVec2(x + 0.45 * half, top))
    draw.path_stroke(colour, 0.25 * half)


def lock_button(name: str, closed: bool) -> bool:
    """Draw a padlock, dim where it is open; return whether it was clicked."""
    clicked, x, y, size, colour, _ = _button(name, closed)
    padlock(imgui.get_window_draw_list(), x, y, 0.45 * size, colour, closed=closed)
    return clicked


def eye_button(name: str, open_: bool) -> bool:
    """Draw an eye, dim and struck out where it is closed; return whether it was clicked."""
    clicked, x, y, size, colour, line = _button(name, open_)
    draw = imgui.get_window_draw_list()
    left, right = imgui.ImVec2(x - 0.46 * size, y), imgui.ImVec2(x + 0.46 * size, y)
    for side in (-1, 1):
        bend = imgui.ImVec2(x, y + side * 0.56 * size)
        draw.add_bezier_quadratic(left, bend, right, colour, line)
    if open_:
        draw.add_circle_filled(imgui.ImVec2(x, y), 0.14 * size, colour)
    else:
        draw.add_line(
            imgui.ImVec2(x - 0.34 * size, y + 0.34 * size),
            imgui.ImVec2(x + 0.34 * size, y - 0.34 * size),
            colour,
            line,
        )
    return clicked


def icon_width() -> float:
    """Return the width of a sign."""
    return 1.25 * float(imgui.get_font_size())


def _button(name: str, lit: bool) -> tuple[bool, float, float, float, int, float]:
    """Make room for a sign; return clicked, its middle, size, colour and width of lines."""
    size = float(imgui.get_font_size())
    corner = imgui.get_cursor_screen_pos()
    height = imgui.get_frame_height()
    clicked = bool(imgui.invisible_button(name, imgui.ImVec2(icon_width(), height)))
    bright = lit or imgui.is_item_hovered()
    index, opacity = (imgui.Col_.text, 1.0) if bright else (imgui.Col_.text_disabled, 0.6)
    colour = int(imgui.get_color_u32(index, opacity))
    return clicked, corner.x + icon_width() / 2, corner.y + height / 2, 0.82 * size, colour, 0.1 * size
