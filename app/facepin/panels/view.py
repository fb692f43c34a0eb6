"""What is shown and how: the part of the state that undo leaves alone."""

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from facepin.core.pose import Freedom
from facepin.panels.weights import WeightsView

Quality = Literal["auto", "always", "off"]


@dataclass
class View:
    """Toggles that panels change in place."""

    QUALITIES: ClassVar[dict[Quality, str]] = {
        "auto": "When the picture rests, or always with a GPU",
        "always": "Always",
        "off": "Never",
    }

    weights: WeightsView = field(default_factory=WeightsView)
    freedom: Freedom = "space"
    """What new pins constrain."""
    quality: Quality = "auto"
    ui_scale: float = 1.0
    """Size of text and panels, times what the screen asks for."""
    pin_menu: int | None = None
    """Vertex of the pin whose menu is open."""
    pin_menu_opens: bool = False
    """It was asked for just now."""
