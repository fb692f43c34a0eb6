"""What is shown and how: the part of the state that undo leaves alone."""

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from facepin.core.pose import Freedom
from facepin.core.shading import MODES, Shading
from facepin.panels.weights import WeightsView

Quality = Literal["auto", "always", "off"]


Ghost = Literal["none", "neutral", "reference"]


@dataclass
class PaneView:
    """How a pane shows its face: one shading, and over it what else is wanted."""

    shading: Shading = "studio"
    wireframe: bool = False
    """Edges, over any shading."""
    ghost: Ghost = "none"
    """Another pose that shines through."""

    reach: bool = False
    """How far the solver's radius reaches over the skin; shown while the setting is under the mouse."""

    before_heat: Shading = "studio"
    """What the heat map gives way to."""

    @property
    def mode(self) -> str | None:
        """Name of the mode that this is, if any; edges over most shadings have none."""
        shown = (self.shading, self.wireframe)
        return next((name for name, mode in MODES.items() if (mode.shading, mode.wireframe) == shown), None)

    @mode.setter
    def mode(self, name: str) -> None:
        self.shading, self.wireframe = MODES[name].shading, MODES[name].wireframe

    def next_mode(self) -> None:
        """Go on to the next mode; from edges over something, to the one after that."""
        names = list(MODES)
        here = self.mode or next(name for name in names if MODES[name].shading == self.shading)
        self.mode = names[(names.index(here) + 1) % len(names)]

    def toggle_heat(self) -> None:
        """Show the heat map, or what was there before it."""
        if self.shading == "heat":
            self.shading = self.before_heat
        else:
            self.before_heat, self.shading = self.shading, "heat"

    @property
    def measured(self) -> bool:
        """Whether colours are a measure: of the move, or of the reach of the solver's radius."""
        return self.shading == "heat" or self.reach

    def next_ghost(self, *, has_reference: bool) -> None:
        """Go on to the next ghost there is."""
        ghosts: tuple[Ghost, ...] = ("none", "neutral", "reference") if has_reference else ("none", "neutral")
        self.ghost = ghosts[(ghosts.index(self.ghost) + 1) % len(ghosts)] if self.ghost in ghosts else "none"

    @property
    def key(self) -> tuple[Shading, bool, Ghost, bool]:
        """Equal keys look the same."""
        return self.shading, self.wireframe, self.ghost, self.reach


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
