"""The paper's charts: sliders (Figure 3), weights (Figure 4), errors (Figure 6), and γ of the hybrid."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats
from facepin.core.shapes.measures import ACTIVE, LIMIT_SLACK, weight_errors
from facepin.figures.chart_style import ALARM, DIM, FAINT, TEXT, TRACK, add_note, chart_style, number
from facepin.figures.comparison import Comparison
from facepin.solvers.colours import INKS, REFERENCE, Ink

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_SLIDERS = 28
"""Rows of sliders."""
MOST_NAMES = 70
"""With more shapes than this, charts name only the strongest."""
STRETCH = 2.5
"""Weights beyond this are shown on a scale that is even up to 1 and logarithmic beyond."""
LEAST_SINGULAR = 1e-4
"""Singular values below this are drawn there."""
SLIDER_RANGE = (-1.0, 2.0)
"""Bars of sliders are cut here; the number says how far they go."""


@dataclass(frozen=True, eq=False)
class Series:
    """One set of weights in a chart."""

    title: str
    ink: Ink
    weights: Floats
    """(k,)"""
    remark: str = ""


def series_of(comparison: Comparison) -> list[Series]:
    """Return what charts of a comparison show: the reference, if there is one, and every answer."""
    found = []
    if comparison.reference is not None:
        found.append(Series("Reference", REFERENCE, comparison.reference))
    for answer in comparison.answers:
        remark = "" if answer.e_rms is None else f"$E_{{RMS}}$ {number(answer.e_rms)}"
        found.append(Series(answer.title, INKS[answer.key], answer.weights, remark))
    return found


def slider_panels(names: Sequence[str], limits: Floats, series: Sequence[Series], note: str = "") -> "Figure":
    """Draw the sliders of several sets of weights side by side (Figure 3): name, bar and number.

    Rows are the same in all panels: the shapes that any of them uses most, at most `MOST_SLIDERS`.
    """
    from matplotlib.figure import Figure

    rows = strongest([each.weights for each in series], MOST_SLIDERS)
    low, high = _slider_reach(limits, series)
    # Places in inches: what has to line up in every row is too much for an automatic layout.
    name_width, bar_width, number_width, top, bottom = 1.45, 1.25, 0.65, 0.6, 0.75
    width = name_width + len(series) * (bar_width + number_width)
    inner = 0.2 * max(len(rows), 1)
    height = top + inner + bottom
    with chart_style((*names, note)):
        figure = Figure((width, height))
        for place, each in enumerate(series):
            left = name_width + place * (bar_width + number_width)
            panel = figure.add_axes((left / width, bottom / height, bar_width / width, inner / height))
            _sliders(panel, rows, limits, each, (low, high))
            panel.set_xlim(low, high)
            panel.set_ylim(len(rows) - 0.4, -0.6)
            labels = [names[j] for j in rows.tolist()] if place == 0 else [""] * len(rows)
            panel.set_yticks(range(len(rows)), labels, color=TEXT, fontsize=8)
            panel.tick_params(axis="y", length=0)
            panel.set_xticks([value for value in (-1, 0, 1, 2) if low <= value <= high])
            panel.spines["left"].set_visible(False)
            hidden = np.delete(np.abs(each.weights), rows)
            panel.set_xlabel(_rest(hidden), fontsize=7.5, loc="left")
        add_note(figure, note)
    return figure


def _slider_reach(limits: Floats, series: Sequence[Series]) -> tuple[float, float]:
    """Return the lowest and highest weight that bars have room for."""
    everything = np.concatenate([each.weights for each in series] + [limits.ravel(), np.array([0.0, 1.0])])
    low, high = max(float(everything.min()), SLIDER_RANGE[0]), min(float(everything.max()), SLIDER_RANGE[1])
    return low - 0.03 * (high - low), high + 0.03 * (high - low)


def _rest(hidden: Floats) -> str:
    if not len(hidden):
        return ""
    largest = float(hidden.max())
    return f"and {len(hidden)} more, " + (f"up to ±{largest:.2f}" if largest >= 0.005 else "all at 0")


def _sliders(
    panel: "Axes", rows: NDArray[np.intp], limits: Floats, series: Series, reach: tuple[float, float]
) -> None:
    at = np.arange(len(rows))
    weights, (low, high) = series.weights[rows], limits[rows].T
    shown = np.clip(weights, *reach)
    panel.barh(at, high - low, left=low, height=0.56, color=TRACK)
    panel.barh(at, shown, height=0.56, color=series.ink.colour)
    panel.axvline(0, color=FAINT, linewidth=0.7, zorder=0)
    for cut, mark in ((weights < reach[0], "<"), (weights > reach[1], ">")):
        panel.plot(shown[cut], at[cut], mark, color=ALARM, markersize=4, clip_on=False)
    for row, weight in enumerate(weights.tolist()):
        outside = not low[row] - LIMIT_SLACK <= round(weight, 2) <= high[row] + LIMIT_SLACK
        panel.annotate(
            _weight(weight),
            (1.0, row),
            (31, 0),
            xycoords=panel.get_yaxis_transform(),
            textcoords="offset points",
            ha="right",
            va="center",
            fontsize=7.5,
            color=ALARM if outside else (TEXT if abs(weight) > ACTIVE else FAINT),
            fontweight="bold" if outside else "normal",
            annotation_clip=False,
        )
    panel.set_title(series.title.replace(" (", "\n("), color=series.ink.colour)


def _weight(weight: float) -> str:
    """Return a weight as a slider shows it."""
    size = abs(weight)
    text = f"{weight:.2f}" if size < 100 else f"{weight:,.0f}" if size < 1e5 else f"{weight:.0e}"
    return text.replace("-0.00", "0.00").replace("-", "−")


def weight_bars(names: Sequence[str], limits: Floats, series: Sequence[Series], note: str = "") -> "Figure":
    """Draw all weights as bars, one row for each set of weights (the charts of Figure 4)."""
    from matplotlib.figure import Figure

    k = len(names)
    with chart_style((*names, note)):
        figure = Figure((_width(k), 1.2 * len(series) + 1.1), layout="constrained")
        rows = figure.subplots(len(series), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
        at = np.arange(k)
        for row, each in zip(rows, series, strict=True):
            row.axhspan(
                float(limits[:, 0].min(initial=0)),
                float(limits[:, 1].max(initial=1)),
                color="#f4f5f7",
                zorder=0,
            )
            row.bar(at, each.weights, width=0.78, color=each.ink.colour)
            row.axhline(0, color=FAINT, linewidth=0.7)
            row.set_title(each.title, color=each.ink.colour)
            row.set_title(
                each.remark, loc="right", color=DIM, fontweight="normal", fontsize=8.5, parse_math=True
            )
        scale = _value_scale(rows[0], [each.weights for each in series])
        rows[-1].set_xlim(-0.8, k - 0.2)
        for row in rows[:-1]:
            row.tick_params(axis="x", length=0)
        _name_shapes(rows[-1], names, [each.weights for each in series])
        figure.supylabel(f"weight{scale}", fontsize=8.5, color=DIM)
        add_note(figure, note)
    return figure


def error_charts(
    names: Sequence[str], reference: Floats, series: Sequence[Series], note: str = ""
) -> "Figure":
    """Draw |w − w̄| of every shape, as marks and as lines (Figure 6), with E_RMS (Eq. 9) in the legend."""
    from matplotlib.figure import Figure

    k = len(names)
    errors = [weight_errors(each.weights, reference) for each in series]
    with chart_style((*names, note)):
        figure = Figure((_width(k), 5.4), layout="constrained")
        marks, lines = figure.subplots(2, 1, sharex=True, sharey=True)
        at = np.arange(k)
        for later, (each, error) in enumerate(zip(series, errors, strict=True)):
            label = f"{each.title}   {each.remark}"
            marks.plot(
                at,
                error,
                each.ink.marker,
                color=each.ink.colour,
                markersize=4.2,
                alpha=0.85,
                label=label,
                markeredgewidth=0,
            )
            # Wide lines below narrow ones: solvers that agree are still seen apart.
            lines.plot(at, error, color=each.ink.colour, linewidth=1.1 + 0.4 * (len(series) - 1 - later))
        scale = _value_scale(marks, errors)
        for axes in (marks, lines):
            axes.grid(axis="y")
        figure.supylabel(f"$|w - \\bar{{w}}|${scale}", fontsize=8.5, color=DIM, parse_math=True)
        top = marks.get_ylim()[1]
        marks.set_ylim(-0.03 * min(top, STRETCH), top)
        legend = figure.legend(
            loc="outside upper left", ncols=min(len(series), max(int(_width(k) / 3.2), 1)), fontsize=8.5
        )
        for written in legend.get_texts():
            written.set_parse_math(True)
        lines.set_xlim(-0.8, k - 0.2)
        _name_shapes(lines, names, errors)
        add_note(figure, note)
    return figure


def gamma_chart(smallest: Sequence[float], note: str = "") -> "Figure":
    """Draw the smallest singular value of the pin rows, and γ of the hybrid, by number of pins (from 1)."""
    from matplotlib.figure import Figure
    from matplotlib.ticker import MaxNLocator

    values = np.maximum(np.array(smallest), LEAST_SINGULAR)
    counts = np.arange(1, len(values) + 1)
    with chart_style():
        figure = Figure((6.5, 2.9), layout="constrained")
        axes = figure.subplots()
        axes.axhline(1, color=FAINT, linewidth=0.7)
        axes.plot(
            counts, values, "x--", color=DIM, linewidth=0.9, markersize=5, label="smallest singular value"
        )
        ink = INKS["hybrid"]
        axes.plot(counts, np.minimum(values, 1), ink.marker + "-", color=ink.colour, markersize=5, label="γ")
        axes.set_yscale("log")
        axes.grid(axis="y")
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        axes.set_xlabel("pins")
        axes.set_title(
            f"values below {LEAST_SINGULAR:g} are drawn there",
            loc="right",
            color=DIM,
            fontweight="normal",
            fontsize=7.5,
        )
        axes.legend(loc="upper right")
        add_note(figure, note)
    return figure


def strongest(sets: Sequence[Floats], most: int) -> NDArray[np.intp]:
    """Return at most `most` shapes that sets of weights use, by turns the strongest of each set.

    A set with huge weights does not push out what another one uses.
    """
    orders = [np.argsort(-np.abs(weights), kind="stable") for weights in sets]
    taken: dict[int, None] = {}
    for rank in range(len(orders[0])):
        for order, weights in zip(orders, sets, strict=True):
            if abs(weights[order[rank]]) > ACTIVE and len(taken) < most:
                taken.setdefault(int(order[rank]))
    return np.array(list(taken), np.intp)


def _width(k: int) -> float:
    """Width in inches of a chart with a place for each of k shapes."""
    return float(np.clip(0.145 * k, 6.5, 13.0))


def _value_scale(axes: "Axes", values: Sequence[Floats]) -> str:
    """Choose the scale that suits the values; return what has to be said about it."""
    largest = max((float(np.abs(each).max(initial=0.0)) for each in values), default=0.0)
    if largest <= STRETCH:
        return ""
    from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

    axes.set_yscale("symlog", linthresh=1.0, linscale=1.5)
    axes.margins(y=0.08)
    lowest = min(float(each.min(initial=0.0)) for each in values)
    highest = max(float(each.max(initial=0.0)) for each in values)
    ticks = [-tick for tick in reversed(_ticks(-lowest))] + [0.0, *_ticks(highest)]
    axes.yaxis.set_major_locator(FixedLocator(ticks))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}".replace("-", "−")))
    return " (logarithmic beyond 1)"


def _ticks(largest: float) -> list[float]:
    """Return the ticks on one side of 0: 1, and the last power of ten."""
    power = int(np.floor(np.log10(largest))) if largest > 0 else -1
    return [1.0, 10.0**power] if power > 0 else [1.0]


def _name_shapes(axes: "Axes", names: Sequence[str], sets: Sequence[Floats]) -> None:
    """Name the shapes below a chart: all, or the strongest where there are too many."""
    if len(names) <= MOST_NAMES:
        at = np.arange(len(names))
    else:
        at = np.sort(strongest(sets, MOST_NAMES // 2))
    axes.set_xticks(at, [names[j] for j in at.tolist()], rotation=90, fontsize=6.5)
    axes.tick_params(axis="x", length=2)
