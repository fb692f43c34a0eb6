"""Pictures without a window."""

import io

import moderngl
import numpy as np
import pytest
from PIL import Image

from facepin.core.errors import FacepinError
from facepin.gpu import picture
from facepin.gpu.markers import Markers, MarkerState
from facepin.gpu.picture import draw_picture, open_context, png_bytes, render_picture
from support.gpu_help import SIZE, ball, camera, draw, drawn


def test_a_picture_is_what_the_viewport_shows(gl: moderngl.Context) -> None:
    rig = ball()
    with drawn(gl, rig, rig.neutral, samples=4) as (mesh, canvas):
        seen = draw(mesh, canvas, camera(rig))
        np.testing.assert_array_equal(draw_picture(mesh, camera(rig), (SIZE, SIZE)), seen)


def test_tiles_fit_together(gl: moderngl.Context, monkeypatch: pytest.MonkeyPatch) -> None:
    rig = ball()
    with drawn(gl, rig, rig.neutral) as (mesh, _):
        whole = draw_picture(mesh, camera(rig), (150, 100), samples=0).astype(int)
        monkeypatch.setattr(picture, "TILE", 47)
        tiled = draw_picture(mesh, camera(rig), (150, 100), samples=0).astype(int)
    difference = np.abs(tiled - whole).max(axis=2)
    assert np.mean(difference > 2) < 0.002, "but for rounding at the outline"


def test_the_wall_has_no_seams_between_tiles(gl: moderngl.Context, monkeypatch: pytest.MonkeyPatch) -> None:
    rig = ball(6)
    with drawn(gl, rig, rig.neutral) as (mesh, _):
        view = camera(rig).zoomed(0.02)  # nothing but wall: its pool of light, and the noise that hides bands
        whole = draw_picture(mesh, view, (150, 100), samples=0)
        monkeypatch.setattr(picture, "TILE", 47)
        tiled = draw_picture(mesh, view, (150, 100), samples=0)
    assert len(np.unique(whole[:3, :3, 0])) > 1, "there is noise"
    different = (tiled != whole).any(axis=2)
    different[44:56, 69:81] = False  # the face
    assert np.mean(different) < 0.005, "but for rounding"


@pytest.mark.parametrize("supersampling", [1, 2])
def test_pins_have_the_same_size_in_tiles_and_supersampled(
    gl: moderngl.Context, monkeypatch: pytest.MonkeyPatch, supersampling: int
) -> None:
    rig = ball()
    pin = Markers(np.float32([[0, 0, 1]]), np.float32([[0.5, 0.4, 1]]), np.uint8([MarkerState.HELD]))

    def picture_of(markers: Markers | None, **options: object) -> np.ndarray:
        look = camera(rig)
        return render_picture(gl, rig, rig.neutral, rig.neutral, look, (90, 80), markers=markers, **options)

    bare = picture_of(None).astype(int)
    plain = picture_of(pin).astype(int)
    monkeypatch.setattr(picture, "TILE", 41)
    other = picture_of(pin, supersampling=supersampling).astype(int)
    assert np.mean(np.abs(plain - bare).max(axis=2) > 40) > 0.01
    assert np.mean(np.abs(plain - other).max(axis=2) > 60) < 0.01


def test_supersampling_averages(gl: moderngl.Context) -> None:
    rig = ball()
    with drawn(gl, rig, rig.neutral) as (mesh, _):
        plain = draw_picture(mesh, camera(rig), (64, 48), samples=0).astype(int)
        smooth = draw_picture(mesh, camera(rig), (64, 48), samples=0, supersampling=3).astype(int)
    assert smooth.shape == (48, 64, 4)
    assert np.median(np.abs(plain - smooth).max(axis=2)) <= 1
    assert np.abs(plain - smooth).max() > 20


def test_transparent_pictures_have_straight_alpha(gl: moderngl.Context) -> None:
    rig = ball(48)
    image = render_picture(
        gl,
        rig,
        rig.neutral,
        rig.neutral,
        camera(rig),
        (SIZE, SIZE),
        transparent=True,
        samples=0,
        supersampling=4,
    )
    alpha = image[..., 3]
    assert alpha[0, 0] == 0
    assert alpha[SIZE // 2, SIZE // 2] == 255
    # Along the rim colours go on as inside; premultiplied ones would fade to black.
    rim = (alpha > 64) & (alpha < 192)
    assert rim.sum() > 50
    inside = (alpha == 255) & (np.hypot(*(np.mgrid[:SIZE, :SIZE] + 0.5 - SIZE / 2)) > 0.8 * SIZE * 0.44)
    assert abs(image[rim, :3].mean() - image[inside, :3].mean()) < 25


@pytest.mark.parametrize(("size", "factor"), [((0, 10), 1), ((10, -1), 1), ((10, 10), 0)])
def test_sizes_below_one_are_refused(gl: moderngl.Context, size: tuple[int, int], factor: int) -> None:
    rig = ball(6)
    with pytest.raises(FacepinError, match=f"{size[0]}x{size[1]}.*1x1"):
        render_picture(gl, rig, rig.neutral, rig.neutral, camera(rig), size, supersampling=factor)


@pytest.mark.parametrize("alpha", [255, 100])
def test_png_keeps_pixels(alpha: int) -> None:
    image = np.random.default_rng(1).integers(0, 255, (5, 7, 4)).astype(np.uint8)
    image[..., 3] = alpha
    read = np.asarray(Image.open(io.BytesIO(png_bytes(image))))
    np.testing.assert_array_equal(read, image[..., :3] if alpha == 255 else image)


def test_no_opengl_is_said_in_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(**_: object) -> None:
        raise Exception("cannot open\ndisplay")

    monkeypatch.setattr(moderngl, "create_context", refuse)
    with pytest.raises(FacepinError, match=r"no OpenGL 3\.3 .*cannot open display") as caught:
        open_context()
    assert "\n" not in str(caught.value)
