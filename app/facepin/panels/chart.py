"""The chart window: weights of all panes as bars (Figure 4), errors against the reference (Figure 6)."""

from collections.abc import Sequence

import numpy as np
from imgui_bundle import imgui, implot

from facepin.core.arrays import Floats
from facepin.core.measures import e_rms, weight_errors
from facepin.core.rig import Rig
from facepin.panels.commands import Command
from facepin.panels.theme import Colour, Theme, pane_colours
from facepin.session.session import Pane

TITLE = "Chart"
_MARKERS = (
    implot.Marker_.circle,
    implot.Marker_.square,
    implot.Marker_.diamond,
    implot.Marker_.up,
)


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
    imgui.set_next_window_size(imgui.ImVec2(760 * scale, 520 * scale), imgui.Cond_.first_use_ever)
    shown, stays = imgui.begin(TITLE, True)
    asked: Command | None = None
    if shown:
        colours = pane_colours(theme, [pane.choice.kind.key for pane in panes])
        titles = [f"{at + 1} {pane.choice.kind.title}" for at, pane in enumerate(panes)]
        weights = [pane.pose.weights for pane in panes]
        if imgui.button("Save chart"):
            asked = Command.SAVE_CHART
        imgui.set_item_tooltip("As PNG, SVG and CSV, beside the pictures")
        if reference is None:
            imgui.same_line()
            imgui.text_disabled("Set a reference in the menu Compare to see errors too.")
        height = imgui.get_content_region_avail().y
        upper = height if reference is None else 0.5 * (height - imgui.get_style().item_spacing.y)
        if implot.begin_plot("##weights", imgui.ImVec2(-1, upper), implot.Flags_.no_mouse_text):
            _axes(rig, "weight")
            _bars(titles, weights, colours, reference, theme)
            _name_under_mouse(rig)
            implot.end_plot()
        if reference is not None and implot.begin_plot(
            "##errors", imgui.ImVec2(-1, -1), implot.Flags_.no_mouse_text
        ):
            _axes(rig, "|w - reference|")
            _errors(titles, weights, colours, reference)
            _name_under_mouse(rig)
            implot.end_plot()
    imgui.end()
    return bool(stays), asked


def _axes(rig: Rig, label: str) -> None:
    implot.setup_axes("shape", label, implot.AxisFlags_.none, implot.AxisFlags_.auto_fit)
    implot.setup_axis_limits(implot.ImAxis_.x1, -0.7, rig.shape_count - 0.3)
    flags = implot.LegendFlags_.horizontal | implot.LegendFlags_.outside
    implot.setup_legend(implot.Location_.north_west, flags)


def _bars(
    titles: Sequence[str],
    weights: Sequence[Floats],
    colours: Sequence[Colour],
    reference: Floats | None,
    theme: Theme,
) -> None:
    series = list(zip(titles, weights, colours, strict=True))
    if reference is not None:
        series.insert(0, ("Reference", reference, theme.text_dim))
    width = 0.8 / len(series)
    at = np.arange(len(weights[0]), dtype=np.float64)
    for number, (title, values, colour) in enumerate(series):
        spec = implot.Spec()
        spec.fill_color = imgui.ImVec4(*colour)
        spec.line_color = imgui.ImVec4(*colour)
        shift = (number - 0.5 * (len(series) - 1)) * width
        implot.plot_bars(title, at + shift, np.ascontiguousarray(values, np.float64), width, spec)


def _errors(
    titles: Sequence[str], weights: Sequence[Floats], colours: Sequence[Colour], reference: Floats
) -> None:
    at = np.arange(len(reference), dtype=np.float64)
    for number, (title, values, colour) in enumerate(zip(titles, weights, colours, strict=True)):
        label = f"{title}: E_RMS {e_rms(values, reference):.3f}"
        errors = np.abs(weight_errors(values, reference))
        spec = implot.Spec()
        spec.line_color = imgui.ImVec4(*colour)
        spec.fill_color = imgui.ImVec4(*colour)
        implot.plot_line(label, at, errors, spec)
        spec.marker = int(_MARKERS[number % len(_MARKERS)])
        spec.marker_fill_color = imgui.ImVec4(*colour)
        spec.marker_line_color = imgui.ImVec4(*colour)
        spec.marker_size = 3.0
        implot.plot_scatter(label, at, errors, spec)


def _name_under_mouse(rig: Rig) -> None:
    if implot.is_plot_hovered():
        j = round(implot.get_plot_mouse_pos().x)
        if 0 <= j < rig.shape_count:
            imgui.set_tooltip(rig.shape_names[j])
