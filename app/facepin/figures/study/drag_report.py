"""The drag study as a table, as JSON, as CSV, as a chart and as maps of the face."""

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from facepin.figures.chart_style import write_chart
from facepin.figures.compare import context_or_word, made_folder
from facepin.figures.study.drag_study import DragRow, DragStudy
from facepin.figures.study.drags import PIXEL
from facepin.figures.study.maps import write_maps
from facepin.figures.study.telling import (
    Panel,
    brief,
    dot_chart,
    plain_choices,
    plain_figures,
    plain_table,
    write_rows,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.table import Table

HEADINGS = {
    "reachable": "in\nreach",
    "lag_median_percent": "\nlag",
    "lag_p90_percent": "lag\np90",
    "dead_percent": "\ndead",
    "far_share_percent": "\nfar",
    "active_p90": "acti\nve",
    "weight_per_pixel_p90": "per\npixel",
    "overdrag_change_median": "over\ndrag",
    "overdrag_change_p90": "over\np90",
    "press_jump_percent": "\npress",
    "removal_jump_percent": "remo\nval",
    "slip_median_percent": "\nslip",
    "sequence_lag_p90_percent": "held\nlag",
    "milliseconds": "\nms",
}
CHARTED = {
    "lag_median_percent": "lag, % of the drag",
    "lag_p90_percent": "lag of nine in ten, %",
    "dead_percent": "dead drags, %",
    "far_share_percent": "drags felt far away, %",
    "weight_per_pixel_p90": "weight per pixel",
    "overdrag_change_p90": "change by overdrag",
    "removal_jump_percent": "jump by a removal, %",
}


def as_json(studies: Sequence[DragStudy]) -> dict[str, Any]:
    """Return what `facepin study --drags --json` prints."""
    protocol = studies[0].protocol
    settings = {
        "rigs": [{"rig": study.rig.name, "points": len(study.vertices)} for study in studies],
        "sizes_percent": list(protocol.sizes),
        "points": protocol.points,
        "cases": protocol.cases,
        "seed": protocol.seed,
        "pixel_percent": 100 * PIXEL,
        "solvers": plain_choices([row.choice for row in studies[0].rows]),
    }
    return {"settings": settings, "rows": [_plain(study, row) for study in studies for row in study.rows]}


def _plain(study: DragStudy, row: DragRow) -> dict[str, Any]:
    method = {"rig": study.rig.name, "solver": row.choice.kind.key, "freedom": row.freedom}
    figures = plain_figures(asdict(row.figures), row.intervals)
    return {**method, "size_percent": row.size, **figures}


def origin(studies: Sequence[DragStudy]) -> str:
    """Return in a line what was dragged."""
    first = studies[0]
    rigs = ", ".join(study.rig.name for study in studies)
    sizes = " and ".join(f"{size:g}" for size in first.protocol.sizes)
    freedoms = " and ".join(dict.fromkeys(row.freedom for row in first.rows))
    return (
        f"{rigs}: {len(first.vertices)} points dragged by {sizes} % of face height in 4 directions, "
        f"{freedoms} pins, seed {first.protocol.seed}"
    )


def as_table(studies: Sequence[DragStudy]) -> "Table":
    """Return what the terminal shows; what is the same in all rows is said above it alone."""
    rows = [(study, row) for study in studies for row in study.rows]
    words = {
        "rig": [study.rig.name for study, _ in rows],
        "solver": [row.choice.kind.key for _, row in rows],
        "freedom": [row.freedom for _, row in rows],
        "%": [f"{row.size:g}" for _, row in rows],
    }
    shown = [name for name, column in words.items() if name == "solver" or len(set(column)) > 1]
    title = f"{origin(studies)}\nlag, far, slip in % of the drag; press and removal in % of face height"
    table = plain_table(title, shown, list(HEADINGS.values()))
    for at, (_, row) in enumerate(rows):
        figures = [_figure(row, name) for name in HEADINGS]
        table.add_row(*(words[name][at] for name in shown), *figures)
    return table


def _figure(row: DragRow, name: str) -> str:
    """Return a figure of a table, per cents without needless digits."""
    figure, interval = getattr(row.figures, name), row.intervals.get(name)
    return brief(figure, interval)


def write_drags(folder: Path, studies: Sequence[DragStudy]) -> list[Path]:
    """Write drags.json, drags.csv, the chart and, where there is OpenGL, maps; return the files' paths.

    Raises
    ------
    FacepinError
        If they cannot be written.
    """
    made_folder(folder)
    files = write_rows(folder, "drags", as_json(studies))
    files += write_chart(folder, "drags", summary_chart(studies))
    with context_or_word() as ctx:
        if ctx is not None:
            files += write_maps(folder, studies, ctx)
    return files


def summary_chart(studies: Sequence[DragStudy]) -> "Figure":
    """Draw what matters most, a panel for each measure; further left is better."""
    lines = [(study, row) for study in studies for row in study.rows]
    several = len(studies) > 1
    labels = [
        f"{study.rig.name + ': ' if several else ''}{row.choice.kind.title}, {row.freedom}, {row.size:g} %"
        for study, row in lines
    ]
    panels = [
        Panel(
            title,
            [getattr(row.figures, name) for _, row in lines],
            [row.intervals.get(name) for _, row in lines],
        )
        for name, title in CHARTED.items()
    ]
    return dot_chart(labels, [row.choice.kind.key for _, row in lines], panels, origin(studies))
