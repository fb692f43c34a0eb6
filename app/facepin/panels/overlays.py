"""Menu items of what a pane shows over its face, and how a menu is left."""

from imgui_bundle import imgui

from facepin.panels.requests import Command, key_of
from facepin.panels.view import Ghost, PaneView
from facepin.session.navigation import Habit

GHOSTS: dict[Ghost, str] = {
    "none": "No ghost",
    "neutral": "Ghost of the neutral",
    "reference": "Ghost of the reference",
}


def overlay_items(view: PaneView, habit: Habit, *, has_reference: bool) -> None:
    """Draw a menu item for each overlay of a pane, changed in place; `habit` has the keys."""
    if imgui.menu_item_simple(Command.HEAT.title, key_of(Command.HEAT, habit), selected=view.heat):
        view.heat = not view.heat
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
