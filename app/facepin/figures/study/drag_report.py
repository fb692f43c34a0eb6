"""The drag study as a table, as JSON, as CSV, as a chart and as maps of the face."""

from collections.abc import Sequence
from dataclasses import asdict
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from facepin.core.names import without_author
from facepin.figures.chart_style import write_chart
from facepin.figures.compare import context_or_word, made_folder
from facepin.figures.study.drag_study import DragRow, DragStudy
from facepin.figures.study.drags import PIXEL
from facepin.figures.study.maps import write_maps
from facepin.figures.study.telling import (
    ENDS,
    Panel,
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

COLUMNS = {
    "in\nreach": ("reachable",),
    "lag\n": ("lag_median_percent", "lag_p90_percent"),
    "\ndead": ("dead_percent",),
    "\nfar": ("far_share_percent",),
    "acti\nve": ("active_p90",),
    "per\npx": ("weight_per_pixel_p90",),
    "over\ndrag": ("overdrag_change_p90",),
    "\npress": ("press_jump_percent",),
    "remo\nval": ("removal_jump_percent",),
    "\nslip": ("slip_median_percent",),
    "held\nlag": ("sequence_lag_p90_percent",),
    "\nms": ("milliseconds",),
}
"""Of the table: headings, and figures that share a column.  The overdrag's median is in the JSON only."""
WORDS = "lag (median/p90), slip and held lag in % of the drag; press and removal in % of face height"
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
    """Return what the terminal shows: rows of one rig, size and freedom under a line that says so."""
    rows = studies[0].rows
    sure = any(row.intervals for row in rows)
    title = f"{origin(studies)}\n{WORDS}{'; ' + ENDS if sure else ''}"
    table = plain_table(title, ["solver"], list(COLUMNS))
    several = len({row.freedom for row in rows}) > 1
    for study in studies:
        for freedom, size in dict.fromkeys((row.freedom, row.size) for row in study.rows):
            rig = [study.rig.name] if len(studies) > 1 else []
            heading_row(table, [*rig, f"{size:g} %", *([freedom] if several else [])])
            for row in study.rows:
                if (row.freedom, row.size) == (freedom, size):
                    cells = [_cell(row, names) for names in COLUMNS.values()]
                    table.add_row(row.choice.kind.key, *cells)
    return table


def _cell(row: DragRow, names: tuple[str, ...]) -> str:
    figures = [short(getattr(row.figures, name)) for name in names]
    intervals = [row.intervals[name] for name in names if name in row.intervals]
    return cell(figures, [(short(low), short(high)) for low, high in intervals])


def short(figure: float) -> str:
    """Return a figure in two digits that matter: 99.6 as 100, 0.057 as .06."""
    if not isfinite(figure):
        return "-"
    if abs(figure) >= 9.95:
        return f"{figure:,.0f}"
    text = f"{figure:.1f}" if abs(figure) >= 0.995 else f"{figure:.2f}".removeprefix("0")
    return text.removesuffix(".0") if abs(figure) >= 0.995 else "0" if text == ".00" else text


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
        f"{study.rig.name + ': ' if several else ''}{without_author(row.choice.kind.title)}, "
        f"{row.freedom}, {row.size:g} %"
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
