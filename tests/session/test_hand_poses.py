"""A few drags, and the shapes that an animator would have named: on a built-in face and on a real one."""

from pathlib import Path

import numpy as np
import pytest

from facepin.core.pose import FRONT_AXES, Pin, as_vector
from facepin.core.rig import Rig
from facepin.core.shapes.motion import shape_moves
from facepin.core.shapes.places import find_places
from facepin.files.formats import open_rig
from facepin.resources import resource
from facepin.session.edit import Edit
from facepin.session.session import Session
from facepin.session.solving.solving import choose

ICT = Path(__file__).resolve().parents[3] / "shared/models/ict-facekit/ict_expressions.glb"
Move = tuple[float, float]


@pytest.fixture(scope="module", params=["ada", "ict"])
def rig(request: pytest.FixtureRequest) -> Rig:
    if request.param == "ada":
        return open_rig(resource("assets", "faces/ada.npz"))
    if not ICT.exists():
        pytest.skip("needs ict_expressions.glb, which is not part of the project")
    return open_rig(ICT)


def spelled(name: str) -> str:
    """A name as both faces spell it: mouthSmile_L."""
    return name.removesuffix("Left") + "_L" if name.endswith("Left") else name.replace("Right", "_R")


class Hand:
    """Drags points of a face, seen from the front, from the neutral."""

    def __init__(self, rig: Rig) -> None:
        self.rig, self.session = rig, Session(rig, [choose("hand")])
        self.names = [spelled(name) for name in rig.shape_names]

    def drag(self, *points: tuple[str, Move]) -> "Hand":
        """Drag the points that shapes move most, all at once, by shares of the face height."""
        pins = {pin.vertex: pin for pin in self.session.pose.pins}
        positions = self.rig.evaluate(self.session.pose.weights).astype(float)
        for shape, move in points:
            vertex = int(np.argmax(shape_moves(self.rig, self.names.index(shape))))
            goal = positions[vertex] + self.rig.height * np.array([*move, 0.0])
            pins[vertex] = Pin(vertex, as_vector(goal), "screen", FRONT_AXES)
        self.session.apply(Edit("Drag pins", True, tuple(pins.values()), solve=True))
        return self

    def used(self, least: float = 0.35) -> set[str]:
        """Names of the shapes in use."""
        weights = self.session.pose.weights
        return {name for name, weight in zip(self.names, weights, strict=True) if weight > least}


def both(shape: str, move: Move) -> tuple[tuple[str, Move], tuple[str, Move]]:
    """The point on the left and its twin."""
    return (f"{shape}_L", move), (f"{shape}_R", (-move[0], move[1]))


def test_two_corners_up_and_out_are_a_smile(rig: Rig) -> None:
    assert Hand(rig).drag(*both("mouthSmile", (0.02, 0.03))).used() == {"mouthSmile_L", "mouthSmile_R"}


def test_one_corner_is_a_smile_of_one_side_and_not_a_mouth_that_slides(rig: Rig) -> None:
    used = Hand(rig).drag(("mouthSmile_L", (0.02, 0.03))).used(0.2)
    assert "mouthSmile_L" in used
    assert not any(name.endswith("_R") or name in ("mouthLeft", "jawLeft", "jawOpen") for name in used)


def test_the_chin_pulled_down_opens_the_jaw(rig: Rig) -> None:
    assert Hand(rig).drag(("jawOpen", (0.0, -0.05))).used() == {"jawOpen"}


def test_lids_pulled_down_blink(rig: Rig) -> None:
    assert Hand(rig).drag(*both("eyeBlink", (0.0, -0.04))).used(0.1) == {"eyeBlink_L", "eyeBlink_R"}


def test_brows_up_and_chin_down_are_a_surprise(rig: Rig) -> None:
    hand = Hand(rig).drag(*both("browOuterUp", (0.0, 0.03))).drag(("jawOpen", (0.0, -0.05)))
    assert {"browOuterUp_L", "browOuterUp_R", "jawOpen"} <= hand.used()
    assert not any(name.startswith(("mouthSmile", "noseSneer", "tongue")) for name in hand.used(0.1))


def test_the_nostril_pulled_up_sneers_on_its_side(rig: Rig) -> None:
    used = Hand(rig).drag(("noseSneer_L", (0.0, 0.02))).used()
    assert used == {"noseSneer_L"}


def test_corners_pulled_in_are_a_kiss(rig: Rig) -> None:
    assert "mouthPucker" in Hand(rig).drag(*both("mouthSmile", (-0.03, 0.0))).used()


def test_shapes_that_cancel_each_other_out_are_hardly_ever_used_at_once(rig: Rig) -> None:
    random = np.random.default_rng(3)
    against = rig.sentinels.likeness < -0.3
    drags = fights = 0
    for vertex in random.choice(np.flatnonzero(find_places(rig).moved), 20, replace=False).tolist():
        rest = rig.neutral[vertex].astype(float)
        for way in ((1, 0), (-1, 0), (0, 1), (0, -1)):
            session = Session(rig, [choose("hand")])
            goal = rest + 0.03 * rig.height * np.array([*way, 0])
            session.apply(
                Edit("Drag", True, (Pin(vertex, as_vector(goal), "screen", FRONT_AXES),), solve=True)
            )
            used = session.pose.weights > 0.1
            drags, fights = drags + 1, fights + bool(against[np.ix_(used, used)].any())
    assert fights <= 0.05 * drags
