"""All panels of one frame: what they show of the desk, and what the user wants of it."""

from collections.abc import Sequence
from pathlib import Path

from imgui_bundle import imgui

from facepin.core.camera import Viewport
from facepin.core.pose import Pose
from facepin.core.shape_motion import movers
from facepin.desk import Desk
from facepin.panels import layout
from facepin.panels.chart import chart_window
from facepin.panels.legend import heat_legend
from facepin.panels.menu import menu_bar, pin_menu
from facepin.panels.pane_title import pane_title
from facepin.panels.requests import Request
from facepin.panels.solver import solver_panel
from facepin.panels.status import hint, loading_card, status_line
from facepin.panels.theme import pane_colours
from facepin.panels.vertex_card import vertex_card
from facepin.panels.weights.panel import weights_panel
from facepin.session.edit import Edit
from facepin.stage import Stage


def bars(desk: Desk, recent: Sequence[Path], seconds: float) -> list[Request]:
    """Draw menu bar and status line, and what floats over everything.

    Parameters
    ----------
    desk : Desk
        What is shown.
    recent : sequence of Path
        Rigs opened lately.
    seconds : float
        Time of the last frame.
    """
    session = desk.session
    asked = [menu_bar(desk.view, recent, session)]
    timing = f"frame {seconds * 1e3:.1f} ms"
    if session is not None and desk.stage is not None and session.pane.solved is not None:
        solve = sum(pane.solved.seconds for pane in session.panes if pane.solved is not None)
        timing = f"solve {solve * 1e3:.2f} ms   deform {desk.stage.seconds * 1e3:.2f} ms   {timing}"
    rig = session.rig if session else None
    status_line(rig, timing, desk.message, is_error=desk.is_error, warnings=rig.warnings if rig else ())
    if desk.loading is not None and desk.loading.is_long:
        asked.append(loading_card(desk.loading.path.name, desk.loading.fraction, desk.loading.line))
    if desk.dialog is not None:
        desk.dialog.draw()
    if session is not None:
        asked.append(_pin_popup(desk, session.pose))
    return [request for request in asked if request is not None]


def panels(desk: Desk, scale: float) -> list[Request]:
    """Draw the docked panels; apply the edit they make, return what else they ask for.

    Parameters
    ----------
    desk : Desk
        What is shown.
    scale : float
        imgui units per pixel of a 1x screen.
    """
    session = desk.session
    request = wish = None
    layout.without_background(layout.SOLVER)
    if imgui.begin(layout.SOLVER)[0] and session is not None:
        request = solver_panel(
            session.rig, session.control, session.pane, session.active, desk.view.panes[session.active]
        )
    imgui.end()
    desk.view.weights.explained = None
    layout.without_background(layout.WEIGHTS)
    if imgui.begin(layout.WEIGHTS)[0] and session is not None:
        wish = weights_panel(
            session.rig,
            session.control,
            session.panes,
            session.active,
            desk.view.weights,
            scale,
            in_gesture=session.in_gesture,
        )
    imgui.end()
    for at, pane in enumerate(desk.view.panes):
        pane.shape = desk.view.weights.explained if session is not None and at == session.active else None
    if isinstance(wish, Edit):
        desk.apply(wish)
        wish = None
    chart: Request | None = None
    if desk.view.chart and session is not None:
        desk.view.chart, chart = chart_window(session.rig, session.panes, session.work.reference, scale)
    return [asked for asked in (request, wish, chart) if asked is not None]


def over_picture(
    desk: Desk, viewport: Viewport, viewports: Sequence[Viewport], pixel_ratio: float, scale: float
) -> list[Request]:
    """Draw what stands over the picture: a title for each of several panes, a hint over an untouched face."""
    session, stage = desk.session, desk.stage
    if session is None or stage is None:
        return []
    asked: list[Request] = []
    if len(viewports) > 1:
        colours = pane_colours([pane.choice.kind.key for pane in session.panes])
        for at, (pane, place) in enumerate(zip(session.panes, viewports, strict=False)):
            asked += pane_title(
                at,
                pane,
                stage.appraise(at),
                desk.view.panes[at],
                place,
                pixel_ratio,
                scale,
                colour=colours[at],
                active=at == session.active,
                has_reference=session.work.reference is not None,
            )
    for view, place in zip(desk.view.panes, viewports, strict=False):
        if view.heat:
            heat_legend(session.rig.height, place, pixel_ratio, scale)
    _vertex_under_mouse(desk, stage, viewports, pixel_ratio, scale)
    if not session.pose.pins and not session.pose.weights.any():
        hint("Click the face to place a pin, then drag it", viewport, pixel_ratio)
    return asked


def _vertex_under_mouse(
    desk: Desk, stage: Stage, viewports: Sequence[Viewport], pixel_ratio: float, scale: float
) -> None:
    """While Ctrl is held: tell which shapes can move what is under the mouse, and mark their sliders."""
    io, view = imgui.get_io(), desk.view.weights
    view.marked = frozenset()
    if not io.key_ctrl or io.want_capture_mouse or any(io.mouse_down):
        return
    pixel = io.mouse_pos.x * pixel_ratio, io.mouse_pos.y * pixel_ratio
    for at, (place, camera) in enumerate(zip(viewports, desk.cameras, strict=False)):
        vertex = stage.vertex_under(at, camera, place, pixel) if place.contains(*pixel) else None
        if vertex is not None:
            found = movers(stage.session.rig, vertex)
            view.marked = frozenset(j for j, _ in found)
            vertex_card(stage.session.rig, stage.session.control, vertex, found, scale)


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
