"""The status line and the card of what takes long."""

from collections.abc import Sequence

from imgui_bundle import imgui

from facepin.core.rig import Rig
from facepin.panels import layout
from facepin.panels.theme import Theme


def status_line(
    rig: Rig | None,
    timing: str,
    message: str,
    theme: Theme,
    *,
    is_error: bool,
    warnings: Sequence[str] = (),
    unkept: str = "",
) -> None:
    """Draw the line at the bottom: what is open, how fast it is, and the last message.

    `unkept` says why unsaved work is in memory only; that stays in sight as long as it is so.
    """
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
        else:
            imgui.text_disabled("No face is open")
        if warnings:
            imgui.same_line()
            count = f"{len(warnings)} warning" + ("s" if len(warnings) > 1 else "")
            imgui.text_colored(imgui.ImVec4(*theme.accent), count)
            imgui.set_item_tooltip("\n".join(warnings))
        if unkept:
            imgui.same_line(0, 2 * imgui.get_font_size())
            imgui.text_colored(imgui.ImVec4(*theme.warning), "Work is in memory only")
            imgui.set_item_tooltip(f"{unkept}\nIt is tried again every few seconds.")
        if message:
            imgui.same_line(0, 2 * imgui.get_font_size())
            imgui.text_colored(imgui.ImVec4(*(theme.warning if is_error else theme.text)), message)
            imgui.set_item_tooltip(message)
        padding = imgui.get_style().window_padding.x
        right = imgui.get_window_width() - imgui.calc_text_size(timing).x - padding
        if right > imgui.get_item_rect_max().x - imgui.get_window_pos().x + padding:  # else there is no room
            imgui.same_line(right)
            imgui.text_disabled(timing)
    imgui.end()


def progress_card(title: str, fraction: float, line: str) -> bool:
    """Draw how far something long is; return whether the user gives it up."""
    view = imgui.get_main_viewport()
    middle = imgui.ImVec2(view.pos.x + view.size.x / 2, view.pos.y + view.size.y / 2)
    imgui.set_next_window_pos(middle, imgui.Cond_.always, imgui.ImVec2(0.5, 0.5))
    imgui.set_next_window_size(imgui.ImVec2(26 * imgui.get_font_size(), 0))
    flags = (
        imgui.WindowFlags_.no_decoration
        | imgui.WindowFlags_.no_saved_settings
        | imgui.WindowFlags_.no_docking
        | imgui.WindowFlags_.no_focus_on_appearing
    )
    imgui.begin("##progress", None, flags)
    imgui.text(title)
    imgui.progress_bar(fraction, imgui.ImVec2(-1, 0))
    imgui.text_disabled(line)
    imgui.same_line(imgui.get_window_width() - 5 * imgui.get_font_size())
    cancelled = imgui.button("Cancel", imgui.ImVec2(-1, 0))
    imgui.end()
    return cancelled
