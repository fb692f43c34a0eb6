"""The card that shows a tidied pose before it is taken."""

from dataclasses import dataclass

import numpy as np
from imgui_bundle import imgui

from facepin.core.arrays import Floats
from facepin.core.shapes.measures import active
from facepin.panels.requests import LeaveTidy, Request, TakeTidy, Tidy
from facepin.panels.theme import Theme, dim_sentence

LABEL = "Tidy the pose"
WINDOW = f"{LABEL}###tidy"
"""Name of the undo step, and of the edit while it is only shown."""
WIDTH = 300.0
"""Of the card, in pixels at 1x scale."""
LEAST, MOST = 0.1, 5.0
"""Range of the tolerance, in per cent of the face height."""


@dataclass(frozen=True, eq=False)
class Tidied:
    """What the card tells."""

    before: Floats
    """(k,) weights that are tidied up."""
    after: Floats
    """(k,) weights that are shown."""
    moved: float
    """Largest move of a pin, or without pins of the face, in per cent of the face height."""
    pins: int


def tidy_card(
    tidied: Tidied, tolerance: float, left: float, top: float, scale: float, theme: Theme
) -> Request | None:
    """Draw the card at the top left of the picture; return what the user wants.

    Parameters
    ----------
    tolerance : float
        In per cent of the face height.
    left, top : float
        Where the picture begins, in imgui units.
    scale : float
        imgui units per pixel of a 1x screen.
    """
    inset = 12 * scale
    imgui.set_next_window_pos(imgui.ImVec2(left + inset, top + inset), imgui.Cond_.appearing)
    imgui.set_next_window_size(imgui.ImVec2(WIDTH * scale, 0))
    flags = (
        imgui.WindowFlags_.no_resize
        | imgui.WindowFlags_.no_collapse
        | imgui.WindowFlags_.no_saved_settings
        | imgui.WindowFlags_.no_docking
    )
    shown, stays = imgui.begin(WINDOW, True, flags)
    asked: Request | None = None
    if shown:
        was, now = active(tidied.before), active(tidied.after)
        same = np.array_equal(tidied.before, tidied.after)
        imgui.text(f"{was} shapes in use" if same else f"{was} shapes become {now}")
        what = {0: "the face", 1: "the pin", 2: "both pins"}.get(tidied.pins, f"all {tidied.pins} pins")
        if same:
            dim_sentence(f"No fewer shapes keep {what} within {tolerance:.2g} %.")
        else:
            dim_sentence(f"They keep {what} within {tidied.moved:.2f} % of the face's height.")
        imgui.set_next_item_width(-1)
        flag = imgui.SliderFlags_.logarithmic | imgui.SliderFlags_.always_clamp
        changed, new = imgui.slider_float("##tolerance", tolerance, LEAST, MOST, "tolerance %.2f %%", flag)
        imgui.set_item_tooltip(
            "How far what is held may go, in % of the face's height: more leaves fewer shapes."
        )
        if changed:
            asked = Tidy(new)
        width = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
        imgui.begin_disabled(same)
        imgui.push_style_color(imgui.Col_.button, imgui.ImVec4(*theme.accent[:3], 0.45))
        if imgui.button("Take it", imgui.ImVec2(width, 0)):
            asked = TakeTidy()
        imgui.pop_style_color()
        imgui.end_disabled()
        imgui.same_line()
        if imgui.button("Leave it", imgui.ImVec2(width, 0)):
            asked = LeaveTidy()
        focused = imgui.is_window_focused(imgui.FocusedFlags_.root_and_child_windows)
        if focused and not imgui.is_any_item_active() and imgui.is_key_pressed(imgui.Key.enter, False):
            asked = LeaveTidy() if same else TakeTidy()
    imgui.end()
    if not stays or imgui.is_key_pressed(imgui.Key.escape, False):
        asked = LeaveTidy()
    return asked
