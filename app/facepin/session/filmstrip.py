"""The steps that led to the pose that is shown, as a filmstrip shows them."""

from dataclasses import dataclass

import numpy as np

from facepin.core.pose import Pose, hold_alike
from facepin.session.session import Session
from facepin.session.work import Work


@dataclass(frozen=True, eq=False)
class Still:
    """One picture of a filmstrip."""

    label: str
    """What was done."""
    pose: Pose
    """What it led to, as it was shown: without the weights of shapes that were muted."""


class Filmstrip:
    """The steps so far; looked through again only when there is another one."""

    def __init__(self) -> None:
        self._of: tuple[Work, int] | None = None
        self._stills: tuple[Still, ...] = ()

    def stills(self, session: Session) -> tuple[Still, ...]:
        """Return the steps of the active pane up to now, without those after which it looked the same."""
        of = session.committed, session.active
        if of != self._of:
            self._of, self._stills = of, _stills(session)
        return self._stills


def _stills(session: Session) -> tuple[Still, ...]:
    stills: list[Still] = []
    shown = session.committed.panes[min(session.active, len(session.committed.panes) - 1)].number
    for step in session.steps[: session.step + 1]:
        pane = next((pane for pane in step.value.panes if pane.number == shown), None)
        if pane is None:  # it was opened later
            continue
        pose = pane.pose
        heard = step.value.control.heard(pose.weights)
        if heard is not pose.weights:
            pose = pose.with_weights(heard)
        if not stills:
            stills.append(Still("Start", pose))
        elif not _look_alike(pose, stills[-1].pose):
            stills.append(Still(step.label, pose))
    return tuple(stills)


def _look_alike(pose: Pose, other: Pose) -> bool:
    same = pose.weights is other.weights or np.array_equal(pose.weights, other.weights)
    return same and (pose.pins is other.pins or hold_alike(pose.pins, other.pins))
