"""The eyes: shapes that turn them, and the weights that make them look somewhere."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facepin.core.control import ShapeControl
from facepin.core.rig import Rig
from facepin.core.shapes.gaze import Gaze, aimed, find_gaze, look, named_turns
from facepin.files.formats import open_rig
from facepin.resources import resource
from support.small_rigs import sheet

ICT = "models/ict-facekit/ict_expressions.glb"


@pytest.fixture(scope="module", params=["ada", "bruno", "mira"])
def face(request: pytest.FixtureRequest) -> Rig:
    return open_rig(resource("assets", f"faces/{request.param}.npz"))


def gaze_of(rig: Rig) -> Gaze:
    gaze = find_gaze(rig)
    assert gaze is not None
    return gaze


@pytest.mark.parametrize(
    ("name", "turns"),
    [
        ("eyeLookInLeft", [("left", "right")]),
        ("eyeLookIn_R", [("right", "left")]),
        ("EyeLookOutRight", [("right", "right")]),
        ("head_blendShape.eyeLookOut_L", [("left", "left")]),
        ("eyelookdownleft", [("left", "down")]),
        ("L_eye_look_up", [("left", "up")]),
        ("eyeLookLeft_R", [("right", "left")]),
        ("lookUp", [("left", "up"), ("right", "up")]),
        ("LookRight", [("left", "right"), ("right", "right")]),
        ("eyesDown", [("left", "down"), ("right", "down")]),
        ("eyesClosed", []),
        ("eyeLookUpLeft_50", []),
        ("eyeLookIn", []),
        ("look", []),
        ("outlookLeft", []),
        ("eyeBlinkLeft", []),
        ("mouthLeft", []),
    ],
)
def test_names_say_which_eye_turns_which_way(name: str, turns: list[tuple[str, str]]) -> None:
    assert named_turns(name) == turns


def test_eyes_that_turn_are_measured(face: Rig) -> None:
    gaze = gaze_of(face)
    left, right = gaze.eyes
    assert left[0] > 0 > right[0] and left[1:] == pytest.approx(right[1:], abs=0.01)
    assert gaze.forward == 1
    names = [face.shape_names[j] for j in gaze.shapes[0]]
    assert names == ["eyeLookOutLeft", "eyeLookInLeft", "eyeLookUpLeft", "eyeLookDownLeft"]
    names = [face.shape_names[j] for j in gaze.shapes[1]]
    assert names == ["eyeLookInRight", "eyeLookOutRight", "eyeLookUpRight", "eyeLookDownRight"]
    # The pupil is the foremost vertex: where it goes is the angle, measured another way.
    pupil = int(np.argmax(np.where(np.abs(face.neutral[:, :2] - left[:2]).max(axis=1) < 0.3, 1, 0)))
    (eye,) = (part for part in face.parts if part.name == "eyeL")
    vertices = np.unique(face.triangles[eye.triangles.start : eye.triangles.stop])
    pupil = int(vertices[np.argmax(face.neutral[vertices, 2])])
    for way, axis in ((0, 0), (1, 0), (2, 1), (3, 1)):
        weights = np.zeros(face.shape_count)
        weights[gaze.shapes[0, way]] = 1
        x, y, z = face.evaluate(weights)[pupil] - left
        angle = np.arctan2(abs((x, y)[axis]), z)
        assert gaze.angles[0, way] == pytest.approx(angle, abs=0.03)


def test_eyes_that_stand_still_turn_as_is_customary(shared: Path) -> None:
    gaze = gaze_of(open_rig(shared / ICT))
    assert np.degrees(gaze.angles) == pytest.approx(np.array([[30, 30, 25, 30]] * 2))
    assert gaze.eyes[0] == pytest.approx([3.12, 3.6, 7.98], abs=0.1)


@pytest.mark.parametrize("yaw", [-0.3, 0.0, 0.2])
@pytest.mark.parametrize("pitch", [-0.2, 0.0, 0.25])
def test_eyes_look_where_they_are_aimed_and_never_two_ways_at_once(
    face: Rig, yaw: float, pitch: float
) -> None:
    gaze, control = gaze_of(face), ShapeControl.of(face)
    before = np.random.default_rng(1).uniform(0, 1, face.shape_count)
    weights = aimed(gaze, before, yaw, pitch, control)
    assert look(gaze, weights) == pytest.approx(np.array([[yaw, pitch]] * 2))
    assert gaze.angles_to(gaze.handle(weights)) == pytest.approx((yaw, pitch))
    for one, other in (0, 1), (2, 3):
        assert not (weights[gaze.shapes[:, one]] * weights[gaze.shapes[:, other]]).any()
    others = np.setdiff1d(np.arange(face.shape_count), gaze.shapes)
    assert np.array_equal(weights[others], before[others])


def test_weights_end_at_their_limits(face: Rig) -> None:
    gaze, control = gaze_of(face), ShapeControl.of(face)
    weights = aimed(gaze, np.zeros(face.shape_count), 1.2, -1.2, control)
    assert weights[gaze.shapes[:, [0, 3]]] == pytest.approx(1.0)
    assert weights[gaze.shapes[:, [1, 2]]] == pytest.approx(0.0)


def test_a_locked_shape_stays_and_its_opposite_makes_up_for_it(face: Rig) -> None:
    gaze = gaze_of(face)
    before = np.zeros(face.shape_count)
    locked = np.zeros(face.shape_count, np.bool_)
    before[gaze.shapes[0, 0]], locked[gaze.shapes[0, 0]] = 0.5, True
    weights = aimed(gaze, before, -0.1, 0.0, replace(ShapeControl.of(face), locked=locked))
    assert weights[gaze.shapes[0, 0]] == 0.5
    assert look(gaze, weights)[:, 0] == pytest.approx(-0.1)


def test_one_shape_for_both_eyes(face: Rig) -> None:
    """VRM's lookLeft turns both; made here of what the eyes of the face have."""
    gaze = gaze_of(face)
    names = list(face.shape_names)
    for j in gaze.shapes.ravel():
        names[j] = f"was {j}"
    for way, name in enumerate(("lookLeft", "lookRight", "lookUp", "lookDown")):
        names[gaze.shapes[0, way]] = name
    both = gaze_of(replace(face, shape_names=tuple(names)))
    assert np.array_equal(both.shapes[0], both.shapes[1])
    weights = aimed(both, np.zeros(face.shape_count), 0.1, 0.1, ShapeControl.of(face))
    assert np.count_nonzero(weights) == 2


def test_a_face_without_such_shapes_has_no_gaze(face: Rig) -> None:
    assert find_gaze(sheet()) is None
    assert find_gaze(replace(face, shape_names=tuple(f"s{j}" for j in range(face.shape_count)))) is None
