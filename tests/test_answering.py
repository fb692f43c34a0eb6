"""Which shapes answer a hand: eyes and tongue have their own."""

from dataclasses import replace

import numpy as np
import pytest

from facepin.core.answering import answering, gaze_shapes, tongue_shapes
from facepin.core.rig import Rig
from facepin.core.shape_motion import shape_moves
from facepin.files.formats import open_rig
from facepin.resources import resource
from small_rigs import sheet


@pytest.fixture(scope="module", params=["ada", "bruno", "mira"])
def face(request: pytest.FixtureRequest) -> Rig:
    return open_rig(resource("assets", f"faces/{request.param}.npz"))


def in_part(rig: Rig, part: str, shape: str) -> int:
    """The vertex of a part that a shape moves most."""
    (found,) = (each for each in rig.parts if each.name == part)
    vertices = np.unique(rig.triangles[found.triangles.start : found.triangles.stop])
    return int(vertices[np.argmax(shape_moves(rig, rig.shape_names.index(shape))[vertices])])


def names(rig: Rig, flags: np.ndarray) -> set[str]:
    return {name for name, flag in zip(rig.shape_names, flags, strict=True) if flag}


def test_shapes_of_gaze_and_tongue_are_known_by_their_names(face: Rig) -> None:
    assert {name for name in face.shape_names if name.startswith("eyeLook")} <= names(face, gaze_shapes(face))
    assert not {"eyeBlinkLeft", "jawOpen", "mouthLeft"} & names(face, gaze_shapes(face))
    assert "tongueOut" in names(face, tongue_shapes(face))


@pytest.mark.parametrize("shape", ["eyeBlinkLeft", "jawOpen", "mouthSmileRight", "browInnerUp"])
def test_skin_is_answered_by_its_own_shapes(face: Rig, shape: str) -> None:
    if shape not in face.shape_names:
        pytest.skip(f"this face has no {shape}")
    skin = in_part(face, "skin", shape) if any(p.name == "skin" for p in face.parts) else None
    vertex = int(np.argmax(shape_moves(face, face.shape_names.index(shape)))) if skin is None else skin
    answers = answering(face, [vertex])
    assert answers[face.shape_names.index(shape)]
    assert not (answers & (gaze_shapes(face) | tongue_shapes(face))).any()


def test_an_eye_is_answered_by_the_gaze_and_a_tongue_by_its_own(face: Rig) -> None:
    eye = int(np.argmax(shape_moves(face, face.shape_names.index("eyeLookOutLeft"))))
    answers = names(face, answering(face, [eye]))
    assert "eyeLookOutLeft" in answers and "eyeBlinkLeft" not in answers
    tongue = int(np.argmax(shape_moves(face, face.shape_names.index("tongueOut"))))
    answers = names(face, answering(face, [tongue]))
    assert "tongueOut" in answers and "mouthSmileLeft" not in answers


def test_where_names_say_nothing_all_shapes_answer() -> None:
    assert answering(sheet(), [40]).all()
    looking = replace(sheet(), shape_names=("lookLeft", "lookRight", "lookUp", "tongue"))
    assert answering(looking, [40]).any()
