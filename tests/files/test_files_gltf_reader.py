"""Rigs from glTF: every way in which a morph target can be stored."""

import base64
import json

import numpy as np
import pygltflib
import pytest

from facepin.core.errors import FacepinError
from facepin.files import open_rig
from support.sample_files import BLINK, POSITIONS, SMILE, TRIANGLES, Gltf, dense, face_gltf


def test_dense_targets(tmp_path):
    rig = open_rig(face_gltf().save(tmp_path / "face.glb"))
    assert rig.shape_names == ("smile", "blink")
    assert np.array_equal(rig.neutral, POSITIONS)
    assert np.array_equal(rig.triangles, TRIANGLES)
    assert np.array_equal(dense(rig), [SMILE, BLINK])
    assert (rig.name, rig.warnings, rig.colours) == ("face", (), None)
    assert rig.rest_weights.tolist() == [0.0, 0.0]


def test_a_vrm_is_a_glb_and_a_harmless_extension_may_be_required(tmp_path):
    gltf = face_gltf()
    gltf.json["extensionsRequired"] = ["VRMC_vrm", "KHR_materials_unlit", "KHR_texture_transform"]
    assert open_rig(gltf.save(tmp_path / "face.VRM")).shape_count == 2


@pytest.mark.parametrize("index_type", [np.uint8, np.uint16, np.uint32])
def test_sparse_targets_without_and_over_a_base(tmp_path, index_type):
    gltf = Gltf()

    def sparse(places, values):
        indices = gltf.view(np.array(places, index_type).tobytes())
        component = {1: 5121, 2: 5123, 4: 5125}[np.dtype(index_type).itemsize]
        return {
            "count": len(places),
            "indices": {"bufferView": indices, "componentType": component},
            "values": {"bufferView": gltf.view(np.array(values, np.float32).tobytes())},
        }

    alone = gltf.raw_accessor(SMILE, sparse=sparse([0, 2], SMILE[[0, 2]]))
    over = gltf.accessor(SMILE, sparse=sparse([2, 3], [[7, 8, 9], [0, 0, 0]]))
    nothing = gltf.raw_accessor(SMILE)
    gltf.node(mesh=gltf.mesh([gltf.primitive([alone, over, nothing])], ["alone", "over", "nothing"]))
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    expected = SMILE.copy()
    expected[2] = 7, 8, 9
    assert np.array_equal(dense(rig), [SMILE, expected, np.zeros((4, 3))])
    assert any("move nothing: nothing" in line for line in rig.warnings)


def test_interleaved_data(tmp_path):
    gltf = Gltf()
    table = np.concatenate([POSITIONS, SMILE, BLINK], axis=1).astype(np.float32)
    view = gltf.view(bytes(8) + table.tobytes(), byteStride=36)
    position, smile, blink = (
        gltf.raw_accessor(POSITIONS, bufferView=view, byteOffset=8 + 12 * at) for at in range(3)
    )
    primitive = gltf.primitive([smile, blink])
    primitive["attributes"]["POSITION"] = position
    gltf.node(mesh=gltf.mesh([primitive], ["smile", "blink"]))
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    assert np.array_equal(rig.neutral, POSITIONS)
    assert np.array_equal(dense(rig), [SMILE, BLINK])


@pytest.mark.parametrize(("kind", "most"), [("i1", 127), ("u1", 255), ("i2", 32767), ("u2", 65535)])
@pytest.mark.parametrize("normalized", [True, False])
def test_quantised_data(tmp_path, kind, most, normalized):
    generator = np.random.default_rng(1)
    limits = np.iinfo(kind)
    whole = generator.integers(limits.min, limits.max, (2, 4, 3), endpoint=True).astype(kind)
    gltf = Gltf()
    stride = -(-3 * whole.itemsize // 4) * 4
    accessors = []
    for values in whole:
        rows = b"".join(row.tobytes().ljust(stride, b"\0") for row in values)
        accessors.append(
            gltf.raw_accessor(values, bufferView=gltf.view(rows, byteStride=stride), normalized=normalized)
        )
    primitive = gltf.primitive([accessors[1]])
    primitive["attributes"]["POSITION"] = accessors[0]
    gltf.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    gltf.node(mesh=gltf.mesh([primitive], ["s"]), scale=[2.0, 2.0, 2.0], translation=[1.0, 2.0, 3.0])
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    real = whole.astype(np.float64)
    if normalized:
        real = np.maximum(real / most, -1.0)
    assert np.allclose(rig.neutral, 2 * real[0] + [1, 2, 3], rtol=1e-6)
    assert np.allclose(dense(rig)[0], 2 * real[1], rtol=1e-6)


def test_node_transforms_move_the_neutral_and_turn_the_deltas(tmp_path):
    gltf = face_gltf(rotation=[0.0, 0.0, np.sin(np.pi / 4), np.cos(np.pi / 4)], scale=[2.0, 2.0, 2.0])
    matrix = np.eye(4)
    matrix[:3, 3] = [10.0, 20.0, 30.0]
    gltf.json["scenes"][0]["nodes"] = [gltf.node(root=False, children=[0], matrix=matrix.T.ravel().tolist())]
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    turn = np.array([[0, -2, 0], [2, 0, 0], [0, 0, 2]])  # a quarter turn about z, twice as large
    assert np.allclose(rig.neutral, POSITIONS @ turn.T + [10, 20, 30], atol=1e-6)
    assert np.allclose(dense(rig), np.array([SMILE, BLINK]) @ turn.T, atol=1e-6)


def test_a_mirrored_node_keeps_faces_outwards(tmp_path):
    rig = open_rig(face_gltf(scale=[-1.0, 1.0, 1.0]).save(tmp_path / "face.glb"))
    assert rig.triangles.tolist() == [[0, 2, 1], [0, 3, 2]]


def test_same_names_in_several_meshes_are_one_shape(tmp_path):
    gltf = face_gltf()
    teeth = gltf.primitive([gltf.accessor(-SMILE), gltf.accessor(2 * SMILE)])
    gltf.node(mesh=gltf.mesh([teeth], ["jaw", "smile"], name="teeth"))
    eye = {"attributes": {"POSITION": gltf.accessor(POSITIONS)}}
    gltf.node(mesh=gltf.mesh([eye], name="eye"), translation=[5.0, 0.0, 0.0])
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    zero = np.zeros((4, 3))
    assert rig.shape_names == ("smile", "blink", "jaw")
    assert np.array_equal(dense(rig)[0], np.concatenate([SMILE, 2 * SMILE, zero]))
    assert np.array_equal(dense(rig)[1], np.concatenate([BLINK, zero, zero]))
    assert np.array_equal(dense(rig)[2], np.concatenate([zero, -SMILE, zero]))
    assert [part.name for part in rig.parts] == ["mesh 0", "teeth", "eye"]
    assert np.array_equal(rig.neutral[8:], POSITIONS + np.array([5, 0, 0]))
    assert len(rig.triangles) == 2 + 2 + 1  # the eye has no indices: its first three vertices


def test_primitives_that_share_vertices_keep_sharing_them(tmp_path):
    gltf = Gltf()
    one = gltf.primitive([gltf.accessor(SMILE)], material=0)
    other = one | {"indices": gltf.accessor(np.array([1, 3, 2], np.uint16)), "material": 1}
    apart = gltf.primitive([gltf.accessor(BLINK)], material=1)
    gltf.json["materials"] = [{"name": "skin"}, {"name": "lips"}]
    gltf.node(mesh=gltf.mesh([one, other, apart], ["s"]))
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    assert rig.vertex_count == 8
    assert rig.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [1, 3, 2], [4, 5, 6], [4, 6, 7]]
    assert np.array_equal(dense(rig)[0], np.concatenate([SMILE, BLINK]))
    assert [part.name for part in rig.parts] == ["skin", "lips", "lips 2"]


def test_rest_weights_of_the_node_override_the_mesh(tmp_path):
    gltf = face_gltf()
    gltf.json["meshes"][0]["weights"] = [0.5, 1.5]
    rig = open_rig(gltf.save(tmp_path / "mesh.glb"))
    assert (rig.rest_weights.tolist(), rig.limits.tolist()) == ([0.5, 1.5], [[0.0, 1.0], [0.0, 1.5]])
    gltf.json["nodes"][0]["weights"] = [0.0, 0.25]
    assert open_rig(gltf.save(tmp_path / "node.glb")).rest_weights.tolist() == [0.0, 0.25]


def test_strips_and_fans(tmp_path):
    for mode, expected in ((5, [[0, 1, 2], [2, 1, 3]]), (6, [[0, 1, 2], [0, 2, 3]])):
        gltf = Gltf()
        primitive = gltf.primitive([gltf.accessor(SMILE)], mode=mode)
        primitive["indices"] = gltf.accessor(np.array([0, 1, 2, 3], np.uint8))
        points = {"attributes": {"POSITION": gltf.accessor(POSITIONS)}, "mode": 0}
        gltf.node(mesh=gltf.mesh([primitive, points], ["s"]))
        rig = open_rig(gltf.save(tmp_path / "face.glb"))
        assert rig.triangles.tolist() == expected
        assert rig.vertex_count == 4
        assert any("points and lines" in line for line in rig.warnings)


def test_materials_and_vertex_colours_become_srgb(tmp_path):
    gltf = face_gltf()
    primitive = gltf.json["meshes"][0]["primitives"][0]
    primitive["material"] = 0
    shine = {"baseColorFactor": [0.5, 0.0, 1.0, 0.3], "roughnessFactor": 0.25}
    gltf.json["materials"] = [{"pbrMetallicRoughness": shine}]
    part = open_rig(gltf.save(tmp_path / "m.glb")).parts[0]
    half = 1.055 * 0.5 ** (1 / 2.4) - 0.055
    assert part.colour == pytest.approx((half, 0.0, 1.0), abs=1e-6)
    assert part.roughness == 0.25
    colours = np.array([[255, 255, 255, 9], [0, 255, 0, 0], [51, 0, 255, 0], [255, 0, 0, 0]], np.uint8)
    primitive["attributes"]["COLOR_0"] = gltf.accessor(colours, normalized=True)
    rig = open_rig(gltf.save(tmp_path / "c.glb"))
    assert rig.colours == pytest.approx(
        np.array([[half, 0, 1], [0, 0, 0], [1.055 * 0.1 ** (1 / 2.4) - 0.055, 0, 1], [half, 0, 0]]), abs=1e-6
    )


def test_a_gltf_with_companions_and_with_data_inside(tmp_path):
    gltf = face_gltf()
    folder = tmp_path / "a folder"
    (folder / "data").mkdir(parents=True)
    (folder / "data" / "the buffer.bin").write_bytes(bytes(gltf.binary))
    for uri in (
        "data/the%20buffer.bin",
        "data:application/octet-stream;base64," + base64.b64encode(gltf.binary).decode(),
    ):
        gltf.json["buffers"] = [{"byteLength": len(gltf.binary), "uri": uri}]
        path = folder / "face.gltf"
        path.write_text(json.dumps(gltf.json))
        assert np.array_equal(dense(open_rig(path)), [SMILE, BLINK])


@pytest.mark.parametrize(
    "uri",
    [
        "../secret.bin",
        "..\\secret.bin",
        "%2e%2e/secret.bin",
        "sub/../../secret.bin",
        "{outside}/secret.bin",
        "file://{outside}/secret.bin",
        "C:\\secret.bin",
        "\\\\host\\share\\secret.bin",
        "http://example.org/secret.bin",
        "link.bin",
        "linked/secret.bin",
        "loop.bin",
        "missing.bin",
        ".",
        "",
        "a\0b",
        "data:text/plain,hello",
        "data:;base64,????",
        "x" * 5000,
    ],
)
def test_a_buffer_outside_the_folder_is_refused(tmp_path, uri):
    gltf = face_gltf()
    outside, folder = tmp_path / "outside", tmp_path / "outside" / "model"
    folder.mkdir(parents=True)
    (outside / "secret.bin").write_bytes(bytes(gltf.binary))
    (folder / "link.bin").symlink_to(outside / "secret.bin")
    (folder / "linked").symlink_to(outside)
    (folder / "loop.bin").symlink_to(folder / "loop.bin")
    gltf.json["buffers"] = [{"byteLength": len(gltf.binary), "uri": uri.format(outside=outside)}]
    path = folder / "face.gltf"
    path.write_text(json.dumps(gltf.json))
    with pytest.raises(FacepinError, match=r"face\.gltf: buffers\[0\]\.uri"):
        open_rig(path)


@pytest.mark.parametrize(
    "sample", ["AnimatedMorphCube", "AnimatedMorphSphere", "MorphPrimitivesTest", "SimpleMorph"]
)
def test_khronos_samples_against_an_independent_reader(shared, sample):
    path = shared / "models" / "khronos_morph_samples" / sample / "glTF" / f"{sample}.gltf"
    rig = open_rig(path)
    document = pygltflib.GLTF2().load(str(path))
    mesh = document.meshes[0]

    def floats(index):
        accessor = document.accessors[index]
        view = document.bufferViews[accessor.bufferView]
        content = (path.parent / document.buffers[view.buffer].uri).read_bytes()
        start = (view.byteOffset or 0) + (accessor.byteOffset or 0)
        return np.frombuffer(content, "<f4", 3 * accessor.count, start).reshape(-1, 3)

    node = document.nodes[0]
    linear = np.eye(3)
    if node.rotation is not None:
        x, y, z, w = node.rotation
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        linear = np.eye(3) + 2 * w * cross + 2 * cross @ cross
    linear = linear * (node.scale or [1, 1, 1])
    neutral = np.concatenate([floats(p.attributes.POSITION) for p in mesh.primitives])
    assert np.allclose(rig.neutral, neutral @ linear.T + (node.translation or [0, 0, 0]), atol=1e-5)
    for j in range(rig.shape_count):
        delta = np.concatenate([floats(p.targets[j]["POSITION"]) for p in mesh.primitives])
        assert np.allclose(dense(rig)[j], delta @ linear.T, atol=1e-6)
    assert rig.rest_weights.tolist() == pytest.approx(mesh.weights or [0.0] * rig.shape_count)


def test_the_real_face_is_the_same_in_all_its_forms(shared):
    folder = shared / "models" / "ict-facekit"
    glb, npz = open_rig(folder / "ict_expressions.glb"), open_rig(folder / "ict_full153.npz")
    assert (glb.vertex_count, glb.shape_count, npz.shape_count) == (26719, 53, 153)
    assert glb.shape_names == npz.shape_names[:53]
    assert np.allclose(glb.neutral, npz.neutral, atol=1e-5)
    difference = glb.deltas - npz.deltas[:, :53]
    assert abs(difference).max() < 5e-3  # the archive has half precision
    assert len(npz.parts) == 17
    assert len(npz.face_sizes) == 26384
    assert len(glb.triangles) == len(npz.triangles)


@pytest.mark.parametrize(
    ("extension", "front"), [("VRM", (0.0, 0.0, -1.0)), ("VRMC_vrm", (0.0, 0.0, 1.0)), ("OTHER", None)]
)
def test_an_avatar_says_which_way_it_looks(tmp_path, extension, front):
    gltf = face_gltf()
    gltf.json["extensions"] = {extension: {}}
    rig = open_rig(gltf.save(tmp_path / "face.vrm"))
    assert (rig.front, rig.up) == (front, front and (0.0, 1.0, 0.0))


def test_targets_that_move_nothing_are_told(tmp_path):
    gltf = Gltf()
    primitive = gltf.primitive([gltf.accessor(SMILE)])
    primitive["targets"] += [{"NORMAL": gltf.accessor(SMILE)}, {"COLOR_0": gltf.accessor(SMILE)}]
    gltf.node(mesh=gltf.mesh([primitive], ["smile", "wrinkle", "blush"]))
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    assert np.array_equal(dense(rig), [SMILE, 0 * SMILE, 0 * SMILE])
    assert rig.warnings == ("shapes that move nothing: wrinkle, blush",)
