"""Text can be read on all that it stands on, in both themes."""

import pytest
from PIL import ImageFont

from facepin.panels.theme import THEMES, Colour, Theme, pane_colours
from facepin.resources import resource
from facepin.solvers import SOLVERS

ENOUGH = 4.5
"""WCAG 2.1, level AA, for text of normal size."""


def luminance(colour: Colour) -> float:
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in colour[:3]]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: Colour, other: Colour) -> float:
    dark, light = sorted((luminance(one), luminance(other)))
    return (light + 0.05) / (dark + 0.05)


def over(colour: Colour, ground: Colour) -> Colour:
    """A colour that is partly transparent, on a ground."""
    alpha = colour[3]
    return (*(alpha * c + (1 - alpha) * g for c, g in zip(colour[:3], ground[:3], strict=True)), 1.0)


def grounds(theme: Theme) -> dict[str, Colour]:
    return {
        "panel": theme.panel,
        "bar": theme.bar,
        "popup": over(theme.popup, theme.panel),
        "frame": theme.frame,
        "frame_hovered": theme.frame_hovered,
    }


def test_the_contrast_is_measured_as_the_guideline_says() -> None:
    white, black, grey = (1, 1, 1, 1), (0, 0, 0, 1), (0.4667, 0.4667, 0.4667, 1)
    assert contrast(white, black) == pytest.approx(21)
    assert contrast(white, grey) == pytest.approx(4.48, abs=0.01)  # #777777, the textbook's example


@pytest.mark.parametrize("name", THEMES)
def test_text_has_contrast(name: str) -> None:
    theme = THEMES[name]
    low = {
        (what, where): round(contrast(colour, ground), 2)
        for where, ground in grounds(theme).items()
        for what, colour in (("text", theme.text), ("text_dim", theme.text_dim))
        if contrast(colour, ground) < ENOUGH
    }
    assert not low
    assert contrast(theme.text, theme.frame_active) >= ENOUGH
    for ground in (theme.panel, theme.frame):  # a chosen row, the bar of a weight
        assert contrast(theme.text, over(theme.accent_dim, ground)) >= ENOUGH


@pytest.mark.parametrize("name", THEMES)
def test_what_stands_out_can_be_read_too(name: str) -> None:
    theme = THEMES[name]
    for where in ("panel", "bar", "popup"):
        ground = grounds(theme)[where]
        assert contrast(theme.accent, ground) >= ENOUGH, where
        assert contrast(theme.warning, ground) >= ENOUGH, where
    assert contrast(theme.warning, theme.frame) >= 3  # numbers in a slider's trough have a bar beside them


@pytest.mark.parametrize("name", THEMES)
def test_the_colours_of_panes_can_be_read_and_told_apart(name: str) -> None:
    theme = THEMES[name]
    colours = pane_colours(theme, [*SOLVERS, "transpose", "transpose"])
    assert len(set(colours)) == len(colours)
    for key, colour in zip([*SOLVERS, "again", "and again"], colours, strict=True):
        assert contrast(colour, theme.panel) >= ENOUGH, key


def test_the_light_theme_is_light() -> None:
    assert luminance(THEMES["light"].panel) > 0.7 > 0.1 > luminance(THEMES["dark"].panel)


def test_numbers_stand_in_columns() -> None:
    font = ImageFont.truetype(str(resource("assets", "fonts/Roboto-Regular.ttf")), 300)
    assert len({font.getlength(digit) for digit in "0123456789"}) == 1
