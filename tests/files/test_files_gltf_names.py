"""Names of shapes in glTF: wherever exporters put them, and one shape over several meshes."""

import numpy as np
import pytest

from facepin.files import open_rig
from support.sample_files import BLINK, SMILE, Gltf, dense


def test_names_come_from_the_mesh_then_the_primitive_then_numbers(tmp_path):
    gltf = Gltf()
    primitive = gltf.primitive(
        [gltf.accessor(SMILE), gltf.accessor(BLINK)], extras={"targetNames": ["a", "b"]}
    )
    gltf.node(mesh=gltf.mesh([primitive]))
    assert open_rig(gltf.save(tmp_path / "p.glb")).shape_names == ("a", "b")
    gltf.json["meshes"][0]["extras"] = {"targetNames": ["c"]}
    rig = open_rig(gltf.save(tmp_path / "m.glb"))
    assert rig.shape_names == ("c", "shape_1")
    assert any("1 target names for 2 targets" in line for line in rig.warnings)
    gltf.json["meshes"][0]["extras"] = {"targetNames": [None, "d"]}
    assert open_rig(gltf.save(tmp_path / "n.glb")).shape_names == ("shape_0", "d")


def meshes(path, named):
    """Write meshes {name: names of its targets} and open them; mesh i, target j moves by (i + 1) 4ʲ SMILE."""
    gltf = Gltf()
    for at, (name, shapes) in enumerate(named.items()):
        targets = [gltf.accessor(((at + 1) * 4**j * SMILE).astype(np.float32)) for j in range(len(shapes))]
        gltf.node(mesh=gltf.mesh([gltf.primitive(targets)], shapes, name=name))
    return open_rig(gltf.save(path / "face.glb"))


def moved(rig):
    """Return {name: for each mesh, how many times SMILE it moves by}."""
    tables = dense(rig).reshape(rig.shape_count, -1, 4, 3)[:, :, 2, 2] / 2
    return {name: table.tolist() for name, table in zip(rig.shape_names, tables, strict=True)}


@pytest.mark.parametrize(
    ("named", "expected"),
    [
        ({"Head": ["Head_blendShape.jawOpen"], "Teeth": ["Teeth_blendShape.jawOpen"]}, {"jawOpen": [1, 2]}),
        ({"a": ["bs1.jaw", "bs1.lid"], "c": ["lid"]}, {"bs1.jaw": [1, 0], "lid": [4, 2]}),
        ({"a": ["jaw", "lid"], "b": ["Lashes.jaw", "Lashes.lid"]}, {"jaw": [1, 2], "lid": [4, 8]}),
        ({"a": ["jawOpen", "lid"], "b": ["JawOpen", "LID"]}, {"jawOpen": [1, 2], "lid": [4, 8]}),
        ({"a": ["\u00e9"], "b": ["e\u0301"]}, {"\u00e9": [1, 2]}),
    ],
)
def test_one_shape_moves_all_meshes_however_it_is_spelled_there(tmp_path, named, expected):
    assert moved(meshes(tmp_path, named)) == expected


@pytest.mark.parametrize(
    "named",
    [
        {"a": ["blink.001", "open"], "b": ["mouth.001"]},
        {"face": ["mouth.open"], "body": ["eyes.open"]},
        {"a": ["A", "a"], "b": ["á"]},
        {"a": ["x.001", "x.002"], "b": ["y.001", "y.002"]},
        {"a": ["bs.jaw", "lid"], "b": ["jaw", "bs2.lid"]},
    ],
)
def test_nothing_is_one_shape_that_might_be_two(tmp_path, named):
    rig = meshes(tmp_path, named)
    assert rig.shape_names == tuple(name for names in named.values() for name in names)


def test_a_name_that_would_fit_two_of_a_mesh_fits_only_its_very_self(tmp_path):
    rig = meshes(tmp_path, {"a": ["A", "a"], "b": ["a"], "c": ["A"]})
    assert moved(rig) == {"A": [1, 0, 3], "a": [4, 2, 0]}
    rig = meshes(tmp_path, {"a": ["x.jaw", "x.lid"], "b": ["jaw", "x.jaw"]})
    assert moved(rig) == {"x.jaw": [1, 8], "x.lid": [4, 0], "jaw": [0, 2]}


def test_the_names_of_a_single_mesh_stay_as_they_are(tmp_path):
    names = ["blendShape1.jawOpen", "blendShape1.été", "blendShape1.x/../y", "blendShape1.%s##1"]
    assert meshes(tmp_path, {"Head": names}).shape_names == tuple(names)


def test_one_line_tells_which_names_are_one_shape(tmp_path):
    rig = meshes(tmp_path, {"Head": ["Head.jaw"], "Teeth": ["Teeth.jaw"]})
    assert rig.warnings == ("one shape under several names: jaw is Head.jaw and Teeth.jaw",)


def test_names_stand_on_targets_or_on_their_data(tmp_path):
    gltf = Gltf()
    primitive = gltf.primitive([gltf.accessor(SMILE, name="smile"), gltf.accessor(BLINK, name="blink")])
    gltf.node(mesh=gltf.mesh([primitive]))
    assert open_rig(gltf.save(tmp_path / "data.glb")).shape_names == ("smile", "blink")
    primitive["targets"][1]["extras"] = {"name": "wink"}
    assert open_rig(gltf.save(tmp_path / "target.glb")).shape_names == ("smile", "wink")
    for at, target in enumerate(primitive["targets"]):
        gltf.json["accessors"][target["POSITION"]]["name"] = f"accessor_{at}"
        target.pop("extras", None)
    assert open_rig(gltf.save(tmp_path / "numbers.glb")).shape_names == ("shape_0", "shape_1")


def test_targets_without_names_say_their_mesh_and_stay_apart(tmp_path):
    gltf = Gltf()
    head = gltf.mesh([gltf.primitive([gltf.accessor(SMILE)])], name="Head")
    teeth = gltf.mesh([gltf.primitive([gltf.accessor(BLINK)])], name="Teeth")
    for mesh in (head, teeth, head):
        gltf.node(mesh=mesh)
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    zero = np.zeros((4, 3))
    assert rig.shape_names == ("Head target 0", "Teeth target 0")
    assert np.array_equal(dense(rig)[0], np.concatenate([SMILE, zero, SMILE]))
    assert any("without a name" in line for line in rig.warnings)
