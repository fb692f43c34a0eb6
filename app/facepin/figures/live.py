"""The charts of what the window shows, as files."""

import csv
from io import StringIO
from pathlib import Path

import numpy as np

from facepin.core.errors import FacepinError
from facepin.core.names import without_author
from facepin.core.shapes.measures import e_rms
from facepin.figures.chart_style import number, write_chart
from facepin.figures.charts import Series, error_charts, slider_panels, weight_bars
from facepin.files.safely.atomic import atomic_write
from facepin.session.session import Session
from facepin.solvers.colours import INKS, REFERENCE


def write_session_charts(session: Session, folder: Path) -> None:
    """Write the weights of all panes into `folder`: sliders, bars and, with a reference, errors; weights.csv.

    Raises
    ------
    FacepinError
        If the folder cannot be made or a file cannot be written.
    """
    rig, reference = session.rig, session.work.reference
    series = []
    for at, pane in enumerate(session.panes, 1):
        remark = "" if reference is None else f"$E_{{RMS}}$ {number(e_rms(pane.pose.weights, reference))}"
        ink = INKS[pane.choice.kind.key]
        title = f"{at} {without_author(pane.choice.kind.title)}"
        series.append(Series(title, ink, pane.pose.weights, remark))
    everything = series if reference is None else [Series("Reference", REFERENCE, reference), *series]
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FacepinError(f"{folder}: cannot be made: {error.strerror}") from error
    pins = len(session.pose.pins)
    note = (
        f"{rig.name}: {rig.vertex_count:,} vertices, {rig.shape_count} shapes; {pins} pin{'s'[: pins != 1]}"
    )
    write_chart(folder, "sliders", slider_panels(rig.shown_names, session.control.limits, everything, note))
    write_chart(folder, "weights", weight_bars(rig.shown_names, session.control.limits, everything, note))
    if reference is not None:
        write_chart(folder, "errors", error_charts(rig.shown_names, reference, series, note))
    table = StringIO()
    rows = np.stack([each.weights for each in everything], axis=1).tolist()
    writer = csv.writer(table, lineterminator="\n")
    keys = [f"{at} {pane.choice.kind.key}" for at, pane in enumerate(session.panes, 1)]
    writer.writerow(["shape", *["reference"] * (reference is not None), *keys])
    writer.writerows([name, *row] for name, row in zip(rig.shape_names, rows, strict=True))
    atomic_write(folder / "weights.csv", table.getvalue().encode())
