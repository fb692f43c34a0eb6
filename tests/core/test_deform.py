"""Positions of the drag path against B w written out in float64, whatever the sequence of poses."""

from pathlib import Path

import numpy as np
import pytest

from facepin.core.arrays import Floats, Points
from facepin.core.rig import Rig
from facepin.core.rig_builder import build_rig
from facepin.core.shapes.deform import MOST_DIRECTIONS, Deformer
from facepin.files.formats import open_rig

EPSILON = 2.0**-24


def mixed_rig(shapes: int = 40, vertices: int = 300, seed: int = 2) -> Rig:
    """A rig of noise whose shapes move from none to all of the vertices."""
    random = np.random.default_rng(seed)
    deltas = random.normal(size=(shapes, vertices, 3))
    deltas *= random.uniform(size=(shapes, vertices, 1)) < np.linspace(0, 1, shapes)[:, None, None] ** 2
    faces = np.arange(vertices - vertices % 3).reshape(-1, 3)
    named = [(f"shape{j}", delta) for j, delta in enumerate(deltas)]
    return build_rig(
        "noise", 5 * random.normal(size=(vertices, 3)), faces.ravel(), np.full(len(faces), 3), named
    )


def exact(rig: Rig, weights: Floats) -> Floats:
    return rig.neutral + (rig.deltas.astype(np.float64) @ weights).reshape(-1, 3)


def rounding(rig: Rig, weights: Floats) -> float:
    """What float32 may lose: a few units in the last place of the largest term."""
    reach = np.abs(rig.deltas).astype(np.float64) @ np.abs(weights)
    return 30 * EPSILON * (float(np.abs(rig.neutral).max()) + float(reach.max()))


def random_walk(rig: Rig, steps: int, seed: int) -> list[Floats]:
    """Poses of every kind: drags, sliders, jumps, the rest pose, huge weights and back."""
    random = np.random.default_rng(seed)
    count = rig.shape_count
    weights = np.zeros(count)
    span = random.normal(size=(3, count))
    poses = []
    for _ in range(steps):
        kind = random.integers(8)
        if kind < 3:
            weights = weights + random.normal(0, 0.1, 3) @ span
        elif kind == 3:
            weights = weights.copy()
            weights[random.integers(count)] = random.uniform()
        elif kind == 4:
            weights = np.where(random.uniform(size=count) < 0.2, random.uniform(size=count), 0.0)
        elif kind == 5:
            weights, span = random.uniform(size=count), random.normal(size=(3, count))
        elif kind == 6:
            weights = weights + random.normal(size=count) * 10.0 ** random.integers(-9, 5)
        else:
            weights = np.zeros(count)
        poses.append(weights)
    return poses


@pytest.mark.parametrize("seed", range(4))
def test_every_pose_of_a_long_random_sequence_is_exact_to_rounding(seed: int) -> None:
    rig = mixed_rig(seed=seed)
    deformer = Deformer(rig)
    for weights in random_walk(rig, 400, seed):
        difference = np.abs(deformer.deform(weights) - exact(rig, weights)).max()
        assert difference <= rounding(rig, weights)
        assert np.abs(rig.evaluate(weights) - exact(rig, weights)).max() <= rounding(rig, weights)


def test_a_drag_back_and_forth_ten_thousand_times_does_not_drift() -> None:
    rig = mixed_rig()
    deformer = Deformer(rig)
    random = np.random.default_rng(3)
    start, span = random.uniform(size=rig.shape_count), random.normal(size=(3, rig.shape_count))
    for at in random.normal(size=(10_000, 3)):
        deformer.deform(start + at @ span)
    assert np.abs(deformer.deform(start) - exact(rig, start)).max() <= rounding(rig, start)


def test_a_real_face_with_every_weight_in_use(shared: Path) -> None:
    rig = open_rig(shared / "models" / "ict-facekit" / "ict_full153.npz")
    deformer = Deformer(rig)
    for weights in random_walk(rig, 10, 9):
        assert np.abs(deformer.deform(weights) - exact(rig, weights)).max() <= rounding(rig, weights)


def test_the_rest_pose_is_the_neutral() -> None:
    rig = mixed_rig()
    deformer = Deformer(rig)
    assert deformer.deform(np.zeros(rig.shape_count)) is rig.neutral
    deformer.deform(np.ones(rig.shape_count))
    difference = deformer.deform(np.zeros(rig.shape_count)) - rig.neutral
    assert np.abs(difference).max() <= rounding(rig, np.ones(rig.shape_count))


def test_identity_tells_whether_something_moved() -> None:
    rig = mixed_rig()
    deformer = Deformer(rig)
    weights = np.full(rig.shape_count, 0.5)
    first = deformer.deform(weights)
    copy = first.copy()
    assert deformer.deform(weights.copy()) is first
    assert deformer.deform(weights * 0.9) is not first
    assert not first.flags.writeable
    np.testing.assert_array_equal(first, copy)


def test_weights_changed_in_place_are_noticed() -> None:
    rig = mixed_rig()
    deformer = Deformer(rig)
    weights = np.full(rig.shape_count, 0.5)
    first = deformer.deform(weights)
    weights[-1] = 1.0
    assert np.abs(deformer.deform(weights) - first).max() > 0.01


@pytest.mark.parametrize("active", [1, 3, 6, 12, 20])
def test_answers_of_a_sparse_solver_are_exact(active: int) -> None:
    rig = mixed_rig()
    deformer, random = Deformer(rig), np.random.default_rng(active)
    before = np.zeros(rig.shape_count)
    for frame in range(300):
        if frame % 7 == 0:
            chosen = random.choice(rig.shape_count, active, replace=False)
        if frame % 100 == 0:
            before = random.uniform(size=rig.shape_count) * (random.uniform() < 0.7)
        weights = before.copy()
        weights[chosen] = random.uniform(size=active)
        positions = deformer.deform(weights)
        assert np.abs(positions - exact(rig, weights)).max() <= rounding(rig, weights)
        assert np.abs(rig.evaluate(weights) - positions).max() <= rounding(rig, weights)


def test_a_solver_that_bends_its_way_multiplies_each_shape_once(monkeypatch: pytest.MonkeyPatch) -> None:
    rig = mixed_rig()
    deformer, random = Deformer(rig), np.random.default_rng(6)
    products: list[int] = []
    product = rig.columns.product
    monkeypatch.setattr(
        rig.columns, "product", lambda weights: products.append(np.count_nonzero(weights)) or product(weights)
    )
    for _ in range(200):
        weights = np.zeros(rig.shape_count)
        weights[random.choice([3, 8, 20, 30, 35, 39], random.integers(1, 6), replace=False)] = (
            random.uniform()
        )
        deformer.deform(weights)
    assert products == [1] * 6


def test_vertices_that_a_gesture_does_not_move_stay_put_to_the_last_bit() -> None:
    rig = mixed_rig()
    deformer = Deformer(rig)
    for weights in random_walk(rig, 50, 4):
        deformer.deform(weights)
    weights = np.full(rig.shape_count, 0.3)
    frames: list[Points] = []
    for amount in np.linspace(0.31, 0.9, 10):
        weights[8] = amount  # moves few vertices
        frames.append(deformer.deform(weights))
    moving = np.unique(rig.deltas[:, [8]].indices // 3)
    still = np.setdiff1d(np.arange(rig.vertex_count), moving)
    for frame in frames[2:]:
        np.testing.assert_array_equal(frame[still], frames[1][still])


def test_a_drag_multiplies_shapes_only_until_its_directions_are_known(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    rig = mixed_rig()
    deformer = Deformer(rig)
    products = 0
    product = rig.columns.product

    def counted(weights: Floats) -> Points:
        nonlocal products
        products += 1
        return product(weights)

    monkeypatch.setattr(rig.columns, "product", counted)
    random = np.random.default_rng(5)
    start, span = random.uniform(size=rig.shape_count), random.normal(size=(3, rig.shape_count))
    for at in random.normal(size=(100, 3)):
        deformer.deform(start + at @ span)
    assert products <= 4, "three directions and the way from the rest pose to the start"
    for weights in random.uniform(size=(100, rig.shape_count)):
        deformer.deform(weights)
    assert products <= 104 + MOST_DIRECTIONS, "and never more than once a frame"


def test_not_a_number_leaves_no_trace() -> None:
    rig = mixed_rig()
    deformer = Deformer(rig)
    weights = np.full(rig.shape_count, 0.5)
    deformer.deform(weights)
    bad = weights.copy()
    bad[3] = np.nan
    deformer.deform(bad)
    assert np.abs(deformer.deform(weights) - exact(rig, weights)).max() <= rounding(rig, weights)


def test_twins_are_independent() -> None:
    rig = mixed_rig()
    deformer = Deformer(rig)
    ones, halves = np.ones(rig.shape_count), np.full(rig.shape_count, 0.5)
    first = deformer.deform(ones)
    twin = deformer.twin()
    assert np.abs(twin.deform(halves) - exact(rig, halves)).max() <= rounding(rig, halves)
    assert deformer.deform(ones) is first
