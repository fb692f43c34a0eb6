"""What both studies tell alike: figures in a table, files of rows, and a chart with a dot for each figure."""

import csv
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from io import StringIO
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from facepin.figures.chart_style import DIM, chart_style, number
from facepin.figures.study.intervals import Interval
from facepin.files.safely.atomic import atomic_write
from facepin.session.solving.solving import SolverChoice
from facepin.solvers.colours import INKS
from facepin.solvers.settings import plain_settings

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from rich.table import Table

WIDEST = 14.0
"""Inches of a chart."""


def plain_choices(choices: Sequence[SolverChoice]) -> dict[str, Any]:
    """Return the settings of solvers by their keys."""
    return {
        choice.kind.key: {**plain_settings(choice.settings), "limits": choice.keep_limits}
        for choice in choices
    }


def plain_figures(figures: Mapping[str, float], intervals: Mapping[str, Interval]) -> dict[str, Any]:
    """Return figures as JSON has them, null for what is not there; each followed by its interval, if any."""
    told: dict[str, Any] = {}
    for name, figure in figures.items():
        told[name] = figure if isfinite(figure) else None
        if name in intervals:
            told[f"{name}_interval"] = [end if isfinite(end) else None for end in intervals[name]]
    return told


ENDS = "below each figure its 95 % interval: the lower end, then the upper"


def plain_table(title: str, left: Sequence[str], right: Sequence[str], least: int = 0) -> "Table":
    """Return an empty table for the terminal: columns of words, then columns of figures, `least` wide."""
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    table = Table(title=title, title_justify="left", box=SIMPLE_HEAD, show_edge=False, padding=0)
    for heading in left:
        table.add_column(heading, no_wrap=True)
    for heading in right:
        table.add_column(heading, justify="right", no_wrap=True, min_width=least)
    return table


def heading_row(table: "Table", words: Sequence[str]) -> None:
    """Add a line that says what the rows below it are about, if there is anything to say."""
    from rich.markup import escape

    if words:
        table.add_row(f"[bold]{escape(', '.join(words))}[/bold]")


def cell(figures: Sequence[str], ends: Sequence[tuple[str, str]]) -> str:
    """Return figures that share a column, and the ends of their intervals, if any, in two lines below."""
    lines = ["/".join(figures)]
    if len(ends) == len(figures):
        lines += [f"[dim]{'/'.join(line)}[/dim]" for line in zip(*ends, strict=True)]
    return "\n".join(lines)


def brief(figure: float) -> str:
    """Return a figure in at most six characters, so that eight of them fit a terminal of 80 columns."""
    if not isfinite(figure):
        return "-"
    return number(figure).replace("e+0", "e").replace("e+", "e")


def write_rows(folder: Path, name: str, told: Mapping[str, Any]) -> list[Path]:
    """Write what a study found as name.json, and its rows as name.csv; return their paths.

    Raises
    ------
    FacepinError
        If they cannot be written.
    """
    paths = [folder / f"{name}.json", folder / f"{name}.csv"]
    text = StringIO(newline="")
    rows = [_flat(row) for row in told["rows"]]
    table = csv.DictWriter(text, list(rows[0]))
    table.writeheader()
    table.writerows(rows)
    atomic_write(paths[0], (json.dumps(told, indent=2, ensure_ascii=False) + "\n").encode())
    atomic_write(paths[1], text.getvalue().encode())
    return paths


def _flat(row: Mapping[str, Any]) -> dict[str, Any]:
    """Return a row with the ends of its intervals in columns of their own."""
    flat: dict[str, Any] = {}
    for name, value in row.items():
        if isinstance(value, list):
            figure = name.removesuffix("_interval")
            flat[f"{figure}_low"], flat[f"{figure}_high"] = value
        else:
            flat[name] = value
    return flat


@dataclass(frozen=True)
class Panel:
    """One measure of a chart."""

    title: str
    values: Sequence[float]
    """One for each line of the chart; NaN leaves it empty."""
    intervals: Sequence[Interval | None]


def dot_chart(labels: Sequence[str], keys: Sequence[str], panels: Sequence[Panel], note: str) -> "Figure":
    """Draw a line for each label, in the colour of its solver's key, and a panel for each measure.

    Further left is better.
    """
    from matplotlib.figure import Figure

    with chart_style():
        width = min(2.75 * len(panels), WIDEST)
        figure = Figure((width, 0.24 * len(labels) + 1.3), layout="constrained")
        axes = figure.subplots(1, len(panels), sharey=True, squeeze=False)[0]
        for axis, panel in zip(axes, panels, strict=True):
            _dots(axis, keys, panel)
        axes[0].set_yticks(range(len(labels)), labels, fontsize=8)
        axes[0].invert_yaxis()
        figure.supxlabel(note, x=0.008, ha="left", fontsize=6.5, color=DIM)
    return figure


def _dots(axis: "Axes", keys: Sequence[str], panel: Panel) -> None:
    """Draw a mark for each value."""
    axis.set_title(panel.title)
    values = [value for value in panel.values if isfinite(value)]
    logarithmic = bool(values) and min(values) > 0 and max(values) > 30 * min(values)
    if logarithmic:
        axis.set_xscale("log")
        axis.set_xlabel("logarithmic", fontsize=7.5)
    for at, (key, value, interval) in enumerate(zip(keys, panel.values, panel.intervals, strict=True)):
        if not isfinite(value):
            continue
        ink = INKS[key]
        axis.plot(value, at, ink.marker, color=ink.colour, markersize=6, clip_on=False)
        if interval is not None and all(map(isfinite, interval)):
            axis.plot(interval, (at, at), "-", color=ink.colour, linewidth=1.2, alpha=0.6)
        axis.annotate(
            number(value), (value, at), (7, 0), textcoords="offset points", va="center", fontsize=7.5
        )
    if not logarithmic:
        axis.set_xlim(left=0)
    axis.margins(x=0.22)
    axis.grid(axis="y")
    axis.tick_params(axis="y", length=0)
