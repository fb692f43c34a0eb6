"""From pins to weights: puts a rig's pins before a solver and reads its answer back."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from time import perf_counter
from typing import Any

import numpy as np

from facepin.core.arrays import Floats, frozen
from facepin.core.control import ShapeControl
from facepin.core.errors import FacepinError
from facepin.core.pose import Pin, Pose, as_vector, pin_displacement
from facepin.core.rig import Rig
from facepin.core.rig_builder import LARGEST_WEIGHT
from facepin.session.solving.problem import LinearProblem, PinProblem
from facepin.solvers import SOLVERS
from facepin.solvers.interface import Solution, Solve, SolverKind

LARGEST_AMOUNT = LARGEST_WEIGHT**2
"""Of a shape or a combination in a solver's answer: more is beyond what can be drawn."""
FARTHEST = 1e6
"""Face heights that a goal may be away from its vertex: no arithmetic is led to where numbers end."""
SECOND_LOOKS = 2
"""Times that a solver which starts afresh is asked again, for the face as it is at its last answer."""
SETTLED = 1e-4
"""Change of every weight from look to look up to which no further look is needed."""


@dataclass(frozen=True)
class SolverChoice:
    """A solver with its settings, as one pane uses it."""

    kind: SolverKind
    settings: Any
    keep_limits: bool = False
    """Clip the result to the limits of the shapes; solvers that obey them by construction ignore this."""


def choose(key: str, settings: Any = None, keep_limits: bool = False) -> SolverChoice:
    """Return the solver `key` of the registry with its default settings or the given ones.

    Raises
    ------
    FacepinError
        Naming the solvers that exist.
    """
    if key not in SOLVERS:
        raise FacepinError(f"there is no solver '{key}' (there are: {', '.join(SOLVERS)})")
    kind = SOLVERS[key]
    return SolverChoice(kind, kind.settings() if settings is None else settings, keep_limits)


@dataclass(frozen=True, eq=False)
class Solved:
    """A solver's answer."""

    weights: Floats
    """(k,) float64, finite, read-only."""
    pin_error: float
    """Mean distance from the pins' vertices to their goals after the solve, in the rig's unit; for screen
    pins across the line of sight only.  0 without pins."""
    seconds: float
    """Time of the solve itself, as on every frame of a drag: without what is prepared once for its pins."""
    notes: Mapping[str, float] = field(default_factory=dict)


class PinSolver:
    """Solves the pins of one pane; keeps what depends on the pins' places only, for all frames of a drag."""

    def __init__(self, rig: Rig, choice: SolverChoice, control: ShapeControl | None = None) -> None:
        """Use the shapes that `control` leaves free, within its limits.

        Without one these are all shapes within the rig's own limits, as the formulas have it; ties count
        where the choice is to keep within limits.
        """
        self.choice = choice
        self._rig = rig
        if control is None:
            control = ShapeControl.of(rig)
            control = control if choice.keep_limits else replace(control, ties=())
        self._control = control
        self._places: object = None
        self._start: Floats | None = None
        self._prepared: _Prepared | None = None

    def solve(self, pins: tuple[Pin, ...], start: Floats, grabbed: frozenset[int] | None = None) -> Solved:
        """Return weights (k,) that carry the pins towards their goals from the weights `start` (k,).

        `grabbed` are the vertices of the pins in the hand, None for all; to most solvers pins are all alike.

        Raises
        ------
        FacepinError
            For a goal that is not finite or absurdly far away, and when the solver fails or gives a weight
            that is not finite.
        """
        kind = self.choice.kind
        _check_goals(self._rig, pins)
        displacement = pin_displacement(self._rig, pins)
        try:
            prepared = self._prepare(pins, start, grabbed)
            began = perf_counter()
            weights, solution = prepared.answer(displacement, start)
            if (kind.afresh or kind.grasps) and prepared.problem.curved:
                # The start may be far from the answer, and the face another one there.
                for _ in range(SECOND_LOOKS):
                    again = self._linearised(prepared.problem, weights, solution.forces)
                    before = weights
                    weights, solution = again.answer(displacement, start)
                    if np.abs(weights - before).max(initial=0.0) <= SETTLED:
                        break
        except np.linalg.LinAlgError as error:
            raise FacepinError(f"{kind.title} found no solution for these pins: {error}") from error
        if self.choice.keep_limits and not kind.obeys_limits:
            weights = self._control.clipped(weights, start)
        seconds = perf_counter() - began
        missing = prepared.problem.moves(weights) - displacement
        return Solved(frozen(weights, np.float64), _mean_length(pins, missing), seconds, solution.notes)

    def _prepare(self, pins: tuple[Pin, ...], start: Floats, grabbed: frozenset[int] | None) -> "_Prepared":
        """Return the solver for pins at these places; goals may differ from call to call."""
        if not self.choice.kind.grasps:
            grabbed = None
        elif grabbed is None:
            grabbed = frozenset(pin.vertex for pin in pins)
        places = (
            grabbed,
            *(
                (pin.vertex, pin.freedom, pin.axes if pin.freedom == "screen" else None, pin.stiffness)
                for pin in pins
            ),
        )
        if self._prepared is None or places != self._places or not self._fits(self._prepared, start):
            radius = getattr(self.choice.settings, "radius", 0.0)
            problem = PinProblem(self._rig, self._control, pins, start, radius=radius, grabbed=grabbed)
            self._prepared = self._linearised(problem, start)
            self._places, self._start = places, start
        return self._prepared

    def _fits(self, prepared: "_Prepared", start: Floats) -> bool:
        return not prepared.problem.follows_start or (
            self._start is not None and np.array_equal(start, self._start)
        )

    def _linearised(self, problem: PinProblem, weights: Floats, forces: Floats | None = None) -> "_Prepared":
        linear = problem.linear_at(weights, forces)
        solve = self.choice.kind.prepare(linear.system, self.choice.settings)
        return _Prepared(problem, linear, solve, self.choice.kind.title)


@dataclass(frozen=True, eq=False)
class _Prepared:
    """What is the same on every frame of a drag."""

    problem: PinProblem
    linear: LinearProblem
    solve: Solve
    title: str
    """Of the solver."""

    def answer(self, displacement: Floats, start: Floats) -> tuple[Floats, Solution]:
        """Return weights (k,), and the solver's answer for the free shapes."""
        solution = self.solve(self.linear.displacement(displacement), self.linear.taken(start))
        if not np.isfinite(solution.weights).all():
            raise FacepinError(f"{self.title} gave weights that are not finite")
        weights = self.linear.given_back(solution.weights, start)
        largest = float(np.abs(self.problem.amounts(weights)).max(initial=0.0))
        if largest > LARGEST_AMOUNT:
            # Products of weights grow faster than weights: what can't be drawn must not become the pose.
            raise FacepinError(f"{self.title} moves shapes {largest:.0e} times as far as they go")
        return weights, solution


def _check_goals(rig: Rig, pins: tuple[Pin, ...]) -> None:
    """Refuse goals that no face reaches: some solvers would search for ever."""
    for pin in pins:
        away = float(np.abs(np.subtract(pin.goal, rig.neutral[pin.vertex])).max())
        if not away <= FARTHEST * rig.height:
            where = ", ".join(f"{part:g}" for part in pin.goal)
            raise FacepinError(
                f"the pin on vertex {pin.vertex} should be at ({where}), "
                f"allowed are finite goals within {FARTHEST:.0e} face heights"
            )


def _mean_length(pins: tuple[Pin, ...], missing: Floats) -> float:
    """Return the mean length of what pins miss, (r,) in the scale of their rows; 0 without pins."""
    if not pins:
        return 0.0
    at = np.cumsum([0] + [2 if pin.freedom == "screen" else 3 for pin in pins[:-1]])
    stiffness = np.array([pin.stiffness for pin in pins])
    return float(np.sqrt(np.add.reduceat(missing**2, at) / stiffness).mean())


def snapped(rig: Rig, pose: Pose, control: ShapeControl) -> Pose:
    """Return the pose with every goal moved to where its vertex is now."""
    if not pose.pins:
        return pose
    vertices = [pin.vertex for pin in pose.pins]
    moves = rig.rows_at(vertices) @ rig.amounts(control.heard(pose.weights))
    places = moves.reshape(-1, 3) + rig.neutral[vertices]
    return pose.with_pins(
        tuple(replace(pin, goal=as_vector(place)) for pin, place in zip(pose.pins, places, strict=True))
    )
