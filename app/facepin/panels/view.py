"""What is shown and how: the part of the state that undo leaves alone."""

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from facepin.core.pose import Freedom
from facepin.panels.weights.view import WeightsView

Quality = Literal["auto", "always", "off"]


Ghost = Literal["none", "neutral", "reference"]


@dataclass
class PaneView:
    """What a pane shows over its face."""

    heat: bool = False
    """How far each vertex moved since the drag began, as colours."""
    wireframe: bool = False
    ghost: Ghost = "none"
    """Another pose that shines through."""

    reach: bool = False
    """How far the solver's radius reaches over the skin; shown while the setting is under the mouse."""

    shape: int | None = None
    """Shape whose moves are shown as colours; while the mouse rests on its name."""

    def next_ghost(self, *, has_reference: bool) -> None:
        """Go on to the next ghost there is."""
        ghosts: tuple[Ghost, ...] = ("none", "neutral", "reference") if has_reference else ("none", "neutral")
        self.ghost = ghosts[(ghosts.index(self.ghost) + 1) % len(ghosts)] if self.ghost in ghosts else "none"

    @property
    def coloured(self) -> bool:
        """Whether the face is shown in colours that are not its own."""
        return self.heat or self.reach or self.shape is not None

    @property
    def key(self) -> tuple[bool, bool, Ghost, bool, int | None]:
        """Equal keys look the same."""
        return self.heat, self.wireframe, self.ghost, self.reach, self.shape


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
    panes: list[PaneView] = field(default_factory=lambda: [PaneView()])
    """One per pane."""
    chart: bool = False
    """Whether the chart window is open."""
    linked: bool = True
    """One camera for all panes."""
