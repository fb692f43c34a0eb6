"""The docked panels of one frame: what they show of the desk, and what the user wants of it."""

from dataclasses import replace

from imgui_bundle import imgui

from facepin.core.shapes.places import titles
from facepin.desk.desk import Desk
from facepin.frame.part import part
from facepin.panels import layout
from facepin.panels.chart import SIZE as CHART_SIZE
from facepin.panels.chart import TITLE as CHART
from facepin.panels.chart import chart_window
from facepin.panels.library.filmstrip import TITLE as FILMSTRIP
from facepin.panels.library.filmstrip import filmstrip_window, strip_height
from facepin.panels.library.panel import Shown, library_panel
from facepin.panels.pins import list_height, pins_panel
from facepin.panels.requests import Request
from facepin.panels.solving.panel import solver_panel
from facepin.panels.weights.panel import weights_panel
from facepin.session.edit import Edit
from facepin.session.hand.mirroring import linked_weights
from facepin.session.session import Session


def panels(desk: Desk, scale: float) -> list[Request]:
    """Draw the docked panels; apply the edit they make, return what else they ask for.

    Parameters
    ----------
    desk : Desk
        What is shown.
    scale : float
        imgui units per pixel of a 1x screen.
    """
    session, theme = desk.session, desk.view.theme
    request: Request | None = None
    wish: Edit | Request | None = None
    with part(desk, "The panel of the solver"):
        layout.without_background(layout.SOLVER)
        if imgui.begin(layout.SOLVER)[0] and session is not None:
            request = solver_panel(
                session.rig,
                session.control,
                session.pane,
                session.active,
                desk.view.panes[session.active],
                theme,
            )
            layout.fit_height(layout.WEIGHTS, scale)
        imgui.end()
    of_pins: Request | None = None
    with part(desk, "The panel of pins"):
        of_pins = _pins(desk, session, scale)
    desk.view.weights.explained = None
    with part(desk, "The panel of weights"):
        layout.without_background(layout.WEIGHTS)
        if imgui.begin(layout.WEIGHTS)[0] and session is not None:
            wish = weights_panel(
                session.rig,
                session.control,
                session.panes,
                session.active,
                desk.view.weights,
                scale,
                theme,
                lambda: session.mirror,
                in_gesture=session.in_gesture,
                reference=session.work.reference if desk.view.reference_shown else None,
            )
        imgui.end()
    is_first = not layout.is_known(layout.LIBRARY)
    blend: Edit | None = None
    more: list[Request] = []
    with part(desk, "The panel of poses"):
        blend, more = _library(desk, scale)
    if is_first:  # else the tab that is made last lies on top
        imgui.set_window_focus(layout.WEIGHTS)
    for at, pane in enumerate(desk.view.panes):
        pane.shape = desk.view.weights.explained if session is not None and at == session.active else None
    with part(desk, "What a panel changed"):
        if isinstance(wish, Edit):
            desk.apply(_linked(desk, session, wish))
            wish = None
        elif blend is not None:
            desk.apply(blend)
    chart: Request | None = None
    film: Request | None = None
    count = 1 if desk.stage is None else len(desk.stage.panes)
    with part(desk, "The chart"):
        if desk.view.chart and session is not None:
            desk.view.beside.left(CHART, CHART_SIZE[0] * scale, count, layout.WEIGHTS)
            desk.view.chart, chart = chart_window(
                session.rig, session.panes, session.work.reference, scale, theme
            )
    with part(desk, "The filmstrip"):
        if desk.view.filmstrip and session is not None and desk.portraits is not None:
            stills = desk.filmstrip.stills(session)
            desk.view.beside.below(FILMSTRIP, strip_height(scale))
            desk.view.filmstrip, film = filmstrip_window(stills, desk.portraits.tile, scale)
    others = (request, of_pins, None if isinstance(wish, Edit) else wish, chart, film)
    return [asked for asked in (*others, *more) if asked is not None]


def _pins(desk: Desk, session: Session | None, scale: float) -> Request | None:
    """Draw the list of pins."""
    layout.without_background(layout.PINS)
    layout.beside(layout.PINS, layout.SOLVER)
    asked: Request | None = None
    if imgui.begin(layout.PINS)[0] and session is not None and desk.stage is not None:
        pins, positions = session.pose.pins, desk.stage.positions(session.active)
        called = titles(desk.stage.places, pins) if pins else {}
        asked = pins_panel(
            session.rig, pins, called, positions, desk.tool.selected, desk.view.pins, theme=desk.view.theme
        )
        if desk.view.pins.hovered is not None:
            desk.tool.hovered = desk.view.pins.hovered
        layout.fit_height(layout.WEIGHTS, scale, list_height(len(pins)))
    imgui.end()
    return asked


def _linked(desk: Desk, session: Session | None, edit: Edit) -> Edit:
    """Let the twin of a slider move along while left and right are one."""
    if session is None or edit.weights is None or not desk.view.symmetric:
        return edit
    before = session.committed.panes[session.active].pose.weights
    return replace(edit, weights=linked_weights(session.mirror, before, edit.weights))


def _library(desk: Desk, scale: float) -> tuple[Edit | None, list[Request]]:
    """Draw the library panel, where its tab is open."""
    layout.beside(layout.LIBRARY, layout.WEIGHTS)
    layout.without_background(layout.LIBRARY)
    if desk.view.library_opens:
        imgui.set_next_window_focus()
        desk.view.library_opens = False
    edit: Edit | None = None
    asked: list[Request] = []
    session, library, portraits = desk.session, desk.library, desk.portraits
    is_open = imgui.begin(layout.LIBRARY, None, imgui.WindowFlags_.no_focus_on_appearing)[0]
    if is_open and session is not None and library is not None and portraits is not None:
        if imgui.is_window_appearing() and library.looked_at:
            library.read_again()
        library.looked_at = True
        panes = session.committed.panes
        shown = Shown(
            session.rig,
            library.poses,
            lambda pose: portraits.tile(pose.weights, library.picture_file(pose)),
            panes[min(session.active, len(panes) - 1)].pose.weights,
            library.folder,
            "\n".join(filter(None, [library.remark, portraits.complaint])),
            desk.view.theme,
            library.complaints,
            library.is_reading,
        )
        edit, wishes = library_panel(shown, desk.view.library, scale)
        asked += wishes
    imgui.end()
    return edit, asked
