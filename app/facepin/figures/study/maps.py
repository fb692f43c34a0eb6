"""Maps of a face: where the skin stays behind the mouse, and from where a drag is felt far away."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.look.camera import Viewport
from facepin.core.look.heat import heat_colours
from facepin.core.names import without_author
from facepin.core.rig import Rig
from facepin.core.shapes.measures import moves
from facepin.figures.pictures import Painter
from facepin.figures.study.drag_study import DragRow, DragStudy
from facepin.figures.study.intervals import median, p90
from facepin.files.work.pose_library import free_key
from facepin.sheets import Image, Legend, Pane, write_sheet
from facepin.solvers.colours import INKS

if TYPE_CHECKING:
    import moderngl

PANE = (380, 440)
BEYOND = 1.2
"""More than the top of the scale, as the skin shows it."""
DISC = 5.0
"""Radius of a point in pixels."""
OPEN = "#a9adb3"
"""Of a point that nothing can be said of."""
REACH = 2.0
"""A point colours the skin around it as far as this many times the usual gap between points."""
FAINT = 0.1
"""Skin with less than this share of a point's colour fades out."""


def write_maps(folder: Path, studies: Sequence[DragStudy], ctx: "moderngl.Context") -> list[Path]:
    """Write one sheet for each rig, freedom of the pins and size of the drags; return their paths.

    Four maps for each solver: the mean of the directions and the worst, of the lag and of what moves far
    away, each as a share of the drag.  What can't be reached counts for no lag.

    Raises
    ------
    FacepinError
        If they cannot be written.
    """
    written: list[Path] = []
    for study in studies:
        painter = Painter(ctx, study.rig, PANE)
        blend = _blend(study.rig, study.vertices)
        for freedom, size in dict.fromkeys((row.freedom, row.size) for row in study.rows):
            rows = [row for row in study.rows if (row.freedom, row.size) == (freedom, size)]
            panes = [pane for row in rows for pane in _panes(study, row, painter, blend)]
            name = free_key(
                f"map-{study.rig.name}-{freedom}-{size:g}", (path.stem.lower() for path in written)
            )
            footer = (
                f"{study.rig.name}: {len(study.vertices)} points dragged by {size:g} % of face height in 4 "
                f"directions, {freedom} pins; colours in % of the drag, white beyond; rings: out of reach"
            )
            legend = Legend(heat_colours(), ("0 %", "50 %", "100 %"))
            written.append(write_sheet(folder / f"{name}.png", panes, footer, 4, legend))
        painter.release()
    return written


def _panes(study: DragStudy, row: DragRow, painter: Painter, blend: Floats) -> list[Pane]:
    title, colour = without_author(row.choice.kind.title), INKS[row.choice.kind.key].colour
    figures = row.figures
    lag = f"median {figures.lag_median_percent:.0f} %, p90 {figures.lag_p90_percent:.0f} %"
    usual, most = 100 * median(row.far.ravel()), 100 * p90(row.far.ravel())
    far = f"median {usual:.0f} %, p90 {most:.0f} %"
    felt = f"{figures.far_share_percent:.1f} % of drags move more than themselves"
    maps = {
        "lag, mean": (_mean(row.lag), lag),
        "lag, worst direction": (_worst(row.lag), f"{figures.dead_percent:.1f} % of drags are dead"),
        "far motion, mean": (_mean(row.far), far),
        "far motion, worst direction": (_worst(row.far), felt),
    }
    return [
        Pane(draw_map(study, painter, values, blend), title, what, (words,), colour)
        for what, (values, words) in maps.items()
    ]


def draw_map(study: DragStudy, painter: Painter, values: Floats, blend: Floats) -> Image:
    """Return the neutral coloured by values (p,) of its points, with a disc for each point.

    1 is the top of the scale; NaN colours nothing and makes a ring of the disc.
    """
    from PIL import Image as Pillow
    from PIL import ImageDraw

    rig, known = study.rig, ~np.isnan(values)
    # What is far beyond the scale must not outshine its neighbours.
    seen = np.minimum(values[known], BEYOND)
    skin = blend[:, known] @ seen / np.maximum(blend[:, known].sum(axis=1), FAINT)
    picture = painter.paint(rig.neutral, heat=skin)
    page = Pillow.fromarray(picture[..., :3])
    draw = ImageDraw.Draw(page)
    width, height = painter.size
    places = painter.camera.project(rig.neutral[list(study.vertices)], Viewport(0, 0, width, height))
    for (x, y, _), value in zip(places.tolist(), values.tolist(), strict=True):
        box = (x - DISC, y - DISC, x + DISC, y + DISC)
        if np.isnan(value):
            draw.ellipse(box, outline=OPEN, width=1)
        else:
            draw.ellipse(box, fill=_colour(value), outline="#16181d", width=1)
    return np.asarray(page)


def _colour(value: float) -> tuple[int, int, int]:
    if value > 1:
        return 255, 255, 255
    colours = heat_colours()
    red, green, blue = np.rint(255 * colours[round(value * (len(colours) - 1))]).astype(int).tolist()
    return red, green, blue


def _blend(rig: Rig, vertices: Sequence[int]) -> Floats:
    """Return how much each vertex takes from each point, (n, p): near ones all, distant ones nothing."""
    gaps = np.stack([moves(rig.neutral, rig.neutral[vertex]) for vertex in vertices], axis=1)
    between = gaps[list(vertices)]
    np.fill_diagonal(between, np.inf)
    usual = float(np.median(between.min(axis=1))) if len(vertices) > 1 else 0.1 * rig.height
    near: Floats = np.clip(1.0 - gaps / (REACH * usual), 0.0, None) ** 2
    return near


def _mean(values: Floats) -> Floats:
    """Return the mean of each row, NaN where there is nothing."""
    there = ~np.isnan(values)
    count = there.sum(axis=1)
    total = np.where(there, values, 0.0).sum(axis=1)
    return np.where(count > 0, total / np.maximum(count, 1), np.nan)


def _worst(values: Floats) -> Floats:
    """Return the largest of each row, NaN where there is nothing."""
    largest = np.where(np.isnan(values), -np.inf, values).max(axis=1)
    return np.where(np.isfinite(largest), largest, np.nan)
