"""The status line, the loading card and the hint over an untouched face."""

from collections.abc import Sequence

from imgui_bundle import imgui

from facepin.core.camera import Viewport
from facepin.core.rig import Rig
from facepin.panels import layout
from facepin.panels.requests import CancelLoading
from facepin.panels.theme import ACCENT, TEXT, WARNING, packed


def status_line(
    rig: Rig | None, timing: str, message: str, *, is_error: bool, warnings: Sequence[str] = ()
) -> None:
    """Draw the line at the bottom: what is open, how fast it is, and the last message."""
    height = imgui.get_frame_height() + imgui.get_style().window_padding.y * 0.5
    flags = (
        imgui.WindowFlags_.no_scrollbar | imgui.WindowFlags_.no_saved_settings | imgui.WindowFlags_.no_docking
    )
    layout.push_no_ground()
    imgui.push_style_var(
        imgui.StyleVar_.window_padding,
        imgui.ImVec2(imgui.get_style().window_padding.x, imgui.get_style().window_padding.y * 0.4),
    )
    shown = imgui.internal.begin_viewport_side_bar(
        "##status", imgui.get_main_viewport(), imgui.Dir.down, height, flags
    )
    imgui.pop_style_var()
    layout.pop_no_ground()
    if shown:
        imgui.align_text_to_frame_padding()
        if rig is not None:
            imgui.text(rig.name)
            imgui.same_line()
            imgui.text_disabled(
                f"{rig.vertex_count:,} vertices   {len(rig.triangles):,} triangles   {rig.shape_count} shapes"
            )
        if warnings:
            imgui.same_line()
            count = f"{len(warnings)} warning" + ("s" if len(warnings) > 1 else "")
            imgui.text_colored(imgui.ImVec4(*ACCENT), count)
            imgui.set_item_tooltip("\n".join(warnings))
        if message:
            imgui.same_line(0, 2 * imgui.get_font_size())
            imgui.text_colored(imgui.ImVec4(*(WARNING if is_error else TEXT)), message)
            imgui.set_item_tooltip(message)
        padding = imgui.get_style().window_padding.x
        right = imgui.get_window_width() - imgui.calc_text_size(timing).x - padding
        if right > imgui.get_item_rect_max().x - imgui.get_window_pos().x + padding:  # else there is no room
            imgui.same_line(right)
            imgui.text_disabled(timing)
    imgui.end()


def loading_card(name: str, fraction: float, line: str) -> CancelLoading | None:
    """Draw how far the opening of a rig is; return a request when the user gives it up."""
    view = imgui.get_main_viewport()
    middle = imgui.ImVec2(view.pos.x + view.size.x / 2, view.pos.y + view.size.y / 2)
    imgui.set_next_window_pos(middle, imgui.Cond_.always, imgui.ImVec2(0.5, 0.5))
    imgui.set_next_window_size(imgui.ImVec2(26 * imgui.get_font_size(), 0))
    flags = (
        imgui.WindowFlags_.no_decoration
        | imgui.WindowFlags_.no_saved_settings
        | imgui.WindowFlags_.no_docking
    )
    imgui.begin("##loading", None, flags)
    imgui.text(f"Opening {name}")
    imgui.progress_bar(fraction, imgui.ImVec2(-1, 0))
    imgui.text_disabled(line)
    imgui.same_line(imgui.get_window_width() - 5 * imgui.get_font_size())
    cancelled = imgui.button("Cancel", imgui.ImVec2(-1, 0))
    imgui.end()
    return CancelLoading() if cancelled else None


def hint(text: str, viewport: Viewport, pixel_ratio: float) -> None:
    """Write a line at the bottom of the picture."""
    size = imgui.calc_text_size(text)
    x = (viewport.x + viewport.width / 2) / pixel_ratio - size.x / 2
    y = (viewport.y + viewport.height) / pixel_ratio - 2.2 * size.y
    draw = imgui.get_background_draw_list()
    pad = 0.6 * size.y
    draw.add_rect_filled(
        imgui.ImVec2(x - 1.5 * pad, y - 0.5 * pad),
        imgui.ImVec2(x + size.x + 1.5 * pad, y + size.y + 0.5 * pad),
        packed((0, 0, 0, 0.35)),
        size.y,
    )
    draw.add_text(imgui.ImVec2(x, y), packed(TEXT, 0.85), text)
