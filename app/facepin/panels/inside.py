"""Floating windows stay where they can be seen."""

from collections.abc import Iterable

from imgui_bundle import imgui


def bring_inside(names: Iterable[str]) -> None:
    """Move windows of these names back to where all of them is seen, or as much as there is room for.

    The main window may have become smaller, or the screen another one.  What the mouse holds is left to it.
    """
    if imgui.is_mouse_down(0):
        return
    area = imgui.get_main_viewport()
    left, top, room = area.work_pos.x, area.work_pos.y, area.work_size
    for name in names:
        window = imgui.internal.find_window_by_name(name)
        if window is None or not window.was_active:
            continue
        root = window.root_window_dock_tree  # of several that are docked together: what holds them all
        width, height = min(root.size.x, room.x), min(root.size.y, room.y)
        if (width, height) != (root.size.x, root.size.y) and not root.collapsed:
            imgui.internal.set_window_size(root, imgui.ImVec2(width, height))
        x = max(min(root.pos.x, left + room.x - width), left)
        y = max(min(root.pos.y, top + room.y - height), top)
        if (x, y) != (root.pos.x, root.pos.y):
            imgui.internal.set_window_pos(root, imgui.ImVec2(x, y))
