"""What is shown and how: the part of the state that undo leaves alone."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from facepin.core.look.shading import MODES, Shading
from facepin.core.pose import Freedom
from facepin.core.quality import Quality
from facepin.panels.help.guide import Guide
from facepin.panels.layout import Beside
from facepin.panels.library.view import LibraryView
from facepin.panels.pins import FREEDOMS, PinsView
from facepin.panels.recovery import RecoveryView
from facepin.panels.theme import THEMES, Theme, ThemeName
from facepin.panels.weights.view import WeightsView
from facepin.session.navigation import PRESETS, Habit
from facepin.session.solving.solving import SolverChoice, choose

Ghost = Literal["none", "neutral", "reference"]


@dataclass
class PaneView:
    """How a pane shows its face: one shading, and over it what else is wanted."""

    shading: Shading = "studio"
    wireframe: bool = False
    """Edges, over any shading."""
    ghost: Ghost = "none"
    """Another pose that shines through."""

    used: dict[str, SolverChoice] = field(default_factory=dict)
    """Solvers that gave way to others here, by key."""
    title_hovered: bool = False
    """The mouse is on the button in the title of the pane."""
    reach: bool = False
    """How far the solver's radius reaches over the skin; shown while the setting is under the mouse."""

    shape: int | None = None
    """Shape whose moves tint the face: while the mouse rests on its name or, with Ctrl, on what it moves."""
    before_heat: Shading = "studio"
    """What the heat map gives way to."""

    def choice(self, key: str, instead_of: SolverChoice) -> SolverChoice:
        """Return a solver for this pane: with the settings that it had here before, if it was in use."""
        if key == instead_of.kind.key:
            return instead_of
        return self.used.get(key) or choose(key, keep_limits=instead_of.keep_limits)

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
        """Whether colours are a measure: of a move, or of the reach of the solver's radius."""
        return self.shading == "heat" or self.reach

    def next_ghost(self, *, has_reference: bool) -> None:
        """Go on to the next ghost there is."""
        ghosts: tuple[Ghost, ...] = ("none", "neutral", "reference") if has_reference else ("none", "neutral")
        self.ghost = ghosts[(ghosts.index(self.ghost) + 1) % len(ghosts)] if self.ghost in ghosts else "none"

    @property
    def key(self) -> tuple[Shading, bool, Ghost, bool, int | None]:
        """Equal keys look the same."""
        return self.shading, self.wireframe, self.ghost, self.reach, self.shape


@dataclass
class PaletteView:
    """The command palette while it is open."""

    query: str = ""
    row: int = 0
    """Which of the fitting actions is chosen."""
    fresh: bool = True
    """It was opened just now."""


@dataclass
class GazeView:
    """The handle of the eyes; where it is, the weights say."""

    shown: bool = True
    hovered: bool = False
    """The mouse is on it."""


@dataclass
class View:
    """Toggles that panels change in place."""

    weights: WeightsView = field(default_factory=WeightsView)
    pins: PinsView = field(default_factory=PinsView)
    library: LibraryView = field(default_factory=LibraryView)
    gaze: GazeView = field(default_factory=GazeView)
    library_opens: bool = False
    """The library panel was asked for just now."""
    filmstrip: bool = False
    """Whether the filmstrip is open."""
    freedom: Freedom = "screen"
    """What new pins constrain."""
    symmetric: bool = False
    """Whether pins and sliders move their twins on the other side."""
    steady: bool = True
    """Whether a drag stays where the hand but trembles."""
    quality: Quality = "auto"
    ui_scale: float = 1.0
    """Size of text and panels, times what the screen asks for."""
    pin_menu: int | None = None
    """Vertex of the pin whose menu is open."""
    pin_menu_opens: bool = False
    """It was asked for just now."""
    panes: list[PaneView] = field(default_factory=lambda: [PaneView()])
    """One per pane."""
    reference_shown: bool = False
    """Whether the reference has a pane of its own."""
    reference: PaneView = field(default_factory=PaneView)
    """How that one is shown."""
    beside: Beside = field(default_factory=Beside)
    """Which windows have a place beside the picture."""
    chart: bool = False
    """Whether the chart window is open."""
    history: bool = False
    """Whether the history window is open."""
    recovery: RecoveryView = field(default_factory=RecoveryView)
    linked: bool = True
    """One camera for all panes."""
    hidden_parts: frozenset[str] = frozenset()
    """Names of the parts of the mesh that are not shown."""
    theme_name: ThemeName = "dark"
    habit: Habit = "facepin"
    """Whose mouse and keys the user knows."""
    tidy: float | None = None
    """Tolerance in per cent of the face height while a tidied pose is shown."""
    palette: PaletteView | None = None
    lately: tuple[str, ...] = ()
    """Titles of what was chosen in the command palette, newest first."""
    keyboard: bool = False
    """Whether the keyboard map is shown."""
    about: bool = False
    guide: Guide = field(default_factory=Guide)

    @property
    def theme(self) -> Theme:
        """The colours of all panels."""
        return THEMES[self.theme_name]


@dataclass(frozen=True)
class Choice:
    """An attribute of the View with a few values: a submenu, and a line each in the command palette."""

    title: str
    values: Mapping[object, str]
    help: str


CHOICES: dict[str, Choice] = {
    "theme_name": Choice(
        "Theme", {"dark": "Dark", "light": "Light"}, "Dark or light mode of menus and panels."
    ),
    "habit": Choice(
        "Mouse and keys",
        {habit: preset.title for habit, preset in PRESETS.items()},
        "Moves the camera as your other program does, with its keys where they differ.",
    ),
    "ui_scale": Choice(
        "Interface size",
        {factor: f"{factor:.0%}" for factor in (0.8, 1.0, 1.25, 1.5, 2.0)},
        "Size of text and panels, times what the screen asks for.",
    ),
    "quality": Choice(
        "Quality",
        {
            "auto": "Automatic (fast in motion without a GPU)",
            "fast": "Fast (light at vertices)",
            "good": "Good (light at pixels, smooth edges)",
            "best": "Best (light at pixels, edges as smooth as can be)",
        },
        "How smooth light and edges of the picture are; better costs time where there is no GPU.",
    ),
    "freedom": Choice(
        "New pins",
        {freedom: title for freedom, title in FREEDOMS.items()},
        "Whether the next pin holds its depth too.",
    ),
    "steady": Choice(
        "Steady hand",
        {True: "On", False: "Off"},
        "A drag takes no notice of a hand that trembles by less than a pixel.",
    ),
    "linked": Choice(
        "Cameras",
        {True: "One for all panes", False: "One per pane"},
        "Whether several panes are looked at from the same side.",
    ),
}
"""What the menus and the command palette can set."""
