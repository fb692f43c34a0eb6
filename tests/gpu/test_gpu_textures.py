"""Faces coloured by pictures."""

from dataclasses import replace

import moderngl
import numpy as np

from facepin.core.look.shading import Shading
from facepin.core.rig import Rig, Texture
from facepin.gpu.shaders import Shaders
from support.gpu_help import SIZE, ball, camera, draw, drawn

HALVES = np.zeros((2, 64, 4), np.uint8)
HALVES[0, :, :], HALVES[1, :, :] = (230, 40, 40, 255), (40, 60, 230, 255)
"""Red above blue."""


def painted(pixels: np.ndarray, cutout: float | None = None) -> Rig:
    """The ball, its front seen through a picture that fills it from left to right and top to bottom."""
    rig = ball(24)
    places = np.stack([0.5 + 0.5 * rig.neutral[:, 0], 0.5 - 0.5 * rig.neutral[:, 1]], axis=1)
    (part,) = rig.parts
    part = replace(part, texture=Texture(pixels, (False, False)), cutout=cutout)
    return replace(rig, parts=(part,), texture_places=places.astype(np.float32))


def seen(gl: moderngl.Context, rig: Rig, shading: Shading = "studio", *, fine: bool = True) -> np.ndarray:
    with drawn(gl, rig, rig.neutral) as (mesh, canvas):
        if shading == "studio":
            return draw(mesh, canvas, camera(rig), fine=fine).astype(int)
        canvas.clear()
        mesh.draw_framed(canvas, frame_of(rig, canvas), fine=fine, shading=shading)
        return canvas.read().astype(int)


def frame_of(rig: Rig, canvas: object) -> object:
    from facepin.gpu.framing import frame
    from support.gpu_help import WHOLE

    return frame(camera(rig), WHOLE)


def test_the_first_row_is_on_top_in_a_drag_too(gl: moderngl.Context) -> None:
    for fine in (True, False):
        image = seen(gl, painted(HALVES), fine=fine)
        top, bottom = image[SIZE // 2 - 20, SIZE // 2], image[SIZE // 2 + 20, SIZE // 2]
        assert top[0] > top[2] + 60, "red"
        assert bottom[2] > bottom[0] + 60, "blue"


def test_a_grey_picture_is_the_same_as_a_grey_colour(gl: moderngl.Context) -> None:
    grey = np.full((4, 4, 4), 128, np.uint8)
    grey[..., 3] = 255
    picture = seen(gl, painted(grey))
    plain = ball(24, colour=(128 / 255,) * 3)
    assert np.abs(picture - seen(gl, plain)).max() <= 2


def test_alpha_cuts_out_and_cards_are_left_out_where_they_would_hide(gl: moderngl.Context) -> None:
    holes = HALVES.copy()
    holes[1, :, 3] = 0
    whole, cut = seen(gl, painted(holes)), painted(holes, cutout=0.5)
    image = seen(gl, cut)
    assert np.abs(image - whole)[: SIZE // 2 - 8].max() <= 2
    wall = seen(gl, painted(holes), "normals")  # any picture of the ball
    assert wall[SIZE // 2, SIZE // 2, 3] == 255
    below = image[SIZE // 2 + 20, SIZE // 2, :3]
    assert below.max() < 110, "the wall, or the dark inside of the ball"
    assert seen(gl, cut, "normals")[..., 3].max() == 0
    assert seen(gl, cut, "clay")[SIZE // 2 - 20, SIZE // 2, 3] == 255


def test_clay_has_no_picture(gl: moderngl.Context) -> None:
    np.testing.assert_array_equal(seen(gl, painted(HALVES), "clay"), seen(gl, ball(24), "clay"))


def test_a_picture_is_sent_once(gl: moderngl.Context) -> None:
    rig = painted(HALVES)
    shaders = Shaders(gl)
    assert rig.parts[0].texture is not None
    assert shaders._picture(rig.parts[0].texture) is shaders._picture(rig.parts[0].texture)
    shaders.release()
