"""One open rig being posed: its panes, the undo history, and the solving of every edit."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import count

import numpy as np

from facepin.core.arrays import Floats, frozen
from facepin.core.control import ShapeControl
from facepin.core.errors import FacepinError
from facepin.core.names import listed
from facepin.core.pose import Pin, Pose, hold_alike, rest_pose
from facepin.core.rig import Rig
from facepin.core.rig_builder import LARGEST_WEIGHT
from facepin.core.shapes.mirror import Mirror, find_mirror
from facepin.session.edit import Edit
from facepin.session.history import History, Step
from facepin.session.shelf import Shelf
from facepin.session.solving.press import Begun, Press, begin, grabbed, press
from facepin.session.solving.solving import PinSolver, Solved, SolverChoice, snapped

MOST_PANES = 4


@dataclass(frozen=True, eq=False)
class Pane:
    """One solver at work: what it is, and the pose it led to.  All panes of a session share their pins."""

    choice: SolverChoice
    pose: Pose
    hand: Floats
    """Weights last made otherwise than by dragging: where solvers start that take all pins afresh."""
    began: Pose | None = None
    """The pose before the drag that led here, so that another solver can be asked for the same drag."""
    solved: Solved | None = None
    """The solver's answer, None where the pose is not the solver's."""
    number: int = 0
    """Stays the same as long as the pane is there, and comes back with it."""

    def by_hand(self, pose: Pose) -> "Pane":
        """Return the pane with a pose that no solver made."""
        return Pane(self.choice, pose, pose.weights, number=self.number)


@dataclass(frozen=True, eq=False)
class Work:
    """What undo brings back."""

    panes: tuple[Pane, ...]
    control: ShapeControl
    """What holds for the shapes, in all panes."""
    mirror: Mirror | None = None
    """Who is whose twin, where the user has said so."""
    reference: Floats | None = None
    """Weights (k,) that the panes are measured against (Figure 4a of the paper), if any."""
    shelf: Shelf = field(default_factory=dict)
    """What was done to poses of the library, see `facepin.session.shelf`."""


class Session:
    """Applies edits to the poses of one rig.

    Everything it hands out is a frozen value, so `is` tells whether something changed.
    """

    def __init__(self, rig: Rig, choices: Sequence[SolverChoice], pose: Pose | None = None) -> None:
        self.rig = rig
        self.message = ""
        """Why the last edit could not be carried out as asked; empty when it could."""
        pose = pose or rest_pose(rig)
        panes = tuple(
            Pane(choice, pose, pose.weights, number=number) for number, choice in enumerate(choices)
        )
        self._numbers = count(len(panes))
        self._history = History(Work(panes, ShapeControl.of(rig)))
        self._preview: Work | None = None
        self._preview_label = ""
        self._active = 0
        self._solvers: dict[tuple[int, SolverChoice, ShapeControl], PinSolver] = {}
        self._begun: tuple[tuple[Work, Pose, tuple[int, ...], frozenset[int]], Begun] | None = None
        """Where the drag in progress began, and which it is."""

    @classmethod
    def resumed(cls, rig: Rig, work: Work, active: int = 0) -> "Session":
        """Begin where another session ended: with its work, whose panes have numbers 0, 1, 2 and so on."""
        session = cls(rig, [pane.choice for pane in work.panes])
        session._history = History(work)
        session._active = active
        return session

    @property
    def work(self) -> Work:
        """Everything as it is shown now."""
        return self._preview or self._history.current

    @property
    def panes(self) -> tuple[Pane, ...]:
        """The panes as they are shown now, one or more."""
        return self.work.panes

    @property
    def active(self) -> int:
        """Index of the pane whose weights the panels show and edit."""
        return min(self._active, len(self.panes) - 1)

    @active.setter
    def active(self, pane: int) -> None:
        self._active = pane

    @property
    def pane(self) -> Pane:
        """The active pane."""
        return self.panes[self.active]

    @property
    def pose(self) -> Pose:
        """The pose of the active pane."""
        return self.pane.pose

    @property
    def control(self) -> ShapeControl:
        """What holds for the shapes."""
        return self.work.control

    @property
    def mirror(self) -> Mirror:
        """Left and right: as the user has said, or as found in the rig when first asked for."""
        return self.work.mirror or self._found_mirror

    @cached_property
    def _found_mirror(self) -> Mirror:
        return find_mirror(self.rig)

    @property
    def in_gesture(self) -> bool:
        """Whether an edit is being shown that is not an undo step yet."""
        return self._preview is not None

    @property
    def committed(self) -> Work:
        """The work at the last undo step; its identity tells whether anything is unsaved."""
        return self._history.current

    @property
    def undo_label(self) -> str | None:
        """What undo would take back, or None."""
        return self._preview_label if self._preview is not None else self._history.undo_label

    @property
    def redo_label(self) -> str | None:
        """What redo would bring back, or None."""
        return self._history.redo_label

    @property
    def steps(self) -> tuple[Step[Work], ...]:
        """All undo steps, from the beginning to the last that can be redone."""
        return self._history.steps

    @property
    def step(self) -> int:
        """Which of the steps is the current one."""
        return self._history.at

    def apply(self, edit: Edit) -> None:
        """Show an edit, and make it an undo step when it is final.

        A solver that fails leaves the last good poses in place and says so in `message`.  So do new weights
        for locked shapes: these stay as they are, and where nothing else is asked for, so does everything.
        """
        self.message = ""
        before = self._history.current
        try:
            work = replace(before, panes=self._edited(before, edit))
        except FacepinError as error:
            self.message = str(error)
            work = self.work
        self._show(edit.label, work, final=edit.final)

    def choose_solver(self, at: int, choice: SolverChoice, *, final: bool = True) -> None:
        """Give a pane another solver or other settings.

        If the last step was a drag, it is solved again from where it began: the difference is seen at once.
        What is there already is no step.
        """
        self.message = ""
        before = self._history.current
        if choice == before.panes[at].choice:
            self._preview = None
            return
        panes = (*before.panes[:at], self._with_solver(at, before.panes[at], choice), *before.panes[at + 1 :])
        self._show(f"Solve with {choice.kind.title}", replace(before, panes=panes), final=final)

    def add_pane(self, choice: SolverChoice) -> None:
        """Open one more pane: the active one's pose, with its last drag solved by another solver.

        Raises
        ------
        FacepinError
            When there are as many as fit.
        """
        before = self._begin()
        if len(before.panes) >= MOST_PANES:
            raise FacepinError(f"{MOST_PANES} panes are open already, no more fit")
        at = len(before.panes)
        new = replace(before.panes[self.active], number=next(self._numbers))
        pane = self._with_solver(at, new, choice)
        self._show("Add a pane", replace(before, panes=(*before.panes, pane)), final=True)
        self._active = at

    def close_pane(self, at: int) -> None:
        """Close one of several panes."""
        before = self._begin()
        if len(before.panes) > 1:
            active = self.active
            panes = (*before.panes[:at], *before.panes[at + 1 :])
            self._show("Close a pane", replace(before, panes=panes), final=True)
            self._active = active - 1 if at < active else active

    def keep_pane(self, at: int) -> None:
        """Go on with one pane's pose alone."""
        before = self._begin()
        if len(before.panes) == 1:
            return
        self._show("Keep one pane", replace(before, panes=(before.panes[at],)), final=True)
        self._active = 0

    def reset(self) -> None:
        """Put all weights of all panes to zero; the goals of the pins follow the active pane's vertices.

        Locked shapes stay as they are, which `message` says.
        """
        before = self._begin()
        zero = np.zeros(self.rig.shape_count)
        poses = [
            pane.pose.with_weights(before.control.keeping_locked(zero, pane.pose.weights))
            for pane in before.panes
        ]
        pins = snapped(self.rig, poses[self.active], before.control).pins
        self._tell_locks(before, zero)
        panes = tuple(
            pane.by_hand(pose.with_pins(pins)) for pane, pose in zip(before.panes, poses, strict=True)
        )
        self._show("Reset the pose", replace(before, panes=panes), final=True)

    def set_control(self, label: str, control: ShapeControl) -> None:
        """Restrain shapes in another way.

        Weights and goals stay as they are: to mute a shape and to hear it again changes nothing.
        """
        if len(control.locked) != self.rig.shape_count:
            raise ValueError(f"control of {len(control.locked)} shapes for {self.rig.shape_count}")
        self._show(label, replace(self._begin(), control=control), final=True)

    def set_mirror(self, label: str, mirror: Mirror) -> None:
        """Take other shapes for twins from now on; no weight changes."""
        self._show(label, replace(self._begin(), mirror=mirror), final=True)

    def set_reference(self, weights: Floats | None) -> None:
        """Measure the panes against weights (k,) from now on; None forgets them."""
        label = "Forget the reference" if weights is None else "Set the reference"
        kept = None if weights is None else frozen(weights, np.float64)
        self._show(label, replace(self._begin(), reference=kept), final=True)

    def compare(self, label: str, weights: Floats, reference: Floats) -> None:
        """Put weights (k,) on the active pane, to be measured against others (k,), as one step.

        Locks are obeyed and told as by `apply`.

        Raises
        ------
        FacepinError
            When all that differs is locked.
        """
        before = self._begin()
        panes = self._edited(before, Edit(label, True, weights=weights))
        kept = frozen(reference, np.float64)
        self._show(label, replace(before, panes=panes, reference=kept), final=True)

    def arrange(self, label: str, changes: Shelf) -> None:
        """Change poses of the library, as one step."""
        before = self._begin()
        self._show(label, replace(before, shelf={**before.shelf, **changes}), final=True)

    def cancel(self) -> None:
        """Drop the gesture in progress; the poses are exactly those before it."""
        self._preview = None

    def settle(self) -> None:
        """Make an undo step of the gesture in progress, since another one begins."""
        if self._preview is not None:
            self._show(self._preview_label, self._preview, final=True)

    def undo(self) -> bool:
        """Take the gesture in progress back, or else the last undo step; False when there is neither."""
        if self._preview is not None:
            self._preview = None
            return True
        return self._history.undo()

    def redo(self) -> bool:
        """Bring the last undone step back; False when there is none."""
        self._preview = None
        return self._history.redo()

    def go_to(self, step: int) -> bool:
        """Undo or redo to one of the steps; False when there is none of that number."""
        self._preview = None
        return self._history.go_to(step)

    def _begin(self) -> Work:
        """Return the work that a step begins with: with the gesture in progress, which is a step of its own.

        What was said of the last step is over.
        """
        self.settle()
        self.message = ""
        return self._history.current

    def _show(self, label: str, work: Work, *, final: bool) -> None:
        shown = None if final or work is self._history.current else work
        self._preview, self._preview_label = shown, label
        if final and work is not self._history.current:
            self._history.commit(label, work)

    def _edited(self, before: Work, edit: Edit) -> tuple[Pane, ...]:
        """Return the panes after an edit.

        Raises
        ------
        FacepinError
            When a solver fails, a weight that was typed is beyond all sense, or all that is asked for is
            locked.
        """
        panes, control = before.panes, before.control
        pins = panes[0].pose.pins if edit.pins is None else edit.pins
        poses = [pane.pose.with_pins(pins) for pane in panes]
        if edit.weights is not None:
            allowed = np.abs(edit.weights) <= LARGEST_WEIGHT
            if not allowed.all():
                j = int(np.argmin(allowed))
                raise FacepinError(
                    f"the weight of {self.rig.shape_names[j]} can't be {edit.weights[j]:g}, "
                    f"allowed are numbers up to {LARGEST_WEIGHT:.0e}"
                )
            current = poses[self.active].weights
            weights = control.keeping_locked(edit.weights, current)
            self._tell_locks(before, edit.weights)
            if self.message and edit.pins is None and np.array_equal(weights, current):
                raise FacepinError(self.message)
            pose = poses[self.active].with_weights(weights)
            if edit.pins is None:
                pose = snapped(self.rig, pose, control)
                poses = [other.with_pins(pose.pins) for other in poses]
            poses[self.active] = pose
            return tuple(pane.by_hand(pose) for pane, pose in zip(panes, poses, strict=True))
        if edit.solve:
            return self._dragged(before, pins)
        if hold_alike(
            pins, panes[0].pose.pins
        ):  # the last drag is still what another solver can be asked for
            return tuple(replace(pane, pose=pose) for pane, pose in zip(panes, poses, strict=True))
        # A new pin holds what is there; but what a removed one made must not fall back with the next drag.
        if {pin.vertex for pin in pins} >= {pin.vertex for pin in panes[0].pose.pins}:
            return tuple(
                replace(pane, pose=pose, began=None) for pane, pose in zip(panes, poses, strict=True)
            )
        pins = snapped(self.rig, poses[self.active], control).pins
        return tuple(pane.by_hand(pose.with_pins(pins)) for pane, pose in zip(panes, poses, strict=True))

    def _tell_locks(self, work: Work, weights: Floats) -> None:
        """Say in `message` which locks keep the active pane from these weights (k,), if any do."""
        broken = np.flatnonzero(work.control.breaks_lock(weights, work.panes[self.active].pose.weights))
        names = listed([self.rig.shape_names[j] for j in broken])
        self.message = f"{names} {'is' if len(broken) == 1 else 'are'} locked" if names else ""

    def _dragged(self, before: Work, pins: tuple[Pin, ...]) -> tuple[Pane, ...]:
        """Return the panes solved for moved pins; where one of several solvers fails, its weights stay.

        Raises
        ------
        FacepinError
            When all of them fail.
        """
        begun = self._pressed(before, pins)
        pins = begun.shown(pins)
        dragged: list[Pane] = []
        failures: list[FacepinError] = []
        for at, (pane, start) in enumerate(zip(before.panes, begun.presses, strict=True)):
            try:
                dragged.append(self._solve(at, pane, start, pins))
            except FacepinError as error:
                failures.append(error)
                kept = self.panes[at].pose if len(self.panes) == len(before.panes) else pane.pose
                dragged.append(replace(pane, pose=kept.with_pins(pins), began=start.pose, solved=None))
        if len(failures) == len(before.panes):
            raise failures[0]
        self.message = str(failures[0]) if failures else ""
        return tuple(dragged)

    def _pressed(self, before: Work, pins: tuple[Pin, ...]) -> Begun:
        """Return where the drag began in each pane; the same for all its frames."""
        vertices = tuple(pin.vertex for pin in pins)
        active = before.panes[min(self._active, len(before.panes) - 1)].pose
        key = before, active, vertices, grabbed(active.pins, pins)
        if self._begun is None or self._begun[0] != key:
            snaps = not any(pane.choice.kind.afresh for pane in before.panes)
            begun = begin(
                self.rig,
                before.control,
                active,
                [(pane.pose, pane.began) for pane in before.panes],
                pins,
                snaps=snaps,
            )
            self._begun = key, begun
        return self._begun[1]

    def _with_solver(self, at: int, pane: Pane, choice: SolverChoice) -> Pane:
        """Return a pane with its last drag, if it was the last step, solved in another way."""
        chosen = replace(pane, choice=choice, solved=None)
        if pane.began is None or len(pane.began.pins) != len(pane.pose.pins):
            return chosen
        try:
            begun = press(self.rig, self._history.current.control, pane.began)
            return self._solve(at, chosen, begun, pane.pose.pins)
        except FacepinError as error:
            self.message = str(error)
            return chosen

    def _solve(self, at: int, pane: Pane, start: Press, pins: tuple[Pin, ...]) -> Pane:
        """Return a pane with its weights carried towards its pins."""
        control = self._history.current.control
        solver = self._solvers.get((at, pane.choice, control))
        if solver is None:
            if len(self._solvers) >= 4 * MOST_PANES:  # a setting that is being slid leaves a trail
                self._solvers.clear()
            solver = self._solvers[at, pane.choice, control] = PinSolver(self.rig, pane.choice, control)
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
