"""Keys drawn as caps: "Ctrl+Shift+Z" becomes three of them."""

from imgui_bundle import imgui

from facepin.panels.theme import Theme, packed, tinted

_PADDING, _GAP = 5.0, 3.0
"""Beside the letters of a cap, and between caps, at 1x scale."""


def caps_width(keys: str, scale: float) -> float:
    """Return how wide the caps of a combination are, in imgui units."""
    words = keys.split("+")
    letters = sum(max(imgui.calc_text_size(word).x, 0.5 * imgui.get_font_size()) for word in words)
    return letters + (2 * _PADDING * len(words) + _GAP * (len(words) - 1)) * scale


def draw_caps(draw: imgui.ImDrawList, x: float, y: float, keys: str, theme: Theme, scale: float) -> None:
    """Draw the caps of a combination, from `x` to the right and centred about the height `y`."""
    line = imgui.get_text_line_height()
    half = line / 2 + scale
    for word in keys.split("+"):
        text = imgui.calc_text_size(word).x
        wide = max(text, 0.5 * imgui.get_font_size()) + 2 * _PADDING * scale
        corner, opposite = imgui.ImVec2(x, y - half), imgui.ImVec2(x + wide, y + half)
        draw.add_rect_filled(corner, opposite, packed(tinted(theme.ink, 0.07)), 3 * scale)
        draw.add_rect(corner, opposite, packed(tinted(theme.ink, 0.22)), 3 * scale, thickness=scale)
        draw.add_text(imgui.ImVec2(x + (wide - text) / 2, y - line / 2), packed(theme.text), word)
        x += wide + _GAP * scale
