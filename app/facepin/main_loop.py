"""One frame after another: input, edits, panels, picture."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from time import perf_counter

from imgui_bundle import imgui

from facepin.actions import carry_out
from facepin.core.errors import FacepinError
from facepin.core.events import CloseRequested
from facepin.core.look.camera import Viewport
from facepin.core.pose import Pose
from facepin.core.rig import Rig
from facepin.desk.desk import ChartWriter, Desk
from facepin.files.work.preferences import Preferences, read_preferences, write_preferences
from facepin.frame.bars import bars
from facepin.frame.cards import cards
from facepin.frame.docks import panels
from facepin.frame.layout_file import LayoutFile
from facepin.frame.letters import ShownLetters
from facepin.frame.over_picture import over_picture
from facepin.frame.painting import Painting
from facepin.frame.part import part
from facepin.frame.routing import Router
from facepin.panels import layout
from facepin.panels.commands import Command
from facepin.panels.requests import Request
from facepin.panels.theme import Theme, apply_theme
from facepin.panels.view import View
from facepin.panels.weights.listing import ARRANGEMENTS
from facepin.platforms import has_native_dialogs
from facepin.resources import BUILTIN, resource
from facepin.session.solving.solving import SolverChoice
from facepin.window import Window

IDLE_WAIT = 0.5
"""Seconds to sleep at most when nothing happens; a text cursor blinks in this rhythm."""
BUSY_WAIT = 1 / 30
"""The same while a file is being opened, a dialog is up, or keys move something."""
SETTLE = 3
"""Frames drawn after the last event, so that imgui comes to rest."""
HOVER_DELAY = 0.2
"""Seconds after the last event when imgui is given another look: it explains what the mouse rests on."""
ICON_SIZES = (16, 32, 48, 256)
"""Pixels per side of the icon, for whoever shows it."""
PANE_GAP = 2.0
"""Pixels between panes at 1x scale."""


@dataclass(frozen=True)
class Start:
    """What the window opens with."""

    choices: Sequence[SolverChoice]
    rig: Path | None = None
    """None for the built-in face."""
    first_pose: Callable[[Rig], Pose] | None = None
    """Makes the pose to begin with once the rig is there."""
    settings_folder: Path | None = None
    """Where preferences and the panel layout are kept; None keeps nothing."""
    pictures: Path = Path()
    native_dialogs: bool = True
    chart_writer: ChartWriter | None = None
    """Writes the charts of a session into a folder."""
    neutral: str | None = None
    """For a folder of OBJ files: the one with the neutral."""
    solve_first: bool = False
    """Whether the weights follow the pins of the first pose: a pins file says only where they go."""
    caught: bool = True
    """Whether a bug in one part is told there and everything else goes on.  Tests want to see bugs."""


@dataclass(frozen=True)
class Frame:
    """What a finished frame looked like, for whoever drives the loop."""

    desk: Desk
    viewport: Viewport
    """What the panels leave free."""
    viewports: tuple[Viewport, ...]
    """One per pane."""
    drawn: bool
    """Whether anything was drawn at all; nothing is when nothing happened."""
    seconds: float
    """Time from the first event to the finished picture."""


def run(window: Window, start: Start) -> None:
    """Show the window until the user closes it."""
    for number, _ in enumerate(frames(window, start)):
        if number == 1:  # what the first picture can do without comes after it
            window.set_icons([resource("assets", f"icon/facepin-{size}.png") for size in ICON_SIZES])


def frames(window: Window, start: Start) -> Iterator[Frame]:
    """Run the program frame by frame; ends when the user quits.

    However it ends, work that nobody saved is kept, and the next start offers it.

    Raises
    ------
    FacepinError
        At the end, when there is such work and it could not be kept.
    """
    view = View()
    painting = Painting(window.ctx, window.texture)
    desk = Desk(
        window.ctx,
        view,
        start.choices,
        native_dialogs=start.native_dialogs and has_native_dialogs(),
        pictures=start.pictures,
        drafts=start.settings_folder / "autosave" if start.settings_folder else None,
        settings=start.settings_folder,
        chart_writer=start.chart_writer,
        caught=start.caught,
    )
    _set_up_imgui()
    layout_file = LayoutFile(start.settings_folder / "layout.ini" if start.settings_folder else None)
    with ExitStack() as at_the_end:  # last in, first out; whatever fails there, the rest is done
        for each in (painting.release, desk.release, partial(_leave, desk), desk.keep, layout_file.save):
            at_the_end.callback(each)
        try:
            yield from _loop(window, start, desk, layout_file, painting)
        except Exception as error:
            desk.faults.write("The main loop", error)
            raise


def _leave(desk: Desk) -> None:
    """Leave what is unsaved to the next window."""
    if lost := [line for line in (desk.keeper.close(), desk.errands.close()) if line]:
        raise FacepinError("; ".join(lost))


def _loop(
    window: Window, start: Start, desk: Desk, layout_file: LayoutFile, painting: Painting
) -> Iterator[Frame]:
    """Draw frame after frame until the user quits."""
    view = desk.view
    preferences_file = start.settings_folder / "preferences.json" if start.settings_folder else None
    preferences, complaint = read_preferences(preferences_file) if preferences_file else (Preferences(), None)
    view.freedom, view.quality, view.ui_scale = preferences.freedom, preferences.quality, preferences.ui_scale
    view.theme_name, view.habit, view.lately = preferences.theme, preferences.habit, preferences.lately
    view.steady = preferences.steady
    view.guide.step = preferences.guide
    if preferences.arrangement in ARRANGEMENTS:
        view.weights.arrangement = preferences.arrangement
    # Nobody is shown moving pictures at every start because nothing is remembered.
    view.guide.lively = preferences_file is not None
    router, letters = Router(), ShownLetters()
    view.recovery.shown = bool(desk.keeper.left)
    for problem in (*desk.keeper.remarks, layout_file.complaint, complaint):
        if problem:
            desk.say(problem, error=True)
    with desk.reporting("Opening"):
        rig = start.rig or resource("assets", BUILTIN)
        desk.opener.open(rig, start.first_pose, solve=start.solve_first, neutral=start.neutral)
    viewport = Viewport(0, 0, *window.size)
    viewports: tuple[Viewport, ...] = (viewport,)
    desk.viewport = viewport
    scale: float | None = None
    theme: Theme | None = None
    settling, wait, title, seconds, reset_layout = SETTLE, 0.0, "", 0.0, False
    unkept = ""
    look_again: float | None = None

    while not desk.closing:
        # What happened.
        events = window.poll(wait)
        began = perf_counter()
        waiting = any((desk.loading, desk.dialog, desk.job, desk.errands.busy))
        busy = waiting or desk.tool.nudging or view.weights.rests or view.guide.moving(began)
        settling = SETTLE if events or busy or desk.keeper.complaint != unkept else settling - 1
        unkept = desk.keeper.complaint
        if 0 in window.size:
            # Minimised: there is nothing to draw on, and imgui would fold its panels up.
            if CloseRequested() in events:
                break
            settling, wait = SETTLE, IDLE_WAIT
            yield Frame(desk, viewport, viewports, False, 0.0)
            continue
        if events:
            look_again = began + HOVER_DELAY
        elif settling < 0 and look_again is not None and began >= look_again:
            settling = SETTLE - 1
            # A text cursor goes on blinking.
            look_again = began + IDLE_WAIT if imgui.get_io().want_text_input else None
        if settling < 0:
            # Nothing to do: time for what makes the picture better, then sleep.
            settling = SETTLE if desk.refine() else -1
            rest = IDLE_WAIT if look_again is None else max(look_again - began, 0.0)
            wait = rest if desk.refined else 0.0
            yield Frame(desk, viewport, viewports, False, 0.0)
            continue
        wait = (0.0 if desk.job is not None else BUSY_WAIT) if busy else 0.0
        if window.scale * view.ui_scale / window.pixel_ratio != scale:
            former, scale = scale, window.scale * view.ui_scale / window.pixel_ratio
            if former is not None:  # docked panels keep their pixels, which no longer fit the text
                layout_file.scale(scale / former)
            theme = None
        if view.theme is not theme:
            theme = view.theme
            apply_theme(theme, scale)
        with desk.reporting("What was finished meanwhile"):
            desk.poll()
            desk.sync()
        with desk.reporting("The letters of names"):
            letters.load(desk, preferences.recent)
        window.begin_frame()

        # The hand in the picture; then the panels, so that they show this frame's weights.
        asked: list[Request] = []
        with part(desk, "The hand in the picture") as within:
            asked += router.take(events, desk, viewports, window.scale)
        if within.failed:
            with desk.reporting("The hand in the picture"):
                router = Router()
                desk.drop_gesture()
        asked += bars(desk, [Path(path) for path in preferences.recent], seconds, scale)
        reset_layout = reset_layout or Command.RESET_LAYOUT in asked
        viewport = layout.dock_space(scale, window.pixel_ratio, reset=reset_layout)
        if reset_layout:
            view.beside.forget()
        reset_layout = False
        stage = desk.stage
        if stage is not None:
            stage.with_reference = view.reference_shown
            viewports = layout.split(viewport, len(stage.panes), PANE_GAP * window.scale)
            desk.viewport, desk.pixel_scale = viewports[0], window.scale
        asked += panels(desk, scale)
        asked += cards(desk, viewport, window.pixel_ratio, scale)
        shown = False
        if stage is not None:
            moved = True
            with part(desk, "The face"):
                moved = stage.update()
            with part(desk, "What is over the picture"):
                asked += over_picture(desk, viewport, viewports, window.pixel_ratio, scale)
            with part(desk, "The picture"):
                moving = moved or router.navigator.holding or desk.tool.holding
                painting.draw(desk, stage, viewports, window.size, theme.panel, moving=moving)
                window.show(painting.flat())
                shown = True
        if not shown:
            window.clear(theme.panel)
        window.end_frame()
        seconds = perf_counter() - began

        # What was asked for is there in the next frame.
        for request in asked:
            carry_out(request, desk)
        with desk.reporting("Keeping the work"):
            if asked:
                desk.sync()
                settling = SETTLE
            desk.keep()
        if desk.title != title:
            title = desk.title
            window.set_title(title)
        if complaint := layout_file.save_if_due():
            desk.say(complaint, error=True)
        remembered = _remembered(preferences, desk)
        if preferences_file and remembered != preferences:
            preferences = remembered
            if complaint := write_preferences(preferences_file, preferences):
                desk.say(complaint, error=True)
        yield Frame(desk, viewport, viewports, True, seconds)
    if preferences_file and 0 not in window.size:
        width, height = (round(side / window.scale) for side in window.size)
        write_preferences(preferences_file, replace(preferences, window=(width, height)))


def _remembered(preferences: Preferences, desk: Desk) -> Preferences:
    """Return what to remember for the next run."""
    view = desk.view
    found = replace(
        preferences,
        freedom=view.freedom,
        quality=view.quality,
        steady=view.steady,
        ui_scale=view.ui_scale,
        theme=view.theme_name,
        habit=view.habit,
        guide=view.guide.step,
        lately=view.lately,
        arrangement=view.weights.arrangement,
    )
    if desk.opened is not None:
        found = found.opened(desk.opened)
    if desk.session is not None:
        found = replace(found, solver=desk.session.panes[0].choice.kind.key)
    return found


def _set_up_imgui() -> None:
    io = imgui.get_io()
    io.config_flags |= imgui.ConfigFlags_.docking_enable
    io.config_windows_move_from_title_bar_only = True
