"""Projection, rays and the moves of the camera against each other and against plain geometry."""

from math import pi, radians, tan

import numpy as np
import pytest

from facepin.core.look.camera import VIEWS, Camera, Viewport, frame_points

VIEWPORT = Viewport(30, 20, 640, 480)
CAMERA = Camera(target=(1.0, 2.0, -3.0), distance=9.0, yaw=0.7, pitch=-0.4, fov_y=radians(40), radius=3.0)


def to_clip(camera: Camera, viewport: Viewport) -> np.ndarray:
    """World to clip space, as a column's matrix."""
    return camera.projection(viewport.aspect) @ camera.view_matrix()


def cloud(seed: int = 0, size: int = 400) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(size, 3)) * (1.0, 2.0, 0.5) + (1.0, 2.0, -3.0)


def test_viewport_contains_its_pixels_and_not_its_neighbours() -> None:
    viewport = Viewport(10, 20, 30, 40)
    assert viewport.contains(10, 20) and viewport.contains(39.9, 59.9)
    assert not viewport.contains(40, 30) and not viewport.contains(20, 60) and not viewport.contains(9.9, 30)
    assert Viewport(0, 0, 0, 0).aspect == 1.0


def test_axes_are_right_handed_and_unit_length_at_every_angle() -> None:
    for yaw in np.linspace(-pi, pi, 9):
        for pitch in np.linspace(-pi / 2, pi / 2, 7):
            axes = np.stack(Camera(yaw=yaw, pitch=pitch).axes)
            np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
            assert np.linalg.det(axes) == pytest.approx(1.0)


def test_project_agrees_with_the_matrices_given_to_the_graphics_card() -> None:
    points = cloud()
    pixels = CAMERA.project(points, VIEWPORT)
    clip = np.column_stack([points, np.ones(len(points))]) @ to_clip(CAMERA, VIEWPORT).T
    x, y, z = (clip[:, :3] / clip[:, 3:]).T
    np.testing.assert_allclose(pixels[:, 0], VIEWPORT.x + (x + 1) / 2 * VIEWPORT.width, atol=1e-9)
    np.testing.assert_allclose(pixels[:, 1], VIEWPORT.y + (1 - y) / 2 * VIEWPORT.height, atol=1e-9)
    np.testing.assert_allclose(pixels[:, 2], clip[:, 3], atol=1e-12)
    assert (np.abs(z) < 1).all(), "all points lie between the near and the far plane"


def test_near_and_far_are_the_ends_of_depth() -> None:
    back = CAMERA.axes[2]
    points = CAMERA.eye - np.array([[CAMERA.near], [CAMERA.far]]) * back
    clip = np.column_stack([points, np.ones(2)]) @ to_clip(CAMERA, VIEWPORT).T
    np.testing.assert_allclose(clip[:, 2] / clip[:, 3], [-1, 1], atol=1e-9)


def test_a_point_behind_the_eye_has_no_pixel() -> None:
    behind = CAMERA.eye + CAMERA.axes[2]
    pixels = CAMERA.project([behind, CAMERA.target], VIEWPORT)
    assert np.isnan(pixels[0, :2]).all() and pixels[0, 2] == pytest.approx(-1)
    np.testing.assert_allclose(pixels[1], [350, 260, 9])


def test_rays_pass_through_what_they_were_projected_from() -> None:
    for point, (x, y, _) in zip(cloud(), CAMERA.project(cloud(), VIEWPORT), strict=True):
        origin, direction = CAMERA.ray((x, y), VIEWPORT)
        assert np.linalg.norm(direction) == pytest.approx(1)
        np.testing.assert_allclose(np.cross(point - origin, direction), 0, atol=1e-9)


def test_plane_point_lies_under_the_pixel_and_in_the_plane_that_faces_the_camera() -> None:
    through = np.array([0.4, 2.5, -2.0])
    point = CAMERA.plane_point((100, 400), through, VIEWPORT)
    assert (point - through) @ CAMERA.axes[2] == pytest.approx(0, abs=1e-12)
    np.testing.assert_allclose(CAMERA.project(point, VIEWPORT)[0, :2], [100, 400])
    behind = CAMERA.plane_point((100, 400), CAMERA.eye + CAMERA.axes[2], VIEWPORT)
    assert CAMERA.project(behind, VIEWPORT)[0, 2] == pytest.approx(CAMERA.near)


def test_a_panned_point_follows_the_mouse_exactly() -> None:
    up_and_right = 0.3 * CAMERA.axes[0] - 1.1 * CAMERA.axes[1]
    points = np.array([CAMERA.target, CAMERA.target + up_and_right])
    moved = CAMERA.panned(37, -12, VIEWPORT).project(points, VIEWPORT) - CAMERA.project(points, VIEWPORT)
    np.testing.assert_allclose(moved, [[37, -12, 0]] * 2, atol=1e-9)


def test_zooming_doubles_and_keeps_what_is_under_the_cursor() -> None:
    at = (500.0, 90.0)
    under = CAMERA.plane_point(at, CAMERA.target, VIEWPORT)
    other = CAMERA.plane_point((510, 70), CAMERA.target, VIEWPORT)
    closer = CAMERA.zoomed(2, at, VIEWPORT)
    pixels = closer.project([under, other], VIEWPORT)
    np.testing.assert_allclose(pixels[:, :2], [at, (520, 50)], atol=1e-9)
    assert closer.distance == pytest.approx(4.5)
    assert CAMERA.zoomed(2).target == CAMERA.target


@pytest.mark.parametrize("factor", [1e9, 1e-9])
def test_zooming_stops_before_it_breaks(factor: float) -> None:
    camera = CAMERA
    for _ in range(5):
        camera = camera.zoomed(factor, (0, 0), VIEWPORT)
    assert 0 < camera.near < camera.distance < camera.far < 1e4
    assert camera == camera.zoomed(factor, (600, 400), VIEWPORT), "at the end of its range it stands still"


def test_orbiting_stops_at_the_poles_and_wraps_round() -> None:
    assert CAMERA.orbited(0, 10).pitch == pi / 2
    assert CAMERA.orbited(0, -10).pitch == -pi / 2
    assert CAMERA.orbited(2 * pi, 0).yaw == pytest.approx(CAMERA.yaw)
    np.testing.assert_allclose(CAMERA.orbited(1, 0.3).project(CAMERA.target, VIEWPORT)[0], [350, 260, 9])


def test_named_views_see_the_side_they_are_named_after() -> None:
    sides = {"front": (0, 0, 1), "back": (0, 0, -1), "left": (1, 0, 0), "right": (-1, 0, 0), "top": (0, 1, 0)}
    for view, side in sides.items():
        camera = CAMERA.looking(view)  # type: ignore[arg-type]  # the keys are the words of View
        np.testing.assert_allclose(camera.axes[2], side, atol=1e-12)
        assert (camera.target, camera.distance) == (CAMERA.target, CAMERA.distance)
    x, y, z = CAMERA.looking("three-quarter").axes[2]
    assert 0 < y < x < z, "from the front, somewhat from the character's left and above"
    assert set(VIEWS) == {*sides, "three-quarter"}


@pytest.mark.parametrize("aspect", [0.3, 1.0, 2.5])
@pytest.mark.parametrize("view", list(VIEWS))
def test_framing_shows_everything_and_touches_the_margin(view: str, aspect: float) -> None:
    points = cloud(3)
    viewport = Viewport(0, 0, 1000 * aspect, 1000)
    camera = frame_points(points, viewport.aspect, CAMERA.looking(view))  # type: ignore[arg-type]
    x, y, depth = (camera.project(points, viewport)).T
    margins = np.array([x.min(), 1000 * aspect - x.max()]) / aspect, np.array([y.min(), 1000 - y.max()])
    tight = min(margins, key=np.min)
    np.testing.assert_allclose(tight, 60)
    assert min(margins[0].min(), margins[1].min()) == tight.min()
    assert depth.min() > camera.near and depth.max() < camera.far
    assert camera.project(camera.target, viewport)[0, 2] == pytest.approx((depth.min() + depth.max()) / 2)


@pytest.mark.parametrize(
    "points",
    [np.zeros((0, 3)), np.ones((1, 3)), np.full((3, 3), np.nan), [[0, 0, 0], [0, 0, 5]], [[1, 1, 1]] * 4],
)
def test_framing_bears_degenerate_points(points: np.ndarray) -> None:
    for camera in (None, CAMERA):
        framed = frame_points(points, 1.5, camera)
        assert np.isfinite(framed.eye).all() and framed.distance > 0 and framed.radius > 0
        assert np.isfinite(to_clip(framed, VIEWPORT)).all()


def test_framing_a_part_keeps_the_scene_reachable() -> None:
    whole = frame_points(cloud(), 1.0)
    part = frame_points(cloud()[:3], 1.0, whole)
    assert part.radius == whole.radius
    assert part.zoomed(1e-3).distance > whole.distance


def test_a_narrow_picture_shows_more_above_and_below_instead_of_cutting_the_sides_off() -> None:
    camera = Camera(distance=10.0, least_aspect=0.8)
    free = Camera(distance=10.0)
    half = 10.0 * tan(camera.fov_y / 2)
    side = np.array([[0.8 * half, 0.0, 0.0]])  # what is seen at the right border of a picture of that aspect
    for width, seen in ((1600, 1600 / 2 + 0.8 * 500), (800, 800), (400, 400), (200, 200)):
        viewport = Viewport(0, 0, width, 1000)
        x, y, _ = camera.project(side, viewport)[0]
        assert (x, y) == pytest.approx((seen, 500))
        clip = to_clip(camera, viewport) @ [*side[0], 1]
        assert viewport.width * (clip[0] / clip[3] + 1) / 2 == pytest.approx(seen)
        back = camera.plane_point((x, y), (0, 0, 0), viewport)
        np.testing.assert_allclose(back, side[0], atol=1e-9)
    wide = Viewport(0, 0, 1600, 1000)
    np.testing.assert_array_equal(camera.projection(wide.aspect), free.projection(wide.aspect))


def test_without_perspective_what_is_parallel_stays_so() -> None:
    camera = frame_points(cloud(), 1.0).through(orthographic=True)
    viewport = Viewport(0, 0, 800, 800)
    points = np.array([[0.5, 0.5, z] for z in (-1.0, 0.0, 1.0)])
    x, y, depth = camera.looking("front").project(points, viewport).T
    assert np.ptp(x) < 1 and np.ptp(y) < 1
    assert depth.min() > camera.near and depth.max() < camera.far
    back = camera.through(orthographic=False)
    assert back.distance == pytest.approx(frame_points(cloud(), 1.0).distance)
    assert camera.pixel_size(viewport) == pytest.approx(back.pixel_size(viewport))
    assert camera.orthographic and not back.orthographic


def test_focusing_changes_what_is_turned_about_and_not_the_picture() -> None:
    point = CAMERA.eye - 3 * CAMERA.axes[2] + CAMERA.axes[0]
    camera = CAMERA.focused(point)
    np.testing.assert_allclose(camera.eye, CAMERA.eye)
    np.testing.assert_allclose(camera.project(cloud(), VIEWPORT), CAMERA.project(cloud(), VIEWPORT))
    assert camera.distance == pytest.approx(3)
    assert CAMERA.focused(CAMERA.eye + CAMERA.axes[2]) is CAMERA, "it is behind the eye"
