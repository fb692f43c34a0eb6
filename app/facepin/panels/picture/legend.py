"""What the colours of the heat map mean."""

from functools import cache

from imgui_bundle import imgui

from facepin.core.look.camera import Viewport
from facepin.core.look.heat import BEYOND, heat_colours, heat_scale, hex_colours
from facepin.core.shapes.measures import percent
from facepin.panels.theme import PICTURE, VEIL, Colour, packed

BANDS = 48
"""Pieces that the bar of colours is drawn in."""
BAR = (10.0, 108.0)
"""Width and height of the bar, at 1x scale."""
MARGIN, PADDING, GAP = 10.0, 9.0, 6.0
"""Round the legend, inside of it, and between bar and numbers."""


def heat_legend(height: float, place: Viewport, pixel_ratio: float, scale: float) -> None:
    """Draw the legend of the heat map at the lower right of a pane, unless the pane is tiny.

    Parameters
    ----------
    height : float
        Height of the face, in the rig's unit.
    place : Viewport
        Where the pane is, in framebuffer pixels.
    pixel_ratio, scale : float
        Framebuffer pixels per imgui unit, imgui units per pixel of a 1x screen.
    """
    ticks = heat_scale(height).ticks
    lengths = [f"{tick:.3g}" for tick in ticks]
    shares = [f"{percent(tick, height):.2g} %" for tick in ticks]
    line = imgui.get_text_line_height()
    widths = [max(imgui.calc_text_size(text).x for text in column) for column in (lengths, shares)]
    bar_width, bar_height = BAR[0] * scale, BAR[1] * scale
    padding, gap = PADDING * scale, GAP * scale
    width = 2 * padding + sum(widths) + 2 * gap + bar_width
    tall = 2 * padding + bar_height + 2.3 * line
    right = (place.x + place.width) / pixel_ratio - MARGIN * scale
    bottom = (place.y + place.height) / pixel_ratio - MARGIN * scale
    if width > 0.4 * place.width / pixel_ratio or tall > 0.5 * place.height / pixel_ratio:
        return
    draw = imgui.get_background_draw_list()
    left, top = right - width, bottom - tall
    ground = packed(PICTURE.panel, VEIL)
    draw.add_rect_filled(imgui.ImVec2(left, top), imgui.ImVec2(right, bottom), ground, 3 * scale)
    draw.add_text(imgui.ImVec2(left + padding, top + padding), packed(PICTURE.text), "Moved")

    colours = _bands()
    start = left + padding + widths[0] + gap
    end, floor = start + bar_width, bottom - padding - 0.5 * line
    step = bar_height / BANDS
    for band in range(BANDS):
        low, high = packed(colours[band]), packed(colours[band + 1])
        upper, lower = floor - (band + 1) * step, floor - band * step
        draw.add_rect_filled_multi_color(
            imgui.ImVec2(start, upper), imgui.ImVec2(end, lower), high, high, low, low
        )
    # More than the top: a point on top of the bar.
    ceiling = floor - bar_height - scale
    draw.add_triangle_filled(
        imgui.ImVec2(start, ceiling),
        imgui.ImVec2(end, ceiling),
        imgui.ImVec2((start + end) / 2, ceiling - 0.8 * bar_width),
        packed(colours[-1]),
    )
    for at, (length, share) in enumerate(zip(lengths, shares, strict=True)):
        y = floor - at * bar_height / (len(ticks) - 1)
        x = start - gap - imgui.calc_text_size(length).x
        draw.add_text(imgui.ImVec2(x, y - line / 2), packed(PICTURE.text), length)
        draw.add_text(imgui.ImVec2(end + gap, y - line / 2), packed(PICTURE.text_dim), share)
        draw.add_line(imgui.ImVec2(end, y), imgui.ImVec2(end + 3 * scale, y), packed(PICTURE.text_dim), scale)


@cache
def _bands() -> tuple[Colour, ...]:
    """Colours where bands meet, from nothing to the top, and the one for more."""
    tops, beyond = heat_colours(BANDS + 1).tolist(), hex_colours((BEYOND,)).tolist()
    return tuple((r, g, b, 1.0) for r, g, b in (*tops, *beyond))
