"""Menu items of how a pane shows its face, and how a menu is left."""

from imgui_bundle import imgui

from facepin.core.look.shading import MODES
from facepin.panels.commands import Command, key_of
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


def explain_item(text: str) -> None:
    """Explain the menu item under the mouse, beside the menu: what stands below it stays to be read."""
    if imgui.is_item_hovered(imgui.HoveredFlags_.for_tooltip):
        gap = imgui.get_style().item_spacing.x / 2
        x = imgui.get_window_pos().x + imgui.get_window_width() + gap
        y = imgui.get_item_rect_min().y - imgui.get_style().window_padding.y
        imgui.set_next_window_pos(imgui.ImVec2(x, y))
        imgui.set_tooltip(text)
