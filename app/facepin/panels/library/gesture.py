"""The hand in the library: a pose is blended into the face, or dragged to another place in the list."""

from collections.abc import Sequence

from imgui_bundle import imgui

from facepin.core.arrays import Floats
from facepin.core.saved_pose import SavedPose
from facepin.panels.library.requests import LibraryRequest, MovePose, StopBlending
from facepin.panels.library.view import GAP, LibraryView
from facepin.session.edit import Edit
from facepin.session.shelf import blended

DEAD_ZONE = 4.0
"""How far the mouse moves before a click becomes a drag, at 1x scale."""
EDGE = 24.0
"""How near to an end of the list a dragged picture scrolls it, at 1x scale."""
BLEND_WAY = 200.0
"""How far the mouse goes from nothing to the whole pose, at 1x scale."""


def gesture(
    start: Floats, poses: Sequence[SavedPose], view: LibraryView, scale: float
) -> tuple[Edit | None, list[LibraryRequest]]:
    """Go on with what a press on a picture became: a blend, or a pose on its way to another place.

    Parameters
    ----------
    start : (k,) float64
        Weights that a pose is blended into.
    poses : sequence of SavedPose
        Those that are shown.
    view : LibraryView
        Changed in place.
    scale : float
        Pixels per pixel of a 1x screen.
    """
    if view.pressed is None:
        return None, []
    io = imgui.get_io()
    key, x, y = view.pressed
    pose = next((pose for pose in poses if pose.key == key), None)
    dx, dy = io.mouse_pos.x - x, io.mouse_pos.y - y
    if not view.gesture and max(abs(dx), abs(dy)) > DEAD_ZONE * scale:
        view.gesture = "blend" if io.key_alt else "move"
    if pose is None or imgui.is_key_pressed(imgui.Key.escape):
        given_up = view.gesture == "blend"
        view.pressed, view.gesture = None, ""
        return None, [StopBlending()] if given_up else []
    doing, released = view.gesture, not imgui.is_mouse_down(0)
    if released:
        view.gesture, view.pressed = "", None
    if doing == "blend":
        view.amount = round(min(max(dx / (BLEND_WAY * scale), 0.0), 1.0), 2)
        if released and view.amount == 0:
            return None, [StopBlending()]
        weights = blended(start, pose.weights, view.amount)
        label = f"Blend {view.amount:.0%} of {pose.title}"
        return Edit(label, released, weights=weights), []
    if doing == "move":
        _scroll_along(scale)
        keys = [pose.key for pose in poses]
        place = _drop_place(keys, view, scale)
        if released and place is not None:
            return None, [MovePose(key, [*keys, None][place])]
    return None, []


def _scroll_along(scale: float) -> None:
    """Scroll while the mouse is at the upper or lower end of the list."""
    mouse, top, height = imgui.get_io().mouse_pos.y, imgui.get_window_pos().y, imgui.get_window_height()
    edge = min(EDGE * scale, height / 4)
    past = min(mouse - top - edge, 0.0) + max(mouse - top - height + edge, 0.0)
    if past:
        imgui.set_scroll_y(imgui.get_scroll_y() + 0.5 * max(-edge, min(past, edge)))


def _drop_place(keys: Sequence[str], view: LibraryView, scale: float) -> int | None:
    """Mark where a dragged picture would come to stand; return the place of the pose that will follow it."""
    mouse = imgui.get_io().mouse_pos
    for key, left, top, right, bottom in view.cells:
        if top <= mouse.y < bottom and left - GAP * scale <= mouse.x < right + GAP * scale:
            after = mouse.x > (left + right) / 2
            x = right + 0.5 * GAP * scale if after else left - 0.5 * GAP * scale
            imgui.get_foreground_draw_list().add_line(
                imgui.ImVec2(x, top),
                imgui.ImVec2(x, bottom),
                imgui.get_color_u32(imgui.Col_.check_mark),
                2.5 * scale,
            )
            return keys.index(key) + after
    return None
