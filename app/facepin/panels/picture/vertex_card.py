"""A card beside the mouse: which shapes can move the vertex under it."""

from collections.abc import Sequence

from imgui_bundle import imgui

from facepin.core.control import ShapeControl
from facepin.core.rig import Rig
from facepin.core.shapes.measures import percent

MOST_LISTED = 10
BAR = 60.0
"""Width of the strongest one's bar at 1x scale."""


def vertex_card(
    rig: Rig, control: ShapeControl, place: str, movers: Sequence[tuple[int, float]], scale: float
) -> None:
    """Draw the shapes that move a vertex, strongest first.

    Parameters
    ----------
    rig, control
        Names and height; which shapes are locked or silent.
    place : str
        What that vertex is called: what is under the mouse.
    movers : sequence of (shape, length)
        As `facepin.core.shapes.motion.movers` finds them.
    scale : float
        imgui units per pixel of a 1x screen.
    """
    imgui.begin_tooltip()
    if not movers:
        imgui.text_disabled(f"No shape moves this place ({place})")
        imgui.end_tooltip()
        return
    title = f"{place[:1].upper()}{place[1:]}"
    imgui.text_disabled(f"{title}: {len(movers)} shape{'s' if len(movers) > 1 else ''}, % of face height")
    draw, strongest = imgui.get_window_draw_list(), movers[0][1]
    bars = max(imgui.calc_text_size(rig.shown_names[j]).x for j, _ in movers[:MOST_LISTED]) + 12 * scale
    for j, length in movers[:MOST_LISTED]:
        held = bool(control.held[j])
        write = imgui.text_disabled if held else imgui.text
        write(rig.shown_names[j])
        imgui.same_line(imgui.get_style().window_padding.x + bars)
        at, height = imgui.get_cursor_screen_pos(), imgui.get_text_line_height()
        draw.add_rect_filled(
            imgui.ImVec2(at.x, at.y + 0.3 * height),
            imgui.ImVec2(at.x + BAR * scale * length / strongest, at.y + 0.8 * height),
            imgui.get_color_u32(imgui.Col_.check_mark, 0.3 if held else 0.8),
        )
        imgui.same_line(imgui.get_style().window_padding.x + bars + (BAR + 8) * scale)
        write(f"{percent(length, rig.height):.2g}" + ("   " + _why(control, j) if held else ""))
    if len(movers) > MOST_LISTED:
        imgui.text_disabled(f"and {len(movers) - MOST_LISTED} more")
    imgui.end_tooltip()


def _why(control: ShapeControl, j: int) -> str:
    return "locked" if control.locked[j] else "muted" if control.muted[j] else "not solo"
