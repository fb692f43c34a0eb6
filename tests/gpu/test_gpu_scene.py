"""A face on the graphics card: what is sent, where it is drawn, and that it always looks the same."""

from collections.abc import Callable
from dataclasses import replace

import moderngl
import numpy as np
import pytest

from facepin.core.look.camera import Viewport
from facepin.core.rig import Rig
from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import frame
from facepin.gpu.scene import PaneMesh, Scene
from support.gpu_help import SIZE, WHOLE, ball, ball_normals, bowl, camera, draw, drawn


def test_the_same_arrays_are_sent_once(gl: moderngl.Context) -> None:
    rig = ball()
    scene = Scene(gl, rig)
    mesh = PaneMesh(scene)
    positions, normals = rig.neutral, rig.neutral.copy()
    assert mesh.upload(positions, normals)
    assert not mesh.upload(positions, normals)
    assert mesh.upload(positions.copy(), normals)
    mesh.release()
    scene.release()


def test_a_ball_covers_what_the_camera_says(gl: moderngl.Context) -> None:
    rig = ball(48)
    with drawn(gl, rig, rig.neutral) as (mesh, canvas):
        alpha = draw(mesh, canvas, camera(rig), background=False)[..., 3]
    eye = camera(rig)
    # A sphere's outline is the cone that touches it.
    edge = np.tan(np.arcsin(1 / eye.distance)) / np.tan(eye.fov_y / 2) * SIZE / 2
    y, x = np.mgrid[:SIZE, :SIZE] + 0.5 - SIZE / 2
    away = np.hypot(x, y)
    assert (alpha[away < edge - 1] == 255).all()
    assert (alpha[away > edge + 1] == 0).all()


@pytest.mark.parametrize("samples", [0, 4])
def test_it_stays_in_its_rectangle(gl: moderngl.Context, samples: int) -> None:
    rig = ball()
    with drawn(gl, rig, rig.neutral, samples) as (mesh, canvas):
        alpha = draw(mesh, canvas, camera(rig).zoomed(3), Viewport(16, 8, 64, 40))[..., 3]
    inside = np.zeros((SIZE, SIZE), bool)
    inside[8:48, 16:80] = True
    np.testing.assert_array_equal(alpha, 255 * inside)


def test_two_panes_show_their_own_poses(gl: moderngl.Context) -> None:
    rig = ball()
    stretched = rig.evaluate(np.ones(1))
    left, right = Viewport(0, 0, SIZE / 2, SIZE), Viewport(SIZE / 2, 0, SIZE / 2, SIZE)
    with drawn(gl, rig, rig.neutral) as (mesh, canvas):
        other = PaneMesh(mesh.scene)
        other.upload(stretched, rig.neutral)
        canvas.clear()
        for pane, place in ((mesh, left), (other, right)):
            pane.draw(canvas, place, camera(rig))
        alpha = canvas.read()[..., 3]
        other.release()
    halves = alpha[:, : SIZE // 2], alpha[:, SIZE // 2 :]
    assert [half[0].any() for half in halves] == [False, True], "only the stretched one reaches the top"
    np.testing.assert_array_equal(halves[0][SIZE // 2 :], halves[1][SIZE // 2 :])


def test_the_wall_is_kept_until_panes_or_lens_change(gl: moderngl.Context) -> None:
    rig = ball(6)
    left, right = Viewport(0, 0, SIZE / 2, SIZE), Viewport(SIZE / 2, 0, SIZE / 2, SIZE)
    with drawn(gl, rig, rig.neutral) as (mesh, canvas):
        wall = mesh.scene.background
        for viewports in ([WHOLE], [left, right], [left], [WHOLE]):
            mesh.draw(canvas, WHOLE, camera(rig))  # something to erase
            wall.draw(canvas, [(viewport, camera(rig)) for viewport in viewports])
            kept = canvas.read().copy()
            wall.draw_framed(canvas, [frame(camera(rig), viewport) for viewport in viewports])
            np.testing.assert_array_equal(canvas.read(), kept)
            assert len(np.unique(kept[..., 3])) == (2 if viewports == [left] else 1)


def test_drawing_does_not_depend_on_the_state_left_by_others(gl: moderngl.Context) -> None:
    rig = ball()
    with drawn(gl, rig, rig.neutral) as (mesh, canvas):
        expected = draw(mesh, canvas, camera(rig))
        gl.enable_only(moderngl.BLEND | moderngl.CULL_FACE)
        gl.blend_func = moderngl.ONE, moderngl.ONE
        gl.cull_face, gl.front_face, gl.depth_func = "front", "ccw", ">"
        canvas.framebuffer.scissor = (3, 3, 5, 5)
        canvas.framebuffer.viewport = (1, 1, 20, 20)
        np.testing.assert_array_equal(draw(mesh, canvas, camera(rig)), expected)


def test_an_inside_out_file_looks_like_any_other(gl: moderngl.Context) -> None:
    pictures = []
    for inside_out in (False, True):
        rig = ball(inside_out=inside_out)
        for fine in (False, True):
            with drawn(gl, rig, ball_normals(rig, inside_out=inside_out)) as (mesh, canvas):
                assert [run.hidden for run in mesh.scene.runs] == ["front" if inside_out else "back"]
                pictures.append(draw(mesh, canvas, camera(rig), fine=fine).astype(int))
    assert np.abs(pictures[2] - pictures[0]).mean() < 0.2
    assert np.abs(pictures[3] - pictures[1]).mean() < 0.2


@pytest.mark.parametrize("turn", [0.0, 2.5])
@pytest.mark.parametrize("make", [lambda: ball(64), lambda: bowl(64)], ids=["closed", "sheet"])
def test_light_at_vertices_looks_like_light_at_pixels(
    gl: moderngl.Context, make: Callable[[], Rig], turn: float
) -> None:
    rig = make()
    with drawn(gl, rig, rig.neutral) as (mesh, canvas):
        view = camera(rig).orbited(turn, 0.0)
        fast, fine = (draw(mesh, canvas, view, fine=fine).astype(int) for fine in (False, True))
    assert np.abs(fast - fine).max() <= 6


def test_hard_edges_between_colours_have_no_speckles(gl: moderngl.Context) -> None:
    rig = ball(24, name="eye")
    grey = np.where(rig.neutral[:, :1] * rig.neutral[:, 1:2] > 0, 0.0, 0.9).repeat(3, axis=1)
    rig = replace(rig, colours=grey.astype(np.float32))
    with drawn(gl, rig, rig.neutral, samples=4) as (mesh, canvas):
        image = draw(mesh, canvas, camera(rig), background=False)[..., :3].astype(int)
    # Samples beyond the edge of a triangle guess colours below black.
    assert (image.max(axis=2) - image.min(axis=2)).max() < 50


def test_light_comes_from_the_upper_left(gl: moderngl.Context) -> None:
    rig = ball(48)
    with drawn(gl, rig, rig.neutral) as (mesh, canvas):
        grey = draw(mesh, canvas, camera(rig))[..., :3].mean(axis=2)
    upper_left, lower_right = grey[40:50, 40:50].mean(), grey[80:90, 80:90].mean()
    assert upper_left > 1.4 * lower_right
    assert 120 < upper_left < 235, "bright, and nothing burnt out"


def test_a_canvas_smooths_edges_and_copies_all_of_itself(gl: moderngl.Context) -> None:
    rig = ball()
    with drawn(gl, rig, rig.neutral, samples=4) as (mesh, canvas):
        smooth = draw(mesh, canvas, camera(rig), background=False)
        canvas.framebuffer.scissor = canvas.flat().scissor = (5, 5, 9, 9)
        np.testing.assert_array_equal(canvas.read(), smooth)
    if canvas.samples:
        assert ((smooth[..., 3] > 0) & (smooth[..., 3] < 255)).sum() > SIZE


def test_a_canvas_can_be_resized_again_and_again(gl: moderngl.Context) -> None:
    canvas = Canvas(gl, 4)
    with pytest.raises(RuntimeError, match="size"):
        _ = canvas.framebuffer
    for width, height in ((10, 20), (0, 7), (10, 20)):
        canvas.resize(width, height)
        canvas.framebuffer.clear(1.0)
        assert canvas.read().shape == (max(height, 1), max(width, 1), 4)
    canvas.release()
    canvas.release()
