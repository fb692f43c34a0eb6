"""Small signs: mute, solo, reset, and the triangle of a header.

Each takes a draw list, x and y of its middle, half its height and a packed colour.
"""

from math import pi

from imgui_bundle import imgui

ImVec2 = imgui.ImVec2


def mute(draw: imgui.ImDrawList, x: float, y: float, half: float, colour: int) -> None:
    """An M, as on a mixing desk."""
    _letter(draw, x, y, colour, "M")


def solo(draw: imgui.ImDrawList, x: float, y: float, half: float, colour: int) -> None:
    """An S, as on a mixing desk."""
    _letter(draw, x, y, colour, "S")


def reset(draw: imgui.ImDrawList, x: float, y: float, half: float, colour: int) -> None:
    """An arrow that goes back round."""
    radius = 0.68 * half
    draw.path_arc_to(ImVec2(x, y), radius, -0.75 * pi, 0.8 * pi)
    draw.path_stroke(colour, 0.26 * half)
    tip = ImVec2(x - 0.95 * half, y - 0.15 * half)
    draw.add_triangle_filled(
        ImVec2(x - 0.95 * half, y - 0.95 * half), ImVec2(x - 0.15 * half, y - 0.3 * half), tip, colour
    )


def fold(draw: imgui.ImDrawList, x: float, y: float, half: float, colour: int, *, folded: bool) -> None:
    """The triangle of a header: to the right when folded, else down."""
    size = 0.55 * half
    if folded:
        corners = ((-0.6, -1.0), (0.8, 0.0), (-0.6, 1.0))
    else:
        corners = ((-1.0, -0.6), (1.0, -0.6), (0.0, 0.8))
    a, b, c = (ImVec2(x + size * dx, y + size * dy) for dx, dy in corners)
    draw.add_triangle_filled(a, b, c, colour)


def _letter(draw: imgui.ImDrawList, x: float, y: float, colour: int, letter: str) -> None:
    size = imgui.calc_text_size(letter)
    draw.add_text(ImVec2(x - size.x / 2, y - size.y / 2), colour, letter)
