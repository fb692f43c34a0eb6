"""What is drawn over the faces: titles of panes, pins and the hand, the first steps."""

from collections.abc import Sequence
from time import perf_counter

from imgui_bundle import imgui

from facepin.core.look.camera import Viewport
from facepin.core.shapes.gaze import find_gaze
from facepin.core.shapes.measures import active
from facepin.core.shapes.motion import movers
from facepin.core.shapes.places import titles
from facepin.desk.desk import Desk
from facepin.desk.stage import Stage
from facepin.panels import layout
from facepin.panels.commands import Command
from facepin.panels.help.guide import Hand, draw_guide
from facepin.panels.picture.gaze import draw_gaze
from facepin.panels.picture.hand import (
    aim_ring,
    axis_line,
    draw_gesture,
    goal_label,
    hidden_pins,
    pin_label,
    sketch_hint,
    soft_ring,
    symmetry_button,
)
from facepin.panels.picture.legend import heat_legend
from facepin.panels.picture.pane_title import pane_title, reference_title
from facepin.panels.picture.vertex_card import vertex_card
from facepin.panels.requests import Request
from facepin.panels.theme import PICTURE, packed, pane_colours
from facepin.session.hand.gaze import GazeHold
from facepin.session.hand.hold import Hold
from facepin.session.session import Session
from facepin.session.solving.reasons import reason


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
            why = reason(session.rig, session.control, session.panes[at], hovered)
            pin_label(hovered, name, stage.positions(at), camera, place, pixel_ratio, scale, why)
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
    if isinstance(gesture, Hold) and gesture.moved:
        pin = next((pin for pin in pins if pin.vertex == gesture.pin.vertex), None)
        for at, (camera, place) in enumerate(zip(desk.cameras, viewports, strict=False)):
            if pin is not None and at < len(session.panes):
                why = reason(session.rig, session.control, session.panes[at], pin)
                goal_label(pin, why, camera, place, pixel_ratio, scale)
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
