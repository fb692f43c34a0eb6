"""Moving and still triangles against counting by hand."""

import numpy as np

from facepin.core.mesh.topology import draw_order
from facepin.core.rig import Rig
from facepin.core.rig_builder import build_rig
from facepin.gpu.materials import material_runs
from facepin.gpu.motion import VISIBLE, Motion
from support.small_rigs import sheet

COLUMNS, ROWS = 9, 9


def strip(columns: int = COLUMNS, split: bool = False) -> Rig:
    """A band of quads along x, one unit each; `split` doubles the vertices of the middle column."""
    points = np.array([(x, y, 0) for x in range(columns) for y in (0, 1)], np.float64)
    at = np.arange(len(points)).reshape(columns, 2)
    right = at[1:].copy()
    if split:
        middle = columns // 2
        points = np.concatenate([points, points[at[middle]]])
        right[middle - 1] = [len(points) - 2, len(points) - 1]
    faces = np.stack([at[:-1, 0], right[:, 0], right[:, 1], at[:-1, 1]], axis=1)
    return build_rig("strip", points, faces.ravel(), np.full(len(faces), 4), [("move", np.ones_like(points))])


def motion_of(rig: Rig, pixel: float = 1.0) -> Motion:
    order = draw_order(rig)
    motion = Motion(rig, order.triangles, material_runs(rig, order.runs))
    motion.forget(pixel)
    return motion


def lifted(rig: Rig, chosen: np.ndarray, height: float) -> np.ndarray:
    positions = rig.neutral.copy()
    positions[chosen, 2] += np.float32(height)
    return positions


def corners(motion: Motion, still: bool) -> np.ndarray:
    runs = motion.still if still else motion.moving
    flat = motion.triangles.ravel()
    return np.concatenate([flat[run.first : run.first + run.count] for run in runs]).reshape(-1, 3)


def test_nothing_is_sorted_before_something_has_moved() -> None:
    rig = sheet(COLUMNS, ROWS)
    motion = motion_of(rig)
    assert not motion.follow(rig.neutral)
    assert not motion.follow(rig.neutral)
    assert not motion.still
    assert sum(run.count for run in motion.moving) == 3 * len(rig.triangles)
    assert motion.settled(rig.neutral) is rig.neutral


def test_what_shares_a_corner_with_what_moves_is_drawn_too() -> None:
    rig = strip()
    motion = motion_of(rig)
    motion.follow(rig.neutral)
    assert motion.follow(lifted(rig, rig.neutral[:, 0] == 0, 1.0))
    moving, still = corners(motion, still=False), corners(motion, still=True)
    assert rig.neutral[moving, 0].max() == 2, "the first quad moves, and the light at its far edge"
    assert rig.neutral[still, 0].min() == 2
    together = np.sort(np.concatenate([moving, still]), axis=1)
    expected = np.sort(rig.triangles, axis=1)
    np.testing.assert_array_equal(np.unique(together, axis=0), np.unique(expected, axis=0))
    assert len(together) == len(rig.triangles)


def test_vertices_that_a_seam_has_split_count_as_one() -> None:
    rig = strip(split=True)
    motion = motion_of(rig)
    motion.follow(rig.neutral)
    motion.follow(lifted(rig, rig.neutral[:, 0] == COLUMNS // 2 - 1, 1.0))
    assert rig.neutral[corners(motion, still=False), 0].max() == COLUMNS // 2 + 1


def test_a_move_that_nobody_sees_is_none() -> None:
    rig = strip()
    first, last = rig.neutral[:, 0] == 0, rig.neutral[:, 0] == COLUMNS - 1
    motion = motion_of(rig, 0.1)
    motion.follow(rig.neutral)
    assert motion.follow(lifted(rig, first, 1.0))
    pose = lifted(rig, first, 2.0)
    pose[last, 2] = 0.99 * VISIBLE * 0.1
    assert not motion.follow(pose)
    expected = pose.copy()
    expected[last, 2] = 0
    np.testing.assert_array_equal(motion.settled(pose), expected)
    pose = pose.copy()
    pose[last, 2] = 1.01 * VISIBLE * 0.1
    assert motion.follow(pose)
    np.testing.assert_array_equal(motion.settled(pose), pose)
    assert rig.neutral[corners(motion, still=False), 0].max() == COLUMNS - 1


def test_what_has_moved_may_move_on_and_come_back_without_sorting() -> None:
    rig = strip()
    motion = motion_of(rig)
    motion.follow(rig.neutral)
    first = rig.neutral[:, 0] == 0
    assert motion.follow(lifted(rig, first, 1.0))
    before = motion.triangles
    for height in (3.0, -5.0, 0.0):
        assert not motion.follow(lifted(rig, first, height))
    assert motion.triangles is before


def test_when_nearly_all_moves_nothing_is_sorted_until_it_is_forgotten() -> None:
    rig = strip()
    motion = motion_of(rig)
    motion.follow(rig.neutral)
    everything = np.ones(rig.vertex_count, bool)
    motion.follow(lifted(rig, everything, 1.0))
    assert not motion.still
    assert not motion.follow(lifted(rig, everything, 2.0))
    assert sum(run.count for run in motion.moving) == 3 * len(rig.triangles)
    motion.forget(1.0)
    motion.follow(rig.neutral)
    motion.follow(lifted(rig, rig.neutral[:, 0] == 0, 1.0))
    assert motion.still


def test_vertices_without_triangles_do_not_disturb() -> None:
    rig = strip()
    points = np.concatenate([rig.neutral, [[0, 9, 0]]])
    loose = build_rig(
        "loose", points, rig.corners, rig.face_sizes, [("move", np.ones_like(points, dtype=np.float64))]
    )
    motion = motion_of(loose)
    motion.follow(loose.neutral)
    last = np.arange(loose.vertex_count) == loose.vertex_count - 1
    motion.follow(lifted(loose, last, 1.0))
    assert not motion.follow(lifted(loose, last, 9.0))
