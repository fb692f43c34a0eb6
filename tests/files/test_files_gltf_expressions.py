"""Expressions of avatars are poses of the library."""

import numpy as np
import pytest

from facepin.core.errors import FacepinError
from facepin.core.pose import Pose
from facepin.desk.library import Library
from facepin.files import open_rig
from facepin.session.session import Session
from facepin.session.solving.solving import choose
from support.sample_files import SMILE, face_gltf


def avatar(path, extensions, teeth=("smile",)):
    gltf = face_gltf()
    primitive = gltf.primitive([gltf.accessor(SMILE) for _ in teeth])
    gltf.node(mesh=gltf.mesh([primitive], list(teeth)))
    gltf.json["extensions"] = extensions
    return open_rig(gltf.save(path / "face.vrm"))


def vrm0(*groups):
    return {"VRM": {"blendShapeMaster": {"blendShapeGroups": list(groups)}}}


def found(rig):
    return [(title, weights.tolist()) for title, weights in rig.poses]


def bind(index, weight, mesh=0):
    return {"mesh": mesh, "index": index, "weight": weight}


JOY = {"name": "Joy", "presetName": "joy", "binds": [bind(0, 40), bind(1, 80), bind(0, 40, mesh=1)]}


def test_expressions_of_vrm_0(tmp_path):
    groups = [
        JOY,
        {"name": "", "presetName": "blink", "binds": [bind(1, 100)]},
        {"name": "Neutral", "binds": []},
        {"name": "Glow", "materialValues": [{}]},
        {"name": "Elsewhere", "binds": [bind(0, 100, mesh=7), bind(9, 100), bind(0, 100, mesh=-1)]},
    ]
    rig = avatar(tmp_path, vrm0(*groups))
    assert found(rig) == [("Joy", [0.4, 0.8]), ("blink", [0.0, 1.0])]
    assert rig.warnings == ()


def test_expressions_of_vrm_1(tmp_path):
    happy = {"morphTargetBinds": [{"node": 0, "index": 0, "weight": 0.5}]}
    wink = {"morphTargetBinds": [{"node": 0, "index": 1, "weight": 1.0}]}
    extensions = {"VRMC_vrm": {"expressions": {"preset": {"happy": happy}, "custom": {"wink": wink}}}}
    assert found(avatar(tmp_path, extensions)) == [("happy", [0.5, 0.0]), ("wink", [0.0, 1.0])]


@pytest.mark.parametrize("fault", [bind("x", 1), bind(0, "1"), bind(0, 1e300), {}])
def test_a_faulty_expression_is_left_out_and_told(tmp_path, fault):
    rig = avatar(tmp_path, vrm0({"name": "Bad", "binds": [fault]}, JOY))
    assert found(rig) == [("Joy", [0.4, 0.8])]
    (line,) = rig.warnings
    assert line.startswith("the expression Bad is left out: face.vrm: extensions.VRM")


def test_they_stand_in_the_library_and_become_files_when_they_are_changed(tmp_path):
    rig = avatar(tmp_path, vrm0(JOY, {"name": "A", "binds": [bind(0, 100)]}))
    session, folder = Session(rig, [choose("transpose")]), tmp_path / "face.poses"
    library = Library(session, folder, "")
    library.read_all()
    assert [(pose.title, pose.weights.tolist()) for pose in library.poses] == [
        ("A", [1.0, 0.0]),
        ("Joy", [0.4, 0.8]),
    ]
    assert not folder.exists()
    library.save(Pose(np.array([0.0, 0.3])), "Joy", ())
    assert sorted(path.name for path in folder.iterdir()) == ["Joy 2.json"]
    (folder / "Joy 2.json").rename(folder / "Joy.json")
    again = Library(session, folder, "")
    again.read_all()
    assert {pose.title: pose.weights.tolist() for pose in again.poses} == {"A": [1, 0], "Joy": [0, 0.3]}


def test_one_that_is_removed_is_said_to_come_again(tmp_path):
    session = Session(avatar(tmp_path, vrm0(JOY)), [choose("transpose")])
    library = Library(session, tmp_path / "face.poses", "")
    library.read_all()
    session.arrange("remove", {"Joy": None})
    assert library.poses == ()
    with pytest.raises(FacepinError, match="'Joy' is in the rig's own file"):
        library.follow()
