"""The menu bar and the menu of a pin."""

from collections.abc import Sequence
from pathlib import Path

from imgui_bundle import imgui

from facepin.core.pose import Freedom, Pin
from facepin.panels import layout
from facepin.panels.overlays import close_on_escape, overlay_items
from facepin.panels.requests import (
    AddPane,
    ClosePane,
    Command,
    KeepPane,
    OpenPath,
    RandomReference,
    Request,
    SetPin,
)
from facepin.panels.view import View
from facepin.session.session import MOST_PANES, Session
from facepin.session.solving import choose
from facepin.solvers import SOLVERS

FREEDOMS: dict[Freedom, str] = {
    "space": "Hold in space (x, y and z)",
    "screen": "Hold on screen (depth free)",
}

RANDOM_SHAPES = (1, 2, 4, 8, 12)
"""Sizes of random reference poses on offer."""


def menu_bar(view: View, recent: Sequence[Path], session: Session | None) -> Request | None:
    """Draw the menu bar; return what the user asks for, or None.

    Parameters
    ----------
    view : View
        What is shown, changed in place.
    recent : paths
        Rigs opened lately, newest first.
    session : Session
        What is open, if anything; only read.
    """
    undo = session.undo_label if session else None
    redo = session.redo_label if session else None
    pins = len(session.pose.pins) if session else 0
    asked: Request | None = None
    layout.push_no_ground()
    shown = imgui.begin_main_menu_bar()
    layout.pop_no_ground()
    if not shown:
        return None
    if imgui.begin_menu("File"):
        close_on_escape()
        asked = _item(Command.OPEN_FILE) or _item(Command.OPEN_FOLDER) or asked
        if imgui.begin_menu("Open recent", bool(recent)):
            for path in recent:
                if imgui.menu_item_simple(f"{path.name}##{path}"):
                    asked = OpenPath(path)
                imgui.set_item_tooltip(str(path))
            imgui.end_menu()
        asked = _item(Command.OPEN_BUILTIN) or asked
        imgui.separator()
        for command in (Command.LOAD_POSE, Command.SAVE_POSE, Command.EXPORT):
            asked = _item(command) or asked
        imgui.separator()
        for command in (Command.SCREENSHOT, Command.SCREENSHOT_PINS):
            asked = _item(command, session is not None) or asked
        imgui.separator()
        asked = _item(Command.QUIT) or asked
        imgui.end_menu()
    if imgui.begin_menu("Edit"):
        close_on_escape()
        asked = _item(Command.UNDO, undo is not None, undo) or asked
        asked = _item(Command.REDO, redo is not None, redo) or asked
        imgui.separator()
        asked = _item(Command.DELETE_PINS, bool(pins)) or asked
        asked = _item(Command.CLEAR_PINS, bool(pins)) or asked
        asked = _item(Command.RESET_POSE) or asked
        imgui.separator()
        if imgui.begin_menu("New pins"):
            for freedom, title in FREEDOMS.items():
                if imgui.menu_item_simple(title, selected=view.freedom == freedom):
                    view.freedom = freedom
            imgui.end_menu()
        imgui.end_menu()
    if imgui.begin_menu("Compare", session is not None) and session is not None:
        close_on_escape()
        asked = _compare(view, session) or asked
        imgui.end_menu()
    if imgui.begin_menu("View"):
        close_on_escape()
        for command in (Command.FRAME, Command.FRONT, Command.LEFT, Command.RIGHT, Command.THREE_QUARTER):
            asked = _item(command) or asked
        imgui.separator()
        if session is not None:
            overlay_items(view.panes[session.active], has_reference=session.work.reference is not None)
            imgui.separator()
        if imgui.begin_menu("Smooth edges"):
            for quality, title in view.QUALITIES.items():
                if imgui.menu_item_simple(title, selected=view.quality == quality):
                    view.quality = quality
            imgui.end_menu()
        if imgui.begin_menu("Interface size"):
            for factor in (0.8, 1.0, 1.25, 1.5, 2.0):
                if imgui.menu_item_simple(f"{factor:.0%}", selected=view.ui_scale == factor):
                    view.ui_scale = factor
            imgui.end_menu()
        asked = _item(Command.RESET_LAYOUT) or asked
        imgui.end_menu()
    imgui.end_main_menu_bar()
    return asked


def _compare(view: View, session: Session) -> Request | None:
    """Draw the inside of the menu for several panes and the reference pose."""
    asked: Request | None = None
    if imgui.begin_menu("Add a pane", len(session.panes) < MOST_PANES):
        for key, kind in SOLVERS.items():
            if imgui.menu_item_simple(kind.title):
                asked = AddPane(choose(key))
        imgui.end_menu()
    several = len(session.panes) > 1
    if imgui.menu_item_simple("Keep the selected pane", enabled=several):
        asked = KeepPane(session.active)
    if imgui.menu_item_simple("Close the selected pane", enabled=several):
        asked = ClosePane(session.active)
    if imgui.menu_item_simple("One camera for all panes", selected=view.linked, enabled=several):
        view.linked = not view.linked
    imgui.separator()
    for command in (Command.REFERENCE_FROM_POSE, Command.REFERENCE_FROM_FILE):
        asked = _item(command) or asked
    if imgui.begin_menu("Random reference"):
        for shapes in RANDOM_SHAPES:
            if imgui.menu_item_simple(f"of {shapes} shape{'s' if shapes > 1 else ''}"):
                asked = RandomReference(shapes)
        imgui.end_menu()
    asked = _item(Command.FORGET_REFERENCE, session.work.reference is not None) or asked
    imgui.separator()
    return _item(Command.CHART) or asked


def pin_menu(pin: Pin) -> SetPin | None:
    """Draw the inside of the menu of a pin; return what the user changes, or None."""
    request = None
    close_on_escape()
    imgui.text_disabled(f"Pin on vertex {pin.vertex}")
    imgui.separator()
    for freedom, title in FREEDOMS.items():
        if imgui.menu_item_simple(title, selected=pin.freedom == freedom) and pin.freedom != freedom:
            request = SetPin(pin.vertex, freedom=freedom)
    imgui.set_next_item_width(9 * imgui.get_font_size())
    flags = imgui.SliderFlags_.logarithmic | imgui.SliderFlags_.always_clamp
    changed, stiffness = imgui.slider_float("stiffness", pin.stiffness, 0.01, 100.0, "%.2f", flags)
    if changed or imgui.is_item_deactivated_after_edit():
        request = SetPin(pin.vertex, stiffness=stiffness, final=imgui.is_item_deactivated_after_edit())
    imgui.separator()
    if imgui.menu_item_simple("Remove", "Delete"):
        request = SetPin(pin.vertex, remove=True)
    return request


def _item(command: Command, enabled: bool = True, detail: str | None = None) -> Command | None:
    title = f"{command.title}: {detail}" if detail else command.title
    shortcut = command.shortcuts[0] if command.shortcuts else None
    return command if imgui.menu_item_simple(title, shortcut, enabled=enabled) else None
