"""How the face is looked at."""

from math import radians

import numpy as np

from facepin.core.look.camera import Camera, frame_points
from facepin.core.look.face_view import MARGIN, expressive
from facepin.desk.desk import Desk
from facepin.desk.stage import Stage
from facepin.panels.commands import FACE_TURNS, VIEW_COMMANDS, Command
from facepin.panels.requests import Request, ShadeAs, ShowParts

STEP = radians(15)
CLOSEST = 0.25
"""Share of the height of the face that is seen at least: a single pin has no extent to be framed by."""
TURNS: dict[Command, tuple[float, float]] = {
    Command.TURN_LEFT: (-STEP, 0.0),
    Command.TURN_RIGHT: (STEP, 0.0),
    Command.TURN_UP: (0.0, STEP),
    Command.TURN_DOWN: (0.0, -STEP),
}
"""Changes of yaw and pitch."""


def act(request: Request, desk: Desk) -> bool:
    """Carry out what concerns cameras and overlays; undo leaves these alone."""
    stage = desk.stage
    if request is Command.RESET_LAYOUT:
        return True  # the main loop has seen to it
    if stage is None:
        return False
    active = stage.session.active
    shown = desk.view.panes[active]
    match request:
        case Command.FRAME:
            desk.look(_framed(desk, stage))
        case Command() if request in VIEW_COMMANDS:
            desk.look(desk.camera.looking(VIEW_COMMANDS[request]))
        case Command() if request in FACE_TURNS:
            desk.turn(FACE_TURNS[request])
            return True
        case Command.ORTHOGRAPHIC:
            desk.look(desk.camera.through(orthographic=not desk.camera.orthographic))
        case Command() if request in TURNS:
            yaw, pitch = TURNS[request]
            desk.look(desk.camera.orbited(yaw, pitch))
        case Command.SHADING:
            shown.next_mode()
        case Command.HEAT:  # of all panes, so that they can be compared
            on = shown.shading == "heat"
            for each in (*desk.view.panes, desk.view.reference):
                if (each.shading == "heat") == on:
                    each.toggle_heat()
        case Command.SHOW_REFERENCE:
            if stage.session.work.reference is not None:
                desk.view.reference_shown = not desk.view.reference_shown
        case ShadeAs(mode):
            shown.mode = mode
        case ShowParts(hidden):
            desk.view.hidden_parts = hidden
            stage.hide(hidden)
        case Command.WIREFRAME:
            shown.wireframe = not shown.wireframe
        case Command.GHOST:
            shown.next_ghost(has_reference=stage.session.work.reference is not None)
        case Command.GAZE:
            desk.view.gaze.shown = not desk.view.gaze.shown
        case Command.CHART:
            desk.view.chart = not desk.view.chart
        case Command.HISTORY:
            desk.view.history = not desk.view.history
        case _:
            return False
    desk.say("")
    return True


def _framed(desk: Desk, stage: Stage) -> Camera:
    """Return the camera close to the selected pins, or to the part of the face that shapes move."""
    session, viewport = stage.session, desk.viewport
    positions = stage.positions(session.active)
    selected = [pin.vertex for pin in session.pose.pins if pin.vertex in desk.tool.selected]
    if not selected:
        chosen = positions[expressive(session.rig)]
        return frame_points(chosen, viewport.aspect, desk.camera, MARGIN)
    points = positions[selected].astype(np.float64)
    right, up, _ = desk.camera.axes
    around = CLOSEST * session.rig.height / 2 * np.array([right, -right, up, -up])
    points = np.concatenate([points, points.mean(axis=0) + around])
    return frame_points(points, viewport.aspect, desk.camera, MARGIN)
