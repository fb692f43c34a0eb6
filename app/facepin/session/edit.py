"""What a tool or a panel wants done to the pose: one frozen value, carried out by the session."""

from dataclasses import dataclass

from facepin.core.arrays import Floats
from facepin.core.pose import Pin


@dataclass(frozen=True, eq=False)
class Edit:
    """A change of pins, of weights, or of both.

    An edit that is not `final` is a step of a gesture: it is shown, but the next one starts again from the
    pose in which the gesture began, so a gesture ends as one undo step, whatever the path of the mouse.
    """

    label: str
    """Name of the undo step, as a menu would say it."""
    final: bool
    pins: tuple[Pin, ...] | None = None
    solve: bool = False
    """With `pins`: whether the weights follow the pins (a drag) or stay (placing or removing a pin)."""
    weights: Floats | None = None
    """(k,) weights set by other means than a solver, for the active pane.  Without `pins`, the goals of all
    pins follow their vertices."""
