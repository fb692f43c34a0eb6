"""Moving one slider by whatever means; from the first touch to the last it is one undo step."""

from dataclasses import dataclass
from typing import Literal

from imgui_bundle import imgui

from facepin.core.arrays import Floats
from facepin.core.control import ShapeControl
from facepin.core.rig import Rig
from facepin.panels.requests import CancelEdit, CopyShapes, PairShapes, PasteShapes, Refused, SetControl
from facepin.session.edit import Edit
from facepin.session.hand.sliding import slid, within

Wish = Edit | SetControl | CancelEdit | PairShapes | Refused | CopyShapes | PasteShapes | None
"""What the panel asks for."""
Hand = Literal["mouse", "wheel", "keys", "typing"]

STEP, LEAP = 0.01, 0.1
"""What an arrow key or a notch of the wheel adds, and with Shift."""
FINE = 0.1
"""How much slower a slider follows the mouse with Shift."""


@dataclass
class Gesture:
    """A slider in the user's hand."""

    hand: Hand
    shape: int
    base: Floats
    """(k,) weights when it began."""
    span: tuple[float, float]
    """Lowest and highest weight that the slider shows; stays while it is moved, so that nothing slips."""
    reach: float
    """Where the hand is, which may be further than the slider goes."""
    began: float
    """When, in imgui's seconds."""
    digits: int = 2
    """Decimals that the mouse sets."""
    moved: bool = False
    """Whether the mouse has moved since."""
    keyed: float = 0.0
    """When a key was held last, in imgui's seconds: taps that follow soon belong to it."""

    @property
    def start(self) -> float:
        """The weight when it began."""
        return float(self.base[self.shape])

    def weight(self, control: ShapeControl) -> float:
        """Return where the slider is: within its limits, unless a number was typed."""
        if self.hand == "typing":
            return self.reach
        value = round(self.reach, self.digits if self.hand == "mouse" else 6)
        return within(control, self.base, self.shape, value)

    def edit(self, rig: Rig, control: ShapeControl, *, final: bool) -> Edit | CancelEdit:
        """Return the step of the gesture that is due; one that ends where it began leaves no trace."""
        weight = self.weight(control)
        if final and weight == self.start:
            return CancelEdit()
        label = f"Set {rig.shape_names[self.shape]}"
        return Edit(label, final, weights=slid(self.base, {self.shape: weight}))


def begun(hand: Hand, shape: int, weights: Floats, span: tuple[float, float]) -> Gesture:
    """Return a gesture that begins now, from weights (k,)."""
    return Gesture(
        hand, shape, weights, span, float(weights[shape]), imgui.get_time(), keyed=imgui.get_time()
    )
