"""The study as a table, as JSON, as CSV and as a chart."""

import csv
import json
from dataclasses import asdict, fields
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from facepin.figures.animator import FRAMES, Outcome, drawable
from facepin.figures.chart_style import DIM, chart_style, number, write_chart
from facepin.figures.compare import made_folder
from facepin.figures.study import Row, Study
from facepin.files.atomic import atomic_write
from facepin.solvers.colours import INKS
from facepin.solvers.settings import plain_settings

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from rich.table import Table

HEADINGS = {
    "e_rms": "E_RMS",
    "pin_error_percent": "pin\nerror",
    "vertex_error_percent": "vertex\nerror",
    "far_motion_percent": "far\nmotion",
    "out_of_range": "out of\nrange",
    "active": "active",
    "travel": "travel",
    "milliseconds": "ms",
}
CHARTED = ("e_rms", "vertex_error_percent", "far_motion_percent", "out_of_range")


def as_json(study: Study) -> dict[str, Any]:
    """Return what `facepin study --json` prints."""
    protocol = study.protocol
    kinds = {row.choice.kind.key: row.choice for row in study.rows}
    return {
        "settings": {
            "rig": study.rig.name,
            "trials": study.trials,
            **asdict(protocol),
            "frames": FRAMES,
            "drawn_from": len(drawable(study.rig, protocol)),
            "solvers": {
                key: {**plain_settings(choice.settings), "limits": choice.keep_limits}
                for key, choice in kinds.items()
            },
        },
        "rows": [_plain(row) for row in study.rows],
    }


def _plain(row: Row) -> dict[str, Any]:
    return {"solver": row.choice.kind.key, "freedom": row.freedom, **asdict(row.outcome)}


def origin(study: Study) -> str:
    """Return in a line what was simulated."""
    protocol = study.protocol
    return (
        f"{study.rig.name}: {study.trials} poses of {protocol.shapes} shapes, {protocol.pins} pins, "
        f"medians, noise {protocol.noise:g} %, seed {protocol.seed}; lengths in % of face height"
    )


def as_table(study: Study) -> "Table":
    """Return what the terminal shows."""
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    table = Table(title=origin(study), title_justify="left", box=SIMPLE_HEAD, show_edge=False, padding=0)
    table.add_column("solver", no_wrap=True, min_width=14)
    table.add_column("freedom", no_wrap=True)
    for heading in HEADINGS.values():
        table.add_column(heading, justify="right", min_width=6)
    for row in study.rows:
        figures = (getattr(row.outcome, name) for name in HEADINGS)
        table.add_row(row.choice.kind.key, row.freedom, *map(_brief, figures))
    return table


def _brief(figure: float) -> str:
    """Return a figure in at most six characters, so that the table fits a terminal of 80 columns."""
    return number(figure).replace("e+0", "e").replace("e+", "e")


def write_study(folder: Path, study: Study) -> list[Path]:
    """Write study.json, study.csv and the chart; return the paths of the files.

    Raises
    ------
    FacepinError
        If they cannot be written.
    """
    made_folder(folder)
    text = StringIO(newline="")
    table = csv.DictWriter(text, ["solver", "freedom", *(field.name for field in fields(Outcome))])
    table.writeheader()
    table.writerows(map(_plain, study.rows))
    atomic_write(folder / "study.csv", text.getvalue().encode())
    told = json.dumps(as_json(study), indent=2, ensure_ascii=False)
    atomic_write(folder / "study.json", (told + "\n").encode())
    return [folder / "study.json", folder / "study.csv", *write_chart(folder, "study", summary_chart(study))]


def summary_chart(study: Study) -> "Figure":
    """Draw what matters most, a panel for each measure; further left is better."""
    from matplotlib.figure import Figure

    rows = study.rows
    with chart_style():
        figure = Figure((11.0, 0.24 * len(rows) + 1.3), layout="constrained")
        panels = figure.subplots(1, len(CHARTED), sharey=True, squeeze=False)[0]
        for panel, name in zip(panels, CHARTED, strict=True):
            _dots(panel, rows, [float(getattr(row.outcome, name)) for row in rows])
            unit = ", %" if name.endswith("percent") else ""
            panel.set_title(HEADINGS[name].replace("\n", " ") + unit)
        labels = [f"{row.choice.kind.title}, {row.freedom}" for row in rows]
        panels[0].set_yticks(range(len(rows)), labels, fontsize=8)
        panels[0].invert_yaxis()
        figure.supxlabel(origin(study), x=0.008, ha="left", fontsize=6.5, color=DIM)
    return figure


def _dots(panel: "Axes", rows: tuple[Row, ...], values: list[float]) -> None:
    """Draw a mark for each value."""
    positive = [value for value in values if value > 0]
    logarithmic = len(positive) == len(values) and max(values) > 30 * min(values)
    if logarithmic:
        panel.set_xscale("log")
        panel.set_xlabel("logarithmic", fontsize=7.5)
    for at, (row, value) in enumerate(zip(rows, values, strict=True)):
        ink = INKS[row.choice.kind.key]
        panel.plot(value, at, ink.marker, color=ink.colour, markersize=6, clip_on=False)
        panel.annotate(
            number(value), (value, at), (7, 0), textcoords="offset points", va="center", fontsize=7.5
        )
    if not logarithmic:
        panel.set_xlim(left=0)
    panel.margins(x=0.22)
    panel.grid(axis="y")
    panel.tick_params(axis="y", length=0)
