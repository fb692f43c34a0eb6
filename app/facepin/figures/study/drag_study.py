"""The drag study: many drags of many points with every solver, and what they come to."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.pose import Freedom
from facepin.core.rig import Rig
from facepin.figures.study.drags import DIRECTIONS, Method, PointDrags, drag_point
from facepin.figures.study.holding import Case, hold
from facepin.figures.study.intervals import Interval, Statistic, bootstrap, median, p90, percent_above
from facepin.figures.study.points import spread_points
from facepin.figures.study.processes import spread
from facepin.figures.study.reach import Reach
from facepin.session.solving.solving import SolverChoice

DEAD = 0.9
"""A drag of which more than this share remains has not moved the point."""


@dataclass(frozen=True)
class DragProtocol:
    """What is dragged."""

    points: int = 60
    sizes: tuple[float, ...] = (3.0, 8.0)
    """Lengths of the drags, in per cent of the face height."""
    seed: int = 1
    cases: int = 30
    """Sequences of drags with pins that stay."""


@dataclass(frozen=True)
class DragFigures:
    """One line of the table; NaN where there was nothing to measure.  Percentages as their names say."""

    reachable: float
    """Share of the drags that the shapes could follow within limits, in per cent."""
    lag_median_percent: float
    """Of the drags that can be reached, like the next two: what remains, in per cent of the drag."""
    lag_p90_percent: float
    dead_percent: float
    """Drags that leave more than 90 %."""
    far_share_percent: float
    """Drags that move something far from the pin by more than their own length."""
    active_p90: float
    weight_per_pixel_p90: float
    overdrag_change_median: float
    overdrag_change_p90: float
    press_jump_percent: float
    """Largest of all cases, like the next; in per cent of the face height."""
    removal_jump_percent: float
    slip_median_percent: float
    """Of the drag."""
    milliseconds: float
    """Median over the points of the median solve."""
    sequence_lag_p90_percent: float
    """What remains of the drags of a sequence, in per cent of the drag."""


@dataclass(frozen=True, eq=False)
class DragRow:
    """A solver with one freedom of the pins and one size of drags."""

    choice: SolverChoice
    freedom: Freedom
    size: float
    """In per cent of the face height."""
    figures: DragFigures
    intervals: Mapping[str, Interval]
    """Of some figures by name; empty unless asked for."""
    lag: Floats
    """(p, 4) of every drag, as shares of it; NaN where it can't be reached."""
    far: Floats
    """(p, 4) largest move far from the pin, as shares of the drag."""


@dataclass(frozen=True, eq=False)
class DragStudy:
    """What was dragged on one rig, and what came of it."""

    rig: Rig
    protocol: DragProtocol
    vertices: tuple[int, ...]
    """(p,) the points that were found."""
    rows: tuple[DragRow, ...]


@dataclass(frozen=True, eq=False)
class _Plan:
    rig: Rig
    protocol: DragProtocol
    methods: Sequence[Method]
    vertices: tuple[int, ...]
    reach: Floats = field(repr=False)
    """(p, 4)"""

    @property
    def count(self) -> int:
        """Pieces of work: for each method its points, then its cases."""
        return len(self.methods) * self._share

    @property
    def _share(self) -> int:
        return len(self.vertices) + self.protocol.cases

    def piece(self, number: int) -> PointDrags | list[Case]:
        """Do one of them; cases with all sizes."""
        which, at = divmod(number, self._share)
        method, sizes = self.methods[which], self.protocol.sizes
        if at < len(self.vertices):
            return drag_point(self.rig, method, self.vertices[at], self.reach[at], sizes)
        case, seed = at - len(self.vertices), self.protocol.seed
        return [hold(self.rig, method, self.vertices, size, seed, case) for size in sizes]


def drag_study(
    rig: Rig,
    protocol: DragProtocol,
    methods: Sequence[Method],
    jobs: int = 1,
    *,
    intervals: bool = False,
    progress: Callable[[float], None] = lambda share: None,
) -> DragStudy:
    """Drag the same points of a rig with every method.

    Parameters
    ----------
    jobs : int
        Processes to share the work among.  All figures but the milliseconds are the same for any number.
    intervals : bool
        Say of most figures how sure they are, too: points (and cases) are drawn again, see `bootstrap`.
    progress : callable
        Told the share of the work that is done.

    Raises
    ------
    FacepinError
        When no point of the rig can be dragged.
    """
    vertices = spread_points(rig, protocol.points, protocol.seed)
    reaches = [Reach(rig, vertex) for vertex in vertices]
    reach = np.array([[each.far(direction) for direction in DIRECTIONS] for each in reaches])
    plan = _Plan(rig, protocol, tuple(methods), vertices, reach)
    done: dict[int, PointDrags | list[Case]] = {}
    for number, piece in spread(plan.piece, plan.count, jobs):
        done[number] = piece
        progress(len(done) / plan.count)
    pieces = [done[number] for number in range(plan.count)]
    rows, share = [], plan.count // len(methods)
    for which, method in enumerate(methods):
        own = pieces[which * share : (which + 1) * share]
        points = [piece for piece in own if isinstance(piece, PointDrags)]
        cases = [piece for piece in own if not isinstance(piece, PointDrags)]
        for place, size in enumerate(protocol.sizes):
            reachable = reach >= size / 100 * rig.height
            held = [case[place] for case in cases]
            rows.append(_row(method, size, points, place, reachable, held, intervals))
    return DragStudy(rig, protocol, vertices, tuple(rows))


def _row(
    method: Method,
    size: float,
    points: Sequence[PointDrags],
    place: int,
    reachable: np.ndarray,
    cases: Sequence[Case],
    intervals: bool,
) -> DragRow:
    """Put together what came of all drags of one size."""

    def of_points(name: str) -> Floats:
        return np.array([getattr(point, name)[place] for point in points])

    def of_cases(name: str) -> Floats:
        return np.array([getattr(case, name) for case in cases])

    far, overdrag = of_points("far"), of_points("overdrag")
    lag = np.where(reachable, of_points("lag"), np.nan)
    measured: dict[str, tuple[Floats, Statistic]] = {
        "reachable": (reachable.astype(np.float64), partial(percent_above, bound=0.5)),
        "lag_median_percent": (100 * lag, median),
        "lag_p90_percent": (100 * lag, p90),
        "dead_percent": (lag, partial(percent_above, bound=DEAD)),
        "far_share_percent": (far, partial(percent_above, bound=1.0)),
        "active_p90": (of_points("active"), p90),
        "weight_per_pixel_p90": (of_points("per_pixel"), p90),
        "overdrag_change_median": (overdrag, median),
        "overdrag_change_p90": (overdrag, p90),
        "slip_median_percent": (of_cases("slip"), median),
        "sequence_lag_p90_percent": (of_cases("lag"), p90),
    }
    figures = DragFigures(
        press_jump_percent=_largest(of_cases("press_jump")),
        removal_jump_percent=_largest(of_cases("removal_jump")),
        milliseconds=1e3 * float(median(np.array([point.seconds for point in points]))),
        **{name: float(statistic(values.ravel())) for name, (values, statistic) in measured.items()},
    )
    sure = {name: bootstrap(*each) for name, each in measured.items() if intervals and each[0].size}
    return DragRow(*method, size, figures, sure, lag, far)


def _largest(values: Floats) -> float:
    return float(values.max()) if values.size else np.nan
