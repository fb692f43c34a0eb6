"""The menu bar."""

from collections.abc import Sequence
from pathlib import Path

from imgui_bundle import imgui

from facepin.core.names import readable
from facepin.panels import layout
from facepin.panels.availability import is_on, title_of, why_not
from facepin.panels.commands import FACE_TURNS, VIEW_COMMANDS, Command, key_of
from facepin.panels.picture.overlays import close_on_escape, explain_item, overlay_items
from facepin.panels.pins import STROKES
from facepin.panels.plain_label import plain_label
from facepin.panels.requests import (
    AddPane,
    Choose,
    ClosePane,
    KeepPane,
    OpenPath,
    RandomReference,
    Request,
    ShowParts,
)
from facepin.panels.view import CHOICES, View
from facepin.resources import builtin_faces
from facepin.session.reference import RANDOM_SHAPES
from facepin.session.session import Session
from facepin.session.solving.solving import choose
from facepin.session.work import MOST_PANES
from facepin.solvers import SOLVERS

POSES_MENU = (
    (Command.SAVE_TO_LIBRARY, Command.TAKE_POSES),
    (Command.CONTACT_SHEET, Command.POSE_PICTURES, Command.TURNTABLE),
    (Command.FILMSTRIP, Command.SAVE_FILMSTRIP),
)


def menu_bar(
    view: View, recent: Sequence[Path], session: Session | None, *, has_leftovers: bool = False
) -> Request | None:
    """Draw the menu bar; return what the user asks for, or None.

    Parameters
    ----------
    view : View
        What is shown, changed in place.
    recent : paths
        Rigs and scenes opened lately, newest first.
    session : Session
        What is open, if anything; only read.
    has_leftovers : bool
        Whether there is unsaved work of former windows.
    """
    asked: Request | None = None
    layout.push_no_ground()
    shown = imgui.begin_main_menu_bar()
    layout.pop_no_ground()
    if not shown:
        return None
    if imgui.begin_menu("File"):
        close_on_escape()
        asked = _items(view, session, Command.OPEN_FILE, Command.OPEN_FOLDER) or asked
        if imgui.begin_menu("Open recent", bool(recent)):
            for number, path in enumerate(recent):
                if imgui.menu_item_simple(plain_label(path.name, number)):
                    asked = OpenPath(path)
                explain_item(readable(str(path)))
            imgui.end_menu()
        if imgui.begin_menu("Open a built-in face"):
            for name, path in builtin_faces().items():
                if imgui.menu_item_simple(name):
                    asked = OpenPath(path)
            imgui.end_menu()
        asked = _item(view, session, Command.UNSAVED_WORK, is_there=has_leftovers) or asked
        imgui.separator()
        asked = _items(view, session, Command.SAVE, Command.SAVE_AS) or asked
        imgui.separator()
        asked = _items(view, session, Command.LOAD_POSE, Command.SAVE_POSE, Command.EXPORT) or asked
        imgui.separator()
        asked = _items(view, session, Command.SCREENSHOT, Command.SCREENSHOT_PINS) or asked
        imgui.separator()
        asked = _items(view, session, Command.QUIT) or asked
        imgui.end_menu()
    if imgui.begin_menu("Edit"):
        close_on_escape()
        asked = _items(view, session, Command.UNDO, Command.REDO, Command.HISTORY) or asked
        imgui.separator()
        asked = _items(view, session, Command.COPY_POSE, Command.PASTE_POSE) or asked
        imgui.separator()
        asked = _items(view, session, Command.RESET_POSE, Command.TIDY) or asked
        imgui.separator()
        mirrored = (Command.SYMMETRY, Command.FLIP_POSE, Command.MIRROR_LEFT, Command.MIRROR_RIGHT)
        asked = _items(view, session, *mirrored) or asked
        imgui.end_menu()
    if imgui.begin_menu("Pins", session is not None) and session is not None:
        close_on_escape()
        asked = _pins(view, session) or asked
        imgui.end_menu()
    if imgui.begin_menu("Poses", session is not None):
        close_on_escape()
        for number, group in enumerate(POSES_MENU):
            if number:
                imgui.separator()
            asked = _items(view, session, *group) or asked
        imgui.end_menu()
    if imgui.begin_menu("Compare", session is not None) and session is not None:
        close_on_escape()
        asked = _compare(view, session) or asked
        imgui.end_menu()
    if imgui.begin_menu("View"):
        close_on_escape()
        asked = _items(view, session, Command.FRAME, *VIEW_COMMANDS, Command.ORTHOGRAPHIC) or asked
        imgui.separator()
        if session is not None:
            overlay_items(
                view.panes[session.active], view.habit, has_reference=session.work.reference is not None
            )
            asked = _items(view, session, Command.GAZE) or asked
            asked = _parts(view, session) or asked
            if imgui.begin_menu("Turn the face"):
                asked = _items(view, session, *FACE_TURNS) or asked
                imgui.end_menu()
            imgui.separator()
        asked = _choices(view, "quality") or asked
        imgui.end_menu()
    if imgui.begin_menu("Settings"):
        close_on_escape()
        for name in ("theme_name", "habit", "ui_scale"):
            asked = _choices(view, name) or asked
        imgui.separator()
        asked = _items(view, session, Command.RESET_LAYOUT) or asked
        imgui.end_menu()
    if imgui.begin_menu("Help"):
        close_on_escape()
        asked = _items(view, session, Command.PALETTE, Command.KEYBOARD, Command.GUIDE) or asked
        imgui.separator()
        asked = _items(view, session, Command.ABOUT) or asked
        imgui.end_menu()
    imgui.end_main_menu_bar()
    return asked


def _compare(view: View, session: Session) -> Request | None:
    """Draw the inside of the menu for several panes and the reference pose."""
    asked: Request | None = None
    if imgui.begin_menu("Add a pane", len(session.panes) < MOST_PANES):
        for key, kind in SOLVERS.items():
            if imgui.menu_item_simple(kind.title):
                asked = AddPane(choose(key, keep_limits=session.pane.choice.keep_limits))
        imgui.end_menu()
    several = len(session.panes) > 1
    if imgui.menu_item_simple("Keep the selected pane", enabled=several):
        asked = KeepPane(session.active)
    if imgui.menu_item_simple("Close the selected pane", enabled=several):
        asked = ClosePane(session.active)
    asked = _choices(view, "linked", several) or asked
    imgui.separator()
    asked = _items(view, session, Command.REFERENCE_FROM_POSE, Command.REFERENCE_FROM_FILE) or asked
    if imgui.begin_menu("Random reference"):
        for shapes in RANDOM_SHAPES:
            if imgui.menu_item_simple(f"of {shapes} shape{'s' if shapes > 1 else ''}"):
                asked = RandomReference(shapes)
        imgui.end_menu()
    asked = _items(view, session, Command.SHOW_REFERENCE, Command.FORGET_REFERENCE) or asked
    imgui.separator()
    return _items(view, session, Command.CHART) or asked


def _pins(view: View, session: Session) -> Request | None:
    """Draw the inside of the menu of pins."""
    of_selected = (Command.SELECT_PINS, Command.LOCK_PINS, Command.HIDE_PINS, Command.DELETE_PINS)
    asked: Request | None = _items(view, session, *of_selected, Command.SHOW_PINS, Command.CLEAR_PINS)
    imgui.separator()
    asked = _choices(view, "freedom") or asked
    asked = _items(view, session, Command.SKETCH_PINS) or asked
    if imgui.begin_menu("Pins along a stroke"):
        for count in range(STROKES[0], STROKES[1] + 1):
            if imgui.menu_item_simple(str(count), selected=view.pins.stroke == count):
                view.pins.stroke = count
        imgui.end_menu()
    imgui.separator()
    return _items(view, session, Command.SAVE_LANDMARKS, Command.LOAD_LANDMARKS) or asked


def _parts(view: View, session: Session) -> Request | None:
    """Draw the submenu of the parts of the mesh: each is shown or hidden, alone or all together."""
    asked: Request | None = None
    names = tuple(dict.fromkeys(part.name for part in session.rig.parts))
    hidden = view.hidden_parts
    if imgui.begin_menu("Parts", len(names) > 1 or bool(hidden)):
        if imgui.menu_item_simple("Show all", enabled=bool(hidden)):
            asked = ShowParts(frozenset())
        imgui.separator()
        for at, name in enumerate(names):
            if imgui.menu_item_simple(f"{name.replace('##', '# #')}##{at}", selected=name not in hidden):
                asked = ShowParts(hidden ^ {name})
            explain_item("What is hidden is neither drawn nor pressed; it goes on moving.")
        imgui.end_menu()
    return asked


def _items(view: View, session: Session | None, *commands: Command) -> Command | None:
    """Draw items of commands; return the one that was chosen."""
    chosen = [command for command in commands if _item(view, session, command)]
    return chosen[0] if chosen else None


def _item(view: View, session: Session | None, command: Command, *, is_there: bool = True) -> Command | None:
    """Draw the item of a command, with its key and what it does, or why it can't be done now."""
    reason, title = why_not(command, session), title_of(command, session)
    chosen = imgui.menu_item_simple(
        plain_label(title, 0) if title != command.title else title,
        key_of(command, view.habit) or None,
        selected=is_there and is_on(command, view, session.active if session else 0),
        enabled=is_there and not reason,
    )
    explain_item(f"{command.help}\nNot now: {reason}." if reason else command.help)
    return command if chosen else None


def _choices(view: View, name: str, enabled: bool = True) -> Choose | None:
    """Draw the submenu of one of the choices."""
    choice, chosen = CHOICES[name], None
    if imgui.begin_menu(choice.title, enabled):
        for value, title in choice.values.items():
            if imgui.menu_item_simple(title, selected=getattr(view, name) == value):
                chosen = Choose(name, value)
            explain_item(choice.help)
        imgui.end_menu()
    return chosen
