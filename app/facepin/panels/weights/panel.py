"""The weights panel as a whole: its head, the list, and what the hand does in it."""

from collections.abc import Sequence
from math import ceil

from imgui_bundle import imgui

from facepin.core.arrays import Floats
from facepin.core.control import ShapeControl
from facepin.core.rig import Rig
from facepin.panels.theme import Theme, pane_colours
from facepin.panels.weights.columns import INSET, Columns
from facepin.panels.weights.gesture import Wish
from facepin.panels.weights.hand import hand
from facepin.panels.weights.head import head
from facepin.panels.weights.listing import Group, Line
from facepin.panels.weights.menu import Twins, group_menu, row_menu
from facepin.panels.weights.painter import Painter, inks
from facepin.panels.weights.typing_field import typing_field
from facepin.panels.weights.view import WeightsView
from facepin.session.work import Pane


def weights_panel(
    rig: Rig,
    control: ShapeControl,
    panes: Sequence[Pane],
    active: int,
    view: WeightsView,
    scale: float,
    theme: Theme,
    twins: Twins,
    *,
    in_gesture: bool,
    reference: Floats | None = None,
) -> Wish:
    """Draw one slider per shape; return what the user changes in this frame, or None.

    Parameters
    ----------
    rig : Rig
        Its shapes are listed.
    control : ShapeControl
        What is locked, muted and solo, and the limits.
    panes : sequence of Pane
        One bar each; with several, a shape's bars stand one under the other in the panes' colours.
    active : int
        The pane whose numbers are shown and edited.
    view : WeightsView
        Search and arrangement, and what is in the user's hand; changed in place.
    scale : float
        imgui units per pixel of a 1x screen.
    theme : Theme
        Its colours.
    twins : callable
        Tells left from right.
    in_gesture : bool
        Whether a drag or a slider is being moved.
    reference : (k,)
        Weights to compare with: one more bar for each shape, which nobody moves.
    """
    weights = panes[active].pose.weights
    listing = view.listing(rig)
    if view.gesture is not None and view.gesture.hand != "typing" and not in_gesture:
        view.gesture = None  # undone meanwhile, or made a step since another gesture began
    wish: Wish = head(rig, control, weights, view, scale)
    lines = listing.lines(view.arrangement, view.search, view.folded, weights, in_gesture=in_gesture)
    if not lines:
        imgui.text_disabled("No shape has that name." if view.search else "This rig has no shapes.")
    imgui.set_cursor_pos_x(imgui.get_cursor_pos().x - INSET * scale)  # names stand in line with the head
    if imgui.begin_child("rows"):
        wish = _list(rig, control, panes, active, view, scale, theme, lines, reference) or wish
    imgui.end_child()
    return _menu(rig, control, weights, view, twins) or wish


def _list(
    rig: Rig,
    control: ShapeControl,
    panes: Sequence[Pane],
    active: int,
    view: WeightsView,
    scale: float,
    theme: Theme,
    lines: Sequence[Line],
    reference: Floats | None,
) -> Wish:
    """Draw the lines that are in sight, and let the hand act on them."""
    at = imgui.get_cursor_screen_pos()
    room = imgui.get_content_region_avail()
    view.elider.follow_font()
    widest = view.elider.widest(rig.shape_names)
    columns = Columns.fitted(at.x, at.x + room.x - 2 * scale, at.y, widest, scale)
    view.columns = columns
    poses = [pane.pose.weights for pane in panes]
    keys = [pane.choice.kind.key for pane in panes]
    colours = pane_colours(theme, keys)
    if reference is not None:
        poses, colours = [*poses, reference], [*colours, theme.text_dim]
    if len(poses) == 1:
        colours = [theme.accent]
    painter = Painter(
        imgui.get_window_draw_list(),
        inks(theme, colours),
        columns,
        view.elider,
        rig,
        control,
        control.limits_at(poses[active]),
        poses,
        active,
        view.marked,
    )
    # One item for the whole list: a row costs only what is drawn of it.
    imgui.set_next_item_allow_overlap()
    imgui.invisible_button("list", imgui.ImVec2(max(room.x, 1.0), max(len(lines) * columns.row, 1.0)))
    place, wish = hand(painter, lines, poses[active], view)
    first = max(columns.line(imgui.get_window_pos().y), 0)
    count = ceil(imgui.get_window_height() / columns.row) + 1
    has_keyboard = imgui.is_window_focused()
    tallies = view.listing(rig).active(view.arrangement, poses[active])
    for number in range(first, min(first + count, len(lines))):
        line, top = lines[number], columns.y(number)
        zone = place.zone if place.number == number else None
        if isinstance(line, Group):
            folded = line.name in view.folded and not view.search
            painter.header(top, line, tallies[line.name], zone, folded=folded)
        else:
            gesture = view.gesture
            span = gesture.span if gesture is not None and gesture.shape == line else painter.span(line)
            painter.row(top, line, span, zone, focused=has_keyboard and line == view.focus)
    return typing_field(painter, lines, view) or wish


def _menu(rig: Rig, control: ShapeControl, weights: Floats, view: WeightsView, twins: Twins) -> Wish:
    """Draw the menu of the line that was clicked with the right button, while it is open."""
    if view.menu_opens:
        imgui.open_popup("line menu")
        view.menu_opens = False
    if view.menu is None or not imgui.begin_popup("line menu"):
        view.menu = None
        return None
    if isinstance(view.menu, Group):
        wish: Wish = group_menu(control, weights, view.menu)
    else:
        wish = row_menu(rig, control, weights, view.menu, twins, view)
    imgui.end_popup()
    return wish
