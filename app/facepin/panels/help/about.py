"""What program this is: version, licences, the paper, and what a report of a fault should say."""

import platform

from imgui_bundle import imgui

from facepin import __version__

TITLE = "About Facepin"
PAPER = (
    "Ozan Cetinaslan, John Lewis, Verónica Orvalho:\nTransposition Based Blendshape Direct Manipulation, 2017"
)


def about_window(graphics: str, scale: float) -> bool:
    """Draw the window; return whether it stays open.

    Parameters
    ----------
    graphics : str
        The graphics driver and its version.
    scale : float
        imgui units per pixel of a 1x screen.
    """
    view = imgui.get_main_viewport()
    middle = imgui.ImVec2(view.pos.x + view.size.x / 2, view.pos.y + view.size.y / 2)
    imgui.set_next_window_pos(middle, imgui.Cond_.appearing, imgui.ImVec2(0.5, 0.5))
    flags = (
        imgui.WindowFlags_.always_auto_resize
        | imgui.WindowFlags_.no_saved_settings
        | imgui.WindowFlags_.no_docking
        | imgui.WindowFlags_.no_collapse
    )
    shown, stays = imgui.begin(TITLE, True, flags)
    facts = {
        "Version": __version__,
        "Graphics": graphics,
        "System": f"{platform.system()} {platform.release()}, Python {platform.python_version()}, "
        f"Dear ImGui {imgui.get_version()}",
        "Licence": "MIT",
        "Font": "Roboto, Apache License 2.0",
    }
    stays = stays and not imgui.is_key_pressed(imgui.Key.escape, False)
    if shown:
        imgui.text("Poses a blendshape face by pinning points on it and dragging them.")
        imgui.dummy(imgui.ImVec2(0, 4 * scale))
        if imgui.begin_table("facts", 2, imgui.TableFlags_.sizing_fixed_fit):
            for name, value in facts.items():
                imgui.table_next_row()
                imgui.table_next_column()
                imgui.text_disabled(name)
                imgui.table_next_column()
                imgui.text(value)
            imgui.table_next_row()
            imgui.table_next_column()
            imgui.text_disabled("After")
            imgui.table_next_column()
            imgui.text(PAPER)
            imgui.end_table()
        imgui.dummy(imgui.ImVec2(0, 4 * scale))
        if imgui.button("Copy"):
            imgui.set_clipboard_text("\n".join(f"{name}: {value}" for name, value in facts.items()))
        imgui.set_item_tooltip("Puts these lines on the clipboard, for a report of a fault.")
    imgui.end()
    return bool(stays)
