"""The chart window: weights of all panes as bars (Figure 4), errors against the reference (Figure 6).

Bars lie: a shape's name stands upright in front of them, where it can be read.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from imgui_bundle import imgui, implot

from facepin.core.arrays import Floats
from facepin.core.rig import Rig
from facepin.core.shapes.measures import e_rms, weight_errors
from facepin.panels.commands import Command
from facepin.panels.theme import Colour, Theme, pane_colours
from facepin.panels.tiles import shortened
from facepin.session.work import Pane

TITLE = "Chart"
SIZE = (400.0, 520.0)
"""Width and height at first, at 1x scale."""
WIDTHS = (0.66, 0.34)
"""Shares of weights, with the names, and of errors."""
WIDEST_NAME = 0.36
"""Share of the window that names may take."""
LINE = 0.92
"""Distance of two names, in heights of a line of text."""
_MARKERS = (
    implot.Marker_.circle,
    implot.Marker_.square,
    implot.Marker_.diamond,
    implot.Marker_.up,
)


@dataclass(frozen=True, eq=False)
class _Series:
    """One set of weights."""

    title: str
    colour: Colour
    weights: Floats
    """(k,)"""


def chart_window(
    rig: Rig, panes: Sequence[Pane], reference: Floats | None, scale: float, theme: Theme
) -> tuple[bool, Command | None]:
    """Draw the chart window; return whether it stays open, and what the user asks for.

    Parameters
    ----------
    rig : Rig
        Names the shapes.
    panes : sequence of Pane
        One series each.
    reference : (k,) float64
        Weights that the panes are measured against, or None.
    scale : float
        Pixels per pixel of a 1x screen.
    theme : Theme
        Colours.
    """
    size = imgui.ImVec2(SIZE[0] * scale, SIZE[1] * scale)
    imgui.set_next_window_size(size, imgui.Cond_.first_use_ever)
    shown, stays = imgui.begin(TITLE, True)
    asked: Command | None = None
    if shown:
        colours = pane_colours(theme, [pane.choice.kind.key for pane in panes])
        series = [
            _Series(pane.choice.kind.title, colour, pane.pose.weights)
            for pane, colour in zip(panes, colours, strict=True)
        ]
        if imgui.button("Save chart"):
            asked = Command.SAVE_CHART
        imgui.set_item_tooltip("As PNG, SVG and CSV, beside the pictures")
        if reference is None:
            imgui.same_line()
            imgui.text_disabled(shortened("Set a reference to see errors too.", _room()))
        _legend(series, reference, scale, theme)
        _plots(rig, series, reference, theme)
    imgui.end()
    return bool(stays), asked


def _room() -> float:
    return float(imgui.get_content_region_avail().x)


def _legend(series: Sequence[_Series], reference: Floats | None, scale: float, theme: Theme) -> None:
    """Say whose bars have which colour, a line each, and how far each is from the reference (Eq. 9)."""
    everything = list(series)
    if reference is not None:
        everything.append(_Series("Reference", theme.text_dim, reference))
    draw, line, side = imgui.get_window_draw_list(), imgui.get_text_line_height(), 9 * scale
    for each in everything:
        at = imgui.get_cursor_screen_pos()
        top = at.y + (line - side) / 2
        draw.add_rect_filled(
            imgui.ImVec2(at.x, top),
            imgui.ImVec2(at.x + side, top + side),
            imgui.get_color_u32(imgui.ImVec4(*each.colour)),
        )
        imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + 1.6 * side)
        error = ""
        if reference is not None and each.weights is not reference:
            error = f"E_RMS {e_rms(each.weights, reference):.3f}"
        width = imgui.calc_text_size(error).x
        end = imgui.get_cursor_pos_x() + _room() - width
        imgui.text(shortened(each.title, _room() - width - side))
        if error:
            imgui.same_line(end)
            imgui.text_disabled(error)


def _plots(rig: Rig, series: Sequence[_Series], reference: Floats | None, theme: Theme) -> None:
    """Draw weights and, with a reference, errors beside them, shape by shape."""
    columns = 1 if reference is None else 2
    flags = implot.SubplotFlags_.no_title | implot.SubplotFlags_.no_menus | implot.SubplotFlags_.link_rows
    flags |= implot.SubplotFlags_.no_resize | implot.SubplotFlags_.no_legend
    implot.push_style_var(implot.StyleVar_.plot_padding, imgui.ImVec2(9, 4))
    implot.push_style_var(implot.StyleVar_.plot_min_size, imgui.ImVec2(40, 40))
    implot.push_style_var(implot.StyleVar_.fit_padding, imgui.ImVec2(0.1, 0))  # the last number has room
    height, line = max(imgui.get_content_region_avail().y, 1.0), imgui.get_text_line_height()
    widest = WIDEST_NAME * imgui.get_window_width()
    # Zooming in makes room for more names.
    storage, key = imgui.get_state_storage(), imgui.get_id("rows")
    rows = storage.get_float(key, float(rig.shape_count))
    ratios = implot.SubplotsRowColRatios()
    ratios.col_ratios = list(WIDTHS[:columns])
    if implot.begin_subplots("##chart", 1, columns, imgui.ImVec2(-1, height), flags, ratios):
        sets = [each.weights for each in series] + ([] if reference is None else [reference])
        plot_flags = implot.Flags_.no_mouse_text | implot.Flags_.no_legend | implot.Flags_.no_menus
        if implot.begin_plot("##weights", imgui.ImVec2(-1, -1), plot_flags):
            largest = np.max(np.abs(np.array(sets)), axis=0)
            gap = LINE * line * rows / max(height - 3 * line, 1.0)
            _axes(rig, "weight", names_that_fit(largest, gap), widest)
            limits = implot.get_plot_limits()
            storage.set_float(key, float(limits.y.max - limits.y.min))
            _bars(series, reference, theme)
            _name_under_mouse(rig)
            implot.end_plot()
        if reference is not None and implot.begin_plot("##errors", imgui.ImVec2(-1, -1), plot_flags):
            _axes(rig, "off the reference", [], 0.0)
            _errors(series, reference)
            _name_under_mouse(rig)
            implot.end_plot()
        implot.end_subplots()
    implot.pop_style_var(3)


def names_that_fit(sizes: Floats, gap: float) -> list[int]:
    """Return which of the rows 0, 1, 2 and so on to name, the largest of `sizes` (k,) first.

    No two of them are nearer than `gap`, in rows.
    """
    if gap <= 1.0:
        return list(range(len(sizes)))
    named = np.zeros(len(sizes), np.bool_)
    reach = int(np.ceil(gap)) - 1
    for row in np.argsort(-sizes, kind="stable"):
        if not named[max(row - reach, 0) : row + reach + 1].any():
            named[row] = True
    return np.flatnonzero(named).tolist()


def _axes(rig: Rig, label: str, named: Sequence[int], widest: float) -> None:
    """Set up axes: values along, shapes from the top down, some of them named as far as `widest` allows."""
    rows = implot.AxisFlags_.invert | implot.AxisFlags_.no_grid_lines | implot.AxisFlags_.no_tick_marks
    rows |= implot.AxisFlags_.no_label
    if not named:
        rows |= implot.AxisFlags_.no_tick_labels
    last = max(rig.shape_count - 0.3, 0.5)
    implot.setup_axes(label, "", implot.AxisFlags_.auto_fit, rows)
    implot.setup_axis_limits(implot.ImAxis_.y1, -0.7, last)
    implot.setup_axis_limits_constraints(implot.ImAxis_.y1, -0.7, last)
    if named:
        names = [shortened(rig.shape_names[j], widest) for j in named]
        implot.setup_axis_ticks(implot.ImAxis_.y1, [float(j) for j in named], names)


def _bars(series: Sequence[_Series], reference: Floats | None, theme: Theme) -> None:
    everything = list(series)
    if reference is not None:
        everything.append(_Series("Reference", theme.text_dim, reference))
    width = 0.8 / len(everything)
    for number, each in enumerate(everything):
        spec = implot.Spec()
        spec.fill_color = imgui.ImVec4(*each.colour)
        spec.line_color = imgui.ImVec4(*each.colour)
        spec.flags = int(implot.BarsFlags_.horizontal)
        rows = np.arange(len(each.weights), dtype=np.float64) + (number - 0.5 * (len(everything) - 1)) * width
        values = np.ascontiguousarray(each.weights, np.float64)
        implot.plot_bars(f"{number} {each.title}", values, rows, width, spec)


def _errors(series: Sequence[_Series], reference: Floats) -> None:
    rows = np.arange(len(reference), dtype=np.float64)
    for number, each in enumerate(series):
        errors = np.abs(weight_errors(each.weights, reference))
        label = f"{number} {each.title}"
        spec = implot.Spec()
        spec.line_color = imgui.ImVec4(*each.colour)
        spec.fill_color = imgui.ImVec4(*each.colour)
        implot.plot_line(label, errors, rows, spec)
        spec.marker = int(_MARKERS[number % len(_MARKERS)])
        spec.marker_fill_color = imgui.ImVec4(*each.colour)
        spec.marker_line_color = imgui.ImVec4(*each.colour)
        spec.marker_size = 3.0
        implot.plot_scatter(label, errors, rows, spec)


def _name_under_mouse(rig: Rig) -> None:
    if implot.is_plot_hovered():
        j = round(implot.get_plot_mouse_pos().y)
        if 0 <= j < rig.shape_count:
            imgui.set_tooltip(rig.shape_names[j])
