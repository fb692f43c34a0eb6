"""What floats over the top of the picture: history, a tidied pose, a missing rig."""

from facepin.core.look.camera import Viewport
from facepin.core.shapes.measures import moves, percent
from facepin.desk.desk import Desk
from facepin.frame.part import part
from facepin.panels import layout
from facepin.panels.chart import TITLE as CHART
from facepin.panels.help.about import TITLE as ABOUT
from facepin.panels.history import TITLE as HISTORY
from facepin.panels.history import history_window
from facepin.panels.inside import bring_inside
from facepin.panels.library.filmstrip import TITLE as FILMSTRIP
from facepin.panels.neutral import neutral_card
from facepin.panels.recovery import lost_card
from facepin.panels.requests import Request
from facepin.panels.solving.tidy import LABEL, Tidied, tidy_card
from facepin.panels.solving.tidy import WINDOW as TIDY

DOCKED = (layout.SOLVER, layout.PINS, layout.WEIGHTS, layout.LIBRARY)
FLOATING = (*DOCKED, CHART, FILMSTRIP, HISTORY, ABOUT, TIDY)
"""Windows that may be anywhere: panels too, when they are torn off."""


def cards(desk: Desk, viewport: Viewport, pixel_ratio: float, scale: float) -> list[Request]:
    """Draw what floats at the top of the picture, face or no face: history, a missing rig or neutral."""
    place = (viewport.x / pixel_ratio, viewport.y / pixel_ratio)
    width = viewport.width / pixel_ratio
    session, view = desk.session, desk.view
    asked: list[Request | None] = []
    bring_inside(FLOATING)
    with part(desk, "The list of steps"):
        if view.history and session is not None:
            steps, step = session.steps, session.step
            view.beside.in_front_of(layout.WEIGHTS, HISTORY)
            view.history, wanted = history_window(session.rig, steps, step, scale, view.theme)
            asked.append(wanted)
    with part(desk, "Tidying"):
        if view.tidy is not None:
            asked.append(_tidy(desk, view.tidy, place, scale))
    with part(desk, "The scene without its rig"):
        if desk.opener.lost is not None:
            asked.append(lost_card(desk.opener.lost.line, *place, width, view.theme))
    with part(desk, "The folder without a neutral"):
        if (unclear := desk.opener.unclear) is not None:
            name, files, likely = unclear.folder.resolve().name, unclear.names, unclear.likely
            asked.append(neutral_card(name, files, likely, *place, width))
    return [request for request in asked if request is not None]


def _tidy(desk: Desk, tolerance: float, place: tuple[float, float], scale: float) -> Request | None:
    """Draw the card of a tidied pose, as long as that is what is shown."""
    session, stage = desk.session, desk.stage
    if session is None or stage is None or not session.in_gesture or session.undo_label != LABEL:
        desk.view.tidy = None
        return None
    pane, rig = session.active, session.rig
    before, after = session.committed.panes[pane].pose, session.panes[pane].pose
    was, now = (rig.evaluate(session.control.heard(pose.weights)) for pose in (before, after))
    vertices = [pin.vertex for pin in before.pins] or slice(None)
    moved = percent(float(moves(now[vertices], was[vertices]).max(initial=0.0)), rig.height)
    told = Tidied(before.weights, after.weights, moved, len(before.pins))
    return tidy_card(told, tolerance, *place, scale, desk.view.theme)
