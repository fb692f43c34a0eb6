"""How the face is looked at."""

from math import radians

from facepin.core.camera import frame_points
from facepin.desk.desk import Desk
from facepin.panels.commands import VIEW_COMMANDS, Command
from facepin.panels.requests import Request, ShadeAs

STEP = radians(15)
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
            desk.look(frame_points(stage.positions(active), desk.viewport.aspect, desk.camera))
        case Command() if request in VIEW_COMMANDS:
            desk.look(desk.camera.looking(VIEW_COMMANDS[request]))
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
        case Command.SHOW_REFERENCE if stage.session.work.reference is not None:
            desk.view.reference_shown = not desk.view.reference_shown
        case ShadeAs(mode):
            shown.mode = mode
        case Command.WIREFRAME:
            shown.wireframe = not shown.wireframe
        case Command.GHOST:
            shown.next_ghost(has_reference=stage.session.work.reference is not None)
        case Command.CHART:
            desk.view.chart = not desk.view.chart
        case Command.HISTORY:
            desk.view.history = not desk.view.history
        case _:
            return False
    desk.say("")
    return True
