"""One open rig being posed: its panes, the undo history, and the solving of every edit."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from itertools import count

import numpy as np

from facepin.core.arrays import Floats, frozen
from facepin.core.control import ShapeControl
from facepin.core.errors import FacepinError
from facepin.core.names import listed
from facepin.core.pose import Pose, hold_alike, rest_pose
from facepin.core.rig import Rig
from facepin.core.rig_builder import LARGEST_WEIGHT
from facepin.core.shapes.mirror import Mirror, find_mirror
from facepin.session.edit import Edit
from facepin.session.history import History, Step
from facepin.session.shelf import Shelf
from facepin.session.solving.panes import PaneSolvers
from facepin.session.solving.solving import SolverChoice, snapped
from facepin.session.work import MOST_PANES, Pane, Work


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
        self._solvers = PaneSolvers(rig)

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

        Another solver takes over with the next drag: choosing one moves nothing.  In a comparison it shows
        the drag that all panes show, if that was the last step; so does the same solver with other settings,
        whose effect is to be seen while they are slid.  What is there already is no step.
        """
        self.message = ""
        before = self._history.current
        pane = before.panes[at]
        if choice == pane.choice:
            self._preview = None
            return
        if choice.kind is pane.choice.kind or len(before.panes) > 1:
            chosen = self._solved_by(at, pane, choice)
        else:
            chosen = replace(pane, choice=choice, began=None, solved=None)
        panes = (*before.panes[:at], chosen, *before.panes[at + 1 :])
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
        pane = self._solved_by(at, new, choice)
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
            dragged, self.message = self._solvers.drag(before, self._active, pins, self.panes)
            return dragged
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

    def _solved_by(self, at: int, pane: Pane, choice: SolverChoice) -> Pane:
        """Return a pane with its last drag, if it was the last step, solved in another way."""
        chosen = replace(pane, choice=choice, solved=None)
        try:
            return self._solvers.again(at, chosen, self._history.current.control)
        except FacepinError as error:
            self.message = str(error)
            return chosen

    def _tell_locks(self, work: Work, weights: Floats) -> None:
        """Say in `message` which locks keep the active pane from these weights (k,), if any do."""
        broken = np.flatnonzero(work.control.breaks_lock(weights, work.panes[self.active].pose.weights))
        names = listed([self.rig.shape_names[j] for j in broken])
        self.message = f"{names} {'is' if len(broken) == 1 else 'are'} locked" if names else ""
