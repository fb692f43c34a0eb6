"""The command `study`: how close a simulated animator gets to a pose, with every solver and both freedoms."""

import json
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, fields
from itertools import product
from os import cpu_count
from pathlib import Path
from typing import get_args

import numpy as np

from facepin.core.errors import FacepinError
from facepin.core.pose import Freedom
from facepin.core.rig import Rig
from facepin.figures.animator import Outcome, Protocol, animate, drawable, make_task
from facepin.figures.processes import spread
from facepin.options import add_rig, add_solver, open_with_bar, solver_choices
from facepin.session.solving import SolverChoice

FREEDOMS: tuple[Freedom, ...] = get_args(Freedom)


@dataclass(frozen=True)
class Row:
    """One line of the study: a solver with one freedom of the pins."""

    choice: SolverChoice
    freedom: Freedom
    outcome: Outcome
    """Medians over the trials, also of counts."""


@dataclass(frozen=True, eq=False)
class Study:
    """What was simulated, and what came of it."""

    rig: Rig
    protocol: Protocol
    trials: int
    rows: tuple[Row, ...]


@dataclass(frozen=True, eq=False)
class _Plan:
    rig: Rig
    protocol: Protocol
    methods: Sequence[tuple[SolverChoice, Freedom]]

    def trial(self, number: int) -> list[Outcome]:
        """Let every method do the same task."""
        task = make_task(self.rig, self.protocol, number)
        return [animate(self.rig, task, choice, freedom) for choice, freedom in self.methods]


def study(
    rig: Rig,
    protocol: Protocol,
    choices: Sequence[SolverChoice],
    freedoms: Sequence[Freedom] = FREEDOMS,
    trials: int = 40,
    jobs: int = 1,
    *,
    progress: Callable[[int], None] = lambda done: None,
) -> Study:
    """Run every trial with every solver and freedom: the same reference poses, pins and tremor for all.

    Parameters
    ----------
    jobs : int
        Processes to share the trials among.  All figures but the milliseconds are the same for any number.
    progress : callable
        Told the number of trials done.

    Raises
    ------
    FacepinError
        When fewer shapes may be used than the protocol wants in a pose.
    """
    drawable(rig, protocol)
    plan = _Plan(rig, protocol, tuple(product(choices, freedoms)))
    outcomes = []
    for _, outcome in spread(plan.trial, trials, jobs):
        outcomes.append(outcome)
        progress(len(outcomes))
    medians = map(_median, zip(*outcomes, strict=True))
    rows = (Row(*method, outcome) for method, outcome in zip(plan.methods, medians, strict=True))
    return Study(rig, protocol, trials, tuple(rows))


def _median(outcomes: Sequence[Outcome]) -> Outcome:
    """Return the median of every figure on its own."""
    names = [field.name for field in fields(Outcome)]
    return Outcome(**{n: float(np.median([getattr(outcome, n) for outcome in outcomes])) for n in names})


def add_options(parser: ArgumentParser) -> None:
    """Declare the options of `facepin study`."""
    default = Protocol()
    add_rig(parser)
    add_solver(parser, "all", "--solvers")

    def add(flag: str, kind: type, value: object, words: str, metavar: str = "N") -> None:
        parser.add_argument(
            flag, type=kind, default=value, metavar=metavar, help=f"{words} (default: %(default)s)"
        )

    add("--pins", int, default.pins, "pins that are dragged, one after the other")
    add("--shapes", int, default.shapes, "active shapes of a reference pose")
    add("--trials", int, 40, "reference poses")
    add("--noise", float, default.noise, "how much the hand trembles, in %% of face height", "X")
    add("--seed", int, default.seed, "other numbers draw other poses", "S")
    parser.add_argument("--freedom", choices=(*FREEDOMS, "both"), default="both", help="what the pins hold")
    parser.add_argument(
        "--without",
        action="append",
        default=[],
        metavar="PATTERN",
        help="shapes that no reference pose has, e.g. 'identity*'; may be repeated",
    )
    add("--jobs", int, cpu_count() or 1, "processes")
    parser.add_argument("--json", action="store_true", help="print JSON only")
    parser.add_argument("--out", type=Path, metavar="FOLDER", help="write study.json, study.csv and a chart")


def run(options: Namespace) -> None:
    """Do `facepin study`: print the table or JSON, and write files where asked to."""
    for name, low in (("pins", 1), ("shapes", 1), ("trials", 1), ("jobs", 1), ("noise", 0), ("seed", 0)):
        if not low <= getattr(options, name) < np.inf:
            raise FacepinError(f"--{name}: found {getattr(options, name)}, allowed: {low} or more")
    from facepin.figures.study_report import as_json, as_table, write_study

    choices = solver_choices(options.solver, options.settings, options.limits)
    freedoms = FREEDOMS if options.freedom == "both" else (options.freedom,)
    protocol = Protocol(options.pins, options.shapes, options.noise, options.seed, tuple(options.without))
    rig = open_with_bar(options.rig, options.neutral)
    with _bar(options.trials) as progress:
        found = study(rig, protocol, choices, freedoms, options.trials, options.jobs, progress=progress)
    if options.json:
        sys.stdout.write(json.dumps(as_json(found), indent=2, ensure_ascii=False) + "\n")
    else:
        from rich.console import Console

        Console().print(as_table(found))
    if options.out is not None:  # last: if that fails, what was found is there to be read
        write_study(options.out, found)


@contextmanager
def _bar(trials: int) -> Iterator[Callable[[int], None]]:
    """Show how many trials are done, where a person is watching."""
    if not sys.stderr.isatty():
        yield lambda done: None
        return
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("Posing", total=trials)
        yield lambda done: bar.update(task, completed=done)
