"""The study: how close a simulated animator gets to poses, with every solver and both freedoms."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from itertools import product
from typing import get_args

import numpy as np

from facepin.core.pose import Freedom
from facepin.core.rig import Rig
from facepin.figures.study.animator import Outcome, Protocol, animate, drawable, make_task
from facepin.figures.study.intervals import Interval, bootstrap, median
from facepin.figures.study.processes import spread
from facepin.figures.study.references import References
from facepin.session.solving.solving import SolverChoice

FREEDOMS: tuple[Freedom, ...] = get_args(Freedom)


@dataclass(frozen=True)
class Row:
    """One line of the study: a solver with one freedom of the pins."""

    choice: SolverChoice
    freedom: Freedom
    outcome: Outcome
    """Medians over the trials, also of counts."""
    intervals: Mapping[str, Interval] = field(default_factory=dict)
    """Of every median, by its name; empty unless asked for."""


@dataclass(frozen=True, eq=False)
class Study:
    """What was simulated, and what came of it."""

    rig: Rig
    protocol: Protocol
    trials: int
    rows: tuple[Row, ...]
    reference: str = ""
    """Where the poses are from; empty where they were drawn by chance."""


@dataclass(frozen=True, eq=False)
class _Plan:
    rig: Rig
    protocol: Protocol
    methods: Sequence[tuple[SolverChoice, Freedom]]
    references: References | None

    def trial(self, number: int) -> list[Outcome]:
        """Let every method do the same task."""
        reference = None if self.references is None else self.references.poses[number]
        task = make_task(self.rig, self.protocol, number, reference)
        return [animate(self.rig, task, choice, freedom) for choice, freedom in self.methods]


def study(
    rig: Rig,
    protocol: Protocol,
    choices: Sequence[SolverChoice],
    freedoms: Sequence[Freedom] = FREEDOMS,
    trials: int = 40,
    jobs: int = 1,
    *,
    references: References | None = None,
    intervals: bool = False,
    progress: Callable[[float], None] = lambda share: None,
) -> Study:
    """Run every trial with every solver and freedom: the same reference poses, pins and tremor for all.

    Parameters
    ----------
    jobs : int
        Processes to share the trials among.  All figures but the milliseconds are the same for any number.
    references : References
        Poses to follow, as many as there are trials then; without them, poses are drawn by chance.
    intervals : bool
        Say how sure the medians are, too.
    progress : callable
        Told the share of the trials that is done.

    Raises
    ------
    FacepinError
        When fewer shapes may be used than the protocol wants in a pose.
    """
    if references is None:
        drawable(rig, protocol)
    else:
        trials = len(references.poses)
    plan = _Plan(rig, protocol, tuple(product(choices, freedoms)), references)
    done: dict[int, list[Outcome]] = {}
    for number, outcomes in spread(plan.trial, trials, jobs):
        done[number] = outcomes
        progress(len(done) / trials)
    rows, names = [], [each.name for each in fields(Outcome)]
    for which, method in enumerate(plan.methods):
        own = [done[number][which] for number in range(trials)]
        values = {name: np.array([getattr(each, name) for each in own], np.float64) for name in names}
        sure = {name: bootstrap(each, median) for name, each in values.items()} if intervals else {}
        outcome = Outcome(**{name: float(np.median(each)) for name, each in values.items()})
        rows.append(Row(*method, outcome, sure))
    return Study(rig, protocol, trials, tuple(rows), references.name if references else "")
