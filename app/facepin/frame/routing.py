"""Gives each event to whoever has a right to it: a gesture in progress, imgui, drag tool, camera."""

from collections.abc import Sequence
from itertools import zip_longest
from math import hypot
from time import monotonic

from imgui_bundle import imgui

from facepin.core.events import (
    NONE,
    CloseRequested,
    Event,
    FilesDropped,
    KeyPressed,
    KeyReleased,
    PointerMoved,
    PointerPressed,
    PointerReleased,
    Scrolled,
)
from facepin.core.look.camera import Viewport
from facepin.core.pose import Vector
from facepin.core.shapes.gaze import Gaze, find_gaze
from facepin.desk.desk import Desk
from facepin.desk.stage import Stage
from facepin.panels.commands import PICTURES, Command, command_for
from facepin.panels.requests import OpenPath, Request
from facepin.panels.view import View
from facepin.session.edit import Edit
from facepin.session.hand.gaze import GazeHold, is_on_handle, straightened
from facepin.session.hand.nudge import goes_on
from facepin.session.hand.sight import DEAD_ZONE, Pixel, Sight, pin_at
from facepin.session.navigation import PRESETS, Navigator

DOUBLE_CLICK = 0.35
"""Seconds from the end of a click to the press that makes it a double click."""
FUNCTION_KEYS = frozenset(f"f{number}" for number in range(1, 13))


class Router:
    """Remembers which pane the mouse went down in: that pane keeps the drag."""

    def __init__(self) -> None:
        self.navigator = Navigator()
        self._pane = 0
        self._beside: Pixel | None = None
        """Where the mouse went down beside the face."""
        self._gaze_clicked = -DOUBLE_CLICK
        """When the handle of the eyes was clicked."""

    def take(
        self, events: Sequence[Event], desk: Desk, viewports: Sequence[Viewport], scale: float
    ) -> list[Request]:
        """Let a frame's events happen: edits are applied, the camera is moved, other wishes are returned.

        However many moves of the mouse came, the face is solved once: the last step of a gesture holds all of
        it.  What ends a gesture happens at once, since the next event may begin another on what it left.
        """
        asked: list[Request] = []
        pending: Edit | None = None
        for event, after in zip_longest(events, events[1:]):
            at_rest = not (desk.tool.holding or desk.tool.nudging or self.navigator.holding)
            if at_rest and isinstance(event, PointerMoved) and isinstance(after, PointerMoved):
                continue  # what was under the mouse on its way is not asked for
            if desk.tool.nudging and not goes_on(event) and not _is_escape(event):
                _finished(desk.tool.finish(), desk)
                pending = None
            in_hand = desk.tool.holding or desk.tool.nudging
            edit = self._route(event, desk, viewports, scale, asked)
            if edit is not None and edit.final:
                _finished(edit, desk)
                pending = None
            elif edit is not None:
                pending = edit
            elif in_hand and not (desk.tool.holding or desk.tool.nudging):
                pending = None  # given up: nothing of it may come after
            if desk.tool.remark:
                desk.say(desk.tool.remark)
                desk.tool.remark = ""
        if pending is not None:
            desk.apply(pending)
        _finished(desk.tool.settle(monotonic()), desk)
        return asked

    def _route(
        self,
        event: Event,
        desk: Desk,
        viewports: Sequence[Viewport],
        scale: float,
        asked: list[Request],
    ) -> Edit | None:
        match event:
            case CloseRequested():
                asked.append(Command.QUIT)
            case FilesDropped((first, *_)):
                asked.append(OpenPath(first))
            case KeyPressed():
                command = command_for(event, desk.view.habit)
                if desk.dialog is not None and desk.dialog.can_ask_again:
                    return None  # it is modal
                if desk.view.palette is not None and command is not Command.PALETTE:
                    return None
                silent = command is Command.PALETTE or event.key in FUNCTION_KEYS
                if imgui.get_io().want_text_input and not silent:
                    return None  # it is being written; only what writes nothing is heard everywhere
                in_hand = desk.tool.holding or self.navigator.holding
                # What a gesture began with must not change under it; a picture of it may be taken.
                if command is not None and (not in_hand or command in PICTURES):
                    asked.append(command)
                elif desk.stage is not None:
                    return self._key(event, desk, desk.stage, viewports, scale)
            case KeyReleased() if desk.stage is not None:
                return desk.tool.handle(event, self._sight(desk, desk.stage, viewports, scale, self._pane))
            case PointerMoved() | PointerPressed() | PointerReleased() | Scrolled() if desk.stage is not None:
                return self._pointer(event, desk, desk.stage, viewports, scale)
        return None

    def _key(
        self, event: KeyPressed, desk: Desk, stage: Stage, viewports: Sequence[Viewport], scale: float
    ) -> Edit | None:
        """Give a key that asks for no command to the tool, in the pane that is worked on."""
        if event.key == "escape":
            if desk.tool.holding or desk.tool.nudging:
                stage.session.cancel()
            elif stage.session.in_gesture or _is_over_all(desk.view):
                return None  # that is what it ends
            elif desk.view.pins.sketching:
                desk.view.pins.sketching = False
                return None
        elif imgui.get_io().want_capture_keyboard:
            return None
        return desk.tool.handle(event, self._sight(desk, stage, viewports, scale, stage.session.active))

    def _pointer(
        self,
        event: PointerMoved | PointerPressed | PointerReleased | Scrolled,
        desk: Desk,
        stage: Stage,
        viewports: Sequence[Viewport],
        scale: float,
    ) -> Edit | None:
        if desk.tool.holding:
            gesture = desk.tool.gesture
            edit = desk.tool.handle(event, self._sight(desk, stage, viewports, scale, self._pane))
            if edit is None and isinstance(gesture, GazeHold) and not desk.tool.holding:
                self._gaze_clicked = monotonic()
            return edit
        if self.navigator.holding:
            desk.tool.look_away()
            self._navigate(event, desk, viewports)
            self._click_beside(event, desk, scale)
            return None
        if isinstance(event, PointerReleased) or imgui.get_io().want_capture_mouse:
            desk.tool.look_away()
            desk.view.gaze.hovered = False
            return None
        under = [at for at, viewport in enumerate(viewports) if viewport.contains(event.x, event.y)]
        if not under or under[0] >= len(stage.panes):
            return None
        self._pane = under[0]
        if self._pane >= len(stage.session.panes):  # the reference is looked at, and nothing else
            self._navigate(event, desk, viewports)
            return None
        sight = self._sight(desk, stage, viewports, scale, self._pane)
        gaze = find_gaze(stage.session.rig) if desk.view.gaze.shown else None
        pixel = event.x, event.y
        on_gaze = gaze is not None and is_on_handle(gaze, sight, pixel) and pin_at(sight, pixel) is None
        desk.view.gaze.hovered = on_gaze
        if isinstance(event, PointerPressed):
            stage.session.settle()  # a slider may be on its way by wheel or key
            stage.session.active = self._pane
            if gaze is not None and on_gaze and event.button == "left" and event.modifiers == NONE:
                return self._take_gaze(gaze, pixel, desk, stage, sight)
            if event.button == "right" and not event.modifiers.alt:
                vertex = pin_at(sight, (event.x, event.y))
                if vertex is not None:
                    desk.view.pin_menu, desk.view.pin_menu_opens = vertex, True
                    if vertex not in desk.tool.selected:  # else the menu is for all that are selected
                        desk.tool.selected = frozenset({vertex})
                    return None
        edit = None
        if not (isinstance(event, PointerPressed) and event.modifiers.alt):
            edit = desk.tool.handle(event, sight)
        if not desk.tool.holding:
            self._navigate(event, desk, viewports)
            self._click_beside(event, desk, scale)
        return edit

    def _take_gaze(self, gaze: Gaze, pixel: Pixel, desk: Desk, stage: Stage, sight: Sight) -> Edit | None:
        """Take hold of the handle of the eyes; a double click lets them look ahead."""
        control = stage.session.control
        if monotonic() - self._gaze_clicked < DOUBLE_CLICK:
            return straightened(gaze, sight.pose.weights, control)
        desk.tool.begin(GazeHold(gaze, control, sight, pixel, desk.tool.selected))
        return None

    def _click_beside(self, event: Event, desk: Desk, scale: float) -> None:
        """Let go of the selection after a click beside the face: one that did not turn the camera."""
        match event:
            case PointerPressed(x, y, "left") if event.modifiers == NONE:
                self._beside = (x, y)
            case PointerReleased(x, y, "left") if self._beside is not None:
                if hypot(x - self._beside[0], y - self._beside[1]) < DEAD_ZONE * scale:
                    desk.tool.selected = frozenset()
                self._beside = None

    def _navigate(self, event: Event, desk: Desk, viewports: Sequence[Viewport]) -> None:
        pane = min(self._pane, len(viewports) - 1)  # it may have been closed meanwhile
        own = pane if pane < len(desk.cameras) else None
        before = desk.camera if own is None else desk.cameras[own]
        viewport, stage = viewports[pane], desk.stage

        def surface(pixel: Pixel) -> Vector | None:
            hit = None if stage is None else stage.hit(pane, before, viewport, pixel)
            return None if hit is None else hit.point

        camera = self.navigator.handle(event, before, viewport, PRESETS[desk.view.habit], surface)
        if camera is not before:
            desk.look(camera, own)

    def _sight(
        self, desk: Desk, stage: Stage, viewports: Sequence[Viewport], scale: float, pane: int
    ) -> Sight:
        pane = min(pane, len(viewports) - 1, len(stage.session.panes) - 1)
        return Sight(
            stage.session.rig,
            stage.triangles,
            stage.session.panes[pane].pose,
            stage.positions(pane),
            desk.cameras[pane],
            viewports[pane],
            scale,
            desk.view.freedom,
            desk.view.pins.stroke if desk.view.pins.sketching else None,
            ("left", NONE) not in PRESETS[desk.view.habit].motions,
            stage.session.mirror if desk.view.symmetric else None,
            desk.view.steady,
            lambda _: stage.places,
            stage.present,
        )


def _finished(edit: Edit | None, desk: Desk) -> None:
    """Make an edit an undo step, at once: the next event may begin another on what it left."""
    if edit is not None:
        desk.apply(edit)
        if desk.stage is not None:
            desk.stage.update()


def _is_over_all(view: View) -> bool:
    """Say whether something is open that Esc closes."""
    return view.keyboard or view.about or imgui.is_popup_open("", imgui.PopupFlags_.any_popup)


def _is_escape(event: Event) -> bool:
    return isinstance(event, KeyPressed) and event.key == "escape"
