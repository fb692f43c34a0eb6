"""From pins to weights: puts a rig's pins before a solver and reads its answer back."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from time import perf_counter
from typing import Any

import numpy as np

from facepin.core.arrays import Floats, frozen
from facepin.core.errors import FacepinError
from facepin.core.geodesic import shape_locality
from facepin.core.pose import Pin, Pose, as_vector, pin_displacement, pin_rows
from facepin.core.rig import Rig
from facepin.solvers import SOLVERS
from facepin.solvers.interface import PinSystem, Solve, SolverKind


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

    def __init__(self, rig: Rig, choice: SolverChoice) -> None:
        self.choice = choice
        self._rig = rig
        self._prepared_for: object = None
        self._rows = np.zeros((0, rig.shape_count))
        self._solve: Solve | None = None

    def solve(self, pins: tuple[Pin, ...], start: Floats) -> Solved:
        """Return weights (k,) that carry the pins towards their goals from the weights `start` (k,).

        Raises
        ------
        FacepinError
            When the solver fails or gives a weight that is not finite.
        """
        displacement = pin_displacement(self._rig, pins)
        try:
            solve = self._prepare(pins)
            began = perf_counter()
            solution = solve(displacement, start)
        except np.linalg.LinAlgError as error:
            raise FacepinError(
                f"{self.choice.kind.title} found no solution for these pins: {error}"
            ) from error
        weights = solution.weights
        if not np.isfinite(weights).all():
            raise FacepinError(
                f"{self.choice.kind.title} gave weights that are not finite; the last pose is kept"
            )
        if self.choice.keep_limits and not self.choice.kind.obeys_limits:
            # A weight that began outside its limits may stay there: nothing is clipped silently.
            low, high = np.minimum(self._rig.limits[:, 0], start), np.maximum(self._rig.limits[:, 1], start)
            weights = np.clip(weights, low, high)
        seconds = perf_counter() - began
        miss = self._pin_error(pins, displacement, weights)
        return Solved(frozen(weights, np.float64), miss, seconds, solution.notes)

    def _prepare(self, pins: tuple[Pin, ...]) -> Solve:
        """Return the solver for pins at these places; goals may differ from call to call."""
        places = tuple(
            (pin.vertex, pin.freedom, pin.axes if pin.freedom == "screen" else None, pin.stiffness)
            for pin in pins
        )
        if self._solve is None or places != self._prepared_for:
            rig = self._rig
            self._rows = pin_rows(rig, pins)
            system = PinSystem(
                self._rows,
                rig.limits,
                rig.scale,
                rig.largest_moves,
                self._locality([pin.vertex for pin in pins]),
            )
            self._solve = self.choice.kind.prepare(system, self.choice.settings)
            self._prepared_for = places
        return self._solve

    def _locality(self, vertices: list[int]) -> Floats | None:
        """Return the share of each shape near these vertices, for a solver told to prefer what is near."""
        radius = getattr(self.choice.settings, "radius", 0.0)
        return shape_locality(self._rig, vertices, radius / 100 * self._rig.height) if radius > 0 else None

    def _pin_error(self, pins: tuple[Pin, ...], displacement: Floats, weights: Floats) -> float:
        if not pins:
            return 0.0
        miss = (self._rows @ weights - displacement) ** 2
        at = np.cumsum([0] + [2 if pin.freedom == "screen" else 3 for pin in pins[:-1]])
        stiffness = np.array([pin.stiffness for pin in pins])
        return float(np.sqrt(np.add.reduceat(miss, at) / stiffness).mean())


def snapped(rig: Rig, pose: Pose) -> Pose:
    """Return the pose with every goal moved to where its vertex is now."""
    if not pose.pins:
        return pose
    vertices = [pin.vertex for pin in pose.pins]
    places = (rig.rows_at(vertices) @ pose.weights).reshape(-1, 3) + rig.neutral[vertices]
    return pose.with_pins(
        tuple(replace(pin, goal=as_vector(place)) for pin, place in zip(pose.pins, places, strict=True))
    )
