"""The steps that led to the pose that is shown, as a filmstrip shows them."""

from dataclasses import dataclass

from facepin.core.pose import Pose
from facepin.session.session import Session


@dataclass(frozen=True, eq=False)
class Still:
    """One picture of a filmstrip."""

    label: str
    """What was done."""
    pose: Pose
    """What it led to."""


def filmstrip(session: Session) -> tuple[Still, ...]:
    """Return the steps of the active pane up to now, without those that left its weights and pins alone."""
    stills: list[Still] = []
    for step in session.steps[: session.step + 1]:
        panes = step.value.panes
        pose = panes[min(session.active, len(panes) - 1)].pose
        if not stills:
            stills.append(Still("Start", pose))
        elif pose is not stills[-1].pose:
            stills.append(Still(step.label, pose))
    return tuple(stills)
