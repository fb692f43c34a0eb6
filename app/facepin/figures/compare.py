"""The command `compare`: the paper's Figures 3, 4, 5 and 6 for given pins."""

import json
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from facepin.core.errors import FacepinError
from facepin.core.look.camera import View
from facepin.core.pose import Pose
from facepin.core.shapes.measures import moves
from facepin.figures import charts
from facepin.figures.chart_style import number, write_chart
from facepin.figures.comparison import Answer, Comparison, as_json, compare, weights_csv
from facepin.figures.pictures import Painter, heat_legend
from facepin.files.safely.atomic import atomic_write
from facepin.files.work.pins_file import write_pins
from facepin.files.work.pose_file import write_pose
from facepin.options import (
    VIEWS,
    add_rig,
    add_solver,
    add_turn,
    first_pose,
    open_with_bar,
    picture_size,
    solver_choices,
)
from facepin.sheets import Pane, write_sheet
from facepin.solvers.colours import INKS, REFERENCE

if TYPE_CHECKING:
    import moderngl

PANE = (480, 560)
LARGEST_PANE = 4096
BEYOND = "white: further than the scale goes"


def add_options(parser: ArgumentParser) -> None:
    """Declare the options of `facepin compare`."""
    add_rig(parser)
    add_turn(parser)
    parser.add_argument("--pins", type=Path, required=True, metavar="FILE", help="pins file (JSON)")
    add_solver(parser, "all", "--solvers")
    parser.add_argument(
        "--reference",
        type=Path,
        metavar="POSE",
        help="the pose that was meant: errors are measured against it",
    )
    parser.add_argument(
        "--start", type=Path, metavar="POSE", help="pose to start from (default: the neutral)"
    )
    parser.add_argument(
        "--size", type=picture_size, default=PANE, metavar="WxH", help="pixels of one face (default: 480x560)"
    )
    parser.add_argument("--view", choices=VIEWS, default="front", help="from where the faces are seen")
    parser.add_argument("--out", type=Path, required=True, metavar="FOLDER", help="where the files go")


def run(options: Namespace) -> list[Path]:
    """Do `facepin compare`; return the files written."""
    if max(options.size) > LARGEST_PANE:
        raise FacepinError(f"--size: found {max(options.size)} pixels, allowed for one face: {LARGEST_PANE}")
    choices = solver_choices(options.solver, options.settings, options.limits)
    folder = made_folder(options.out)
    rig = open_with_bar(options.rig, options.neutral, options.turn)
    start = Pose(rig.rest_weights * 0) if options.start is None else first_pose(rig, options.start, None)
    start = start.with_pins(first_pose(rig, None, options.pins).pins)
    if not start.pins:
        raise FacepinError(f"{options.pins.name}: there is no pin in it, a comparison needs one or more")
    reference = None if options.reference is None else first_pose(rig, options.reference, None).weights
    with progress_line() as tell:
        comparison = compare(rig, choices, start, reference, progress=tell)
        return write_comparison(folder, comparison, options.size, options.view, tell)


def write_comparison(
    folder: Path,
    comparison: Comparison,
    size: tuple[int, int] = PANE,
    view: View = "front",
    tell: Callable[[str], None] = lambda what: None,
) -> list[Path]:
    """Write numbers, charts and, where there is OpenGL, the faces; return the paths of the files."""
    written = write_numbers(folder, comparison)
    tell("Charts")
    written += write_charts(folder, comparison)
    tell("Pictures")
    with context_or_word() as ctx:
        if ctx is not None:
            written += write_pictures(folder, comparison, ctx, size, view)
    return written


def made_folder(folder: Path) -> Path:
    """Return `folder`, made if it is not there yet.

    Raises
    ------
    FacepinError
        If it cannot be made, or is a file.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FacepinError(f"{folder}: cannot be made a folder: {error.strerror or error}") from error
    return folder


@contextmanager
def progress_line() -> Iterator[Callable[[str], None]]:
    """Show what is being done, where a person is watching."""
    if not sys.stderr.isatty():
        yield lambda what: None
        return
    from rich.console import Console

    console = Console(stderr=True)
    with console.status("Solving") as status:
        yield lambda what: status.update(what)


@contextmanager
def context_or_word() -> "Iterator[moderngl.Context | None]":
    """Open OpenGL for pictures; on a machine that has none, say that they are left out."""
    from facepin.gpu.picture import open_context

    try:
        ctx = open_context()
    except FacepinError as error:
        sys.stderr.write(f"facepin: pictures of the face are left out: {error}\n")
        yield None
        return
    with ctx:
        yield ctx


def write_numbers(folder: Path, comparison: Comparison) -> list[Path]:
    """Write figures.json, weights.csv, the pins and a pose per solver; return their paths."""
    rig, start = comparison.rig, comparison.start
    atomic_write(folder / "figures.json", (json.dumps(as_json(comparison), indent=2) + "\n").encode())
    atomic_write(folder / "weights.csv", weights_csv(comparison))
    write_pins(folder / "pins.json", start.pins)
    poses = {f"pose-{answer.key}": answer.weights for answer in comparison.answers}
    if comparison.reference is not None:
        poses["reference"] = comparison.reference
    for name, weights in poses.items():
        write_pose(folder / f"{name}.json", rig, start.with_weights(weights))
    return [
        folder / name for name in ("figures.json", "weights.csv", "pins.json", *(f"{n}.json" for n in poses))
    ]


def write_charts(folder: Path, comparison: Comparison, made_by: str = "") -> list[Path]:
    """Write sliders, weights and, with a reference, errors, each as .png and .svg; return their paths."""
    rig, series = comparison.rig, charts.series_of(comparison)
    note = f"{origin_line(comparison)}{made_by}\n{settings_line(comparison)}"
    figures = {
        "sliders": charts.slider_panels(rig.shown_names, rig.limits, series, note),
        "weights": charts.weight_bars(rig.shown_names, rig.limits, series, note),
    }
    if comparison.reference is not None:
        figures["errors"] = charts.error_charts(rig.shown_names, comparison.reference, series[1:], note)
    return [path for name, figure in figures.items() for path in write_chart(folder, name, figure)]


def write_pictures(
    folder: Path, comparison: Comparison, ctx: "moderngl.Context", size: tuple[int, int], view: View
) -> list[Path]:
    """Write the faces side by side, and how far their vertices moved, as .png; return the paths."""
    painter = Painter(ctx, comparison.rig, size, view)
    try:
        faces, motion = comparison_panes(comparison, painter), motion_panes(comparison, painter)
    finally:
        painter.release()
    origin, legend = origin_line(comparison), heat_legend(comparison.rig)
    return [
        write_sheet(folder / "comparison.png", faces, origin),
        write_sheet(folder / "motion.png", motion, f"{origin}; {BEYOND}", legend=legend),
    ]


def motion_panes(comparison: Comparison, painter: Painter) -> list[Pane]:
    """Return how far each vertex moved since the start: in the reference, if any, and in every answer."""
    rig, start = comparison.rig, comparison.start
    origin = rig.evaluate(start.weights)
    panes = []
    if comparison.reference is not None:
        meant = rig.evaluate(comparison.reference)
        image = painter.paint(meant, moved=moves(meant, origin))
        panes.append(Pane(image, "Reference", "what should move", colour=REFERENCE.colour))
    for answer in comparison.answers:
        image = painter.paint(answer.positions, start.pins, moves(answer.positions, origin))
        far = f"{comparison.far_name} {share(comparison, answer.far_motion)}"
        panes.append(Pane(image, answer.title, far, colour=INKS[answer.key].colour))
    return panes


def comparison_panes(comparison: Comparison, painter: Painter, *, timed: bool = True) -> list[Pane]:
    """Return the reference (or the start, with the pins before the drag) and every answer as panes."""
    rig, pins = comparison.rig, comparison.start.pins
    if comparison.reference is None:
        image = painter.paint(rig.evaluate(comparison.start.weights), pins)
        panes = [
            Pane(
                image,
                "Start",
                "1 pin and its goal" if len(pins) == 1 else f"{len(pins)} pins and their goals",
            )
        ]
    else:
        meant = painter.paint(rig.evaluate(comparison.reference))
        panes = [Pane(meant, "Reference", "the pose that is meant", colour=REFERENCE.colour)]
    for answer in comparison.answers:
        panes.append(
            Pane(
                painter.paint(answer.positions, pins),
                answer.title,
                answer.settings_line,
                measured_lines(comparison, answer, timed=timed),
                INKS[answer.key].colour,
            )
        )
    return panes


def measured_lines(comparison: Comparison, answer: Answer, *, timed: bool = True) -> tuple[str, ...]:
    """Return what is measured about an answer, in words for a picture."""

    lines = []
    if answer.e_rms is not None:
        lines.append(f"E_RMS {number(answer.e_rms)}")
    lines += [
        f"pin error {share(comparison, answer.pin_error)}",
        f"{comparison.far_name} {share(comparison, answer.far_motion)}",
        f"{answer.out_of_range} out of range, {answer.active} active",
    ]
    if timed:
        lines.append(f"{answer.milliseconds:.2f} ms per solve")
    return tuple(lines)


def share(comparison: Comparison, length: float) -> str:
    """Return a length in per cent of the face height, in words."""
    value = comparison.percent(length)
    return f"{value:.2f}\u00a0%" if value < 10 else f"{value:,.0f}\u00a0%"


def origin_line(comparison: Comparison) -> str:
    """Return which rig and pins made a picture."""
    rig, pins = comparison.rig, len(comparison.start.pins)
    return (
        f"{rig.name}: {rig.vertex_count:,} vertices, {rig.shape_count} shapes; {pins} pin{'s'[: pins != 1]}; "
        "lengths in % of face height"
    )


def settings_line(comparison: Comparison) -> str:
    """Return the settings of all solvers in a line."""
    return "; ".join(
        f"{answer.title}: {answer.settings_line}" if answer.settings_line else answer.title
        for answer in comparison.answers
    )
