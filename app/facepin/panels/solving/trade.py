"""A slider between two words: what is won and lost at its ends, without a number."""

from collections.abc import Mapping
from dataclasses import Field
from math import exp, log
from typing import Any, cast

from imgui_bundle import imgui

LEAST = 1e-3
"""On a scale of ratios that begins at 0: the smallest number above it, as a share of the usual one."""
STILL = 1e-6
"""A slider that has not moved further than this keeps the number it had."""


def share_of(value: float, about: Mapping[str, Any], usual: float) -> float:
    """Return where between its ends a number stands, 0..1.

    Parameters
    ----------
    value : float
        The number.
    about : mapping
        What `facepin.solvers.interface.setting` says of it.
    usual : float
        Its default.
    """
    low, high = about["low"], about["high"]
    if not about["log"]:
        return float((value - low) / (high - low))
    first = _first(about, usual)
    return 0.0 if value <= first else log(value / first) / log(high / first)


def value_at(share: float, about: Mapping[str, Any], usual: float) -> float:
    """Undo `share_of`, to three digits."""
    low, high = about["low"], about["high"]
    if share <= 0.0 or share >= 1.0:
        return float(low if share <= 0.0 else high)
    first = _first(about, usual)
    value = first * exp(share * log(high / first)) if about["log"] else low + share * (high - low)
    return float(min(max(float(f"{value:.3g}"), low), high))


def _first(about: Mapping[str, Any], usual: float) -> float:
    return float(about["low"] or LEAST * (usual or about["high"]))


def trade_slider(field: "Field[Any]", value: float) -> tuple[float, bool] | None:
    """Draw a setting between the words for its ends; return a new value and whether it is final, or None.

    Whole numbers stay whole.  A double click goes back to the default, which has a mark.
    """
    about, usual = field.metadata, cast(float, field.default)
    before = share_of(value, about, usual)
    imgui.set_next_item_width(-1)
    flags = imgui.SliderFlags_.always_clamp | imgui.SliderFlags_.no_input
    changed, share = imgui.slider_float(f"##trade {field.name}", before, 0.0, 1.0, "", flags)
    finished = imgui.is_item_deactivated_after_edit()
    _write(about["ends"], share_of(usual, about, usual))
    imgui.set_item_tooltip(f"{about['help']}\n{field.name} {value:.3g}; double click: back to {usual:.3g}")
    if imgui.is_item_hovered() and imgui.is_mouse_double_clicked(0):
        imgui.internal.clear_active_id()
        return (usual, True) if value != usual else None
    if not (changed or finished):
        return None
    if abs(share - before) <= STILL:
        return value, finished
    new = value_at(share, about, usual)
    return (round(new) if isinstance(usual, int) else new), finished


def _write(ends: tuple[str, str], mark: float) -> None:
    """Write what its ends mean on the slider that was drawn last, and mark a place on it."""
    style, upper, lower = imgui.get_style(), imgui.get_item_rect_min(), imgui.get_item_rect_max()
    draw = imgui.get_window_draw_list()
    hot = imgui.is_item_hovered() or imgui.is_item_active()
    ink = imgui.get_color_u32(imgui.Col_.text if hot else imgui.Col_.text_disabled)
    y = upper.y + style.frame_padding.y
    right = lower.x - style.frame_padding.x - imgui.calc_text_size(ends[1]).x
    draw.add_text(imgui.ImVec2(upper.x + style.frame_padding.x, y), ink, ends[0])
    draw.add_text(imgui.ImVec2(right, y), ink, ends[1])
    inset = 2.0 + style.grab_min_size / 2  # as imgui places the grab
    x = upper.x + inset + mark * (lower.x - upper.x - 2 * inset)
    half, reach = style.grab_min_size / 12, (lower.y - upper.y) / 5
    draw.add_rect_filled(imgui.ImVec2(x - half, lower.y - reach), imgui.ImVec2(x + half, lower.y), ink)
