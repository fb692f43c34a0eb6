"""The command `study`: a simulated animator, or drags one by one, on one rig or several."""

import json
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import product
from os import cpu_count
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from facepin.core.errors import FacepinError
from facepin.core.pose import Freedom
from facepin.core.rig import Rig
from facepin.figures.compare import made_folder
from facepin.figures.study import drag_report, report
from facepin.figures.study.animator import Protocol
from facepin.figures.study.drag_study import DragProtocol, DragStudy, drag_study
from facepin.figures.study.references import References, read_references
from facepin.figures.study.study import FREEDOMS, Study, study
from facepin.options import add_rigs, add_solver, open_with_bar, solver_choices

TRIALS = 40
WIDEST = 500
"""Characters in a line of a table that no terminal is waiting for."""

Found = TypeVar("Found")

ANIMATOR = ("pins", "shapes", "trials", "noise", "without", "reference")
"""Options that only the simulated animator has."""
DRAGS = ("size", "points")
"""Options that only `--drags` has."""
LEAST = {"pins": 1, "shapes": 1, "trials": 1, "jobs": 1, "noise": 0, "seed": 0, "points": 1}


def add_options(parser: ArgumentParser) -> None:
    """Declare the options of `facepin study`."""
    poses, drags = Protocol(), DragProtocol()
    add_rigs(parser)
    parser.add_argument(
        "--drags",
        action="store_true",
        help="instead of posing, drag many points one by one, and measure how the skin follows",
    )
    add_solver(parser, "all", "--solvers")
    parser.add_argument(
        "--no-limits",
        dest="limits",
        action="store_false",
        help="let weights go beyond (default; with --drags, limits are kept)",
    )
    parser.set_defaults(limits=None)

    def add(flag: str, kind: type, usual: object, words: str, metavar: str = "N") -> None:
        parser.add_argument(flag, type=kind, metavar=metavar, help=f"{words} (default: {usual})")

    add("--pins", int, poses.pins, "pins that are dragged, one after the other")
    add("--shapes", int, poses.shapes, "active shapes of a reference pose")
    add("--trials", int, TRIALS, "reference poses")
    add("--noise", float, poses.noise, "how much the hand trembles, in %% of face height", "X")
    parser.add_argument(
        "--without",
        action="append",
        metavar="PATTERN",
        help="shapes that no reference pose has, e.g. 'identity*'; may be repeated",
    )
    parser.add_argument(
        "--reference",
        type=Path,
        metavar="PATH",
        help="take the reference poses from a folder of pose files, a pose file, or a .csv with the names of "
        "shapes in the first row and a pose in each other row; of more than --trials, evenly chosen ones",
    )
    parser.add_argument(
        "--size",
        type=float,
        nargs="+",
        metavar="PERCENT",
        help="of --drags: lengths of the drags, in %% of face height "
        f"(default: {' '.join(f'{size:g}' for size in drags.sizes)})",
    )
    add("--points", int, drags.points, "of --drags: points that are dragged")
    parser.add_argument(
        "--freedom",
        choices=(*FREEDOMS, "both"),
        help="what the pins hold (default: both; of --drags, screen)",
    )
    parser.add_argument(
        "--seed",
        type=int,
        default=1,
        metavar="S",
        help="other numbers draw others (default: %(default)s)",
    )
    parser.add_argument(
        "--intervals", action="store_true", help="say how sure the figures are: their 95 %% intervals"
    )
    parser.add_argument(
        "--jobs", type=int, default=cpu_count() or 1, metavar="N", help="processes (default: %(default)s)"
    )
    parser.add_argument("--json", action="store_true", help="print JSON only")
    parser.add_argument(
        "--out",
        type=Path,
        metavar="FOLDER",
        help="write JSON, CSV and a chart there; of --drags, maps of the face too",
    )


def run(options: Namespace) -> None:
    """Do `facepin study`: print the table or JSON, and write files where asked to."""
    _check(options)
    if options.out is not None:
        made_folder(options.out)  # better refused before the work than after it
    if options.drags:
        _run_drags(options)
    else:
        _run_animator(options)


def _check(options: Namespace) -> None:
    """Refuse senseless numbers, and options that would do nothing."""
    for name, low in LEAST.items():
        value = getattr(options, name)
        if value is not None and not low <= value < np.inf:
            raise FacepinError(f"--{name}: found {value}, allowed: {low} or more")
    for size in options.size or ():
        if not 0 < size <= 100:
            raise FacepinError(f"--size: found {size:g}, allowed: above 0, up to 100 % of face height")
    for name in ANIMATOR if options.drags else DRAGS:
        if getattr(options, name) is not None:
            where = "not used with" if options.drags else "used only with"
            raise FacepinError(f"--{name} is {where} --drags")
    if options.reference is not None and (options.shapes is not None or options.without is not None):
        raise FacepinError("--shapes and --without are for poses drawn by chance, not with --reference")


def _or_else(value: Any, usual: Any) -> Any:
    return usual if value is None else value


def _freedoms(options: Namespace, usual: str) -> tuple[Freedom, ...]:
    chosen = options.freedom or usual
    return tuple(freedom for freedom in FREEDOMS if chosen in (freedom, "both"))


def _run_animator(options: Namespace) -> None:
    usual = Protocol()
    choices = solver_choices(options.solver, options.settings, bool(options.limits))
    protocol = Protocol(
        _or_else(options.pins, usual.pins),
        _or_else(options.shapes, usual.shapes),
        _or_else(options.noise, usual.noise),
        options.seed,
        tuple(options.without or ()),
    )
    trials, freedoms = _or_else(options.trials, TRIALS), _freedoms(options, "both")

    def one(rig: Rig, tell: Callable[[float], None]) -> Study:
        references = None if options.reference is None else _references(options.reference, rig, trials)
        return study(
            rig, protocol, choices, freedoms, trials, options.jobs,
            references=references, intervals=options.intervals, progress=tell,
        )  # fmt: skip

    found = _each_rig(options, one)
    _print(options, report.as_json(found), lambda: report.as_table(found))
    if options.out is not None:  # last: if that fails, what was found is there to be read
        report.write_study(options.out, found)


def _run_drags(options: Namespace) -> None:
    usual = DragProtocol()
    choices = solver_choices(options.solver, options.settings, _or_else(options.limits, True))
    methods = tuple(product(choices, _freedoms(options, "screen")))
    sizes = tuple(dict.fromkeys(_or_else(options.size, usual.sizes)))
    protocol = DragProtocol(_or_else(options.points, usual.points), sizes, options.seed)

    def one(rig: Rig, tell: Callable[[float], None]) -> DragStudy:
        return drag_study(rig, protocol, methods, options.jobs, intervals=options.intervals, progress=tell)

    found = _each_rig(options, one)
    _print(options, drag_report.as_json(found), lambda: drag_report.as_table(found))
    if options.out is not None:
        drag_report.write_drags(options.out, found)


def _references(path: Path, rig: Rig, trials: int) -> References:
    """Read reference poses, and say what of them this rig does not have."""
    references = read_references(path, rig, trials)
    for line in references.remarks:
        sys.stderr.write(f"facepin: {line}\n")
    return references


def _each_rig(options: Namespace, one: Callable[[Rig, Callable[[float], None]], Found]) -> list[Found]:
    """Study one rig after the other."""
    found = []
    for path in options.rigs:
        rig = open_with_bar(path, options.neutral)
        with _bar(rig.name) as tell:
            found.append(one(rig, tell))
    return found


def _print(options: Namespace, told: dict[str, Any], table: Callable[[], Any]) -> None:
    if options.json:
        sys.stdout.write(json.dumps(told, indent=2, ensure_ascii=False) + "\n")
    else:
        from rich.console import Console

        console, made = Console(), table()
        if not console.is_terminal:  # in a file there is room for all of it
            anything = console.options.update(width=WIDEST)
            console.width = max(console.width, console.measure(made, options=anything).maximum)
        console.print(made)


@contextmanager
def _bar(name: str) -> Iterator[Callable[[float], None]]:
    """Show which share of a rig's work is done, where a person is watching."""
    if not sys.stderr.isatty():
        yield lambda share: None
        return
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(name, total=1.0)
        yield lambda share: bar.update(task, completed=share)
