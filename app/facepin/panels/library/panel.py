"""The library panel: saved poses as pictures, to apply, blend, add, name, order and compare."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from imgui_bundle import imgui

from facepin.core.arrays import Floats
from facepin.core.names import readable
from facepin.core.rig import Rig
from facepin.core.saved_pose import SavedPose, clean_tags
from facepin.core.shapes.measures import active as active_shapes
from facepin.panels.library.gesture import gesture
from facepin.panels.library.requests import (
    ApplyPose,
    ComparePoses,
    LabelPose,
    LibraryRequest,
    RemovePoses,
    ReplacePose,
    SavePose,
)
from facepin.panels.library.selection import selection_height, selection_strip
from facepin.panels.library.view import GAP, LibraryView
from facepin.panels.picture.overlays import close_on_escape
from facepin.panels.theme import Colour, Theme, packed
from facepin.panels.tiles import Tile, draw_tile, shortened
from facepin.session.edit import Edit
from facepin.session.shelf import found

LEAST_CELL = 92.0
"""Least width of a picture, at 1x scale: as many stand in a row as have it."""

HOW_TO = (
    "Click: put it on the face\n"
    "Shift+click: add it to the face\n"
    "Alt+drag to the right: blend it in, in part\n"
    "Ctrl+click: select; two can be compared\n"
    "Drag: put it elsewhere in the list\n"
    "Right click: name, tags, replace, remove"
)
IN_SHORT = "Click: apply   Shift: add   Alt+drag: blend"


@dataclass(frozen=True, eq=False)
class Shown:
    """What the panel shows."""

    rig: Rig
    poses: tuple[SavedPose, ...]
    tile: Callable[[SavedPose], Tile | None]
    start: Floats
    """(k,) weights of the active pane at the last undo step: what a pose is blended into."""
    folder: Path | None
    """Where the poses are kept; None for nowhere."""
    remark: str
    """A line about that place."""
    theme: Theme
    complaints: Sequence[str] = ()
    is_reading: bool = False


def library_panel(shown: Shown, view: LibraryView, scale: float) -> tuple[Edit | None, list[LibraryRequest]]:
    """Draw the saved poses; return the blend that is being dragged, and what else the user asks for.

    Parameters
    ----------
    shown : Shown
        The poses and what there is to say of them.
    view : LibraryView
        Changed in place.
    scale : float
        Pixels per pixel of a 1x screen.
    """
    keys = {pose.key for pose in shown.poses}
    view.selected = tuple(key for key in view.selected if key in keys)
    asked: list[LibraryRequest] = []
    _head(shown, view)
    if view.saving or view.labelled in keys:
        asked += _label_line(view)
    poses = found(shown.poses, view.search)
    selected = [pose for key in view.selected for pose in shown.poses if pose.key == key]
    foot = imgui.get_text_line_height_with_spacing()
    if selected:
        foot += selection_height(selected)
    edit = None
    if imgui.begin_child("poses", imgui.ImVec2(0, -foot)):
        if poses:
            asked += _grid(shown, poses, view, scale)
            edit, more = gesture(shown.start, poses, view, scale)
            asked += more
        else:
            _empty(shown, view)
    imgui.end_child()
    if selected:
        asked += selection_strip(shown.rig, selected, view)
    _foot(shown)
    return edit, asked


def _head(shown: Shown, view: LibraryView) -> None:
    """Search, and the way to save."""
    label = "Save pose"
    width = imgui.calc_text_size(label).x + 2 * imgui.get_style().frame_padding.x
    gap = imgui.get_style().item_spacing.x
    imgui.set_next_item_width(max(imgui.get_content_region_avail().x - width - gap, 4 * gap))
    _, view.search = imgui.input_text_with_hint("##search poses", "Search names and tags", view.search)
    imgui.same_line()
    imgui.begin_disabled(shown.folder is None)
    if imgui.button(label):
        view.begin_saving(f"Pose {len(shown.poses) + 1}")
    imgui.end_disabled()
    why = "The face as it is, into the library (Ctrl+B)"
    imgui.set_item_tooltip(why if shown.folder else shown.remark)


def _label_line(view: LibraryView) -> list[LibraryRequest]:
    """Ask for name and tags where the poses are: Enter takes them, Esc gives up."""
    flags = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all
    if view.focus:
        imgui.set_keyboard_focus_here()
        view.focus = False
    imgui.set_next_item_width(-1)
    entered, view.title = imgui.input_text_with_hint("##title", "Name", view.title, flags)
    word = "Save" if view.saving else "Rename"
    width = max(imgui.calc_text_size(text).x for text in (word, "Cancel"))
    width += 2 * imgui.get_style().frame_padding.x
    gap = imgui.get_style().item_spacing.x
    imgui.set_next_item_width(max(imgui.get_content_region_avail().x - 2 * (width + gap), 4 * gap))
    entered_tags, view.tags = imgui.input_text_with_hint("##tags", "Tags: happy, mouth", view.tags, flags)
    imgui.same_line()
    imgui.begin_disabled(not view.title.strip())
    taken = imgui.button(word, imgui.ImVec2(width, 0))
    imgui.end_disabled()
    imgui.same_line()
    given_up = imgui.button("Cancel", imgui.ImVec2(width, 0)) or imgui.is_key_pressed(imgui.Key.escape)
    asked: list[LibraryRequest] = []
    if (taken or entered or entered_tags) and view.title.strip():
        tags = clean_tags(view.tags)
        if view.labelled is None:
            asked.append(SavePose(view.title, tags))
        else:
            asked.append(LabelPose(view.labelled, view.title, tags))
    if asked or given_up:
        view.done()
    return asked


def _empty(shown: Shown, view: LibraryView) -> None:
    """Say what belongs here and how it gets here."""
    imgui.push_text_wrap_pos(0)
    if shown.poses:
        imgui.text_disabled(f"No pose has '{view.search}' in its name or tags.")
    elif shown.is_reading:
        imgui.text_disabled("Reading the poses…")
    elif shown.folder is None:
        imgui.text_disabled(shown.remark)
    else:
        imgui.text("No poses yet")
        imgui.text_disabled("Pose the face, then press Save pose. It appears here as a picture:")
        imgui.spacing()
        imgui.text_disabled(HOW_TO)
        imgui.spacing()
        imgui.text_disabled("Pose files that you copy into the folder below are in the library too.")
    imgui.pop_text_wrap_pos()


def _grid(shown: Shown, poses: Sequence[SavedPose], view: LibraryView, scale: float) -> list[LibraryRequest]:
    """Draw the pictures, as many in a row as fit."""
    asked: list[LibraryRequest] = []
    gap = GAP * scale
    room = imgui.get_content_region_avail().x
    columns = max(int((room + gap) // (LEAST_CELL * scale + gap)), 1)
    side = (room - gap * (columns - 1)) / columns
    tall = side + imgui.get_text_line_height() + 2 * scale
    view.cells.clear()
    clipper = imgui.ListClipper()
    clipper.begin(-(-len(poses) // columns), tall + imgui.get_style().item_spacing.y)
    while clipper.step():
        for row in range(clipper.display_start, clipper.display_end):
            for at in range(row * columns, min((row + 1) * columns, len(poses))):
                if at % columns:
                    imgui.same_line(0, gap)
                asked += _cell(shown, poses[at], at, view, side, tall, scale)
    return asked


def _cell(
    shown: Shown, pose: SavedPose, number: int, view: LibraryView, side: float, tall: float, scale: float
) -> list[LibraryRequest]:
    """Draw one pose: its picture with the name under it."""
    asked: list[LibraryRequest] = []
    theme = shown.theme
    imgui.push_id(number)
    at = imgui.get_cursor_screen_pos()
    imgui.invisible_button("pose", imgui.ImVec2(side, tall))
    corner = imgui.ImVec2(at.x + side, at.y + side)
    view.cells.append((pose.key, at.x, at.y, corner.x, at.y + tall))
    hovered, io = imgui.is_item_hovered(), imgui.get_io()
    if imgui.is_item_activated():
        view.pressed, view.gesture = (pose.key, io.mouse_pos.x, io.mouse_pos.y), ""
    if imgui.is_item_deactivated() and view.pressed and view.pressed[0] == pose.key and not view.gesture:
        view.pressed = None
        if hovered and io.key_ctrl:
            others = tuple(key for key in view.selected if key != pose.key)
            view.selected = others if pose.key in view.selected else (*others, pose.key)
        elif hovered:
            asked.append(ApplyPose(pose.key, add=io.key_shift))
    draw = imgui.get_window_draw_list()
    rounding = 4 * scale
    draw_tile(draw, shown.tile(pose), at, corner, rounding)
    selected = pose.key in view.selected
    if selected or hovered:
        colour = packed(theme.accent) if selected else packed(theme.text, 0.55)
        draw.add_rect(at, corner, colour, rounding, (2 if selected else 1.5) * scale)
    if pose.report:
        dot = imgui.ImVec2(corner.x - 8 * scale, at.y + 8 * scale)
        draw.add_circle_filled(dot, 4 * scale, packed(theme.warning))
    blending = view.gesture == "blend" and view.pressed is not None and view.pressed[0] == pose.key
    if blending:
        _blend_bar(draw, at, corner, view.amount, scale, theme.accent)
    name = shortened(pose.title, side)
    left = at.x + max(side - imgui.calc_text_size(name).x, 0) / 2
    colour = packed(theme.text, 1.0 if hovered or selected else 0.8)
    draw.add_text(imgui.ImVec2(left, corner.y + 2 * scale), colour, name)
    if not view.gesture and imgui.begin_item_tooltip():
        _tooltip(pose, theme)
        imgui.end_tooltip()
    if imgui.begin_popup_context_item("more"):
        asked += _menu(pose, view)
        imgui.end_popup()
    imgui.pop_id()
    return asked


def _blend_bar(
    draw: imgui.ImDrawList,
    at: imgui.ImVec2,
    corner: imgui.ImVec2,
    amount: float,
    scale: float,
    accent: Colour,
) -> None:
    """Show over a picture how much of it is on the face."""
    text = f"{amount:.0%}"
    top = corner.y - imgui.get_text_line_height() - 8 * scale
    draw.add_rect_filled(imgui.ImVec2(at.x, top), corner, packed((0, 0, 0, 0.62)))
    right = at.x + amount * (corner.x - at.x)
    draw.add_rect_filled(
        imgui.ImVec2(at.x, corner.y - 4 * scale), imgui.ImVec2(right, corner.y), packed(accent)
    )
    left = (at.x + corner.x - imgui.calc_text_size(text).x) / 2
    draw.add_text(imgui.ImVec2(left, top + 2 * scale), packed((1, 1, 1, 1)), text)


def _tooltip(pose: SavedPose, theme: Theme) -> None:
    imgui.text(pose.title)
    if pose.tags:
        imgui.text_colored(imgui.ImVec4(*theme.accent), ", ".join(pose.tags))
    count = active_shapes(pose.weights)
    imgui.text_disabled(f"{count} shape{'' if count == 1 else 's'} active, {pose.key}.json")
    if pose.report:
        imgui.push_text_wrap_pos(24 * imgui.get_font_size())
        imgui.text_colored(imgui.ImVec4(*theme.warning), pose.report)
        imgui.pop_text_wrap_pos()
    imgui.text_disabled(IN_SHORT)


def _menu(pose: SavedPose, view: LibraryView) -> list[LibraryRequest]:
    asked: list[LibraryRequest] = []
    close_on_escape()
    imgui.text_disabled(shortened(pose.title, 16 * imgui.get_font_size()))
    imgui.separator()
    if imgui.menu_item_simple("Apply", "Click"):
        asked.append(ApplyPose(pose.key))
    if imgui.menu_item_simple("Add to the face", "Shift+click"):
        asked.append(ApplyPose(pose.key, add=True))
    others = [key for key in view.selected if key != pose.key]
    if imgui.menu_item_simple("Compare with the selected one", enabled=len(others) == 1):
        asked.append(ComparePoses(others[0], pose.key))
    imgui.separator()
    if imgui.menu_item_simple("Name and tags…"):
        view.begin_labelling(pose)
    if imgui.menu_item_simple("Replace with the face as it is"):
        asked.append(ReplacePose(pose.key))
    imgui.separator()
    if imgui.menu_item_simple("Remove"):
        asked.append(RemovePoses((pose.key,)))
    return asked


def _foot(shown: Shown) -> None:
    """Say how many poses there are, where they are, and what in their folder is none."""
    count = len(shown.poses)
    if shown.folder is not None:
        imgui.text_disabled(f"{count} pose{'' if count == 1 else 's'} in {readable(shown.folder.name)}")
        imgui.set_item_tooltip(f"{shown.remark}\n{readable(str(shown.folder))}")
    if shown.poses:
        imgui.same_line()
        imgui.text_disabled("(?)")
        imgui.set_item_tooltip(HOW_TO)
    if shown.complaints:
        imgui.same_line()
        many = len(shown.complaints)
        imgui.text_colored(
            imgui.ImVec4(*shown.theme.warning), f"{many} file{' is' if many == 1 else 's are'} no pose"
        )
        imgui.set_item_tooltip("\n".join(shown.complaints[:20]))
