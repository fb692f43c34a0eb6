"""One frame after another: input, edits, panels, picture."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter

import moderngl
from imgui_bundle import imgui

from facepin.core.camera import Viewport
from facepin.core.events import (
    CloseRequested,
    Event,
    FilesDropped,
    KeyPressed,
    PointerMoved,
    PointerPressed,
    PointerReleased,
    Scrolled,
)
from facepin.core.pose import Pose
from facepin.core.rig import Rig
from facepin.desk import Desk
from facepin.files.preferences import Preferences, read_preferences, write_preferences
from facepin.gpu.canvas import Canvas
from facepin.options import BUILTIN
from facepin.panels import layout
from facepin.panels.file_dialog import has_native_dialogs
from facepin.panels.menu import menu_bar, pin_menu
from facepin.panels.requests import Command, OpenPath, Request, command_for
from facepin.panels.solver import solver_panel
from facepin.panels.status import hint, loading_card, status_line
from facepin.panels.theme import apply_theme
from facepin.panels.view import View
from facepin.panels.weights import weights_panel
from facepin.resources import resource
from facepin.session.drag import Sight, pin_at
from facepin.session.edit import Edit
from facepin.session.navigation import Navigator
from facepin.session.solving import SolverChoice
from facepin.window import Window

IDLE_WAIT = 0.5
"""Seconds between looks at the clock when nothing happens (a text cursor blinks)."""
BUSY_WAIT = 1 / 30
"""The same while a file is being opened or a dialog is up."""
SETTLE = 3
"""Frames drawn after the last event, so that imgui comes to rest."""


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


@dataclass(frozen=True)
class Frame:
    """What a finished frame looked like, for whoever drives the loop."""

    desk: Desk
    viewport: Viewport
    drawn: bool
    """Whether anything was drawn at all; nothing is when nothing happened."""
    seconds: float
    """Time from the first event to the finished picture."""


def run(window: Window, start: Start) -> None:
    """Show the window until the user closes it."""
    for _ in frames(window, start):
        pass


def frames(window: Window, start: Start) -> Iterator[Frame]:
    """Run the program frame by frame; ends when the user quits."""
    preferences_file = start.settings_folder / "preferences.json" if start.settings_folder else None
    preferences, complaint = read_preferences(preferences_file) if preferences_file else (Preferences(), None)
    view = View(freedom=preferences.freedom, quality=preferences.quality, ui_scale=preferences.ui_scale)
    _set_up_imgui(start.settings_folder)
    software = _is_software(window.ctx)
    rough, smooth = Canvas(window.ctx, 0), Canvas(window.ctx, 4)
    navigator = Navigator()
    desk = Desk(
        window.ctx,
        view,
        start.choices,
        native_dialogs=start.native_dialogs and has_native_dialogs(),
        pictures=start.pictures,
    )
    if complaint:
        desk.say(complaint, error=True)
    desk.open(start.rig or resource("assets", BUILTIN), start.first_pose)
    viewport = Viewport(0, 0, *window.size)
    themed: float | None = None
    drawn_scene: object = None
    settling, wait, title, seconds, reset_layout = SETTLE, 0.0, "", 0.0, False

    while not desk.closing:
        # 1. What happened.
        events = window.poll(wait)
        began = perf_counter()
        busy = desk.loading is not None or desk.dialog is not None
        settling = SETTLE if events or busy else settling - 1
        if settling < 0:
            wait = IDLE_WAIT
            yield Frame(desk, viewport, False, 0.0)
            continue
        wait = BUSY_WAIT if busy else 0.0
        if window.scale * view.ui_scale != themed:
            themed = window.scale * view.ui_scale
            apply_theme(themed / window.pixel_ratio)
        desk.poll(viewport)
        window.begin_frame()

        # 2. The hand in the viewport: a gesture keeps the mouse, then imgui, the drag tool, the camera.
        asked: list[Request] = []
        edit: Edit | None = None
        for event in events:
            step = _route(event, desk, navigator, viewport, window.scale, asked)
            if isinstance(step, Edit):
                if edit is not None and edit.final:
                    desk.apply(edit)
                edit = step
        # However many mouse events came, the face is solved once per frame: the last step of a gesture
        # holds all before it.
        if edit is not None:
            desk.apply(edit)

        # 3. Panels show this frame's weights.
        if reset_layout := (Command.RESET_LAYOUT in asked or reset_layout):
            asked = [request for request in asked if request is not Command.RESET_LAYOUT]
        asked += _bars(desk, [Path(path) for path in preferences.recent], seconds)
        if Command.RESET_LAYOUT in asked:
            asked.remove(Command.RESET_LAYOUT)
            reset_layout = True
        viewport = layout.dock_space(themed / window.pixel_ratio, window.pixel_ratio, reset=reset_layout)
        reset_layout = False
        asked += _panels(desk, themed / window.pixel_ratio)
        if desk.session is not None and not desk.session.pose.pins and not desk.session.pose.weights.any():
            hint("Click the face to place a pin, then drag it", viewport, window.pixel_ratio)
        for request in asked:
            desk.carry_out(request, viewport)

        # 4. The picture.
        if desk.stage is not None:
            moved = desk.stage.update()
            moving = moved or navigator.holding or desk.tool.holding
            canvas = _canvas(view, rough, smooth, software=software, moving=moving)
            scene = _scene_key(desk, viewport, canvas, window.size)
            if scene != drawn_scene:
                canvas.resize(*window.size)
                desk.stage.draw(
                    canvas,
                    (viewport,),
                    desk.camera,
                    desk.tool,
                    window.scale,
                    fine=canvas is smooth,
                )
                drawn_scene = scene
            canvas.resolve(window.ctx.screen)
        else:
            window.ctx.screen.use()
            window.ctx.screen.clear(0.09, 0.095, 0.105)
        window.end_frame()
        seconds = perf_counter() - began

        # 5. What the outside is told.
        if desk.title != title:
            title = desk.title
            window.set_title(title)
        remembered = replace(preferences, freedom=view.freedom, quality=view.quality, ui_scale=view.ui_scale)
        if desk.opened is not None:
            remembered = remembered.opened(desk.opened)
        if desk.session is not None:
            remembered = replace(remembered, solver=desk.session.choices[0].kind.key)
        if preferences_file and remembered != preferences:
            preferences = remembered
            if complaint := write_preferences(preferences_file, preferences):
                desk.say(complaint, error=True)
        yield Frame(desk, viewport, True, seconds)

    desk.release()
    rough.release()
    smooth.release()


def _set_up_imgui(settings_folder: Path | None) -> None:
    io = imgui.get_io()
    io.config_flags |= imgui.ConfigFlags_.docking_enable
    io.config_windows_move_from_title_bar_only = True
    ini = str(settings_folder / "layout.ini") if settings_folder else None
    if settings_folder:
        settings_folder.mkdir(parents=True, exist_ok=True)
    io.set_ini_filename(ini)


def _is_software(ctx: moderngl.Context) -> bool:
    """Say whether OpenGL runs on the processor: many samples then wait until the picture rests."""
    return any(word in ctx.info["GL_RENDERER"].lower() for word in ("llvmpipe", "softpipe", "swiftshader"))


def _canvas(view: View, rough: Canvas, smooth: Canvas, *, software: bool, moving: bool) -> Canvas:
    if view.quality == "off" or (view.quality == "auto" and software and moving):
        return rough
    return smooth


def _scene_key(desk: Desk, viewport: Viewport, canvas: Canvas, size: tuple[int, int]) -> tuple[object, ...]:
    """Return everything the picture depends on; the same key means the same picture."""
    assert desk.stage is not None
    tool = desk.tool
    poses = desk.stage.session.poses
    return (desk.stage, canvas, size, viewport, desk.camera, poses, tool.selected, tool.hovered, tool.held)


def _route(
    event: Event, desk: Desk, navigator: Navigator, viewport: Viewport, scale: float, asked: list[Request]
) -> Edit | None:
    """Give an event to whoever has a right to it; return the edit it makes, if any."""
    io = imgui.get_io()
    match event:
        case CloseRequested():
            asked.append(Command.QUIT)
            return None
        case FilesDropped(paths):
            asked.append(OpenPath(paths[0].parent if paths[0].suffix.lower() == ".obj" else paths[0]))
            return None
        case KeyPressed():
            if io.want_text_input:
                return None
            command = command_for(event)
            if command is not None:
                asked.append(command)
                return None
    if desk.stage is None or desk.session is None:
        return None
    session = desk.session
    sight = Sight(
        session.rig,
        session.pose,
        desk.stage.positions(session.active),
        desk.camera,
        viewport,
        scale,
        desk.view.freedom,
    )
    if isinstance(event, KeyPressed):
        if event.key == "escape" and desk.tool.holding:
            session.cancel()
        return desk.tool.handle(event, sight)
    if desk.tool.holding:
        return desk.tool.handle(event, sight)
    if navigator.holding:
        desk.camera = navigator.handle(event, desk.camera, viewport)
        return None
    if io.want_capture_mouse and not isinstance(event, PointerReleased):
        desk.tool.hovered = None
        return None
    inside = isinstance(event, PointerMoved | PointerPressed | Scrolled) and viewport.contains(
        event.x, event.y
    )
    if not inside:
        return None
    if isinstance(event, PointerPressed) and event.button == "right" and not event.modifiers.alt:
        vertex = pin_at(sight, (event.x, event.y))
        if vertex is not None:
            desk.view.pin_menu, desk.view.pin_menu_opens = vertex, True
            desk.tool.selected = frozenset({vertex})
            return None
    edit = None
    if not (isinstance(event, PointerPressed) and event.modifiers.alt):
        edit = desk.tool.handle(event, sight)
    if not desk.tool.holding:
        desk.camera = navigator.handle(event, desk.camera, viewport)
    return edit


def _bars(desk: Desk, recent: list[Path], seconds: float) -> list[Request]:
    """Draw menu bar, status line, and what floats over everything."""
    session = desk.session
    asked = [
        menu_bar(
            desk.view,
            recent,
            session.undo_label if session else None,
            session.redo_label if session else None,
            len(session.pose.pins) if session else 0,
        )
    ]
    solved = session.solved[session.active] if session else None
    timing = f"frame {seconds * 1e3:.1f} ms"
    if solved is not None and desk.stage is not None:
        timing = f"solve {solved.seconds * 1e3:.2f} ms   deform {desk.stage.seconds * 1e3:.2f} ms   {timing}"
    rig = session.rig if session else None
    status_line(rig, timing, desk.message, is_error=desk.is_error, warnings=rig.warnings if rig else ())
    if desk.loading is not None:
        asked.append(loading_card(desk.loading.path.name, desk.loading.fraction, desk.loading.line))
    if desk.dialog is not None:
        desk.dialog.draw()
    if session is not None:
        asked.append(_pin_popup(desk, session.pose))
    return [request for request in asked if request is not None]


def _pin_popup(desk: Desk, pose: Pose) -> Request | None:
    """Draw the menu of the pin that was clicked with the right button, while it is open."""
    if desk.view.pin_menu is None:
        return None
    if desk.view.pin_menu_opens:
        imgui.open_popup("pin menu")
        desk.view.pin_menu_opens = False
    pin = next((pin for pin in pose.pins if pin.vertex == desk.view.pin_menu), None)
    if pin is None or not imgui.begin_popup("pin menu"):
        desk.view.pin_menu = None
        return None
    request = pin_menu(pin)
    imgui.end_popup()
    return request


def _panels(desk: Desk, scale: float) -> list[Request]:
    """Draw the docked panels; apply the edit they make, return what else they ask for."""
    session = desk.session
    request: Request | None = None
    edit: Edit | None = None
    if imgui.begin(layout.SOLVER)[0] and session is not None:
        active = session.active
        request = solver_panel(
            session.rig, session.pose, active, session.choices[active], session.solved[active]
        )
    imgui.end()
    if imgui.begin(layout.WEIGHTS)[0] and session is not None:
        edit = weights_panel(
            session.rig, session.pose, desk.view.weights, scale, in_gesture=session.in_gesture
        )
    imgui.end()
    if edit is not None:
        desk.apply(edit)
    return [request] if request is not None else []
