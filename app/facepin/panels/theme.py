"""Colours, spacing and fonts of all panels."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from imgui_bundle import imgui

from facepin.resources import resource
from facepin.solvers.colours import INKS

Colour = tuple[float, float, float, float]
"""Red, green, blue and opacity, 0..1."""
ThemeName = Literal["dark", "light"]


@dataclass(frozen=True)
class Theme:
    """Every colour that the panels are made of."""

    accent: Colour
    """The only one that is not grey.  Orange: readable beside skin, for colour-blind eyes too."""
    warning: Colour
    text: Colour
    text_dim: Colour
    panel: Colour
    bar: Colour
    """Of the menu bar and behind tabs."""
    popup: Colour
    frame: Colour
    """Of what can be filled in or pressed."""
    frame_hovered: Colour
    frame_active: Colour
    border: Colour
    ink: Colour
    """White or black: what a thing is covered with, thinly, to set it off from its ground."""
    series: tuple[float, float]
    """Of a solver's colour: how far it goes towards `ink`, and how much further for each one alike."""

    @property
    def accent_dim(self) -> Colour:
        """The accent as a ground under text."""
        return (*self.accent[:3], 0.38)


THEMES: dict[ThemeName, Theme] = {
    "dark": Theme(
        accent=(0.98, 0.62, 0.24, 1.0),
        warning=(0.97, 0.47, 0.43, 1.0),
        text=(0.90, 0.90, 0.91, 1.0),
        text_dim=(0.65, 0.66, 0.69, 1.0),
        panel=(0.125, 0.129, 0.141, 1.0),
        bar=(0.07, 0.072, 0.08, 1.0),
        popup=(0.105, 0.109, 0.12, 1.0),
        frame=(0.185, 0.191, 0.208, 1.0),
        frame_hovered=(0.235, 0.243, 0.264, 1.0),
        frame_active=(0.285, 0.295, 0.320, 1.0),
        border=(0.07, 0.072, 0.08, 1.0),
        ink=(1.0, 1.0, 1.0, 1.0),
        series=(0.3, 0.25),
    ),
    "light": Theme(
        accent=(0.66, 0.28, 0.0, 1.0),
        warning=(0.72, 0.09, 0.09, 1.0),
        text=(0.11, 0.115, 0.13, 1.0),
        text_dim=(0.33, 0.34, 0.37, 1.0),
        panel=(0.925, 0.927, 0.935, 1.0),
        bar=(0.885, 0.888, 0.897, 1.0),
        popup=(0.97, 0.971, 0.976, 1.0),
        frame=(0.85, 0.855, 0.868, 1.0),
        frame_hovered=(0.81, 0.817, 0.835, 1.0),
        frame_active=(0.765, 0.773, 0.795, 1.0),
        border=(0.72, 0.727, 0.745, 1.0),
        ink=(0.0, 0.0, 0.0, 1.0),
        series=(0.4, 0.15),
    ),
}
"""Text has a contrast of at least 4.5 on all that it stands on (WCAG AA); a test computes it."""

PICTURE = THEMES["dark"]
"""Of what stands over the picture.  The studio wall is dark in every theme: so that a face is always judged
before the same ground."""
VEIL = 0.72
"""Opacity of grounds over the picture."""

FONT_SIZE = 15.0
"""Height of text in pixels at 1x scale."""

# All in steps of four pixels: a row in a frame is 23 high and ends 4 before the next.
_SPACING = {
    "window_padding": (12, 8),
    "frame_padding": (8, 4),
    "item_spacing": (8, 4),
    "item_inner_spacing": (8, 4),
    "cell_padding": (4, 2),
    "separator_text_padding": (16, 4),
    "display_safe_area_padding": (4, 4),
}
_SIZES = {
    "scrollbar_size": 12,
    "grab_min_size": 4,
    "window_rounding": 0,
    "child_rounding": 4,
    "frame_rounding": 4,
    "popup_rounding": 4,
    "grab_rounding": 2,
    "tab_rounding": 4,
    "scrollbar_rounding": 6,
    "window_border_size": 1,
    "popup_border_size": 1,
    "frame_border_size": 0,
    "docking_separator_size": 2,
    "indent_spacing": 16,
    "tab_bar_overline_size": 2,
}


def apply_theme(theme: Theme, ui_scale: float) -> None:
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
        imgui.Col_.text: theme.text,
        imgui.Col_.text_disabled: theme.text_dim,
        imgui.Col_.window_bg: theme.panel,
        imgui.Col_.child_bg: (0, 0, 0, 0),
        imgui.Col_.popup_bg: theme.popup,
        imgui.Col_.border: theme.border,
        imgui.Col_.frame_bg: theme.frame,
        imgui.Col_.frame_bg_hovered: theme.frame_hovered,
        imgui.Col_.frame_bg_active: theme.frame_active,
        imgui.Col_.title_bg: theme.bar,
        imgui.Col_.title_bg_active: theme.bar,
        imgui.Col_.menu_bar_bg: theme.bar,
        imgui.Col_.scrollbar_bg: (0, 0, 0, 0),
        imgui.Col_.scrollbar_grab: theme.frame_hovered,
        imgui.Col_.scrollbar_grab_hovered: theme.frame_active,
        imgui.Col_.scrollbar_grab_active: theme.text_dim,
        imgui.Col_.check_mark: theme.accent,
        imgui.Col_.checkbox_selected_bg: theme.frame,
        imgui.Col_.input_text_cursor: theme.text,
        imgui.Col_.drag_drop_target: theme.accent,
        imgui.Col_.drag_drop_target_bg: (0, 0, 0, 0),
        imgui.Col_.unsaved_marker: theme.text,
        imgui.Col_.slider_grab: theme.accent,
        imgui.Col_.slider_grab_active: theme.accent,
        imgui.Col_.button: theme.frame_hovered,
        imgui.Col_.button_hovered: theme.frame_active,
        imgui.Col_.button_active: theme.accent_dim,
        imgui.Col_.header: theme.frame_hovered,
        imgui.Col_.header_hovered: theme.frame_active,
        imgui.Col_.header_active: theme.accent_dim,
        imgui.Col_.separator: tinted(theme.ink, 0.1),
        imgui.Col_.separator_hovered: theme.accent_dim,
        imgui.Col_.separator_active: theme.accent,
        imgui.Col_.tab: theme.bar,
        imgui.Col_.tab_hovered: theme.frame_active,
        imgui.Col_.tab_selected: theme.panel,
        imgui.Col_.tab_selected_overline: theme.accent,
        imgui.Col_.tab_dimmed: theme.bar,
        imgui.Col_.tab_dimmed_selected: theme.panel,
        imgui.Col_.tab_dimmed_selected_overline: (0, 0, 0, 0),
        imgui.Col_.docking_preview: theme.accent_dim,
        imgui.Col_.docking_empty_bg: (0, 0, 0, 0),
        imgui.Col_.text_selected_bg: theme.accent_dim,
        imgui.Col_.nav_cursor: theme.accent_dim,
        imgui.Col_.modal_window_dim_bg: (0, 0, 0, 0.35),
        imgui.Col_.plot_histogram: theme.accent,
        imgui.Col_.resize_grip: (0, 0, 0, 0),
        imgui.Col_.resize_grip_hovered: theme.accent_dim,
        imgui.Col_.resize_grip_active: theme.accent,
    }
    for index, colour in colours.items():
        style.set_color_(index, imgui.ImVec4(*colour))


def pane_colours(theme: Theme, keys: Sequence[str]) -> list[Colour]:
    """Return one colour per pane: its solver's, further off where the same solver came before."""
    first, more = theme.series
    ink = theme.ink[0]
    colours: list[Colour] = []
    for at, key in enumerate(keys):
        code = INKS[key].colour if key in INKS else "#888888"
        share = min(first + more * list(keys[:at]).count(key), 0.9)
        r, g, b = (int(code[i : i + 2], 16) / 255 for i in (1, 3, 5))
        colours.append((r + (ink - r) * share, g + (ink - g) * share, b + (ink - b) * share, 1.0))
    return colours


def tinted(colour: Colour, opacity: float) -> Colour:
    """Return a colour with another opacity."""
    return (*colour[:3], opacity)


def packed(colour: Colour, alpha: float = 1.0) -> int:
    """Return a colour as draw lists want it."""
    r, g, b, a = colour
    return int(imgui.get_color_u32(imgui.ImVec4(r, g, b, a * alpha)))


_OVER_PICTURE: dict[int, Colour] = {
    imgui.Col_.window_bg: PICTURE.popup,
    imgui.Col_.popup_bg: PICTURE.popup,
    imgui.Col_.border: PICTURE.border,
    imgui.Col_.text: PICTURE.text,
    imgui.Col_.text_disabled: PICTURE.text_dim,
    imgui.Col_.button: PICTURE.frame_hovered,
    imgui.Col_.button_hovered: PICTURE.frame_active,
    imgui.Col_.button_active: PICTURE.accent_dim,
}


def push_picture_colours() -> None:
    """Use the colours of what stands over the picture, whatever the theme of the panels."""
    for index, colour in _OVER_PICTURE.items():
        imgui.push_style_color(index, imgui.ImVec4(*colour))


def pop_picture_colours() -> None:
    """Go back to the colours before `push_picture_colours`."""
    imgui.pop_style_color(len(_OVER_PICTURE))


def dim_sentence(text: str) -> None:
    """Draw words that are to be read once, in as many lines as they need."""
    imgui.push_style_color(imgui.Col_.text, imgui.get_style_color_vec4(imgui.Col_.text_disabled))
    imgui.text_wrapped(text)
    imgui.pop_style_color()
