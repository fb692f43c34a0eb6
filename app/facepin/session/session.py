"""One open rig being posed: its poses, the undo history, and the solving of every edit."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from facepin.core.arrays import Floats
from facepin.core.errors import FacepinError
from facepin.core.pose import Pose, rest_pose
from facepin.core.rig import Rig
from facepin.session.edit import Edit
from facepin.session.history import History
from facepin.session.solving import PinSolver, Solved, SolverChoice, snapped

Poses = tuple[Pose, ...]
"""One pose per pane; they share their pins."""


@dataclass(frozen=True, eq=False)
class Work:
    """What undo brings back: the poses of all panes, and where their last drag began."""

    poses: Poses
    hand: tuple[Floats, ...]
    """Per pane, the weights last made otherwise than by dragging: where solvers start that take all pins afresh."""
    began: Poses | None = None
    """The poses before the drag that led here, so that another solver can be asked for the same drag."""


class Session:
    """Applies edits to the poses of one rig.

    Everything it hands out is a frozen value, so `is` tells whether something changed.
    """

    def __init__(self, rig: Rig, choices: Sequence[SolverChoice], pose: Pose | None = None) -> None:
        self.rig = rig
        self.active = 0
        """Index of the pane whose weights the panels show and edit."""
        self.message = ""
        """Why the last edit could not be carried out as asked; empty when it could."""
        self._solvers = [PinSolver(rig, choice) for choice in choices]
        poses = (pose or rest_pose(rig),) * len(self._solvers)
        self._history = History(Work(poses, tuple(pose.weights for pose in poses)))
        self._preview: Work | None = None
        self.solved: list[Solved | None] = [None] * len(self._solvers)
        """The answer of each pane's solver that its pose shows, None where the pose is not a solver's."""

    @property
    def poses(self) -> Poses:
        """The poses as they are shown now, one per pane."""
        return self._work.poses

    @property
    def pose(self) -> Pose:
        """The pose of the active pane as it is shown now."""
        return self.poses[self.active]

    @property
    def choices(self) -> tuple[SolverChoice, ...]:
        """Solver and settings of each pane."""
        return tuple(solver.choice for solver in self._solvers)

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
        return self._history.undo_label

    @property
    def redo_label(self) -> str | None:
        """What redo would bring back, or None."""
        return self._history.redo_label

    def apply(self, edit: Edit) -> None:
        """Show an edit, and make it an undo step when it is final.

        A solver that fails leaves the last good poses in place and says so in `message`.
        """
        self.message = ""
        before = self._history.current
        try:
            work = self._edited(before, edit)
        except FacepinError as error:
            self.message = str(error)
            work = self._work
        self._preview = work
        if edit.final:
            self._preview = None
            if work is not before:
                self._history.commit(edit.label, work)

    def cancel(self) -> None:
        """Drop the gesture in progress; the poses are exactly those before it."""
        self._forget()

    def undo(self) -> bool:
        """Take the last undo step back; False when there is none."""
        self._forget()
        return self._history.undo()

    def redo(self) -> bool:
        """Bring the last undone step back; False when there is none."""
        self._forget()
        return self._history.redo()

    def choose_solver(self, pane: int, choice: SolverChoice) -> None:
        """Give a pane another solver or other settings.

        If the last step was a drag, it is solved again from where it began, so that the difference is seen at once.
        """
        self._solvers[pane] = PinSolver(self.rig, choice)
        self.solved[pane] = None
        work = self._history.current
        if work.began is None:
            return
        self.message = ""
        try:
            pose = self._solve(pane, work.began[pane].with_pins(work.poses[pane].pins), work.hand[pane])
        except FacepinError as error:
            self.message = str(error)
            return
        poses = (*work.poses[:pane], pose, *work.poses[pane + 1 :])
        self._history.commit(f"Solve with {choice.kind.title}", replace(work, poses=poses))

    def _forget(self) -> None:
        self._preview = None
        self.solved = [None] * len(self.solved)

    @property
    def _work(self) -> Work:
        return self._preview or self._history.current

    def _edited(self, before: Work, edit: Edit) -> Work:
        """Return the work after an edit of `before`."""
        pins = before.poses[0].pins if edit.pins is None else edit.pins
        poses = tuple(pose.with_pins(pins) for pose in before.poses)
        if edit.weights is not None:
            self.solved[self.active] = None
            pose = poses[self.active].with_weights(edit.weights)
            if edit.pins is None:
                pose = snapped(self.rig, pose)
            return _by_hand((*poses[: self.active], pose, *poses[self.active + 1 :]))
        if edit.solve:
            solved = (self._solve(i, pose, before.hand[i]) for i, pose in enumerate(poses))
            return Work(tuple(solved), before.hand, before.poses)
        # A new pin holds what is there; without a pin that was there, what it made must not fall back.
        placed = {pin.vertex for pin in pins} >= {pin.vertex for pin in before.poses[0].pins}
        return replace(before, poses=poses, began=None) if placed else _by_hand(poses)

    def _solve(self, pane: int, pose: Pose, hand: Floats) -> Pose:
        """Return the pose with its weights carried towards its pins."""
        solver = self._solvers[pane]
        solved = solver.solve(pose.pins, hand if solver.choice.kind.afresh else pose.weights)
        self.solved[pane] = solved
        return pose.with_weights(solved.weights)


def _by_hand(poses: Poses) -> Work:
    return Work(poses, tuple(pose.weights for pose in poses))
