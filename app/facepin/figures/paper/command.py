"""The command `figures`: every figure and table of the paper that can be made again, on a page."""

from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from facepin.core.errors import FacepinError
from facepin.core.rig import Rig
from facepin.core.shapes.measures import REST
from facepin.figures.bench import command as bench
from facepin.figures.bench.stand_ins import TABLE_1, stand_in, stand_in_name
from facepin.figures.compare import PANE, context_or_word, made_folder, progress_line
from facepin.figures.paper import remakes
from facepin.figures.paper.page import Remake, Table, page
from facepin.figures.pictures import Painter
from facepin.files.safely.atomic import atomic_write
from facepin.options import open_with_bar, rig_path
from facepin.resources import builtin_faces

if TYPE_CHECKING:
    import moderngl

TITLE = "Transposition based blendshape direct manipulation, remade"
LEAD = (
    "The figures and the table of Cetinaslan, Lewis and Orvalho (2017), made again by Facepin. All solvers "
    "get the same pins; lengths are in per cent of the face height unless a unit is given."
)
FIGURES: tuple[Callable[[remakes.Studio], Remake], ...] = (
    remakes.one_pin,
    remakes.target_pose,
    remakes.many_shapes,
    remakes.hybrid_pins,
    remakes.in_steps,
)


def add_options(parser: ArgumentParser) -> None:
    """Declare the options of `facepin figures`."""
    parser.add_argument(
        "rigs",
        type=rig_path,
        nargs="*",
        metavar="RIG",
        help="rigs to make them on, besides the built-in face",
    )
    parser.add_argument("--seed", type=int, default=1, metavar="S", help="of random poses (default: 1)")
    parser.add_argument("--no-table", action="store_true", help="leave out Table 1, which measures times")
    parser.add_argument("--out", type=Path, required=True, metavar="FOLDER", help="where the page goes")


def run(options: Namespace) -> Path:
    """Do `facepin figures`; return the path of the page."""
    folder = made_folder(options.out)
    rigs = [open_with_bar(None), *(open_with_bar(path) for path in options.rigs)]
    for rig in rigs:
        if not rig.shape_count or rig.largest_moves.max() < REST * rig.height:
            raise FacepinError(f"{rig.name}: no shape moves the face, so there are no figures to make")
    with progress_line() as tell, context_or_word() as ctx:
        sections = []
        for number, rig in enumerate(rigs):
            own = made_folder(folder / f"rig-{number + 1}")
            sections.append((_heading(rig), _figures(rig, own, options.seed, FIGURES, ctx, tell)))
        if not any(rig.shape_count > remakes.MANY_SHAPES for rig in rigs):
            sections += [
                (
                    _heading(rig),
                    _figures(
                        rig,
                        made_folder(folder / "many-shapes"),
                        options.seed,
                        (remakes.many_shapes,),
                        ctx,
                        tell,
                    ),
                )
                for rig in _production_face()
            ]
        if not options.no_table:
            tell("Table 1")
            sections.append(("Timings", [table_1(rigs, ctx)]))
    path = folder / "index.html"
    atomic_write(path, page(TITLE, LEAD, sections, folder).encode())
    return path


def _figures(
    rig: Rig,
    folder: Path,
    seed: int,
    makers: tuple[Callable[[remakes.Studio], Remake], ...],
    ctx: "moderngl.Context | None",
    tell: Callable[[str], None],
) -> list[Remake]:
    """Make figures of one rig; Figure 5 only where there are shapes enough."""
    front = None if ctx is None else Painter(ctx, rig, PANE)
    studio = remakes.Studio(rig, folder, seed, front, ctx)
    made = []
    for maker in makers:
        if maker is remakes.many_shapes and rig.shape_count <= remakes.MANY_SHAPES:
            continue
        tell(f"{rig.name}: {maker.__name__.replace('_', ' ')}")
        made.append(maker(studio))
    if front is not None:
        front.release()
    return made


def _heading(rig: Rig) -> str:
    return f"{rig.name}, {rig.shape_count} shapes"


def _production_face() -> list[Rig]:
    """Return the first built-in face with enough shapes for Figure 5, if there is one."""
    for path in builtin_faces().values():
        rig = open_with_bar(path)
        if rig.shape_count > remakes.MANY_SHAPES:
            return [rig]
    return []


def table_1(rigs: list[Rig], ctx: "moderngl.Context | None") -> Remake:
    """Table 1: what a press and a drag frame cost, beside the paper's figures."""
    paper = {stand_in_name(row): row for row in TABLE_1}
    measured = [bench.measure(rig, ctx) for rig in [*rigs, *(stand_in(row) for row in TABLE_1)]]
    rows = []
    for row in measured:
        theirs = paper.get(row.rig)
        rows.append(
            (
                row.rig,
                *(f"{count:,}" for count in (row.vertices, row.edges, row.faces, row.shapes)),
                f"{1e3 * row.t_pin:.2f}",
                f"{1e3 * theirs.t_pin:,.0f}" if theirs else "",
                f"{1e3 * row.t_edit:.2f}",
                f"{1e3 * theirs.t_edit:.1f}" if theirs else "",
            )
        )
    head = ("rig", "vertices", "edges", "faces", "shapes", "T_pin", "paper", "T_edit", "paper")
    slowest = max(row.t_edit for row in measured)
    return Remake(
        "Table 1",
        "What a press and a drag frame cost",
        (
            "T_pin is the time from a press to a pin that can be dragged, T_edit that of a drag frame from "
            "the mouse to positions and normals on the graphics card; both are medians in milliseconds. "
            f"The slowest frame here takes {1e3 * slowest:.2f} ms, the paper's took 9.9 to 19 ms in Maya."
        ),
        f"{bench.machine(ctx)}; {bench.SOLVER}; stand-ins have the paper's counts, made-up shapes",
        table=Table(head, tuple(rows)),
    )
