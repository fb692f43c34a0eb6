"""The command palette: everything the program can do, found by some of its letters."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from imgui_bundle import imgui

from facepin.core.fuzzy import match
from facepin.core.look.shading import MODES
from facepin.core.names import readable
from facepin.core.saved_pose import SavedPose
from facepin.panels.availability import is_on, title_of, why_not
from facepin.panels.commands import Command, key_of
from facepin.panels.help.key_caps import caps_width, draw_caps
from facepin.panels.library.requests import ApplyPose
from facepin.panels.requests import (
    AddPane,
    Choose,
    ClosePane,
    CopyShapes,
    KeepPane,
    OpenPath,
    PasteShapes,
    RandomReference,
    Request,
    ShadeAs,
    ShowParts,
    UseSolver,
)
from facepin.panels.theme import Theme, dim_sentence, packed
from facepin.panels.view import CHOICES, PaletteView, View
from facepin.resources import builtin_faces
from facepin.session.reference import RANDOM_SHAPES
from facepin.session.session import Session
from facepin.session.solving.solving import choose
from facepin.session.work import MOST_PANES
from facepin.solvers import SOLVERS

ROWS = 11
"""Actions seen at once."""
WIDTH = 38.0
"""Of the window, in heights of a letter."""
IN_HELP = 4.0
"""What each letter of a word is worth that stands in the help of an action: less than one in its title, more
than letters that are scattered there."""
LATELY = 3.0
"""What it is worth at most that an action was chosen lately."""


@dataclass(frozen=True)
class Entry:
    """One action."""

    title: str
    topic: str
    request: Request
    help: str = ""
    key: str = ""
    reason: str = ""
    """Why it can't be done now, if it can't."""
    on: bool = False
    """Whether it is what is chosen already."""


def entries(
    view: View, session: Session | None, recent: Sequence[Path], poses: Sequence[SavedPose] = ()
) -> list[Entry]:
    """List all actions there are, in the order of the table of commands; then what has a few values each."""
    found = [_command(command, view, session) for command in Command if command is not Command.PALETTE]
    if session is not None:
        found += _solvers(view, session)
        mode = view.panes[session.active].mode
        found += [
            Entry(f"Shading: {kind.title}", "View", ShadeAs(name), on=name == mode)
            for name, kind in MODES.items()
        ]
        found += _parts(view, session)
    for name, choice in CHOICES.items():
        for value, title in choice.values.items():
            on = getattr(view, name) == value
            found.append(
                Entry(f"{choice.title}: {title}", "Settings", Choose(name, value), choice.help, on=on)
            )
    if session is not None:
        for group in view.weights.listing(session.rig).groups("by region"):
            shapes = tuple(group.shapes.tolist())
            about = f"The shapes of one region, {group.name}, alone."
            copy, paste = CopyShapes(group.name, shapes), PasteShapes(group.name, shapes)
            found.append(Entry(f"Copy {group.name}", "Edit", copy, about))
            found.append(Entry(f"Paste into {group.name}", "Edit", paste, about))
        found += [Entry(f"Pose: {pose.title}", "Poses", ApplyPose(pose.key), _words(pose)) for pose in poses]
    found += [
        Entry(f"Open the face {name}", "Built in", OpenPath(path)) for name, path in builtin_faces().items()
    ]
    found += [
        Entry(readable(f"Open {path.name}"), "Recent", OpenPath(path), readable(str(path))) for path in recent
    ]
    return found


def _parts(view: View, session: Session) -> list[Entry]:
    """List what can be done with the parts of the mesh."""
    hidden, names = view.hidden_parts, dict.fromkeys(part.name for part in session.rig.parts)
    found = [
        Entry(f"{'Show' if name in hidden else 'Hide'} the part {name}", "View", ShowParts(hidden ^ {name}))
        for name in names
        if len(names) > 1
    ]
    reason = "" if hidden else "none is hidden"
    return [*found, Entry("Show all parts", "View", ShowParts(frozenset()), reason=reason)]


def _words(pose: SavedPose) -> str:
    """Say what choosing a pose of the library does; its tags find it too."""
    tags = f" ({', '.join(pose.tags)})" if pose.tags else ""
    return f"Puts this pose of the library on the face{tags}."


def _command(command: Command, view: View, session: Session | None) -> Entry:
    key, reason = key_of(command, view.habit), why_not(command, session)
    on = is_on(command, view, session.active if session else 0)
    return Entry(title_of(command, session), command.topic, command, command.help, key, reason, on)


def _solvers(view: View, session: Session) -> list[Entry]:
    """List what can be done with solvers, panes and random references."""
    choice, shown = session.pane.choice, view.panes[session.active]
    full = f"there are {MOST_PANES} panes" if len(session.panes) >= MOST_PANES else ""
    alone = "" if len(session.panes) > 1 else "there is one pane"
    found = [
        Entry(
            f"Solver: {other.title}",
            "Solver",
            UseSolver(session.active, shown.choice(key, choice)),
            other.summary,
            on=other is choice.kind,
        )
        for key, other in SOLVERS.items()
    ]
    found += [
        Entry(
            f"Add a pane: {other.title}",
            "Compare",
            AddPane(choose(key, keep_limits=choice.keep_limits)),
            other.summary,
            reason=full,
        )
        for key, other in SOLVERS.items()
    ]
    found += [
        Entry("Keep the selected pane", "Compare", KeepPane(session.active), reason=alone),
        Entry("Close the selected pane", "Compare", ClosePane(session.active), reason=alone),
    ]
    found += [
        Entry(
            f"Random reference of {shapes} shape{'s' if shapes > 1 else ''}",
            "Compare",
            RandomReference(shapes),
            "Errors are then measured against a pose made by chance.",
        )
        for shapes in RANDOM_SHAPES
    ]
    return found


def ranked(found: Sequence[Entry], query: str, lately: Sequence[str]) -> list[tuple[Entry, frozenset[int]]]:
    """Return the actions that fit a query, best first, each with the letters of its title that were found.

    Without a query all fit, those that were chosen lately first.  A word may stand in the title (some of its
    letters will do), or whole in the help.
    """
    fitting: list[tuple[float, int, Entry, frozenset[int]]] = []
    for at, entry in enumerate(found):
        worth, letters = 0.0, set[int]()
        for word in query.split():
            way = match(word, entry.title)
            explained = len(word) > 2 and word.lower() in f"{entry.topic} {entry.help}".lower()
            if way is not None and not (explained and way[0] < IN_HELP * len(word)):
                worth += way[0]
                letters.update(way[1])
            elif explained:
                worth += IN_HELP * len(word)
            else:
                break
        else:
            name = _plain(entry)
            if name in lately:
                place = lately.index(name)
                worth += LATELY / (1 + place) if query.strip() else 1000.0 - place
            fitting.append((-worth, at, entry, frozenset(letters)))
    return [(entry, letters) for _, _, entry, letters in sorted(fitting, key=lambda one: one[:2])]


def _plain(entry: Entry) -> str:
    """Return the name that an action is remembered by: a command's own, whatever it would undo."""
    return entry.request.title if isinstance(entry.request, Command) else entry.title


def palette(
    view: View,
    session: Session | None,
    recent: Sequence[Path],
    poses: Sequence[SavedPose],
    scale: float,
) -> Request | None:
    """Draw the command palette while it is open; return what the user chose, or None.

    Parameters
    ----------
    view : View
        Holds what was typed; changed in place.
    session : Session
        What is open, if anything; only read.
    recent : sequence of Path
        Rigs opened lately.
    poses : sequence of SavedPose
        The library.
    scale : float
        imgui units per pixel of a 1x screen.
    """
    state = view.palette
    if state is None:
        return None
    found = entries(view, session, recent, poses)
    fitting = ranked(found, state.query, view.lately)
    state.row = min(state.row, max(len(fitting) - 1, 0))
    area = imgui.get_main_viewport()
    row = imgui.get_frame_height()
    wide = min(WIDTH * imgui.get_font_size(), area.work_size.x - 2 * row)
    middle = imgui.ImVec2(area.work_pos.x + area.work_size.x / 2, area.work_pos.y + 2 * row)
    imgui.set_next_window_pos(middle, imgui.Cond_.always, imgui.ImVec2(0.5, 0.0))
    imgui.set_next_window_size(imgui.ImVec2(wide, 0))
    imgui.push_style_color(imgui.Col_.window_bg, imgui.get_style_color_vec4(imgui.Col_.popup_bg))
    imgui.push_style_var(imgui.StyleVar_.window_rounding, 6 * scale)
    flags = imgui.WindowFlags_.no_decoration | imgui.WindowFlags_.no_saved_settings
    imgui.begin("##palette", None, flags | imgui.WindowFlags_.no_docking | imgui.WindowFlags_.no_move)
    imgui.pop_style_var()
    imgui.pop_style_color()
    if state.fresh:
        imgui.set_window_focus()
        imgui.set_keyboard_focus_here()
    leaves = not state.fresh and not imgui.is_window_focused(imgui.FocusedFlags_.root_and_child_windows)
    state.fresh = False
    imgui.set_next_item_width(-1)
    entered, query = imgui.input_text_with_hint(
        "##query", "What do you want to do?", state.query, imgui.InputTextFlags_.enter_returns_true
    )
    if query != state.query:
        state.query, state.row = query, 0
        fitting = ranked(found, state.query, view.lately)
    step = _steps()
    if step and fitting:
        at, last = state.row + step, len(fitting) - 1
        # A page ends at the ends, a single step goes round.
        state.row = min(max(at, 0), last) if abs(step) > 1 else at % (last + 1)
    clicked = _rows(state, fitting, view.theme, scale, jumped=bool(step))
    _foot(fitting[state.row][0] if fitting else None)
    imgui.end()
    if imgui.is_key_pressed(imgui.Key.escape, False) or leaves:
        view.palette = None
        return None
    if not ((entered or clicked) and fitting):
        return None
    chosen = fitting[state.row][0]
    if chosen.reason:
        state.fresh = True  # Enter has left the field
        return None
    view.palette = None
    name = _plain(chosen)
    view.lately = (name, *(other for other in view.lately if other != name))[:ROWS]
    return chosen.request


def _steps() -> int:
    """Return how far the arrow keys go in this frame."""
    steps = {
        imgui.Key.down_arrow: 1,
        imgui.Key.up_arrow: -1,
        imgui.Key.page_down: ROWS - 1,
        imgui.Key.page_up: 1 - ROWS,
    }
    return sum(step for key, step in steps.items() if imgui.is_key_pressed(key))


def _rows(
    state: PaletteView,
    fitting: Sequence[tuple[Entry, frozenset[int]]],
    theme: Theme,
    scale: float,
    *,
    jumped: bool,
) -> bool:
    """Draw the list; return whether a row was clicked, which is then the chosen one."""
    clicked = False
    line, row = imgui.get_text_line_height(), imgui.get_frame_height()
    gap = imgui.get_style().item_spacing.y
    imgui.begin_child("rows", imgui.ImVec2(-1, ROWS * (row + gap) - gap))
    if not fitting:
        imgui.align_text_to_frame_padding()
        imgui.text_disabled("Nothing is called that.")
    draw = imgui.get_window_draw_list()
    mouse = imgui.get_io().mouse_delta
    for at, (entry, letters) in enumerate(fitting):
        pressed, _ = imgui.selectable(f"##{at}", at == state.row, 0, imgui.ImVec2(0, row))
        if imgui.is_item_hovered() and (mouse.x or mouse.y):
            state.row = at
        if pressed:
            state.row, clicked = at, True
        if at == state.row and jumped and not imgui.is_item_visible():
            imgui.set_scroll_here_y(1.0 if at else 0.0)
        low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
        middle = (low.y + high.y) / 2
        left = low.x + 0.6 * line
        if entry.on:
            imgui.internal.render_check_mark(
                draw, imgui.ImVec2(left, middle - 0.35 * line), packed(theme.accent), 0.7 * line
            )
        colour = theme.text_dim if entry.reason else theme.text
        _title(draw, left + 1.1 * line, middle - line / 2, entry.title, letters, theme, packed(colour))
        right = high.x - 0.6 * line
        if entry.key:
            right -= caps_width(entry.key, scale)
            draw_caps(draw, right, middle, entry.key, theme, scale)
            right -= line
        beside = entry.reason or entry.topic
        x = right - imgui.calc_text_size(beside).x
        draw.add_text(imgui.ImVec2(x, middle - line / 2), packed(theme.text_dim), beside)
    imgui.end_child()
    return clicked


def _title(
    draw: imgui.ImDrawList, x: float, y: float, title: str, letters: frozenset[int], theme: Theme, colour: int
) -> None:
    """Write a title, the letters that were found in the accent's colour."""
    start = 0
    for end in range(1, len(title) + 1):
        if end == len(title) or (end in letters) != (start in letters):
            run = title[start:end]
            draw.add_text(imgui.ImVec2(x, y), packed(theme.accent) if start in letters else colour, run)
            x += imgui.calc_text_size(run).x
            start = end


def _foot(chosen: Entry | None) -> None:
    """Say what the chosen action does."""
    imgui.separator()
    text = "" if chosen is None else chosen.help or chosen.title
    if chosen is not None and chosen.reason:
        text = f"Not now: {chosen.reason}."
    imgui.begin_child("help", imgui.ImVec2(-1, 2 * imgui.get_text_line_height()))
    dim_sentence(text)
    imgui.end_child()
