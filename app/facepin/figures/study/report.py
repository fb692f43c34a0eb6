"""The study as a table, as JSON, as CSV and as a chart."""

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from facepin.core.names import without_author
from facepin.figures.chart_style import write_chart
from facepin.figures.compare import made_folder
from facepin.figures.study.animator import FRAMES, drawable
from facepin.figures.study.study import Row, Study
from facepin.figures.study.telling import (
    ENDS,
    Panel,
    brief,
    cell,
    dot_chart,
    heading_row,
    plain_choices,
    plain_figures,
    plain_table,
    write_rows,
)

if TYPE_CHECKING:
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


def as_json(studies: Sequence[Study]) -> dict[str, Any]:
    """Return what `facepin study --json` prints; of several rigs, each row says of which it is."""
    settings = [_settings(study) for study in studies]
    if len(studies) == 1:
        return {"settings": settings[0], "rows": [_plain(row) for row in studies[0].rows]}
    own = ("rig", "trials", "drawn_from")
    shared = {name: value for name, value in settings[0].items() if name not in own}
    rigs = [{name: each[name] for name in own if name in each} for each in settings]
    rows = [{"rig": study.rig.name, **_plain(row)} for study in studies for row in study.rows]
    return {"settings": {"rigs": rigs, **shared}, "rows": rows}


def _settings(study: Study) -> dict[str, Any]:
    protocol = asdict(study.protocol)
    drawn: dict[str, Any] = {"drawn_from": 0}
    if study.reference:
        protocol = {name: protocol[name] for name in ("pins", "noise", "seed")}
        drawn = {"reference": study.reference}
    else:
        drawn["drawn_from"] = len(drawable(study.rig, study.protocol))
    solvers = plain_choices([row.choice for row in study.rows])
    return {
        "rig": study.rig.name,
        "trials": study.trials,
        **protocol,
        "frames": FRAMES,
        **drawn,
        "solvers": solvers,
    }


def _plain(row: Row) -> dict[str, Any]:
    figures = plain_figures(asdict(row.outcome), row.intervals)
    return {"solver": row.choice.kind.key, "freedom": row.freedom, **figures}


def origin(studies: Sequence[Study]) -> str:
    """Return in a line what was simulated."""
    first, protocol = studies[0], studies[0].protocol
    rigs = ", ".join(study.rig.name for study in studies)
    poses = f"from {first.reference}" if first.reference else f"of {protocol.shapes} shapes"
    return (
        f"{rigs}: {first.trials} poses {poses}, {protocol.pins} pins, "
        f"medians, noise {protocol.noise:g} %, seed {protocol.seed}; lengths in % of face height"
    )


def as_table(studies: Sequence[Study]) -> "Table":
    """Return what the terminal shows."""
    sure = any(row.intervals for row in studies[0].rows)
    title = f"{origin(studies)}{'; ' + ENDS if sure else ''}"
    table = plain_table(title, ["solver", "freedom"], list(HEADINGS.values()), least=6)
    for study in studies:
        heading_row(table, [study.rig.name] if len(studies) > 1 else [])
        for row in study.rows:
            cells = [_cell(row, name) for name in HEADINGS]
            table.add_row(row.choice.kind.key, row.freedom, *cells)
    return table


def _cell(row: Row, name: str) -> str:
    ends = [(brief(low), brief(high)) for low, high in [row.intervals[name]]] if row.intervals else []
    return cell([brief(getattr(row.outcome, name))], ends)


def write_study(folder: Path, studies: Sequence[Study]) -> list[Path]:
    """Write study.json, study.csv and the chart; return the paths of the files.

    Raises
    ------
    FacepinError
        If they cannot be written.
    """
    made_folder(folder)
    files = write_rows(folder, "study", as_json(studies))
    return [*files, *write_chart(folder, "study", summary_chart(studies))]


def summary_chart(studies: Sequence[Study]) -> "Figure":
    """Draw what matters most, a panel for each measure; further left is better."""
    lines = [(study.rig.name, row) for study in studies for row in study.rows]
    labels = [f"{without_author(row.choice.kind.title)}, {row.freedom}" for _, row in lines]
    if len(studies) > 1:
        labels = [f"{rig}: {label}" for label, (rig, _) in zip(labels, lines, strict=True)]
    panels = []
    for name in CHARTED:
        unit = ", %" if name.endswith("percent") else ""
        values = [float(getattr(row.outcome, name)) for _, row in lines]
        intervals = [row.intervals.get(name) for _, row in lines]
        panels.append(Panel(HEADINGS[name].replace("\n", " ") + unit, values, intervals))
    return dot_chart(labels, [row.choice.kind.key for _, row in lines], panels, origin(studies))
