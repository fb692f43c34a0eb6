"""What can be done with selected poses of the library; of two, how they differ."""

from collections.abc import Sequence

from imgui_bundle import imgui

from facepin.core.rig import Rig
from facepin.core.saved_pose import SavedPose
from facepin.panels.library.requests import ComparePoses, LibraryRequest, RemovePoses
from facepin.panels.library.view import LibraryView
from facepin.panels.tiles import shortened
from facepin.session.shelf import differences

MOST_LISTED = 12
"""Differences that are listed."""


def selection_height(selected: Sequence[SavedPose]) -> float:
    """Return the room that `_selection` takes."""
    lines = imgui.get_frame_height_with_spacing() + imgui.get_style().item_spacing.y
    if len(selected) == 2:
        count = len(differences(selected[0].weights, selected[1].weights))
        lines += (
            min(count, MOST_LISTED) + 1 + (count > MOST_LISTED)
        ) * imgui.get_text_line_height_with_spacing()
    return min(lines, 0.5 * imgui.get_content_region_avail().y)


def selection_strip(rig: Rig, selected: Sequence[SavedPose], view: LibraryView) -> list[LibraryRequest]:
    """Draw what can be done with the selected poses; of two, how they differ."""
    asked: list[LibraryRequest] = []
    if imgui.begin_child("selection", imgui.ImVec2(0, -imgui.get_text_line_height_with_spacing())):
        imgui.separator()
        imgui.align_text_to_frame_padding()
        imgui.text_disabled(f"{len(selected)} selected")
        imgui.same_line()
        imgui.begin_disabled(len(selected) != 2)
        if imgui.button("Compare"):
            asked.append(ComparePoses(selected[0].key, selected[1].key))
        imgui.end_disabled()
        imgui.set_item_tooltip("The second on the face, the first as the reference with its ghost")
        imgui.same_line()
        if imgui.button("Remove"):
            asked.append(RemovePoses(view.selected))
        imgui.same_line()
        if imgui.button("None"):
            view.selected = ()
        imgui.set_item_tooltip("Select nothing")
        if len(selected) == 2:
            _differences(rig, selected[0], selected[1])
    imgui.end_child()
    return asked


def _differences(rig: Rig, first: SavedPose, second: SavedPose) -> None:
    """List the weights in which two poses differ, biggest difference first."""
    shapes = differences(first.weights, second.weights)
    if not shapes:
        imgui.text_disabled("Both are the same pose.")
        return
    number = imgui.calc_text_size("-0.00").x + 2 * imgui.get_style().item_spacing.x
    right = imgui.get_content_region_avail().x
    columns = (right - 3 * number, right - 2 * number, right - number)

    def line(name: str, values: Sequence[str], *, dim: bool) -> None:
        colour = imgui.get_style_color_vec4(imgui.Col_.text_disabled if dim else imgui.Col_.text)
        imgui.text_colored(colour, shortened(name, columns[0] - imgui.get_style().item_spacing.x))
        for x, value in zip(columns, values, strict=True):
            imgui.same_line(x + number - imgui.calc_text_size(value).x)
            imgui.text_colored(colour, value)

    line(f"{first.title}, {second.title}", ("1st", "2nd", "by"), dim=True)
    for j in shapes[:MOST_LISTED]:
        one, two = float(first.weights[j]), float(second.weights[j])
        line(rig.shape_names[j], (f"{one:.2f}", f"{two:.2f}", f"{two - one:+.2f}"), dim=False)
    if len(shapes) > MOST_LISTED:
        imgui.text_disabled(f"and {len(shapes) - MOST_LISTED} more")
