"""Colours, spacing and fonts of all panels."""

from collections.abc import Sequence

from imgui_bundle import imgui

from facepin.resources import resource
from facepin.solvers.colours import INKS

Colour = tuple[float, float, float, float]

ACCENT: Colour = (0.98, 0.62, 0.24, 1.0)
"""One accent, a warm orange: readable on the dark panels and beside skin, for colour-blind eyes too."""
ACCENT_DIM: Colour = (0.98, 0.62, 0.24, 0.38)
WARNING: Colour = (0.96, 0.40, 0.36, 1.0)
TEXT: Colour = (0.90, 0.90, 0.91, 1.0)
TEXT_DIM: Colour = (0.60, 0.61, 0.64, 1.0)
PANEL: Colour = (0.125, 0.129, 0.141, 1.0)
FRAME: Colour = (0.185, 0.191, 0.208, 1.0)
FRAME_HOVERED: Colour = (0.235, 0.243, 0.264, 1.0)
FRAME_ACTIVE: Colour = (0.285, 0.295, 0.320, 1.0)
BORDER: Colour = (0.07, 0.072, 0.08, 1.0)

FONT_SIZE = 15.0
"""Height of text in pixels at 1x scale."""


_SPACING = {
    "window_padding": (10, 8),
    "frame_padding": (7, 3),
    "item_spacing": (8, 6),
    "item_inner_spacing": (6, 4),
    "cell_padding": (4, 2),
    "separator_text_padding": (16, 3),
    "display_safe_area_padding": (3, 3),
}
_SIZES = {
    "scrollbar_size": 12,
    "grab_min_size": 4,
    "window_rounding": 0,
    "child_rounding": 3,
    "frame_rounding": 3,
    "popup_rounding": 4,
    "grab_rounding": 2,
    "tab_rounding": 3,
    "scrollbar_rounding": 6,
    "window_border_size": 1,
    "popup_border_size": 1,
    "frame_border_size": 0,
    "docking_separator_size": 3,
    "indent_spacing": 18,
    "tab_bar_overline_size": 2,
}


def apply_theme(ui_scale: float) -> None:
    """Load the font and set every colour and spacing for a scale (2 on a HiDPI screen)."""
    io = imgui.get_io()
    if not io.fonts.fonts:
        io.fonts.add_font_from_file_ttf(str(resource("assets", "fonts/Roboto-Regular.ttf")), FONT_SIZE)
    style = imgui.get_style()
    style.font_size_base = FONT_SIZE
    style.font_scale_dpi = ui_scale
    for name, pair in _SPACING.items():
        setattr(style, name, imgui.ImVec2(*(ui_scale * length for length in pair)))
    for name, length in _SIZES.items():
        setattr(style, name, ui_scale * length)
    style.window_menu_button_position = imgui.Dir.none
    style.disabled_alpha = 0.45
    colours = {
        imgui.Col_.text: TEXT,
        imgui.Col_.text_disabled: TEXT_DIM,
        imgui.Col_.window_bg: PANEL,
        imgui.Col_.child_bg: (0, 0, 0, 0),
        imgui.Col_.popup_bg: (0.105, 0.109, 0.12, 0.98),
        imgui.Col_.border: BORDER,
        imgui.Col_.frame_bg: FRAME,
        imgui.Col_.frame_bg_hovered: FRAME_HOVERED,
        imgui.Col_.frame_bg_active: FRAME_ACTIVE,
        imgui.Col_.title_bg: BORDER,
        imgui.Col_.title_bg_active: BORDER,
        imgui.Col_.menu_bar_bg: (0.095, 0.098, 0.107, 1.0),
        imgui.Col_.scrollbar_bg: (0, 0, 0, 0),
        imgui.Col_.scrollbar_grab: FRAME_HOVERED,
        imgui.Col_.scrollbar_grab_hovered: FRAME_ACTIVE,
        imgui.Col_.scrollbar_grab_active: TEXT_DIM,
        imgui.Col_.check_mark: ACCENT,
        imgui.Col_.slider_grab: ACCENT,
        imgui.Col_.slider_grab_active: ACCENT,
        imgui.Col_.button: FRAME_HOVERED,
        imgui.Col_.button_hovered: FRAME_ACTIVE,
        imgui.Col_.button_active: ACCENT_DIM,
        imgui.Col_.header: FRAME_HOVERED,
        imgui.Col_.header_hovered: FRAME_ACTIVE,
        imgui.Col_.header_active: ACCENT_DIM,
        imgui.Col_.separator: (1, 1, 1, 0.07),
        imgui.Col_.separator_hovered: ACCENT_DIM,
        imgui.Col_.separator_active: ACCENT,
        imgui.Col_.tab: BORDER,
        imgui.Col_.tab_hovered: FRAME_ACTIVE,
        imgui.Col_.tab_selected: PANEL,
        imgui.Col_.tab_selected_overline: ACCENT,
        imgui.Col_.tab_dimmed: BORDER,
        imgui.Col_.tab_dimmed_selected: PANEL,
        imgui.Col_.tab_dimmed_selected_overline: (0, 0, 0, 0),
        imgui.Col_.docking_preview: ACCENT_DIM,
        imgui.Col_.docking_empty_bg: (0, 0, 0, 0),
        imgui.Col_.text_selected_bg: ACCENT_DIM,
        imgui.Col_.nav_cursor: ACCENT_DIM,
        imgui.Col_.plot_histogram: ACCENT,
        imgui.Col_.resize_grip: (0, 0, 0, 0),
        imgui.Col_.resize_grip_hovered: ACCENT_DIM,
        imgui.Col_.resize_grip_active: ACCENT,
    }
    for index, colour in colours.items():
        style.set_color_(index, imgui.ImVec4(*colour))


def pane_colours(keys: Sequence[str]) -> list[Colour]:
    """Return one colour per pane: its solver's, paler where the same solver came before."""
    colours: list[Colour] = []
    for at, key in enumerate(keys):
        code = INKS[key].colour if key in INKS else "#ffffff"
        paler = 0.3 + 0.25 * list(keys[:at]).count(key)  # the chart colours are made for white paper
        r, g, b = (int(code[i : i + 2], 16) / 255 for i in (1, 3, 5))
        colours.append((r + (1 - r) * paler, g + (1 - g) * paler, b + (1 - b) * paler, 1.0))
    return colours


def packed(colour: Colour, alpha: float = 1.0) -> int:
    """Return a colour as draw lists want it."""
    r, g, b, a = colour
    return int(imgui.get_color_u32(imgui.ImVec4(r, g, b, a * alpha)))
