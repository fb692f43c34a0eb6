"""Menu items of how a pane shows its face, and how a menu is left."""

from imgui_bundle import imgui

from facepin.core.shading import MODES
from facepin.panels.requests import Command, key_of
from facepin.panels.view import Ghost, PaneView
from facepin.session.navigation import Habit

GHOSTS: dict[Ghost, str] = {
    "none": "No ghost",
    "neutral": "Ghost of the neutral",
    "reference": "Ghost of the reference",
}


def overlay_items(view: PaneView, habit: Habit, *, has_reference: bool) -> None:
    """Draw the shading of a pane and a menu item for each overlay, changed in place; `habit` has the keys."""
    if imgui.begin_menu("Shading"):
        for name, mode in MODES.items():
            shortcut = key_of(Command.HEAT, habit) if name == "heat" else None
            if imgui.menu_item_simple(mode.title, shortcut, selected=view.mode == name):
                view.mode = name
        imgui.separator()
        if imgui.menu_item_simple(Command.SHADING.title, key_of(Command.SHADING, habit)):
            view.next_mode()
        imgui.end_menu()
    if imgui.menu_item_simple(
        Command.WIREFRAME.title, key_of(Command.WIREFRAME, habit), selected=view.wireframe
    ):
        view.wireframe = not view.wireframe
    for ghost, title in GHOSTS.items():
        there = ghost != "reference" or has_reference
        shortcut = key_of(Command.GHOST, habit) if ghost == "none" else None
        if imgui.menu_item_simple(title, shortcut, selected=view.ghost == ghost, enabled=there):
            view.ghost = ghost


def close_on_escape() -> None:
    """Close the menu that is being drawn when Esc is pressed."""
    if imgui.is_key_pressed(imgui.Key.escape):
        imgui.close_current_popup()
