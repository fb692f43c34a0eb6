"""Skins of glTF: the face as the joints of the file hold it."""

import numpy as np
import pytest

from facepin.core.errors import FacepinError
from facepin.files import open_rig
from support.sample_files import BLINK, POSITIONS, SMILE, TRIANGLES, Gltf, dense

TURN = {"rotation": [0.0, 0.0, np.sin(np.pi / 4), np.cos(np.pi / 4)]}
TURNED = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
ZEROS, FIRST = np.zeros((4, 4)), [[1, 0, 0, 0]] * 4


def skinned(joints, numbers, weights, inverse=None, **node):
    """Return the sample face bound to joints (entries of nodes) by (4, 4) numbers and weights."""
    gltf = Gltf()
    primitive = gltf.primitive([gltf.accessor(SMILE), gltf.accessor(BLINK)])
    primitive["attributes"]["JOINTS_0"] = gltf.accessor(np.array(numbers, np.uint8))
    primitive["attributes"]["WEIGHTS_0"] = gltf.accessor(np.array(weights, np.float32))
    gltf.node(mesh=gltf.mesh([primitive], ["smile", "blink"]), skin=0, **node)
    skin = {"joints": [gltf.node(**joint) for joint in joints]}
    if inverse is not None:
        columns = np.array(inverse, np.float32).transpose(0, 2, 1).reshape(-1, 16)
        skin["inverseBindMatrices"] = gltf.accessor(np.ascontiguousarray(columns))
    gltf.json["skins"] = [skin]
    return gltf


def moved_by(x, y, z):
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def test_a_skin_places_the_face_by_its_joints_and_not_by_its_node(tmp_path):
    joint = {"scale": [2.0, 2.0, 2.0], "translation": [0.0, 5.0, 0.0]}
    gltf = skinned([joint], ZEROS, FIRST, [moved_by(0, 0, 1)], translation=[100, 0, 0])
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    assert np.allclose(rig.neutral, 2 * POSITIONS + np.array([0, 5, 2]))
    assert np.allclose(dense(rig), 2 * np.array([SMILE, BLINK]))
    assert any("bones" in line for line in rig.warnings)


def test_each_vertex_and_its_deltas_follow_the_joints_that_it_is_bound_to(tmp_path):
    numbers = [[0, 1, 0, 0], [1, 0, 0, 0], [0, 1, 0, 0], [0, 9, 0, 0]]  # what has no weight may be anything
    weights = [[1, 0, 0, 0], [1, 0, 0, 0], [0.25, 0.75, 0, 0], [0.5, 0, 0.5, 0]]
    gltf = skinned([{}, TURN | {"translation": [3, 0, 0]}], numbers, weights)
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    turned = POSITIONS @ TURNED.T + np.array([3, 0, 0])
    share = np.array([0, 1, 0.75, 0])[:, None]
    assert np.allclose(rig.neutral, (1 - share) * POSITIONS + share * turned, atol=1e-6)
    for found, delta in zip(dense(rig), (SMILE, BLINK), strict=True):
        assert np.allclose(found, (1 - share) * delta + share * (delta @ TURNED.T), atol=1e-6)


def test_joints_hang_together_and_more_than_four_may_hold_a_vertex(tmp_path):
    gltf = skinned([{}, {}], ZEROS, [[2, 0, 0, 0]] * 4)  # weights need not sum up to one
    attributes = gltf.json["meshes"][0]["primitives"][0]["attributes"]
    attributes["JOINTS_1"] = gltf.accessor(np.full((4, 4), 1, np.uint16))
    attributes["WEIGHTS_1"] = gltf.accessor(np.full((4, 4), 255, np.uint8), normalized=True)
    gltf.json["nodes"][1] |= {"translation": [0.0, 6.0, 0.0], "children": [2]}
    gltf.json["scenes"][0]["nodes"].remove(2)
    gltf.json["nodes"][2]["translation"] = [3.0, 0.0, 0.0]
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    assert np.allclose(rig.neutral, POSITIONS + np.array([2, 6, 0]))


def test_at_the_pose_of_its_binding_a_face_is_as_stored_to_the_last_bit(tmp_path):
    joints = [TURN | {"translation": [0.1, 1.7, 0.3]}, {"translation": [0.3, 0.7, 0.1]}]
    poses = [moved_by(0.1, 1.7, 0.3), moved_by(0.3, 0.7, 0.1)]
    poses[0][:3, :3] = TURNED
    inverse = [np.linalg.inv(pose) for pose in poses]
    gltf = skinned(joints, [[0, 1, 0, 0]] * 4, [[0.3, 0.7, 0, 0]] * 4, inverse)
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    assert np.array_equal(rig.neutral, POSITIONS)
    assert np.array_equal(dense(rig), [SMILE, BLINK])


def test_what_a_joint_mirrors_faces_outwards(tmp_path):
    mirror = {"scale": [-1.0, 1.0, 1.0]}
    rig = open_rig(skinned([mirror], ZEROS, FIRST).save(tmp_path / "all.glb"))
    assert rig.triangles.tolist() == [[0, 2, 1], [0, 3, 2]]
    numbers = [[1, 0, 0, 0]] * 3 + [[0] * 4]
    rig = open_rig(skinned([{}, mirror], numbers, FIRST).save(tmp_path / "most.glb"))
    assert rig.triangles.tolist() == [[0, 2, 1], [0, 3, 2]]
    rig = open_rig(skinned([mirror, {}], numbers, FIRST).save(tmp_path / "few.glb"))
    assert np.array_equal(rig.triangles, TRIANGLES)


def test_a_primitive_without_joints_follows_its_node(tmp_path):
    gltf = skinned([{"translation": [9, 9, 9]}], ZEROS, FIRST, translation=[1, 0, 0])
    del gltf.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"]
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    assert np.allclose(rig.neutral, POSITIONS + np.array([1, 0, 0]))


@pytest.mark.parametrize(
    ("numbers", "weights", "inverse", "words"),
    [
        (np.full((4, 4), 7), FIRST, None, "joint 7, allowed are 0 to 0"),
        (np.zeros((3, 4)), FIRST, None, "JOINTS_0 has 3 elements"),
        (ZEROS, [[1, 0, 0, 0]] * 5, None, "WEIGHTS_0 has 5 elements"),
        (ZEROS, FIRST, [np.full((4, 4), 1e38)], "too large"),
    ],
)
def test_a_skin_that_does_not_fit_is_refused(tmp_path, numbers, weights, inverse, words):
    with pytest.raises(FacepinError, match=words):
        open_rig(skinned([{}], numbers, weights, inverse).save(tmp_path / "face.glb"))


def test_an_eye_at_two_nodes_looks_outwards_at_both(tmp_path):
    gltf = Gltf()
    eye = gltf.mesh([gltf.primitive([gltf.accessor(BLINK)])], ["out"])
    gltf.node(mesh=eye, translation=[2.0, 0.0, 0.0])
    gltf.node(mesh=eye, translation=[-2.0, 0.0, 0.0], scale=[-1.0, 1.0, 1.0])
    rig = open_rig(gltf.save(tmp_path / "eyes.glb"))
    assert np.array_equal(dense(rig)[0], np.concatenate([BLINK, BLINK * [-1, 1, 1]]))
    assert rig.triangles.tolist() == [*TRIANGLES.tolist(), [4, 6, 5], [4, 7, 6]]
