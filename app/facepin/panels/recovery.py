"""What asks to be taken up: unsaved work of former windows, and a scene whose rig is missing."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from imgui_bundle import imgui

from facepin.core.names import readable
from facepin.panels import layout
from facepin.panels.commands import Command
from facepin.panels.requests import CancelLoading, DiscardWork, Request, RestoreWork
from facepin.panels.theme import Theme
from facepin.panels.tiles import shortened

MOST_ROWS = 3
"""Rows that are seen at once; more scroll."""


@dataclass
class RecoveryView:
    """How the strip of unsaved work is shown."""

    shown: bool = False
    doomed: Path | None = None
    """The draft that the next press on its Discard throws away."""


@dataclass(frozen=True)
class WorkRow:
    """Unsaved work, as the strip lists it."""

    draft: Path
    name: str
    about: str
    """When, and how much."""


def recovery_strip(rows: Sequence[WorkRow], view: RecoveryView, theme: Theme) -> Request | None:
    """Draw below the menu bar what can be taken up again; return what the user wants, or None.

    Parameters
    ----------
    rows : sequence of WorkRow
        Newest first, one or more.
    view : RecoveryView
        Changed in place.
    theme : Theme
        Colours.
    """
    style = imgui.get_style()
    step = imgui.get_frame_height_with_spacing()
    around = 0.8 * style.window_padding.y
    height = min(len(rows), MOST_ROWS) * step - style.item_spacing.y
    flags = (
        imgui.WindowFlags_.no_scrollbar | imgui.WindowFlags_.no_saved_settings | imgui.WindowFlags_.no_docking
    )
    layout.push_no_ground()
    imgui.push_style_var(imgui.StyleVar_.window_padding, imgui.ImVec2(style.window_padding.x, around / 2))
    shown = imgui.internal.begin_viewport_side_bar(
        "##recovery", imgui.get_main_viewport(), imgui.Dir.up, height + around, flags
    )
    imgui.pop_style_var()
    asked: Request | None = None
    if shown:
        padding = 2 * style.frame_padding.x
        words = ("Restore", "Really discard", "Later")
        buttons = [imgui.calc_text_size(word).x + padding for word in words]
        imgui.align_text_to_frame_padding()
        imgui.text_colored(imgui.ImVec4(*theme.accent), "Unsaved work")
        imgui.set_item_tooltip("Facepin was left before this was saved.")
        imgui.same_line(0, 2 * style.item_spacing.x)
        later = imgui.get_window_width() - buttons[2] - style.window_padding.x
        imgui.begin_child(
            "rows", imgui.ImVec2(later - imgui.get_cursor_pos_x() - style.item_spacing.x, height)
        )
        for number, row in enumerate(rows):
            imgui.push_id(number)
            asked = _row(row, view, buttons, theme) or asked
            imgui.pop_id()
        imgui.end_child()
        imgui.same_line(later)
        if imgui.button("Later", imgui.ImVec2(buttons[2], 0)):
            view.shown, view.doomed = False, None
        imgui.set_item_tooltip(f"It stays where it is: File, {Command.UNSAVED_WORK.title}")
    imgui.end()
    layout.pop_no_ground()
    return asked


def _row(row: WorkRow, view: RecoveryView, buttons: Sequence[float], theme: Theme) -> Request | None:
    """Draw one piece of work; `buttons` are the widths of the longest words on its two."""
    asked: Request | None = None
    gap, em = imgui.get_style().item_spacing.x, imgui.get_font_size()
    imgui.align_text_to_frame_padding()
    end = imgui.get_content_region_avail().x - buttons[0] - buttons[1] - 2 * gap
    room = end - imgui.calc_text_size(row.about).x - 2 * gap
    imgui.text(shortened(row.name, max(room, 6 * em)))
    imgui.set_item_tooltip(f"{row.name}\n{row.about}")
    imgui.same_line(0, 2 * gap)
    imgui.text_colored(imgui.ImVec4(*theme.text_dim), shortened(row.about, end - imgui.get_cursor_pos_x()))
    imgui.same_line(end + gap)
    if imgui.button("Restore", imgui.ImVec2(buttons[0], 0)):
        asked = RestoreWork(row.draft)
    imgui.same_line()
    if view.doomed == row.draft:
        imgui.push_style_color(imgui.Col_.text, imgui.ImVec4(*theme.warning))
        if imgui.button("Really discard", imgui.ImVec2(buttons[1], 0)):
            asked = DiscardWork(row.draft)
            view.doomed = None
        imgui.pop_style_color()
    elif imgui.button("Discard", imgui.ImVec2(buttons[1], 0)):
        view.doomed = row.draft
    return asked


def lost_card(
    line: str, left: float, top: float, width: float, theme: Theme
) -> Command | CancelLoading | None:
    """Draw which rig is missing; return what the user does about it, or None.

    Parameters
    ----------
    line : str
        What was looked for and where.
    left, top, width : float
        Where the picture is, in imgui units.
    theme : Theme
        Colours.
    """
    begin_card("##lost", left, top, width, 36 * imgui.get_font_size())
    imgui.push_style_color(imgui.Col_.text, imgui.ImVec4(*theme.warning))
    imgui.text_wrapped(readable(line))
    imgui.pop_style_color()
    imgui.align_text_to_frame_padding()
    imgui.text_disabled("Drop the rig on the window, or")
    imgui.same_line()
    asked: Command | CancelLoading | None = None
    if imgui.button(Command.LOCATE_RIG.title):
        asked = Command.LOCATE_RIG
    imgui.same_line()
    if imgui.button("Cancel"):
        asked = CancelLoading()
    imgui.end()
    return asked


def begin_card(name: str, left: float, top: float, width: float, widest: float) -> None:
    """Begin a window at the top of the picture, as wide as it may be."""
    gap = 0.6 * imgui.get_font_size()
    imgui.set_next_window_pos(
        imgui.ImVec2(left + width / 2, top + gap), imgui.Cond_.always, imgui.ImVec2(0.5, 0.0)
    )
    imgui.set_next_window_size(imgui.ImVec2(max(min(width - 2 * gap, widest), gap), 0))
    imgui.begin(
        name,
        None,
        imgui.WindowFlags_.no_decoration
        | imgui.WindowFlags_.no_saved_settings
        | imgui.WindowFlags_.no_docking
        | imgui.WindowFlags_.no_move
        | imgui.WindowFlags_.no_focus_on_appearing
        | imgui.WindowFlags_.no_nav,
    )
