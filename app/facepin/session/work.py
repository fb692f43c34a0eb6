"""What is worked on, as values: panes with their solvers and poses, and all that undo brings back."""

from dataclasses import dataclass, field

from facepin.core.arrays import Floats
from facepin.core.control import ShapeControl
from facepin.core.pose import Pose
from facepin.core.shapes.mirror import Mirror
from facepin.session.shelf import Shelf
from facepin.session.solving.solving import Solved, SolverChoice

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
