"""Which shapes answer a hand: eyes and tongue have their own."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from facepin.core.mesh.pieces import Eyeball, eyeballs, pieces, turn_of
from facepin.core.rig import Rig
from facepin.core.shapes.answering import answering, gaze_shapes, tongue_shapes
from facepin.core.shapes.motion import shape_moves
from facepin.files.formats import open_rig
from facepin.resources import resource
from support.small_rigs import sheet


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


def without_names(rig: Rig) -> Rig:
    return replace(rig, shape_names=tuple(f"s{j}" for j in range(rig.shape_count)))


def in_one_part(rig: Rig) -> Rig:
    whole = replace(rig.parts[0], faces=range(len(rig.face_sizes)), triangles=range(len(rig.triangles)))
    return replace(rig, parts=(whole,))


@pytest.mark.parametrize("change", [without_names, in_one_part, lambda rig: in_one_part(without_names(rig))])
def test_geometry_tells_what_names_and_parts_do_not(face: Rig, change: Callable[[Rig], Rig]) -> None:
    changed = change(face)
    looks = {name for name in face.shape_names if name.startswith("eyeLook") and not name.endswith("_50")}
    tongues = {name for name in face.shape_names if name.startswith("tongue")}
    for found, wanted in ((gaze_shapes(changed), looks), (tongue_shapes(changed), tongues)):
        found_names = {face.shape_names[j] for j in np.flatnonzero(found)}
        assert wanted <= found_names
        # Corrections of such shapes are theirs too; nothing else is.
        assert {name for name in found_names - wanted if "Look" not in name and "Pupil" not in name} == set()
    lid = in_part(face, "skin", "eyeLookDownLeft")
    answers = answering(changed, [lid])
    assert answers[face.shape_names.index("eyeBlinkLeft")]
    assert not (answers & gaze_shapes(changed)).any()
    eye = in_part(face, "eyeL", "eyeLookOutLeft")
    assert answering(changed, [eye])[face.shape_names.index("eyeLookOutLeft")]


def test_lower_teeth_and_the_root_of_the_tongue_are_moved_by_the_jaw(face: Rig) -> None:
    tooth = names(face, answering(face, [in_part(face, "teethLower", "jawOpen")]))
    assert "jawOpen" in tooth and not tooth & {"tongueOut", "eyeLookInLeft"}
    (tongue,) = (part for part in face.parts if part.name == "tongue")
    vertices = np.unique(face.triangles[tongue.triangles.start : tongue.triangles.stop])
    root = int(vertices[np.argmin(face.neutral[vertices, 2])])
    assert {"jawOpen", "tongueOut"} <= names(face, answering(face, [root]))


@pytest.mark.parametrize(
    "name",
    ["eyeLookIn_L", "EyesLookLeft", "lookLeft", "x.eyelookupright", "eyelookinleft", "LookUp", "eyesUp"],
)
def test_names_in_any_spelling_say_that_the_eyes_turn(name: str) -> None:
    rig = replace(sheet(shapes=2), shape_names=(name, "smile"))
    assert gaze_shapes(rig).tolist() == [True, False]


@pytest.mark.parametrize("name", ["eyeBlink_L", "eyeUpperUpLeft", "eyes", "browUp", "up", "lookalike"])
def test_other_names_do_not(name: str) -> None:
    rig = replace(sheet(shapes=2), shape_names=(name, "lookLeft"))
    assert gaze_shapes(rig).tolist() == [False, True]


def test_names_in_any_spelling_say_tongue() -> None:
    rig = replace(sheet(), shape_names=("tongueOut", "tongueout", "Tongue_Up", "mouthOpen"))
    assert tongue_shapes(rig).tolist() == [True, True, True, False]


def test_the_rim_of_a_lid_that_a_file_cuts_off_at_the_socket_is_skin(shared: Path) -> None:
    rig = open_rig(shared / "models/ict-facekit/ict_full153.npz")
    parts = {
        part.name: np.unique(rig.triangles[part.triangles.start : part.triangles.stop]) for part in rig.parts
    }
    rim = np.intersect1d(parts["face"], parts["eye_socket_left"])
    assert len(rim)
    answers = names(rig, answering(rig, rim.tolist()))
    assert "eyeBlink_L" in answers and not {name for name in answers if "Look" in name}


@pytest.mark.parametrize("file", ["ict_expressions.glb", "ict_full153.npz"])
def test_ict_has_eyeballs_that_nothing_moves_and_lids_that_do_not_answer_with_the_gaze(
    shared: Path, file: str
) -> None:
    rig = open_rig(shared / "models/ict-facekit" / file)
    assert names(rig, gaze_shapes(rig)) == {
        f"eyeLook{way}_{side}" for way in ("In", "Out", "Up", "Down") for side in "LR"
    }
    assert not tongue_shapes(rig).any()
    left, right = eyeballs(rig, pieces(rig))
    assert left.centre == pytest.approx([3.12, 3.6, 7.98], abs=0.2)
    assert right.centre == pytest.approx([-3.12, 3.6, 7.98], abs=0.2)
    for shape in ("eyeLookDown_L", "eyeLookUp_R"):
        lid = int(np.argmax(shape_moves(rig, rig.shape_names.index(shape))))
        answers = names(rig, answering(rig, [lid]))
        assert not {name for name in answers if "Look" in name}
        assert answers & {"eyeBlink_L", "eyeBlink_R"}
    # Without names nothing tells them from other shapes of the lids: they answer like those.
    assert not gaze_shapes(without_names(rig)).any()


def test_a_rotation_of_an_eyeball_is_measured() -> None:
    rest = np.random.default_rng(3).normal(size=(200, 3))
    rest /= np.linalg.norm(rest, axis=1)[:, None]
    eye = Eyeball(np.zeros(3), 1.0, np.arange(200))
    turn = np.array([0.2, -0.4, 0.1])
    moved = Rotation.from_rotvec(turn).apply(rest)
    rotation, misfit = turn_of(eye, rest, moved)
    assert rotation == pytest.approx(turn) and misfit < 1e-6
    _, misfit = turn_of(eye, rest, rest + np.array([0.3, 0, 0]))
    assert misfit > 0.9


def test_a_shape_of_the_whole_face_is_no_gaze_though_it_is_called_a_look(face: Rig) -> None:
    names_ = tuple("look_old" if name == "jawOpen" else name for name in face.shape_names)
    changed = replace(face, shape_names=names_)
    assert not gaze_shapes(changed)[names_.index("look_old")]
