"""The pins of all panes, solved: each pane's solver carries its own face towards the pins that all share."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from facepin.core.control import ShapeControl
from facepin.core.errors import FacepinError
from facepin.core.pose import Pin, Pose
from facepin.core.rig import Rig
from facepin.core.rig_builder import LARGEST_WEIGHT
from facepin.session.solving.press import Begun, Press, begin, grabbed, press
from facepin.session.solving.solving import PinSolver, SolverChoice
from facepin.session.work import MOST_PANES, Pane, Work


class PaneSolvers:
    """Solves drags; keeps each pane's solver, and where the drag in progress began, from frame to frame."""

    def __init__(self, rig: Rig) -> None:
        self._rig = rig
        self._solvers: dict[tuple[int, SolverChoice, ShapeControl], PinSolver] = {}
        self._begun: tuple[tuple[Work, Pose, tuple[int, ...], frozenset[int]], Begun] | None = None
        """Where the drag in progress began, and which it is."""

    def drag(
        self, before: Work, active: int, pins: tuple[Pin, ...], shown: Sequence[Pane]
    ) -> tuple[tuple[Pane, ...], str]:
        """Return the panes solved for moved pins, and a line on the solvers that failed, if any.

        Parameters
        ----------
        before : Work
            When the drag began.
        active : int
            The pane in which the hand is.
        pins : tuple of Pin
            As the hand has moved them.
        shown : sequence of Pane
            As they are seen now: where a solver fails, its weights stay.

        Raises
        ------
        FacepinError
            When all solvers fail.
        """
        begun = self._pressed(before, active, pins)
        pins = begun.shown(pins)
        dragged: list[Pane] = []
        failures: list[FacepinError] = []
        for at, (pane, start) in enumerate(zip(before.panes, begun.presses, strict=True)):
            try:
                dragged.append(self._solve(at, pane, start, pins, before.control))
            except FacepinError as error:
                failures.append(error)
                kept = shown[at].pose if len(shown) == len(before.panes) else pane.pose
                dragged.append(replace(pane, pose=kept.with_pins(pins), began=start.pose, solved=None))
        if len(failures) == len(before.panes):
            raise failures[0]
        return tuple(dragged), str(failures[0]) if failures else ""

    def again(self, at: int, pane: Pane, control: ShapeControl) -> Pane:
        """Return a pane with its last drag, if that was the last step, solved by the solver that it has now.

        Raises
        ------
        FacepinError
            When the solver fails.
        """
        if pane.began is None or len(pane.began.pins) != len(pane.pose.pins):
            return pane
        begun = press(self._rig, control, pane.began)
        return self._solve(at, pane, begun, pane.pose.pins, control)

    def _pressed(self, before: Work, active: int, pins: tuple[Pin, ...]) -> Begun:
        """Return where the drag began in each pane; the same for all its frames."""
        pose = before.panes[min(active, len(before.panes) - 1)].pose
        key = before, pose, tuple(pin.vertex for pin in pins), grabbed(pose.pins, pins)
        if self._begun is None or self._begun[0] != key:
            begun = begin(
                self._rig,
                before.control,
                pose,
                [(pane.pose, pane.began) for pane in before.panes],
                pins,
                snaps=not any(pane.choice.kind.afresh for pane in before.panes),
            )
            self._begun = key, begun
        return self._begun[1]

    def _solve(self, at: int, pane: Pane, start: Press, pins: tuple[Pin, ...], control: ShapeControl) -> Pane:
        """Return a pane with its weights carried towards its pins."""
        solver = self._solvers.get((at, pane.choice, control))
        if solver is None:
            if len(self._solvers) >= 4 * MOST_PANES:  # a setting that is being slid leaves a trail
                self._solvers.clear()
            solver = self._solvers[at, pane.choice, control] = PinSolver(self._rig, pane.choice, control)
        weights, pulled = start.pose.weights, start.pulled(pins)
        if pane.choice.kind.afresh:
            weights, pulled = pane.hand, pins
        if control.held.any():  # a shape may have been locked after the weights that the solver starts from
            weights = np.where(control.held, pane.pose.weights, weights)
        solved = solver.solve(pulled, weights, grabbed(start.pose.pins, pins))
        largest = float(np.abs(solved.weights).max(initial=0.0))
        if largest > LARGEST_WEIGHT:  # it could not be saved
            raise FacepinError(
                f"{pane.choice.kind.title} gave a weight of {largest:.0e}, allowed are {LARGEST_WEIGHT:.0e}"
            )
        pose = start.pose.with_weights(solved.weights).with_pins(pins)
        return replace(pane, pose=pose, began=start.pose, solved=solved)
