"""Menu items of how a pane shows its face, and how a menu is left."""

from imgui_bundle import imgui

from facepin.core.shading import MODES
from facepin.panels.requests import Command
from facepin.panels.view import Ghost, PaneView

GHOSTS: dict[Ghost, str] = {
    "none": "No ghost",
    "neutral": "Ghost of the neutral",
    "reference": "Ghost of the reference",
}


def overlay_items(view: PaneView, *, has_reference: bool) -> None:
    """Draw the shading of a pane and a menu item for each overlay, changed in place."""
    if imgui.begin_menu("Shading"):
        for name, mode in MODES.items():
            shortcut = Command.HEAT.shortcuts[0] if name == "heat" else None
            if imgui.menu_item_simple(mode.title, shortcut, selected=view.mode == name):
                view.mode = name
        imgui.separator()
        if imgui.menu_item_simple(Command.SHADING.title, Command.SHADING.shortcuts[0]):
            view.next_mode()
        imgui.end_menu()
    if imgui.menu_item_simple(
        Command.WIREFRAME.title, Command.WIREFRAME.shortcuts[0], selected=view.wireframe
    ):
        view.wireframe = not view.wireframe
    for ghost, title in GHOSTS.items():
        there = ghost != "reference" or has_reference
        shortcut = Command.GHOST.shortcuts[0] if ghost == "none" else None
        if imgui.menu_item_simple(title, shortcut, selected=view.ghost == ghost, enabled=there):
            view.ghost = ghost


def close_on_escape() -> None:
    """Close the menu that is being drawn when Esc is pressed."""
    if imgui.is_key_pressed(imgui.Key.escape):
        imgui.close_current_popup()
