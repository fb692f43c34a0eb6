"""Which file of a folder is the neutral, where no name says so."""

from collections.abc import Sequence

from imgui_bundle import imgui

from facepin.panels.recovery import begin_card
from facepin.panels.requests import CancelLoading, UseNeutral
from facepin.panels.tiles import shortened

MOST_ROWS = 8
"""Files that are seen at once; more scroll."""


def neutral_card(
    folder: str, names: Sequence[str], likely: str, left: float, top: float, width: float
) -> UseNeutral | CancelLoading | None:
    """Draw the files of a folder to choose the neutral from; return what the user chooses, or None.

    Parameters
    ----------
    folder : str
        Its name.
    names : sequence of str
        The files.
    likely : str
        The one of them that is marked, for a button to take.
    left, top, width : float
        Where the picture is, in imgui units.
    """
    begin_card("##neutral", left, top, width, 30 * imgui.get_font_size())
    imgui.text_wrapped(f"Which file of {folder} is the face at rest?")
    imgui.text_disabled("All the others are shapes of it.")
    asked: UseNeutral | CancelLoading | None = None
    step = imgui.get_text_line_height_with_spacing()
    imgui.begin_child("files", imgui.ImVec2(0, min(len(names), MOST_ROWS) * step))
    clipper = imgui.ListClipper()
    clipper.begin(len(names), step)
    while clipper.step():
        for row in range(clipper.display_start, clipper.display_end):
            if _row(row, names[row], names[row] == likely):
                asked = UseNeutral(names[row])
    imgui.end_child()
    if imgui.button("Use the marked one"):
        asked = UseNeutral(likely)
    imgui.same_line()
    if imgui.button("Cancel"):
        asked = CancelLoading()
    imgui.end()
    return asked


def _row(row: int, name: str, chosen: bool) -> bool:
    """Draw one file, its name as it is, number signs and all; return whether it was clicked."""
    imgui.push_id(row)
    place = imgui.get_cursor_pos()
    clicked: bool = imgui.selectable("##file", chosen)[0]
    imgui.set_cursor_pos(place)
    imgui.text(shortened(name, imgui.get_content_region_avail().x))
    imgui.pop_id()
    return clicked
