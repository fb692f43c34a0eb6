"""Table 1 of the paper, measured: what a press, a drag frame and its parts, and pictures cost."""

import json
import os
import platform
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

from facepin.core.arrays import Floats, Points
from facepin.core.errors import FacepinError
from facepin.core.look.camera import Camera, Viewport, frame_points
from facepin.core.mesh.normals import NormalField
from facepin.core.mesh.picking import pick
from facepin.core.mesh.topology import edge_count
from facepin.core.pose import Pin, as_vector
from facepin.core.rig import Rig
from facepin.core.shapes import measures
from facepin.core.shapes.deform import Deformer
from facepin.figures.bench.frame_times import FrameTime, frame_times, frames_as_json, frames_as_table
from facepin.figures.bench.plain_frame import PlainFrame
from facepin.figures.bench.stand_ins import TABLE_1, stand_in, stand_in_name
from facepin.figures.compare import context_or_word, progress_line
from facepin.figures.study.animator import PULL, Protocol, make_task
from facepin.files import open_rig
from facepin.options import rig_path
from facepin.resources import BUILTIN, resource
from facepin.session.solving.solving import PinSolver, SolverChoice, choose

if TYPE_CHECKING:
    import moderngl
    from rich.table import Table

SIZE = (1280, 720)
"""Pixels of the picture that is drawn."""
SOLVER = "transpose"
"""The paper's own."""
PLAIN_EVERY = 5
"""Drag frames after which the plain one is measured too: seldom enough to leave the memory to the others."""


@dataclass(frozen=True)
class Parts:
    """Medians over all drag frames, in seconds; None without OpenGL."""

    solve: float
    deform: float
    normals: float
    upload: float | None
    draw: float | None


@dataclass(frozen=True)
class BenchRow:
    """One line of the table.  Times in seconds."""

    rig: str
    vertices: int
    edges: int
    faces: int
    shapes: int
    pins: int
    t_pin: float
    """Median over the presses: pick, pin rows, preparation of the solver."""
    t_edit: float
    """Median over the drag frames of solve + deform + normals + upload (as far as there is OpenGL)."""
    parts: Parts
    plain: float | None = None
    """Median of `PlainFrame` in the same run, for some of the poses; None where B is too large for it."""


def add_options(parser: ArgumentParser) -> None:
    """Declare the options of `facepin bench`."""
    parser.add_argument(
        "rigs", type=rig_path, nargs="*", metavar="RIG", help="faces to measure (default: the built-in one)"
    )
    parser.add_argument("--json", action="store_true", help="print JSON only")


def run(options: Namespace) -> None:
    """Do `facepin bench`: print the table, or JSON."""
    from rich.console import Console

    with progress_line() as tell, context_or_word() as ctx:
        tell("Opening")
        rigs = [stand_in(row) for row in TABLE_1]
        own = [open_rig(path) for path in options.rigs or [resource("assets", BUILTIN)]]
        rows, frames = [], list[FrameTime]()
        for rig in rigs + own:
            tell(f"Measuring {rig.name}")
            rows.append(measure(rig, ctx))
        if ctx is not None:
            for rig in own:
                tell(f"Drawing {rig.name}")
                frames += frame_times(rig, ctx, SIZE)
        line = machine(ctx)
    if options.json:
        sys.stdout.write(json.dumps(as_json(line, rows, frames), indent=2) + "\n")
    else:
        pictures = [frames_as_table(frames, SIZE)] if frames else []
        Console().print(*as_tables(line, rows), *pictures, sep="\n")


def measure(
    rig: Rig,
    ctx: "moderngl.Context | None" = None,
    choice: SolverChoice | None = None,
    protocol: Protocol | None = None,
) -> BenchRow:
    """Let the simulated animator of the study pose a rig, and time what the window does for it.

    Every pin in turn is pressed and dragged for 20 frames while the earlier ones hold.

    Parameters
    ----------
    rig : Rig
        Any; pins go where a reference pose moves it most.
    ctx : moderngl.Context
        Where to draw; nothing is uploaded or drawn without it.
    choice : SolverChoice
        The paper's transposition by default.
    protocol : Protocol
        As in the study: 15 pins, or as many as find room.

    Raises
    ------
    FacepinError
        When no shape moves anything.
    """
    choice = choice or choose(SOLVER)
    moving = int(np.count_nonzero(rig.largest_moves >= measures.REST * rig.height))
    if not moving:
        raise FacepinError(f"{rig.name}: no shape moves the face, so there is nothing to measure")
    protocol = protocol or Protocol(shapes=min(Protocol.shapes, moving))
    task = make_task(rig, protocol, trial=0)

    viewport = Viewport(0, 0, *SIZE)
    camera = frame_points(rig.neutral, viewport.aspect)
    pane = _Pane(rig, choice, _Screen(ctx, rig, viewport, camera) if ctx else None)
    weights = rig.rest_weights
    positions = pane.deformer.deform(weights)
    pins: tuple[Pin, ...] = ()
    presses: list[float] = []
    frames: list[list[float]] = []
    plain = PlainFrame(rig) if PlainFrame.fits(rig) else None
    plain_frames: list[float] = []
    for vertex, tremor in zip(task.vertices, task.tremor, strict=True):
        x, y, _ = camera.project(positions[vertex], viewport)[0]
        start, goal = weights, positions[vertex].astype(np.float64)
        held, pins = pins, (*pins, Pin(vertex, as_vector(goal)))
        began = perf_counter()
        pick(positions, rig.triangles, camera, viewport, (x, y))
        pane.solver.solve(pins, start)
        presses.append(perf_counter() - began)
        for shake in tremor:
            goal[:2] += PULL * (task.wanted[vertex] - positions[vertex])[:2] + shake
            pins = (*held, Pin(vertex, as_vector(goal)))
            weights, positions, times = pane.frame(pins, start)
            frames.append(times)
            if plain is not None and len(frames) % PLAIN_EVERY == 0:
                began = perf_counter()
                plain.compute(weights)
                plain_frames.append(perf_counter() - began)
    pane.release()
    parts = [float(time) for time in np.median(frames, axis=0)]
    return BenchRow(
        rig.name,
        rig.vertex_count,
        edge_count(rig),
        len(rig.face_sizes),
        rig.shape_count,
        len(task.vertices),
        float(np.median(presses)),
        float(np.median(np.sum(np.array(frames)[:, :4], axis=1))),
        Parts(*parts, *[None] * (5 - len(parts))),
        float(np.median(plain_frames)) if plain_frames else None,
    )


def machine(ctx: "moderngl.Context | None" = None) -> str:
    """Say in a line what the times were measured on."""
    name = platform.processor() or platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        models = [line for line in cpuinfo.read_text().splitlines() if line.startswith("model name")]
        name = models[0].partition(":")[2].strip() if models else name
    renderer = ctx.info["GL_RENDERER"] if ctx else "no OpenGL"
    versions = f"Python {platform.python_version()}, numpy {np.__version__}"
    return f"{name}, {os.cpu_count()} cores, {renderer}, {versions}"


def as_json(machine_line: str, rows: Sequence[BenchRow], frames: Sequence[FrameTime] = ()) -> dict[str, Any]:
    """Return what `facepin bench --json` prints.  Times in seconds; null for what needs OpenGL without it."""
    return {
        "machine": machine_line,
        "rows": [asdict(row) for row in rows],
        "frames": frames_as_json(frames),
    }


def as_tables(machine_line: str, rows: Sequence[BenchRow]) -> "list[Table]":
    """Return what the terminal shows: sizes, T_edit beside plain numpy, and times beside the paper's."""
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    def table(title: str, words: str, columns: list[str]) -> Table:
        made = Table(title=title, caption=words, box=SIMPLE_HEAD, padding=0)
        made.add_column("rig", overflow="ellipsis", max_width=20, no_wrap=True)
        for name in columns:
            made.add_column(name, justify="right", no_wrap=True)
        return made

    sizes = table("What is measured", "", ["vertices", "edges", "faces", "shapes", "pins"])
    plain = table(
        "A drag frame beside plain numpy, in milliseconds (medians)",
        "plain: B w as one dense product, normals of all triangles, nothing else.",
        ["T_edit", "plain", "share"],
    )
    times = table(
        "A press and a drag frame, in milliseconds (medians)",
        "T_edit is solve + deform + normals + upload.  paper: Cetinaslan, Lewis and Orvalho 2017, Table 1, "
        f"their faces on their machine.  Here: {machine_line}.",
        ["T_pin", "paper", "T_edit", "paper", "solve", "deform", "normals", "upload", "draw"],
    )
    paper = {stand_in_name(row): row for row in TABLE_1}
    for row in rows:
        sizes.add_row(row.rig, *map(str, (row.vertices, row.edges, row.faces, row.shapes, row.pins)))
        share = "-" if row.plain is None else f"{row.t_edit / row.plain:.2f}"
        plain.add_row(row.rig, _milliseconds(row.t_edit), _milliseconds(row.plain), share)
        theirs = paper.get(row.rig)
        pin, edit = (theirs.t_pin, theirs.t_edit) if theirs else (None, None)
        parts = asdict(row.parts).values()
        times.add_row(row.rig, *map(_milliseconds, (row.t_pin, pin, row.t_edit, edit, *parts)))
    return [sizes, plain, times]


def _milliseconds(seconds: float | None) -> str:
    if seconds is None:
        return "-"
    digits = 2 if seconds < 0.01 else 1 if seconds < 0.1 else 0
    return f"{1e3 * seconds:.{digits}f}"


class _Pane:
    """What turns pins into a picture, as in the window."""

    def __init__(self, rig: Rig, choice: SolverChoice, screen: "_Screen | None") -> None:
        self.solver = PinSolver(rig, choice)
        self.deformer = Deformer(rig)
        self._normals = NormalField(rig)
        self._screen = screen

    def frame(self, pins: tuple[Pin, ...], start: Floats) -> tuple[Floats, Points, list[float]]:
        """Do a drag frame; return weights (k,), positions (n, 3) and the seconds of its parts, in order."""
        stamps = [perf_counter()]
        weights = self.solver.solve(pins, start).weights
        stamps.append(perf_counter())
        positions = self.deformer.deform(weights)
        stamps.append(perf_counter())
        normals = self._normals.normals(positions)
        stamps.append(perf_counter())
        if self._screen is not None:
            self._screen.upload(positions, normals)
            stamps.append(perf_counter())
            self._screen.draw()
            stamps.append(perf_counter())
        return weights, positions, np.diff(stamps).tolist()

    def release(self) -> None:
        """Give the graphics memory back."""
        if self._screen is not None:
            self._screen.release()


class _Screen:
    """A face on the graphics card, drawn the way a drag draws it."""

    def __init__(self, ctx: "moderngl.Context", rig: Rig, viewport: Viewport, camera: Camera) -> None:
        from facepin.gpu.canvas import Canvas
        from facepin.gpu.scene import PaneMesh, Scene

        self._ctx, self._viewport, self._camera = ctx, viewport, camera
        self._canvas = Canvas(ctx, samples=0)
        self._canvas.resize(*SIZE)
        self._scene = Scene(ctx, rig)
        self._mesh = PaneMesh(self._scene)

    def upload(self, positions: Points, normals: Points) -> None:
        """Send a pose."""
        self._mesh.upload(positions, normals)

    def draw(self) -> None:
        """Draw a picture and wait until it is there."""
        self._mesh.draw(self._canvas, self._viewport, self._camera, fine=False)
        self._ctx.finish()

    def release(self) -> None:
        """Give the graphics memory back."""
        self._mesh.release()
        self._scene.release()
        self._canvas.release()
