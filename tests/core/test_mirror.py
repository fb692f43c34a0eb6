"""Left and right: twins of shapes, vertices and pins."""

from pathlib import Path

import numpy as np
import pytest

from facepin.core.pose import Pin, Pose
from facepin.core.rig import Rig
from facepin.core.rig_builder import build_rig
from facepin.core.shapes.mirror import Mirror, find_mirror, swapped
from facepin.files import open_rig
from facepin.resources import resource
from facepin.session.hand.mirroring import flipped_pose, linked_weights, mirrored_weights, with_twins
from facepin.session.solving.solving import PinSolver, choose


@pytest.fixture(scope="module")
def ada() -> Rig:
    return open_rig(resource("assets", "faces/ada.npz"))


@pytest.fixture(scope="module")
def mirror(ada: Rig) -> Mirror:
    return find_mirror(ada)


@pytest.mark.parametrize(
    ("name", "other"),
    [
        ("eyeBlink_L", "eyeBlink_R"),
        ("eyeBlinkLeft", "eyeBlinkRight"),
        ("LeftEye", "RightEye"),
        ("l_brow", "r_brow"),
        ("brow.R", "brow.L"),
        ("browInnerUpL", "browInnerUpR"),
        ("EYE_LEFT", "EYE_RIGHT"),
        ("mouthSmileLeft_cheekSquintLeft", "mouthSmileRight_cheekSquintRight"),
        ("eyeBlinkLeft_50", "eyeBlinkRight_50"),
        ("Leftover", "Leftover"),
        ("upperLip", "upperLip"),
        ("jawOpen", "jawOpen"),
    ],
)
def test_names_of_twins(name: str, other: str) -> None:
    assert swapped(name) == other
    assert swapped(other) == name


def test_the_built_in_face_has_a_twin_for_everything(ada: Rig, mirror: Mirror) -> None:
    assert (mirror.vertices >= 0).all()
    np.testing.assert_allclose(ada.neutral[mirror.vertices] * (-1, 1, 1), ada.neutral, atol=1e-3)
    names = [ada.shape_names[j] for j in mirror.shapes]
    assert names == [swapped(name) for name in ada.shape_names]
    assert not mirror.remarks
    assert mirror.balance[ada.shape_names.index("eyeBlinkLeft")] > 0.9
    assert abs(mirror.balance[ada.shape_names.index("jawOpen")]) < 0.05


def test_a_real_face(shared: Path) -> None:
    rig = open_rig(shared / "models/ict-facekit/ict_expressions.glb")
    mirror = find_mirror(rig)
    assert (mirror.vertices >= 0).mean() > 0.99
    assert [rig.shape_names[j] for j in mirror.shapes] == [swapped(name) for name in rig.shape_names]
    known = mirror.vertices >= 0
    np.testing.assert_array_equal(rig.neutral[mirror.vertices[mirror.vertices[known]]], rig.neutral[known])


def plane(names: list[str], deltas: list[np.ndarray]) -> Rig:
    """A symmetric strip of seven points from x = −3 to 3."""
    points = np.array([(x, y, 0.0) for x in range(-3, 4) for y in (0, 1)], np.float64)
    faces = [(2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1) for i in range(6)]
    return build_rig(
        "strip", points, np.array(faces).ravel(), np.full(6, 4), list(zip(names, deltas, strict=True))
    )


def lift(*columns: int) -> np.ndarray:
    delta = np.zeros((14, 3))
    for x in columns:
        delta[2 * (x + 3) : 2 * (x + 3) + 2, 1] = 1 + 0.1 * abs(x)
    return delta


def test_geometry_overrules_names_and_stands_in_for_them() -> None:
    rig = plane(
        ["smile_L", "smile_R", "one", "two", "both"], [lift(3), lift(3), lift(2), lift(-2), lift(1, -1)]
    )
    mirror = find_mirror(rig)
    assert mirror.shapes.tolist() == [-1, -1, 3, 2, 4]
    assert "smile_L and smile_R" in mirror.remarks[0]
    edited = mirror.paired(0, 1)
    assert edited.shapes.tolist() == [1, 0, 3, 2, 4]
    assert edited.paired(0, 2).shapes.tolist() == [2, -1, 0, -1, 4]
    assert edited.parted(1).shapes.tolist() == [-1, -1, 3, 2, 4]
    assert mirror.paired(0, 0).shapes.tolist() == [0, -1, 3, 2, 4]


def lips(seed: int = 0) -> tuple[Rig, np.ndarray]:
    """Two strips that touch along y = 0 with a vertex of each at every place there, numbered by chance."""
    x = np.arange(-4.0, 5.0)
    points = np.array([(a, b, 0.0) for b in (1, 0, 0, -1) for a in x])
    upper = np.arange(len(points)) < 2 * len(x)
    quads = [
        (row + i, row + i + 1, row + i + 10, row + i + 9)
        for row in (0, 2 * len(x))
        for i in range(len(x) - 1)
    ]
    order = np.random.default_rng(seed).permutation(len(points))
    back = np.argsort(order)
    jaw, lift_left, lift_right = np.zeros((3, len(points), 3))
    jaw[~upper, 1] = -0.5
    lift_left[:, 1] = upper * np.maximum(points[:, 0], 0) / 8
    lift_right[:, 1] = upper * np.maximum(-points[:, 0], 0) / 8
    shapes = [("jawOpen", jaw[order]), ("lift_L", lift_left[order]), ("lift_R", lift_right[order])]
    rig = build_rig("lips", points[order], back[np.array(quads).ravel()], np.full(len(quads), 4), shapes)
    return rig, upper[order]


@pytest.mark.parametrize("seed", range(4))
def test_the_twin_of_a_lip_is_on_the_same_lip_where_both_touch(seed: int) -> None:
    rig, upper = lips(seed)
    mirror = find_mirror(rig)
    np.testing.assert_array_equal(upper[mirror.vertices], upper)
    np.testing.assert_array_equal(mirror.vertices[mirror.vertices], np.arange(rig.vertex_count))
    assert mirror.shapes.tolist() == [0, 2, 1]


def test_hair_on_one_side_does_not_move_the_middle(ada: Rig, mirror: Mirror) -> None:
    height, count = ada.height, ada.vertex_count
    bun = np.random.default_rng(1).normal(0, 0.1, (count // 3, 3)) * height + (0.6 * height, 0.2 * height, 0)
    faces = count + np.arange(len(bun) // 3 * 3)
    deltas = ada.deltas.tocsc()[:, : ada.shape_count].toarray().T.reshape(ada.shape_count, count, 3)
    rig = build_rig(
        "bun",
        np.concatenate([ada.neutral, bun]),
        np.concatenate([ada.corners, faces]),
        np.concatenate([ada.face_sizes, np.full(len(faces) // 3, 3)]),
        ((name, (np.arange(count), delta)) for name, delta in zip(ada.shape_names, deltas, strict=True)),
    )
    found = find_mirror(rig)
    assert found.middle == mirror.middle
    np.testing.assert_array_equal(found.shapes, mirror.shapes)
    np.testing.assert_array_equal(found.vertices[:count], mirror.vertices)


def test_names_alone_pair_shapes_of_a_mesh_that_is_not_symmetric() -> None:
    points = np.random.default_rng(2).uniform(-1, 1, (60, 3))
    names = ["browUpLeft", "browUpRight", "smile_R", "smile_L", "jawOpen"]
    shapes = [(name, np.random.default_rng(j).normal(0, 0.1, (60, 3))) for j, name in enumerate(names)]
    mirror = find_mirror(build_rig("clay", points, np.arange(60), np.full(20, 3), shapes))
    assert mirror.shapes[:4].tolist() == [1, 0, 3, 2]
    assert not mirror.remarks
    np.testing.assert_array_equal(mirror.flipped(np.arange(5.0)), [1, 0, 3, 2, 4])


def test_a_rig_without_motion() -> None:
    rig = plane(["nothing"], [np.zeros((14, 3))])
    mirror = find_mirror(rig)
    assert mirror.shapes.tolist() == [-1]
    assert not mirror.flipped(np.zeros(1)).any()


def test_a_flipped_pose_is_the_mirror_image(ada: Rig, mirror: Mirror) -> None:
    rng = np.random.default_rng(3)
    pose = Pose(rng.uniform(0, 1, ada.shape_count))
    flipped = flipped_pose(mirror, pose)
    image = ada.evaluate(pose.weights)[mirror.vertices] * (-1, 1, 1)
    np.testing.assert_allclose(ada.evaluate(flipped.weights), image, atol=2e-3)
    np.testing.assert_array_equal(flipped_pose(mirror, flipped).weights, pose.weights)


def test_a_flipped_pin_holds_the_mirrored_place(ada: Rig, mirror: Mirror) -> None:
    right = int(np.argmin(ada.neutral[:, 0]))
    pin = Pin(right, (-1.0, 2.0, 3.0), "screen", ((0.8, 0.0, -0.6), (0.0, 1.0, 0.0)))
    (flipped,) = flipped_pose(mirror, Pose(np.zeros(ada.shape_count), (pin,))).pins
    assert flipped.vertex == mirror.vertices[right]
    assert flipped.goal == (1.0, 2.0, 3.0)
    assert flipped.axes[0] == (-0.8, 0.0, -0.6)


@pytest.mark.parametrize("way", ["left to right", "right to left"])
def test_a_mirrored_pose_is_symmetric(ada: Rig, mirror: Mirror, way: str) -> None:
    rng = np.random.default_rng(4)
    weights = rng.uniform(0, 1, ada.shape_count)
    result = mirrored_weights(mirror, weights, way)
    np.testing.assert_array_equal(mirror.flipped(result), result)
    source = ada.shape_names.index("mouthSmileLeft" if way == "left to right" else "mouthSmileRight")
    assert result[source] == weights[source] == result[mirror.shapes[source]]
    jaw = [ada.shape_names.index(name) for name in ("jawLeft", "jawRight")]
    assert result[jaw[0]] == result[jaw[1]] == weights[jaw].min()
    alone = ada.shape_names.index("jawOpen")
    assert result[alone] == weights[alone]


def test_linked_sliders_change_together_and_nothing_else(ada: Rig, mirror: Mirror) -> None:
    before = np.random.default_rng(5).uniform(0, 1, ada.shape_count)
    after = before.copy()
    left, right = (ada.shape_names.index(f"eyeBlink{side}") for side in ("Left", "Right"))
    after[left] = 0.25
    result = linked_weights(mirror, before, after)
    assert result[left] == result[right] == 0.25
    others = np.delete(np.arange(len(before)), [left, right])
    np.testing.assert_array_equal(result[others], before[others])


@pytest.mark.parametrize("solver", ["pseudo_inverse", "tikhonov", "transpose", "hybrid", "sparse", "bounded"])
def test_a_pin_and_its_twin_make_a_symmetric_face(ada: Rig, mirror: Mirror, solver: str) -> None:
    smile = ada.rows_at(range(ada.vertex_count))[:, ada.shape_names.index("mouthSmileLeft")].reshape(-1, 3)
    corner = int(np.argmax(np.linalg.norm(smile, axis=1)))
    place = ada.neutral[corner].astype(float)
    placed = (Pin(corner, tuple(place.tolist())),)
    pins = with_twins(mirror, (), placed, ada.neutral)
    assert {pin.vertex for pin in pins} == {corner, int(mirror.vertices[corner])}
    dragged = (Pin(corner, tuple(np.add(place, (0.3, 0.5, 0.1)).tolist())), *pins[1:])
    pins = with_twins(mirror, pins, dragged, ada.neutral)
    np.testing.assert_allclose(pins[1].goal, mirror.across(np.array(pins[0].goal)), atol=1e-4)
    weights = PinSolver(ada, choose(solver)).solve(pins, np.zeros(ada.shape_count)).weights
    assert np.abs(weights).max() > 0.05
    np.testing.assert_allclose(mirror.flipped(weights), weights, atol=2e-3 * np.abs(weights).max())


def test_pins_on_the_middle_stay_there_and_the_held_side_leads(ada: Rig, mirror: Mirror) -> None:
    middle = int(np.flatnonzero(mirror.vertices == np.arange(ada.vertex_count))[0])
    start = (Pin(middle, (0.0, 1.0, 2.0)),)
    (pin,) = with_twins(mirror, start, (Pin(middle, (0.7, 1.5, 2.5)),), ada.neutral)
    assert pin.goal == (0.0, 1.5, 2.5)
    left = int(np.argmax(ada.neutral[:, 0]))
    right = int(mirror.vertices[left])
    both = (Pin(left, (1.0, 0.0, 0.0)), Pin(right, (-1.0, 0.0, 0.0)))
    moved = (Pin(left, (1.5, 0.2, 0.0)), Pin(right, (-0.5, 0.2, 0.0)))
    result = {pin.vertex: pin.goal for pin in with_twins(mirror, both, moved, ada.neutral)}
    assert result == {left: (1.5, 0.2, 0.0), right: (-1.5, 0.2, 0.0)}
