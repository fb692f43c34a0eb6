"""Picking against an independent ray caster (Möller and Trumbore 1997) that tests every triangle."""

from pathlib import Path

import numpy as np
import pytest

from facepin.core.arrays import Floats, Indices, Points
from facepin.core.look.camera import Camera, Viewport, frame_points
from facepin.core.mesh.picking import first_hit, pick
from facepin.files.formats import open_rig
from support.small_rigs import sheet

VIEWPORT = Viewport(0, 0, 400, 300)


def reference(
    positions: Points, triangles: Indices, origin: Floats, direction: Floats
) -> tuple[int, float] | None:
    """Number and distance of the nearest triangle, both sides counting."""
    a, b, c = positions.astype(np.float64)[triangles].transpose(1, 0, 2)
    with np.errstate(all="ignore"):
        p = np.cross(direction, c - a)
        inverse = 1 / (p * (b - a)).sum(axis=1)
        u = ((origin - a) * p).sum(axis=1) * inverse
        q = np.cross(origin - a, b - a)
        v = (q @ direction) * inverse
        t = (q * (c - a)).sum(axis=1) * inverse
        t = np.where((u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0), t, np.inf)
    best = int(np.argmin(t))
    return (best, float(t[best])) if np.isfinite(t[best]) else None


def unit(vector: Floats) -> Floats:
    return vector / np.linalg.norm(vector)


def test_rays_through_a_heap_of_triangles_agree_with_the_reference() -> None:
    random = np.random.default_rng(5)
    positions = random.normal(size=(500, 3)).astype(np.float32)
    triangles = random.integers(0, 500, (900, 3)).astype(np.int32)  # some of them degenerate
    hits = 0
    for _ in range(400):
        origin, direction = random.normal(size=3), unit(random.normal(size=3))
        hit, expected = (f(positions, triangles, origin, direction) for f in (first_hit, reference))
        assert (hit is None) == (expected is None)
        if hit is not None and expected is not None:
            hits += 1
            assert hit.triangle == expected[0]
            assert hit.distance == pytest.approx(expected[1])
            np.testing.assert_allclose(hit.point, origin + expected[1] * direction, atol=1e-6)
    assert 100 < hits < 400


@pytest.mark.parametrize("axis", [(0, 0, 1), (0, 0, -1), (1, 0, 0), (0, -1, 0)])
def test_rays_along_the_axes(axis: tuple[int, int, int]) -> None:
    random = np.random.default_rng(6)
    positions = random.normal(size=(90, 3)).astype(np.float32)
    triangles = random.integers(0, 90, (60, 3)).astype(np.int32)
    for origin in random.normal(size=(50, 3)):
        direction = np.array(axis, np.float64)
        hit, expected = (f(positions, triangles, origin, direction) for f in (first_hit, reference))
        assert (hit and hit.triangle) == (expected and expected[0])


def test_no_ray_slips_between_neighbours() -> None:
    rig = sheet(columns=40, rows=40)
    random = np.random.default_rng(7)
    positions = (rig.neutral @ np.linalg.qr(random.normal(size=(3, 3)))[0]).astype(np.float32)
    eye = np.array([3.0, -2.0, 5.0])
    for triangle in random.permutation(len(rig.triangles))[:600]:
        a, b, c = positions[rig.triangles[triangle]].astype(np.float64)
        if np.abs(rig.neutral[rig.triangles[triangle], :2]).max() > 0.99:
            continue
        for point in (a, (a + b) / 2, (b + c) / 2):
            assert first_hit(positions, rig.triangles, eye, unit(point - eye)) is not None


def test_the_vertex_is_the_nearest_of_the_triangle_hit() -> None:
    # Two lips: the lower one's vertex is nearer to the hit than the hit triangle's own.
    positions = np.array(
        [[0, 0, 0], [2, 0, 0], [1, 2, 0], [1.0, -0.05, 0.2], [0, -2, 0.2], [2, -2, 0.2]], np.float32
    )
    triangles = np.array([[0, 1, 2], [3, 4, 5]], np.int32)
    hit = first_hit(positions, triangles, np.array([0.8, 0.01, 5]), np.array([0.0, 0, -1]))
    assert hit is not None and hit.triangle == 0 and hit.vertex == 0


def test_the_nearest_triangle_wins_and_sides_can_be_told_apart() -> None:
    triangle = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], np.float32)
    positions = np.vstack([triangle, triangle + np.float32([0, 0, 1])])
    triangles = np.array([[0, 1, 2], [3, 5, 4]], np.int32)  # the one in front is seen from behind
    ray = np.array([0.1, 0, 5]), np.array([0.0, 0, -1])
    both, front = (first_hit(positions, triangles, *ray, two_sided=two_sided) for two_sided in (True, False))
    assert both is not None and both.triangle == 1 and both.distance == pytest.approx(4)
    assert front is not None and front.triangle == 0 and front.distance == pytest.approx(5)


def test_triangles_that_reach_behind_the_eye() -> None:
    # A floor under the camera, from far behind it to far ahead.
    positions = np.array([[-100, -1, 100], [100, -1, 100], [0, -1, -100]], np.float32)
    triangles = np.array([[0, 1, 2]], np.int32)
    camera = Camera(distance=1.0)
    hit = pick(positions, triangles, camera, VIEWPORT, (200, 290))
    assert hit is not None and hit.point[1] == pytest.approx(-1) and hit.point[2] < camera.eye[2]
    assert pick(positions, triangles, camera, VIEWPORT, (200, 10)) is None, "the sky"


def test_what_is_behind_the_eye_or_before_the_near_plane_is_not_hit() -> None:
    camera = Camera(distance=10.0)
    for z, seen in ((11.0, False), (10 - camera.near / 2, False), (10 - camera.near * 2, True)):
        positions = np.array([[-9, -9, z], [9, -9, z], [0, 9, z]], np.float32)
        hit = pick(positions, np.array([[0, 1, 2]], np.int32), camera, VIEWPORT, (200, 150))
        assert (hit is not None) == seen


def test_nothing_is_hit_outside_the_viewport_or_on_an_empty_mesh() -> None:
    rig = sheet()
    camera = frame_points(rig.neutral, VIEWPORT.aspect)
    assert pick(rig.neutral, rig.triangles, camera, VIEWPORT, (200, 150)) is not None
    assert pick(rig.neutral, rig.triangles, camera, VIEWPORT, (-1, 150)) is None
    assert pick(rig.neutral, rig.triangles[:0], camera, VIEWPORT, (200, 150)) is None


def test_every_vertex_that_can_be_seen_can_be_picked() -> None:
    rig = sheet()
    camera = frame_points(rig.neutral, VIEWPORT.aspect, Camera(yaw=0.4, pitch=0.3))
    inside = np.flatnonzero((np.abs(rig.neutral[:, :2]) < 0.99).all(axis=1))
    for vertex, (x, y, _) in zip(inside, camera.project(rig.neutral[inside], VIEWPORT), strict=True):
        hit = pick(rig.neutral, rig.triangles, camera, VIEWPORT, (x, y))
        assert hit is not None and hit.vertex == vertex


def test_a_real_face_in_every_unit_agrees_with_the_reference(shared: Path) -> None:
    rig = open_rig(shared / "models" / "ict-facekit" / "ict_expressions.glb")
    random = np.random.default_rng(8)
    for unit_length in (1.0, 1e-3, 1e4):
        positions = (rig.neutral * np.float32(unit_length)).astype(np.float32)
        camera = frame_points(positions, VIEWPORT.aspect, Camera().looking("three-quarter"))
        for pixel in random.uniform((0, 0), (400, 300), (25, 2)):
            at = (float(pixel[0]), float(pixel[1]))
            hit = pick(positions, rig.triangles, camera, VIEWPORT, at)
            expected = reference(positions, rig.triangles, *camera.ray(at, VIEWPORT))
            assert (hit and hit.triangle) == (expected and expected[0])
