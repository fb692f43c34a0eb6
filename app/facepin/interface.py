"""All panels of one frame: what they show of the desk, and what the user wants of it."""

from collections.abc import Sequence
from pathlib import Path

from imgui_bundle import imgui

from facepin.core.camera import Viewport
from facepin.core.pose import Pose
from facepin.desk import Desk
from facepin.panels import layout
from facepin.panels.chart import chart_window
from facepin.panels.filmstrip import filmstrip_window
from facepin.panels.legend import heat_legend
from facepin.panels.library import Shown, library_panel
from facepin.panels.menu import menu_bar, pin_menu
from facepin.panels.pane_title import pane_title
from facepin.panels.requests import CancelJob, CancelLoading, Request
from facepin.panels.solver import solver_panel
from facepin.panels.status import hint, progress_card, status_line
from facepin.panels.theme import pane_colours
from facepin.panels.weights import weights_panel
from facepin.session.edit import Edit
from facepin.session.filmstrip import filmstrip


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
        title = f"Opening {desk.loading.path.name}"
        if progress_card(title, desk.loading.fraction, desk.loading.line):
            asked.append(CancelLoading())
    elif desk.job is not None and desk.job.is_long and progress_card(desk.job.title, desk.job.fraction, ""):
        asked.append(CancelJob())
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
    request = edit = None
    layout.without_background(layout.SOLVER)
    if imgui.begin(layout.SOLVER)[0] and session is not None:
        request = solver_panel(session.rig, session.pane, session.active, desk.view.panes[session.active])
    imgui.end()
    layout.without_background(layout.WEIGHTS)
    if imgui.begin(layout.WEIGHTS)[0] and session is not None:
        edit = weights_panel(
            session.rig,
            session.panes,
            session.active,
            desk.view.weights,
            scale,
            in_gesture=session.in_gesture,
        )
    imgui.end()
    is_first = not layout.is_known(layout.LIBRARY)
    blend, more = _library(desk, scale)
    if is_first:  # else the tab that is made last lies on top
        imgui.set_window_focus(layout.WEIGHTS)
    edit = edit or blend
    if edit is not None:
        desk.apply(edit)
    chart: Request | None = None
    film: Request | None = None
    if desk.view.chart and session is not None:
        desk.view.chart, chart = chart_window(session.rig, session.panes, session.work.reference, scale)
    if desk.view.filmstrip and session is not None and desk.portraits is not None:
        stills = filmstrip(session)
        desk.view.filmstrip, film = filmstrip_window(stills, desk.portraits.tile, scale)
    return [asked for asked in (request, chart, film, *more) if asked is not None]


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
            library.remark,
            library.complaints,
            library.is_reading,
        )
        edit, wishes = library_panel(shown, desk.view.library, scale)
        asked += wishes
    imgui.end()
    return edit, asked


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
    if not session.pose.pins and not session.pose.weights.any():
        hint("Click the face to place a pin, then drag it", viewport, pixel_ratio)
    return asked


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
