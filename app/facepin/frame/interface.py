"""All panels of one frame: what they show of the desk, and what the user wants of it."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from time import perf_counter

import numpy as np
from imgui_bundle import imgui

from facepin.core.look.camera import Viewport
from facepin.core.pose import Pose
from facepin.core.shapes.gaze import find_gaze
from facepin.core.shapes.measures import active, moves, percent
from facepin.core.shapes.motion import movers
from facepin.core.shapes.places import titles
from facepin.desk.desk import Desk
from facepin.desk.stage import Stage
from facepin.files.work.drafts import Leftover
from facepin.panels import layout
from facepin.panels.chart import SIZE as CHART_SIZE
from facepin.panels.chart import TITLE as CHART
from facepin.panels.chart import chart_window
from facepin.panels.commands import Command
from facepin.panels.help.about import about_window
from facepin.panels.help.guide import Hand, draw_guide
from facepin.panels.help.keyboard import keyboard_map
from facepin.panels.help.palette import palette
from facepin.panels.history import TITLE as HISTORY
from facepin.panels.history import history_window
from facepin.panels.library.filmstrip import TITLE as FILMSTRIP
from facepin.panels.library.filmstrip import filmstrip_window, strip_height
from facepin.panels.library.panel import Shown, library_panel
from facepin.panels.menu import menu_bar
from facepin.panels.picture.gaze import draw_gaze
from facepin.panels.picture.hand import (
    aim_ring,
    axis_line,
    draw_gesture,
    hidden_pins,
    pin_label,
    sketch_hint,
    soft_ring,
    symmetry_button,
)
from facepin.panels.picture.legend import heat_legend
from facepin.panels.picture.pane_title import pane_title, reference_title
from facepin.panels.picture.pin_menu import pin_menu
from facepin.panels.picture.vertex_card import vertex_card
from facepin.panels.pins import list_height, pins_panel, together
from facepin.panels.recovery import WorkRow, lost_card, recovery_strip
from facepin.panels.requests import CancelJob, CancelLoading, Request
from facepin.panels.solving.panel import solver_panel
from facepin.panels.solving.tidy import LABEL, Tidied, tidy_card
from facepin.panels.status import progress_card, status_line
from facepin.panels.theme import PICTURE, packed, pane_colours
from facepin.panels.weights.panel import weights_panel
from facepin.session.edit import Edit
from facepin.session.hand.gaze import GazeHold
from facepin.session.hand.hold import Hold
from facepin.session.hand.mirroring import linked_weights
from facepin.session.session import Session


def bars(desk: Desk, recent: Sequence[Path], seconds: float, scale: float) -> list[Request]:
    """Draw menu bar, unsaved work and status line, and what floats over everything.

    Parameters
    ----------
    desk : Desk
        What is shown.
    recent : sequence of Path
        Rigs opened lately.
    seconds : float
        Time of the last frame.
    scale : float
        imgui units per pixel of a 1x screen.
    """
    session, view = desk.session, desk.view
    left = desk.keeper.offered
    spacing = imgui.get_style().item_spacing
    imgui.push_style_var(
        imgui.StyleVar_.item_spacing, imgui.ImVec2(spacing.x, 2 * spacing.y)
    )  # easier to hit
    asked: list[Request | None] = [menu_bar(view, recent, session, has_leftovers=bool(left))]
    imgui.pop_style_var()
    if left and view.recovery.shown:
        asked.append(recovery_strip([_work_row(leftover) for leftover in left], view.recovery, view.theme))
    timing = f"frame {seconds * 1e3:.1f} ms"
    if session is not None and desk.stage is not None and session.pane.solved is not None:
        solve = sum(pane.solved.seconds for pane in session.panes if pane.solved is not None)
        timing = f"solve {solve * 1e3:.2f} ms   deform {desk.stage.seconds * 1e3:.2f} ms   {timing}"
    rig = session.rig if session else None
    status_line(
        rig,
        timing,
        desk.message,
        view.theme,
        is_error=desk.is_error,
        warnings=rig.warnings if rig else (),
        unkept=desk.keeper.complaint,
    )
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
    poses = desk.library.poses if desk.library is not None else ()
    asked.append(palette(view, session, recent, poses, scale))
    if view.keyboard:
        view.keyboard = keyboard_map(view.habit, view.theme, scale)
    if view.about:
        view.about = about_window(desk.graphics, scale)
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
    session, theme = desk.session, desk.view.theme
    request = wish = None
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
    layout.without_background(layout.PINS)
    layout.beside(layout.PINS, layout.SOLVER)
    of_pins: Request | None = None
    if imgui.begin(layout.PINS)[0] and session is not None and desk.stage is not None:
        pins, positions = session.pose.pins, desk.stage.positions(session.active)
        called = titles(desk.stage.places, pins) if pins else {}
        of_pins = pins_panel(session.rig, pins, called, positions, desk.tool.selected, desk.view.pins, theme)
        if desk.view.pins.hovered is not None:
            desk.tool.hovered = desk.view.pins.hovered
        layout.fit_height(layout.WEIGHTS, scale, list_height(len(pins)))
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
            theme,
            lambda: session.mirror,
            in_gesture=session.in_gesture,
            reference=session.work.reference if desk.view.reference_shown else None,
        )
    imgui.end()
    is_first = not layout.is_known(layout.LIBRARY)
    blend, more = _library(desk, scale)
    if is_first:  # else the tab that is made last lies on top
        imgui.set_window_focus(layout.WEIGHTS)
    for at, pane in enumerate(desk.view.panes):
        pane.shape = desk.view.weights.explained if session is not None and at == session.active else None
    if isinstance(wish, Edit):
        desk.apply(_linked(desk, session, wish))
        wish = None
    elif blend is not None:
        desk.apply(blend)
    chart: Request | None = None
    film: Request | None = None
    count = 1 if desk.stage is None else len(desk.stage.panes)
    if desk.view.chart and session is not None:
        desk.view.beside.left(CHART, CHART_SIZE[0] * scale, count, layout.WEIGHTS)
        desk.view.chart, chart = chart_window(
            session.rig, session.panes, session.work.reference, scale, theme
        )
    if desk.view.filmstrip and session is not None and desk.portraits is not None:
        stills = desk.filmstrip.stills(session)
        desk.view.beside.below(FILMSTRIP, strip_height(scale))
        desk.view.filmstrip, film = filmstrip_window(stills, desk.portraits.tile, scale)
    return [asked for asked in (request, of_pins, wish, chart, film, *more) if asked is not None]


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


def cards(desk: Desk, viewport: Viewport, pixel_ratio: float, scale: float) -> list[Request]:
    """Draw what floats at the top of the picture, face or no face: history, a missing rig."""
    place = (viewport.x / pixel_ratio, viewport.y / pixel_ratio)
    width = viewport.width / pixel_ratio
    session, view = desk.session, desk.view
    asked: list[Request | None] = []
    if view.history and session is not None:
        steps, step = session.steps, session.step
        view.beside.in_front_of(layout.WEIGHTS, HISTORY)
        view.history, wanted = history_window(session.rig, steps, step, scale, view.theme)
        asked.append(wanted)
    if view.tidy is not None:
        asked.append(_tidy(desk, view.tidy, place, scale))
    if desk.opener.lost is not None:
        asked.append(lost_card(desk.opener.lost.line, *place, width, view.theme))
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


def _work_row(leftover: Leftover) -> WorkRow:
    scene = leftover.scene
    name = scene.rig.name if scene.of is None else f"{scene.of.name} ({scene.rig.name})"
    pins, panes = len(scene.pins), len(scene.panes)
    shapes = active(np.array([*scene.panes[scene.active].weights.values()]))
    about = [f"{leftover.time:%d %b %H:%M}"]
    about += [f"{shapes} active"] * (shapes > 0) + [f"{pins} pin{'' if pins == 1 else 's'}"] * (pins > 0)
    about += [f"{panes} panes"] * (panes > 1)
    return WorkRow(leftover.draft.path, name, "  ".join(about))


def over_picture(
    desk: Desk, viewport: Viewport, viewports: Sequence[Viewport], pixel_ratio: float, scale: float
) -> list[Request]:
    """Draw what stands over the picture: a title for each of several panes, a hint over an untouched face."""
    session, stage = desk.session, desk.stage
    if session is None or stage is None:
        return []
    asked: list[Request] = []
    if len(viewports) > 1:
        _seams(viewport, viewports, pixel_ratio)
        colours = pane_colours(PICTURE, [pane.choice.kind.key for pane in session.panes])
        for at, (pane, place) in enumerate(zip(session.panes, viewports, strict=False)):
            asked += pane_title(
                at,
                pane,
                stage.appraise(at),
                desk.view.panes[at],
                place,
                pixel_ratio,
                scale,
                habit=desk.view.habit,
                colour=colours[at],
                active=at == session.active,
                has_reference=session.work.reference is not None,
                reference_shown=desk.view.reference_shown,
            )
    looks = desk.view.panes
    if stage.shows_reference:
        shapes = active(stage.panes[-1].pose.weights)
        place, look = viewports[-1], desk.view.reference
        asked += reference_title(shapes, look, place, pixel_ratio, scale, desk.view.habit)
        looks = [*looks, look]
    hot = [at for look, at in zip(looks, viewports, strict=False) if look.shading == "heat"]
    if hot:  # one scale for all
        place = layout.unused(viewport, viewports) or hot[-1]
        heat_legend(session.rig.height, place, pixel_ratio, scale)
    _vertex_under_mouse(desk, stage, viewports, pixel_ratio, scale)
    if (chip := _hand(desk, session, stage, viewport, viewports, pixel_ratio, scale)) is not None:
        asked.append(chip)
    if not any(pin.hidden for pin in session.pose.pins) and not desk.view.pins.sketching:
        _first_steps(desk, session, viewport, pixel_ratio, scale)
    return asked


def _seams(viewport: Viewport, viewports: Sequence[Viewport], pixel_ratio: float) -> None:
    """Fill what is between panes, or left over by them, as dark as what is beside them in any theme."""

    def corner(x: float, y: float) -> imgui.ImVec2:
        return imgui.ImVec2(x / pixel_ratio, y / pixel_ratio)

    draw, ink = imgui.get_background_draw_list(), packed(PICTURE.bar)
    for at in viewports:
        right, bottom = at.x + at.width, at.y + at.height
        in_row = [other.x for other in viewports if other.y == at.y and other.x >= right]
        below = [other.y for other in viewports if other.y >= bottom]
        end_x = min(in_row, default=viewport.x + viewport.width)
        end_y = min(below, default=viewport.y + viewport.height)
        draw.add_rect_filled(corner(right, at.y), corner(end_x, end_y), ink)
        draw.add_rect_filled(corner(at.x, bottom), corner(right, end_y), ink)


def _first_steps(desk: Desk, session: Session, viewport: Viewport, pixel_ratio: float, scale: float) -> None:
    """Lead a newcomer on, until the first steps are done."""
    view = desk.view
    if view.guide.over:
        return
    hand = Hand(
        pins=bool(session.pose.pins),
        posed=bool(session.pose.weights.any()),
        pin_menu=view.pin_menu is not None,
        undone=session.redo_label is not None,
        searched=view.palette is not None or view.keyboard,
        work=session.committed,
    )
    now = perf_counter()
    view.guide.watch(hand, now)
    draw_guide(view.guide, now, view.habit, viewport, pixel_ratio, scale)


def _hand(
    desk: Desk,
    session: Session,
    stage: Stage,
    viewport: Viewport,
    viewports: Sequence[Viewport],
    pixel_ratio: float,
    scale: float,
) -> Command | None:
    """Draw what concerns the hand over the picture: pins, and the handle of the eyes."""
    if desk.view.gaze.shown and (gaze := find_gaze(session.rig)) is not None:
        held = isinstance(desk.tool.gesture, GazeHold)
        for at, (camera, place) in enumerate(zip(desk.cameras, viewports, strict=False)):
            state = ("held" if held else "hovered" if desk.view.gaze.hovered else "") * (at == session.active)
            draw_gaze(gaze, session.panes[at].pose.weights, camera, place, pixel_ratio, scale, state=state)
    draw_gesture(desk.tool.gesture, pixel_ratio, scale)
    pins = session.pose.pins
    hovered = next((pin for pin in pins if pin.vertex == desk.tool.hovered and not pin.hidden), None)
    if hovered is not None and not desk.tool.holding:
        name = titles(stage.places, pins)[hovered.vertex]
        for at, (camera, place) in enumerate(zip(desk.cameras, viewports, strict=False)):
            pin_label(hovered, name, stage.positions(at), camera, place, pixel_ratio, scale)
    if desk.tool.aim is not None and not desk.tool.holding:
        for at, (camera, place) in enumerate(zip(desk.cameras, viewports, strict=False)):
            where = stage.positions(at), camera, place
            aim_ring(desk.tool.aim, stage.places, *where, pixel_ratio, scale)
    if desk.tool.line is not None:
        axis, pressed = desk.tool.line
        place = next((each for each in viewports if each.contains(*pressed)), viewport)
        axis_line(axis, pressed, place, pixel_ratio, scale)
    gesture = desk.tool.gesture
    if isinstance(gesture, Hold) and gesture.moved and gesture.radius > 0:
        soft_ring(gesture, stage.positions(session.active), pixel_ratio, scale)
    if desk.view.pins.sketching:
        sketch_hint(desk.view.pins.stroke, desk.view.habit, viewport, pixel_ratio, scale)
    asked = symmetry_button(desk.view.symmetric, desk.view.habit, viewport, pixel_ratio, scale)
    hidden = sum(pin.hidden for pin in pins)
    if hidden:
        asked = hidden_pins(hidden, desk.view.habit, viewport, pixel_ratio, scale) or asked
    return asked


def _vertex_under_mouse(
    desk: Desk, stage: Stage, viewports: Sequence[Viewport], pixel_ratio: float, scale: float
) -> None:
    """While Ctrl is held: tell which shapes can move what is under the mouse, and mark their sliders.

    The first of them, which moves it most, tints the face.
    """
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
            desk.view.panes[at].shape = found[0][0] if found else None
            vertex_card(stage.session.rig, stage.session.control, stage.places.title(vertex), found, scale)


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
    vertices = together(pin, desk.tool.selected)
    title = titles(desk.stage.places, pose.pins)[pin.vertex] if desk.stage is not None else pin.name
    chosen = [other for other in pose.pins if other.vertex in vertices]
    request = pin_menu(pin, chosen, title, desk.view.habit)
    imgui.end_popup()
    return request
