"""Faces are set upright, and come back bit by bit."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from facepin.core.look.upright import upright
from facepin.core.rig import Rig
from facepin.core.turn import AS_IN_FILE, QUARTERS, Turn, after, back, facing, parse_turn, turn_points
from support.small_rigs import ball, rig_of, sheet

TURNS: list[Turn] = sorted(
    {
        after(after(x, y), z)
        for x, y, z in product(
            (AS_IN_FILE, QUARTERS["x"], after(QUARTERS["x"], QUARTERS["x"]), back(QUARTERS["x"])),
            (AS_IN_FILE, QUARTERS["y"], after(QUARTERS["y"], QUARTERS["y"]), back(QUARTERS["y"])),
            (AS_IN_FILE, QUARTERS["z"]),
        )
    }
)


def head(names: tuple[str, ...] = ("jawOpen", "eyeBlinkLeft", "eyeBlinkRight")) -> Rig:
    """A ball that looks along z, whose chin falls and whose lids close."""
    points, faces = ball((0, 1, 0), 1.0, rows=20)
    shapes = []
    for x, y, size in ((0.0, -0.5, 0.5), (0.35, 0.3, 0.25), (-0.35, 0.3, 0.25)):
        middle = np.array([x, 1 + y, np.sqrt(1 - x * x - y * y)])
        near = np.maximum(1 - np.linalg.norm(points - middle, axis=1) / size, 0)
        shapes.append(near[:, None] * np.array([0.0, -0.2, 0.02]))
    rig = rig_of("head", points, faces, np.stack(shapes))
    return replace(rig, shape_names=names)


@pytest.mark.parametrize("turn", TURNS)
def test_turning_back_gives_every_bit_back(turn: Turn) -> None:
    rig = sheet()
    again = rig.turned(turn).turned(back(turn))
    assert again.neutral.tobytes() == rig.neutral.tobytes()
    assert again.deltas.data.tobytes() == rig.deltas.data.tobytes()
    assert again.deltas.indices.tolist() == rig.deltas.indices.tolist()
    assert again.turn == AS_IN_FILE
    assert rig.turned(turn).fingerprint == rig.fingerprint, "it is the same face, however it lies"


@pytest.mark.parametrize("turn", TURNS)
def test_a_pose_turns_with_the_face(turn: Turn) -> None:
    rig, weights = sheet(), np.array([0.2, 0.9, 0.0, 0.5])
    posed = rig.turned(turn).evaluate(weights)
    np.testing.assert_allclose(posed, turn_points(rig.evaluate(weights), turn), atol=1e-6)
    x, y, z = np.eye(3, dtype=np.float32) @ turn_points(np.eye(3, dtype=np.float32), turn)
    assert np.cross(x, y) @ z == pytest.approx(1), "a turn, and no mirror image"


def test_there_are_as_many_turns_as_a_cube_has() -> None:
    assert len(TURNS) == 24


@pytest.mark.parametrize("lies", [turn for turn in TURNS if turn_points([[0, 1, 0]], turn)[0, 1] > -0.5])
def test_a_face_is_set_upright_by_what_its_shapes_do(lies: Turn) -> None:
    turned = head().turned(lies)
    assert after(lies, upright(turned)) == AS_IN_FILE


@pytest.mark.parametrize("lies", TURNS)
def test_what_nothing_is_known_of_is_left_as_it_is(lies: Turn) -> None:
    assert upright(head(("one", "two", "three")).turned(lies)) == AS_IN_FILE
    assert upright(sheet().turned(lies)) == AS_IN_FILE


def test_a_file_that_says_where_the_front_is_is_believed_unless_the_face_is_elsewhere() -> None:
    said = replace(sheet(), up=(0.0, 1.0, 0.0), front=(0.0, 0.0, -1.0))
    assert upright(said) == (-1, 2, -3)
    backwards = head(("one", "two", "three")).turned((-1, 2, -3))
    assert upright(replace(backwards, up=(0.0, 1.0, 0.0), front=(0.0, 0.0, -1.0))) == (-1, 2, -3)
    wrongly = replace(head(), up=(0.0, 1.0, 0.0), front=(0.0, 0.0, -1.0))
    assert upright(wrongly) == AS_IN_FILE, "what moves is in front, whatever the file says"


def test_an_axis_that_lies_between_two_is_none() -> None:
    assert facing((0, 1, 1), (1, 0, 0)) is None
    assert facing((0, 1, 0), (0, -1, 0)) is None
    assert facing((0, 2, 0.1), (0.1, 0, 3)) == AS_IN_FILE


@pytest.mark.parametrize(
    ("text", "turn"),
    [
        ("file", AS_IN_FILE),
        ("x90", QUARTERS["x"]),
        ("x-90", (1, 3, -2)),
        ("x90,x270", AS_IN_FILE),
        ("y180", (-1, 2, -3)),
    ],
)
def test_turns_are_written_as_quarters(text: str, turn: Turn) -> None:
    assert parse_turn(text) == turn


@pytest.mark.parametrize("text", ["", "x", "x45", "w90", "x90;y90", "x90,"])
def test_other_turns_are_refused(text: str) -> None:
    with pytest.raises(ValueError, match="allowed"):
        parse_turn(text)
