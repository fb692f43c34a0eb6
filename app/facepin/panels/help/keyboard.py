"""The keyboard map: all keys, and what the mouse does, on one page."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import get_args

from imgui_bundle import imgui

from facepin.core.events import Button, Modifiers
from facepin.panels.commands import Command, Topic, keys_of
from facepin.panels.help.key_caps import caps_width, draw_caps
from facepin.panels.theme import Theme, packed
from facepin.session.navigation import PRESETS, Habit, Motion, dolly, orbit, pan

COLUMN = 25.0
"""Width of a column, in heights of a letter."""

ABOVE = 0.8
"""Room above a heading, in lines."""

Line = tuple[tuple[str, ...], str]
"""Keys or gestures that do the same, and what they do."""

HAND: tuple[Line, ...] = (
    (("Click on the face",), "Place a pin"),
    (("Drag",), "Move a pin: the face follows"),
    (("Hold Shift",), "Drag a fifth as fast; X, Y: on a line"),
    (("Wheel",), "In a drag: carry near pins along"),
    (("Tab",), "Other lip or lid under the mouse"),
    (("Shift+Click a pin",), "Select one more"),
    (("Right click a pin",), "What it holds; lock, hide"),
    (("Arrows",), "Nudge selected pins; Shift: tenfold"),
    (("Page up", "Page down"), "Nudge them away, nearer"),
    (("Esc",), "Give up the drag in hand"),
    (("Hold Ctrl",), "Which shapes move this point"),
)
"""What the hand does on the face."""
BOX = "Select pins in a box"
SLIDERS: tuple[Line, ...] = (
    (("Drag",), "Set the weight; Shift: finer"),
    (("Ctrl+Wheel", "Arrows"), "Step up or down"),
    (("Enter", "Ctrl+Click"), "Type a number"),
    (("Double click",), "Back to 0; on the number: type"),
)
"""What the mouse does on a weight."""


POSES: tuple[Line, ...] = (
    (("Click",), "Put it on the face"),
    (("Shift+Click",), "Add it to the face"),
    (("Alt+Drag",), "Blend it in, in part"),
    (("Ctrl+Click",), "Select; two can be compared"),
)
"""What the mouse does on a saved pose."""


@dataclass(frozen=True)
class Section:
    """Some lines under a heading."""

    title: str
    lines: tuple[Line, ...]

    @property
    def height(self) -> float:
        """In lines; there is room above the next heading."""
        return len(self.lines) + 1 + ABOVE


def sections(habit: Habit) -> list[Section]:
    """Return all keys and gestures that someone with a habit has."""
    boxes: tuple[str, ...] = ("Ctrl+Drag",)
    if ("left", Modifiers()) not in PRESETS[habit].motions:
        boxes = ("Drag beside the face", *boxes)
    found = [
        Section("On the face", (*HAND, (boxes, BOX))),
        Section(f"Camera, as in {PRESETS[habit].title}", _camera(habit)),
        Section("On a weight", SLIDERS),
        Section("On a saved pose", POSES),
    ]
    for topic in get_args(Topic):
        lines = tuple(
            (keys_of(command, habit), command.title.rstrip("…"))
            for command in Command
            if command.topic == topic and keys_of(command, habit)
        )
        if lines:
            found.append(Section(topic, lines))
    return found


def _camera(habit: Habit) -> tuple[Line, ...]:
    """Read the gestures off the table that the mouse obeys."""
    titles: dict[Motion, str] = {orbit: "Turn", pan: "Shift", dolly: "Come closer"}
    ways: dict[str, list[str]] = {title: [] for title in titles.values()}
    for (button, modifiers), motion in PRESETS[habit].motions.items():
        ways[titles[motion]].append(_gesture(button, modifiers))
    ways["Come closer"].insert(0, "Wheel")
    return tuple((tuple(found), title) for title, found in ways.items() if found)


def _gesture(button: Button, modifiers: Modifiers) -> str:
    keys = ["Ctrl"] * modifiers.control + ["Shift"] * modifiers.shift + ["Alt"] * modifiers.alt
    return "+".join([*keys, f"{button.capitalize()} drag"])


def in_columns(found: Sequence[Section], count: int) -> list[list[Section]]:
    """Share sections out among columns, in order, so that the longest column is as short as can be."""
    if count == 1 or len(found) <= 1:
        return [list(found)]
    ways = [[list(found[:at]), *in_columns(found[at:], count - 1)] for at in range(1, len(found))]
    return min(ways, key=lambda columns: max(height(column) for column in columns))


def height(column: Sequence[Section]) -> float:
    """Return the height of a column, in lines."""
    return sum(section.height for section in column)


def keyboard_map(habit: Habit, theme: Theme, scale: float) -> bool:
    """Draw the map over the window; return whether it stays."""
    area = imgui.get_main_viewport()
    em = imgui.get_font_size()
    padding, margin = 1.4 * em, 1.2 * em
    room = imgui.ImVec2(area.work_size.x - 2 * margin, area.work_size.y - 2 * margin)
    found = sections(habit)
    count = int(max(1, min(3, (room.x - padding) // (COLUMN * em + padding))))
    columns = in_columns(found, count)
    lines = max(height(column) for column in columns) - ABOVE
    line = min(1.6 * em, max((room.y - 2 * padding) / lines, 1.3 * em))  # closer before it has to be scrolled
    tall = lines * line
    size = imgui.ImVec2(
        min(len(columns) * (COLUMN * em + padding) + padding, room.x), min(tall + 2 * padding, room.y)
    )
    middle = imgui.ImVec2(area.work_pos.x + area.work_size.x / 2, area.work_pos.y + area.work_size.y / 2)
    imgui.set_next_window_pos(middle, imgui.Cond_.always, imgui.ImVec2(0.5, 0.5))
    imgui.set_next_window_size(size)
    imgui.push_style_color(imgui.Col_.window_bg, imgui.get_style_color_vec4(imgui.Col_.popup_bg))
    imgui.push_style_var(imgui.StyleVar_.window_rounding, 6 * scale)
    imgui.push_style_var(imgui.StyleVar_.window_padding, imgui.ImVec2(padding, padding))
    flags = (
        imgui.WindowFlags_.no_title_bar
        | imgui.WindowFlags_.no_resize
        | imgui.WindowFlags_.no_move
        | imgui.WindowFlags_.no_collapse
        | imgui.WindowFlags_.no_saved_settings
        | imgui.WindowFlags_.no_docking
    )
    imgui.begin("##keyboard", None, flags)
    imgui.pop_style_var(2)
    imgui.pop_style_color()
    if imgui.is_window_appearing():
        imgui.set_window_focus()
    start = imgui.get_cursor_screen_pos()
    wide = (imgui.get_content_region_avail().x - padding * (len(columns) - 1)) / len(columns)
    for number, column in enumerate(columns):
        y = start.y
        for section in column:
            _section(section, start.x + number * (wide + padding), y, wide, line, theme, scale)
            y += section.height * line
    imgui.dummy(imgui.ImVec2(1, tall))
    stays = imgui.is_window_focused() and not imgui.is_key_pressed(imgui.Key.escape, False)
    imgui.end()
    return stays


def _section(
    section: Section, x: float, y: float, wide: float, line: float, theme: Theme, scale: float
) -> None:
    """Draw one section with its upper left corner at (x, y)."""
    draw = imgui.get_window_draw_list()
    letter = imgui.get_text_line_height()
    draw.add_text(imgui.ImVec2(x, y + (line - letter) / 2), packed(theme.accent), section.title)
    y += line
    for keys, what in section.lines:
        middle = y + line / 2
        draw.add_line(imgui.ImVec2(x, y), imgui.ImVec2(x + wide, y), packed(theme.ink, 0.08), scale)
        draw.add_text(imgui.ImVec2(x, middle - letter / 2), packed(theme.text), what)
        room = wide - imgui.calc_text_size(what).x - letter
        right = x + wide
        for number, key in enumerate(_fitting(keys, room, scale)):
            if number:
                right -= 0.5 * letter
            right -= caps_width(key, scale)
            draw_caps(draw, right, middle, key, theme, scale)
        y += line


def _fitting(keys: Sequence[str], room: float, scale: float) -> list[str]:
    """Return as many keys as there is room for, the most important one last: it stands at the left."""
    gap = 0.5 * imgui.get_text_line_height()
    found = [keys[0]]
    for key in keys[1:]:
        if sum(caps_width(other, scale) + gap for other in (*found, key)) > room:
            break
        found.append(key)
    return found[::-1]
