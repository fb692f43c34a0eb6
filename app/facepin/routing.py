"""Gives each event to whoever has a right to it: a gesture in progress, imgui, drag tool, camera."""

from collections.abc import Sequence

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
from facepin.desk import Desk
from facepin.panels.requests import Command, OpenPath, Request, command_for
from facepin.session.drag import Sight, pin_at
from facepin.session.edit import Edit
from facepin.session.navigation import Navigator
from facepin.stage import Stage


class Router:
    """Remembers which pane the mouse went down in: that pane keeps the drag."""

    def __init__(self) -> None:
        self.navigator = Navigator()
        self._pane = 0

    def take(
        self, events: Sequence[Event], desk: Desk, viewports: Sequence[Viewport], scale: float
    ) -> list[Request]:
        """Let a frame's events happen: edits are applied, the camera is moved, other wishes are returned.

        However many moves of the mouse came, the face is solved once: the last step of a gesture holds all of
        it.  What ends a gesture happens at once, since the next event may begin another on what it left.
        """
        asked: list[Request] = []
        pending: Edit | None = None
        for event in events:
            in_hand = desk.tool.holding
            edit = self._route(event, desk, viewports, scale, asked)
            if edit is not None and edit.final:
                desk.apply(edit)
                if desk.stage is not None:
                    desk.stage.update()
                pending = None
            elif edit is not None:
                pending = edit
            elif in_hand and not desk.tool.holding:  # given up: nothing of it may come after
                pending = None
        if pending is not None:
            desk.apply(pending)
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
                asked.append(OpenPath(first.parent if first.suffix.lower() == ".obj" else first))
            case KeyPressed() if not imgui.get_io().want_text_input:
                command = command_for(event)
                in_hand = desk.tool.holding or self.navigator.holding
                # What a gesture began with must not change under it; a picture of it may be taken.
                if command is not None and (not in_hand or command is Command.SCREENSHOT):
                    asked.append(command)
                elif desk.stage is not None:
                    if event.key == "escape" and desk.tool.holding:
                        desk.stage.session.cancel()
                    return desk.tool.handle(event, self._sight(desk, desk.stage, viewports, scale))
            case PointerMoved() | PointerPressed() | PointerReleased() | Scrolled() if desk.stage is not None:
                return self._pointer(event, desk, desk.stage, viewports, scale)
        return None

    def _pointer(
        self,
        event: PointerMoved | PointerPressed | PointerReleased | Scrolled,
        desk: Desk,
        stage: Stage,
        viewports: Sequence[Viewport],
        scale: float,
    ) -> Edit | None:
        if desk.tool.holding:
            return desk.tool.handle(event, self._sight(desk, stage, viewports, scale))
        if self.navigator.holding:
            self._navigate(event, desk, viewports)
            return None
        if isinstance(event, PointerReleased) or imgui.get_io().want_capture_mouse:
            desk.tool.hovered = None
            return None
        under = [at for at, viewport in enumerate(viewports) if viewport.contains(event.x, event.y)]
        if not under or under[0] >= len(desk.cameras):
            return None
        self._pane = under[0]
        sight = self._sight(desk, stage, viewports, scale)
        if isinstance(event, PointerPressed):
            stage.session.settle()  # a slider may be on its way by wheel or key
            stage.session.active = self._pane
            if event.button == "right" and not event.modifiers.alt:
                vertex = pin_at(sight, (event.x, event.y))
                if vertex is not None:
                    desk.view.pin_menu, desk.view.pin_menu_opens = vertex, True
                    desk.tool.selected = frozenset({vertex})
                    return None
        edit = None
        if not (isinstance(event, PointerPressed) and event.modifiers.alt):
            edit = desk.tool.handle(event, sight)
        if not desk.tool.holding:
            self._navigate(event, desk, viewports)
        return edit

    def _navigate(self, event: Event, desk: Desk, viewports: Sequence[Viewport]) -> None:
        pane = min(self._pane, len(viewports) - 1, len(desk.cameras) - 1)  # it may have been closed meanwhile
        before = desk.cameras[pane]
        camera = self.navigator.handle(event, before, viewports[pane])
        if camera is not before:
            desk.look(camera, pane)

    def _sight(self, desk: Desk, stage: Stage, viewports: Sequence[Viewport], scale: float) -> Sight:
        pane = min(self._pane, len(viewports) - 1, len(stage.session.panes) - 1)
        return Sight(
            stage.session.rig,
            stage.triangles,
            stage.session.panes[pane].pose,
            stage.positions(pane),
            desk.cameras[pane],
            viewports[pane],
            scale,
            desk.view.freedom,
        )
