"""The handle of the eyes over the picture."""

from imgui_bundle import imgui

from facepin.core.arrays import Floats
from facepin.core.look.camera import Camera, Viewport
from facepin.core.shapes.gaze import Gaze
from facepin.panels.picture.hand import clip
from facepin.panels.theme import PICTURE, packed
from facepin.session.hand.gaze import handle_pixel

HALF_WIDTH, HALF_HEIGHT, IRIS = 13.0, 7.0, 4.0
"""Of the eye that is drawn, in pixels of a 1x screen."""


def draw_gaze(
    gaze: Gaze,
    weights: Floats,
    camera: Camera,
    viewport: Viewport,
    pixel_ratio: float,
    scale: float,
    *,
    state: str = "",
) -> None:
    """Draw the handle as an eye, and lines to the eyes of the face while it is hovered or in the hand.

    Parameters
    ----------
    gaze, weights, camera, viewport
        The eyes, a pose (k,), and how it is seen.
    pixel_ratio, scale : float
        Framebuffer pixels per imgui unit, imgui units per pixel of a 1x screen.
    state : str
        "hovered", "held", or empty.
    """
    at = handle_pixel(gaze, weights, camera, viewport)
    if at is None:
        return
    draw = imgui.get_background_draw_list()
    x, y = at[0] / pixel_ratio, at[1] / pixel_ratio
    clip(draw, viewport, pixel_ratio)
    if state:
        for eye_x, eye_y, _ in (camera.project(gaze.eyes, viewport) / pixel_ratio).tolist():
            ends = imgui.ImVec2(eye_x, eye_y), imgui.ImVec2(x, y)
            draw.add_line(*ends, packed((0, 0, 0, 0.35)), 3 * scale)
            draw.add_line(*ends, packed(PICTURE.text, 0.6), scale)
    size = scale * (1.15 if state else 1.0)
    left, right = imgui.ImVec2(x - HALF_WIDTH * size, y), imgui.ImVec2(x + HALF_WIDTH * size, y)
    # A quadratic curve rises half as high as its middle point.
    upper, lower = imgui.ImVec2(x, y - 2 * HALF_HEIGHT * size), imgui.ImVec2(x, y + 2 * HALF_HEIGHT * size)
    colour = packed(PICTURE.accent) if state == "held" else packed(PICTURE.text, 1.0 if state else 0.85)
    _almond(draw, left, right, upper, lower)
    draw.path_fill_convex(packed((0, 0, 0, 0.45)))
    for line, width in ((packed((0, 0, 0, 0.6)), 4.0), (colour, 1.8)):
        _almond(draw, left, right, upper, lower)
        draw.path_stroke(line, width * scale, imgui.ImDrawFlags_.closed)
    draw.add_circle_filled(imgui.ImVec2(x, y), IRIS * size, colour)
    draw.pop_clip_rect()


def _almond(
    draw: imgui.ImDrawList, left: imgui.ImVec2, right: imgui.ImVec2, upper: imgui.ImVec2, lower: imgui.ImVec2
) -> None:
    draw.path_line_to(left)
    draw.path_bezier_quadratic_curve_to(upper, right)
    draw.path_bezier_quadratic_curve_to(lower, left)
