"""The numbers that shaders get agree with the camera."""

import numpy as np
import pytest

from facepin.core.look.camera import Camera, Viewport
from facepin.gpu.framing import frame, tile

CAMERA = Camera(target=(0.3, -0.2, 0.5), distance=5.0, yaw=0.4, pitch=-0.2, radius=2.0)
VIEW = Viewport(30, 20, 160, 90)


def test_the_rectangle_is_whole_pixels() -> None:
    assert frame(CAMERA, VIEW).rectangle == (30, 20, 160, 90)
    assert frame(CAMERA, Viewport(0.4, 0.4, 0.2, 0.0)).rectangle[2:] == (1, 1)


@pytest.mark.parametrize("pixel", [(30.5, 20.5), (189.5, 109.5), (77.5, 63.5)])
def test_the_ray_of_a_pixel_is_the_camera_s(pixel: tuple[float, float]) -> None:
    framing = frame(CAMERA, VIEW)
    sx, sy, ox, oy = framing.ray_of_pixel
    x, y = pixel
    ray = framing.to_view[:3, :3].T @ [x * sx + ox, y * sy + oy, -1]
    _, expected = CAMERA.ray(pixel, VIEW)
    np.testing.assert_allclose(ray / np.linalg.norm(ray), expected, atol=1e-12)


def test_a_tile_shows_its_piece_of_the_whole() -> None:
    whole = frame(CAMERA, Viewport(0, 0, 160, 90))
    piece = tile(whole, 40, 30, 60, 50)
    point = piece.to_view @ [0.5, 0.1, 0.2, 1]
    for framing, at in ((whole, (0, 0)), (piece, (40, 30))):
        clip = framing.to_clip @ point
        _, _, width, height = framing.rectangle
        pixel = (clip[:2] / clip[3] / 2 + 0.5) * (width, height) + at
        x, y, _ = CAMERA.project([[0.5, 0.1, 0.2]], Viewport(0, 0, 160, 90))[0]
        np.testing.assert_allclose(pixel, (x, y), atol=1e-9)
    sx, sy, ox, oy = whole.ray_of_pixel
    tx, ty, ux, uy = piece.ray_of_pixel
    np.testing.assert_allclose((45 * sx + ox, 33 * sy + oy), (5 * tx + ux, 3 * ty + uy), atol=1e-12)
