"""The list of pins: what each is called, what it holds and how far its vertex is from its goal."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from imgui_bundle import imgui

from facepin.core.arrays import Points
from facepin.core.pose import Freedom, Pin
from facepin.core.rig import Rig
from facepin.core.shapes.measures import percent, pin_errors
from facepin.panels.commands import Command
from facepin.panels.icons import eye_button, icon_width, lock_button
from facepin.panels.plain_label import plain_label
from facepin.panels.requests import NamePin, Request, SelectPins, SetPins
from facepin.panels.theme import Theme, dim_sentence
from facepin.panels.tiles import shortened

FAR = 1.0
"""A pin further from its goal than this, in per cent of the face height, stands out."""
STROKES = (2, 15)
"""Fewest and most pins of a stroke."""
SOFTEST, STIFFEST = 0.01, 100.0
"""Ends of what sliders offer; a file may go further."""
DRAG_SPEED = 0.25
"""Of a stiffness that is dragged: about 2 % per pixel."""
_OTHER: dict[Freedom, Freedom] = {"space": "screen", "screen": "space"}


FREEDOMS: dict[Freedom, str] = {
    "space": "Hold in space (x, y and z)",
    "screen": "Hold on screen (depth free)",
}


@dataclass
class PinsView:
    """How the list is shown; not part of the pose."""

    hovered: int | None = None
    """Vertex of the pin whose row is under the mouse."""
    sketching: bool = False
    """Whether a drag on the skin lays a stroke of pins."""
    stroke: int = 6
    """How many."""
    _anchor: int | None = None
    """Vertex of the row clicked last: Shift selects from there."""
    _renaming: int | None = None
    """Vertex of the pin whose name is being typed."""
    typed: str = ""
    """That name so far."""
    _begins: bool = False


def together(pin: Pin, selected: Collection[int]) -> frozenset[int]:
    """Return the vertices that a change of a pin is for: all that are selected if it is one of them."""
    return frozenset(selected) if pin.vertex in selected else frozenset({pin.vertex})


def pins_panel(
    rig: Rig,
    pins: tuple[Pin, ...],
    titles: Mapping[int, str],
    positions: Points,
    selected: Collection[int],
    view: PinsView,
    theme: Theme,
) -> Request | None:
    """Draw a row per pin; return what the user asks for in this frame, or None.

    Parameters
    ----------
    rig : Rig
        What they are on.
    pins : tuple of Pin
        Those of all panes.
    titles : by vertex
        What they are called.
    positions : (n, 3) float32
        The vertices of the pane whose errors are shown.
    selected : vertices
        Of the pins that are selected.
    view : PinsView
        Changed in place.
    theme : Theme
        Its colours.
    """
    view.hovered = None
    request = _head(pins, selected, view)
    if not pins:
        dim_sentence("No pins yet: click the face to place one, or lay them on the landmarks of this rig.")
        if imgui.button(Command.LOAD_LANDMARKS.title):
            request = Command.LOAD_LANDMARKS
        return request
    flags = imgui.TableFlags_.scroll_y | imgui.TableFlags_.sizing_fixed_fit | imgui.TableFlags_.pad_outer_x
    if not imgui.begin_table("pins", 6, flags):
        return request
    imgui.table_setup_scroll_freeze(0, 1)
    imgui.table_setup_column("pin", imgui.TableColumnFlags_.width_stretch)
    digits = imgui.calc_text_size("00.00").x
    for title, width in (
        ("holds", imgui.calc_text_size("screen").x),
        ("stiff", digits + 2 * imgui.get_style().frame_padding.x),
        ("##lock", icon_width()),
        ("##eye", icon_width()),
        ("off %", digits),
    ):
        imgui.table_setup_column(title, imgui.TableColumnFlags_.width_fixed, width)
    _titles()
    errors = pin_errors(positions, pins)
    clipper = imgui.ListClipper()
    clipper.begin(len(pins), imgui.get_frame_height() + imgui.get_style().cell_padding.y * 2)
    while clipper.step():
        for row in range(clipper.display_start, clipper.display_end):
            imgui.push_id(pins[row].vertex)
            off = percent(errors[row], rig.height)
            request = _row(pins, titles, row, off, selected, view, theme) or request
            imgui.pop_id()
    imgui.end_table()
    return request


def list_height(pins: int) -> float:
    """Return the height of the panel with all of so many pins in sight, in imgui units."""
    style = imgui.get_style()
    row = imgui.get_frame_height() + 2 * style.cell_padding.y
    lines = 2 * imgui.get_frame_height_with_spacing() + imgui.get_text_line_height_with_spacing()
    return imgui.get_cursor_start_pos().y + lines + max(pins, 2) * row + style.window_padding.y


def _head(pins: tuple[Pin, ...], selected: Collection[int], view: PinsView) -> Request | None:
    """Draw how a stroke is laid, and how many pins there are."""
    _, view.sketching = imgui.checkbox("Sketch strokes of", view.sketching)
    imgui.set_item_tooltip(Command.SKETCH_PINS.help)
    imgui.same_line()
    imgui.set_next_item_width(-imgui.calc_text_size("pins").x - imgui.get_style().item_inner_spacing.x)
    _, view.stroke = imgui.slider_int("pins", view.stroke, *STROKES, flags=imgui.SliderFlags_.always_clamp)
    hidden = sum(pin.hidden for pin in pins)
    words = [f"{len(pins)} pin{'' if len(pins) == 1 else 's'}"] if pins else []
    words += [f"{len(selected)} selected"] * bool(selected) + [f"{hidden} hidden"] * bool(hidden)
    if words:
        imgui.text_disabled(", ".join(words))
    if hidden:
        imgui.same_line()
        if imgui.small_button("show all"):
            return Command.SHOW_PINS
    return None


def _titles() -> None:
    imgui.table_next_row()
    for column in range(6):
        imgui.table_set_column_index(column)
        imgui.text_disabled(imgui.table_get_column_name(column).split("##")[0])


def _row(
    pins: tuple[Pin, ...],
    titles: Mapping[int, str],
    row: int,
    error: float,
    selected: Collection[int],
    view: PinsView,
    theme: Theme,
) -> Request | None:
    """Draw one pin; a change is for all that are selected if it is one of them."""
    pin = pins[row]
    imgui.table_next_row()
    imgui.table_next_column()
    request = _name(pins, titles[pin.vertex], row, selected, view)
    vertices = together(pin, selected)
    imgui.table_next_column()
    if _quiet_button(pin.freedom):
        request = SetPins(vertices, freedom=_OTHER[pin.freedom])
    imgui.set_item_tooltip(
        "Holds x, y and z" if pin.freedom == "space" else "Holds what is seen; depth is free"
    )
    imgui.table_next_column()
    imgui.set_next_item_width(-1)
    flags = imgui.SliderFlags_.logarithmic | imgui.SliderFlags_.always_clamp
    changed, stiffness = imgui.drag_float(
        "##stiff", pin.stiffness, DRAG_SPEED, SOFTEST, STIFFEST, "%.3g", flags
    )
    finished = imgui.is_item_deactivated_after_edit()
    if changed or finished:
        request = SetPins(vertices, stiffness=stiffness, final=finished)
    imgui.set_item_tooltip("Stiffness: drag, or Ctrl+click to type")
    imgui.table_next_column()
    if lock_button("##lock", pin.locked):
        request = SetPins(vertices, locked=not pin.locked)
    imgui.set_item_tooltip("Locked" if pin.locked else "Lock: it holds, but can't be dragged or removed")
    imgui.table_next_column()
    if eye_button("##eye", not pin.hidden):
        request = SetPins(vertices, hidden=not pin.hidden)
    imgui.set_item_tooltip("Hidden; it still holds" if pin.hidden else "Hide: it still holds")
    imgui.table_next_column()
    imgui.align_text_to_frame_padding()
    text = f"{error:.2f}" if error < 99.5 else "far"
    if error > FAR:
        imgui.text_colored(imgui.ImVec4(*theme.accent), text)
    else:
        imgui.text(text)
    return request


def _name(
    pins: tuple[Pin, ...], title: str, row: int, selected: Collection[int], view: PinsView
) -> Request | None:
    """Draw the name of a pin, on which a click selects and a double click renames."""
    pin = pins[row]
    if view._renaming == pin.vertex:
        return _typed_name(pin, view)
    flags = imgui.SelectableFlags_.span_all_columns | imgui.SelectableFlags_.allow_overlap
    flags |= imgui.SelectableFlags_.allow_double_click
    imgui.push_style_var(imgui.StyleVar_.selectable_text_align, imgui.ImVec2(0, 0.5))
    colour = imgui.get_style_color_vec4(imgui.Col_.text_disabled if pin.hidden else imgui.Col_.text)
    imgui.push_style_color(imgui.Col_.text, colour)
    shown = _fitting(title, imgui.get_content_region_avail().x)
    size = imgui.ImVec2(0, imgui.get_frame_height())
    clicked, _ = imgui.selectable(plain_label(shown, row), pin.vertex in selected, flags, size)
    imgui.pop_style_color()
    imgui.pop_style_var()
    imgui.set_item_tooltip(f"{title} (vertex {pin.vertex})\nDouble click: another name")
    if imgui.is_item_hovered():
        view.hovered = pin.vertex
    if not clicked:
        return None
    if imgui.is_mouse_double_clicked(0):
        view._renaming, view.typed, view._begins = pin.vertex, pin.name, True
        return None
    keys, vertices = imgui.get_io(), [other.vertex for other in pins]
    now = picked(vertices, row, selected, view._anchor, shift=keys.key_shift, ctrl=keys.key_ctrl)
    if not keys.key_shift:
        view._anchor = pin.vertex
    return SelectPins(now)


def _fitting(title: str, width: float) -> str:
    """Return what there is room for of a title: of "mouth corner, left" the side is kept."""
    head, comma, side = title.rpartition(", ")
    if not head or imgui.calc_text_size(title).x <= width:
        return shortened(title, width)
    return shortened(head, width - imgui.calc_text_size(comma + side).x) + comma + side


def picked(
    vertices: Sequence[int],
    row: int,
    selected: Collection[int],
    anchor: int | None,
    *,
    shift: bool,
    ctrl: bool,
) -> frozenset[int]:
    """Return what is selected after a click on a row of a list.

    Parameters
    ----------
    vertices : sequence of int
        One per row.
    row : int
        The one that was clicked.
    selected : vertices
        Selected so far.
    anchor : int
        Vertex of the row that was clicked before.
    shift, ctrl : bool
        Shift selects all from the anchor to the row; Ctrl adds the row to the others, or takes it out.
    """
    if shift and anchor in vertices:
        first, last = sorted((vertices.index(anchor), row))
        return frozenset(vertices[first : last + 1])
    one = frozenset({vertices[row]})
    return frozenset(selected) ^ one if ctrl else one


def _typed_name(pin: Pin, view: PinsView) -> NamePin | None:
    """Let a name be typed; Enter or a click elsewhere takes it, Esc does not."""
    imgui.set_next_item_width(-1)
    if view._begins:
        imgui.set_keyboard_focus_here()
    flags = imgui.InputTextFlags_.auto_select_all | imgui.InputTextFlags_.enter_returns_true
    entered, view.typed = imgui.input_text("##rename", view.typed, flags)
    if not entered and (view._begins or imgui.is_item_active()):
        view._begins = view._begins and not imgui.is_item_active()
        return None
    view._renaming = None
    return None if imgui.is_key_pressed(imgui.Key.escape) else NamePin(pin.vertex, view.typed)


def _quiet_button(text: str) -> bool:
    """Draw a word that can be clicked, without a frame."""
    imgui.align_text_to_frame_padding()
    corner = imgui.get_cursor_screen_pos()
    size = imgui.ImVec2(imgui.get_content_region_avail().x, imgui.get_frame_height())
    clicked = bool(imgui.invisible_button(f"##{text}", size))
    index = imgui.Col_.text if imgui.is_item_hovered() else imgui.Col_.text_disabled
    place = imgui.ImVec2(corner.x, corner.y + imgui.get_style().frame_padding.y)
    imgui.get_window_draw_list().add_text(place, imgui.get_color_u32(index), text)
    return clicked
