"""Painted irises, and eyes under their lids."""

import moderngl
import numpy as np

from facepin.gpu.eyes import ANGLES, IRIS, gaze_angle, paint_iris
from facepin.gpu.materials import EYEBALL, vertex_albedo
from support.gpu_help import ball, camera, draw, drawn

WHITE = (0.9, 0.8, 0.7)


def angles(points: np.ndarray) -> np.ndarray:
    return np.arccos(np.clip(points[:, 2], -1, 1))


def test_angles_are_measured_from_the_middle_of_the_ball() -> None:
    points = ball(20).neutral.astype(float)
    np.testing.assert_allclose(gaze_angle(2.5 * points + (3, -1, 7)), angles(points), atol=1e-6)
    # The back of an eyeball may have any shape.
    deep = points.copy()
    deep[deep[:, 2] < -0.5, 2] *= 2
    front = points[:, 2] > 0
    np.testing.assert_allclose(gaze_angle(deep)[front], angles(points)[front], atol=1e-6)


def test_an_iris_looks_forward() -> None:
    points = ball(90).neutral
    colours = paint_iris(points + np.float32(4), WHITE)
    angle = angles(points)
    assert (colours[angle < ANGLES[0]] < 0.1).all()
    np.testing.assert_allclose(
        colours[angle > IRIS + 0.05], np.float32([WHITE] * (angle > IRIS + 0.05).sum())
    )
    ring = colours[(angle > ANGLES[1]) & (angle < IRIS * 0.9)]
    assert (ring[:, 2] > ring[:, 0] + 0.08).all(), "blue"


def test_two_eyes_in_one_part_get_an_iris_each() -> None:
    one = ball(30).neutral
    both = np.concatenate([one - np.array([2, 0, 0]), one + np.array([2, 0, 0])]).astype(np.float32)
    colours = paint_iris(both, WHITE)
    np.testing.assert_allclose(colours[: len(one)], paint_iris(one, WHITE), atol=1e-4)
    np.testing.assert_allclose(colours[len(one) :], paint_iris(one, WHITE), atol=1e-4)


def test_a_few_points_stay_white() -> None:
    for count in (0, 3):
        np.testing.assert_allclose(
            paint_iris(ball(4).neutral[:count], WHITE), np.float32([WHITE] * count).reshape(-1, 3)
        )


def test_only_eyes_without_a_colour_are_painted() -> None:
    plain = ball(30, name="eyeL")
    assert vertex_albedo(plain)[:, :3].min() < 0.1
    assert vertex_albedo(plain)[:, :3].max() == 1
    assert (vertex_albedo(ball(30, name="eyeL", colour=(0.5, 0.5, 0.5))) == 1).all()
    assert (vertex_albedo(ball(30)) == 1).all()
    assert EYEBALL.roughness < 0.15


def test_an_eye_turns_under_the_shadow_of_its_lids(gl: moderngl.Context) -> None:
    rig = ball(24, name="eyeL", colour=(0.8, 0.8, 0.8))
    with drawn(gl, rig, rig.neutral) as (mesh, canvas):
        plain = draw(mesh, canvas, camera(rig))
        # What is baked at its vertices turns with them, so it must not be seen.
        count = rig.vertex_count
        baked = np.concatenate([np.ones((count, 3)), np.linspace(0, 1, count)[:, None]], axis=1)
        mesh.scene.albedo.write(baked.astype(np.float16))
        np.testing.assert_array_equal(draw(mesh, canvas, camera(rig)), plain)
    grey = plain[..., :3].mean(axis=2)
    other = ball(24, colour=(0.8, 0.8, 0.8))
    with drawn(gl, other, other.neutral) as (mesh, canvas):
        open_ = draw(mesh, canvas, camera(other))[..., :3].mean(axis=2)
    below, above = (slice(76, 84), slice(60, 68)), (slice(28, 36), slice(60, 68))
    assert grey[above].mean() < open_[above].mean() - 15, "the upper lid"
    assert grey[below].mean() > open_[below].mean() - 8
