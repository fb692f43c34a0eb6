"""Models come back as they were written."""

import json
import os
import struct

import numpy as np
import pygltflib
import pytest
import trimesh

from facepin.core.errors import FacepinError
from facepin.core.rig_builder import PartLook, build_rig
from facepin.files import WRITERS, open_rig, write_model
from facepin.files.work.pose_file import read_pose
from support.sample_files import POSITIONS, TRIANGLES, dense


def grid_rig(side=6, shapes=5, seed=1, **more):
    """Return a bumpy square of quads in two parts, with dense, sparse, still and oddly named shapes."""
    generator = np.random.default_rng(seed)
    y, x = np.mgrid[:side, :side] / 3.0
    neutral = np.stack([x, y, generator.normal(0, 0.1, x.shape)], axis=-1).reshape(-1, 3).astype(np.float32)
    at = np.arange(side * side).reshape(side, side)
    corners = np.stack([at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]], axis=-1).reshape(-1)
    faces = len(corners) // 4
    deltas = generator.normal(size=(shapes, side * side, 3)).astype(np.float32)
    deltas[1:, 4:] = 0.0
    deltas[-1] = 0.0
    names = ["smile", "eyeBlink_L", 'Lächeln "笑"', "a b/c", "still"][:shapes]
    return build_rig(
        "bumpy",
        neutral,
        corners,
        np.full(faces, 4),
        zip(names, deltas, strict=True),
        parts=[PartLook("skin", (0.8, 0.5, 0.25), 0.5), PartLook("lip gloss", (0.75, 0.0, 0.125), 0.25)],
        face_parts=np.arange(faces) % 2,
        **more,
    )


WEIGHTS = np.array([0.5, 1.25, 0.0, -0.75, 0.0])


def test_glb_comes_back_whole(tmp_path):
    rig = grid_rig()
    write_model(rig, WEIGHTS, tmp_path / "bumpy.glb")
    back = open_rig(tmp_path / "bumpy.glb")
    assert np.array_equal(back.neutral, rig.neutral)
    assert np.array_equal(back.triangles, rig.triangles)
    assert np.array_equal(dense(back), dense(rig))
    assert back.shape_names == rig.shape_names
    assert back.rest_weights.tolist() == WEIGHTS.tolist()
    assert [part.name for part in back.parts] == ["skin", "lip gloss"]
    assert [part.roughness for part in back.parts] == [0.5, 0.25]
    for part, original in zip(back.parts, rig.parts, strict=True):
        assert part.colour == pytest.approx(original.colour, abs=1e-6)
        assert part.triangles == original.triangles


def test_glb_carries_vertex_colours(tmp_path):
    colours = np.random.default_rng(2).random((36, 3))
    rig = grid_rig(colours=colours)
    write_model(rig, WEIGHTS, tmp_path / "bumpy.glb")
    back = open_rig(tmp_path / "bumpy.glb")
    assert back.colours == pytest.approx(colours, abs=1e-6)
    assert [part.colour for part in back.parts] == [None, None]


def test_glb_as_an_independent_reader_sees_it(tmp_path):
    rig = grid_rig()
    path = tmp_path / "bumpy.glb"
    write_model(rig, WEIGHTS, path)
    magic, version, length = struct.unpack_from("<4sII", path.read_bytes())
    assert (magic, version, length) == (b"glTF", 2, path.stat().st_size)
    document = pygltflib.GLTF2().load(str(path))
    binary = document.binary_blob()
    (mesh,) = document.meshes
    assert mesh.extras["targetNames"] == list(rig.shape_names)
    assert mesh.weights == WEIGHTS.tolist()
    assert len(mesh.primitives) == 2

    def floats(view_index, count):
        view = document.bufferViews[view_index]
        assert view.byteOffset % 4 == 0
        return np.frombuffer(binary, "<f4", 3 * count, view.byteOffset).reshape(-1, 3)

    for target, delta in zip(mesh.primitives[1].targets, dense(rig), strict=True):
        accessor = document.accessors[target["POSITION"]]
        found = np.zeros((36, 3), np.float32)
        if accessor.bufferView is not None:
            found = floats(accessor.bufferView, 36)
        elif accessor.sparse is not None:
            view = document.bufferViews[accessor.sparse.indices.bufferView]
            places = np.frombuffer(binary, "<u2", accessor.sparse.count, view.byteOffset)
            assert (np.diff(places.astype(int)) > 0).all()
            found[places] = floats(accessor.sparse.values.bufferView, accessor.sparse.count)
        assert np.array_equal(found, delta)
        assert accessor.min == pytest.approx(delta.min(axis=0))
        assert accessor.max == pytest.approx(delta.max(axis=0))
    stored = [document.accessors[target["POSITION"]] for target in mesh.primitives[0].targets]
    assert [(a.bufferView is not None, a.sparse is not None) for a in stored] == [
        (True, False),
        (False, True),
        (False, True),
        (False, True),
        (False, False),
    ]
    normals = floats(document.accessors[mesh.primitives[0].attributes.NORMAL].bufferView, 36)
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-6)
    assert (normals[:, 2] > 0.5).all()
    for primitive, part in zip(mesh.primitives, rig.parts, strict=True):
        accessor = document.accessors[primitive.indices]
        view = document.bufferViews[accessor.bufferView]
        indices = np.frombuffer(binary, "<u2", accessor.count, view.byteOffset).reshape(-1, 3)
        assert np.array_equal(indices, rig.triangles[part.triangles.start : part.triangles.stop])


def test_glb_of_more_vertices_than_two_bytes_count(tmp_path):
    rig = grid_rig(side=260)
    write_model(rig, WEIGHTS, tmp_path / "big.glb")
    back = open_rig(tmp_path / "big.glb")
    assert np.array_equal(back.triangles, rig.triangles)
    assert (back.deltas != rig.deltas).nnz == 0


def test_obj_keeps_polygons_and_every_bit(tmp_path):
    rig = grid_rig()
    write_model(rig, WEIGHTS, tmp_path / "posed_neutral.obj")
    write_model(rig, 0 * WEIGHTS, tmp_path / "rest shape.obj")
    back = open_rig(tmp_path, cache=False)
    assert np.array_equal(back.neutral, rig.evaluate(WEIGHTS))
    assert np.array_equal(back.corners, rig.corners)
    assert np.array_equal(back.face_sizes, rig.face_sizes)
    assert [(part.name, part.faces) for part in back.parts] == [
        ("skin", rig.parts[0].faces),
        ("lip_gloss", rig.parts[1].faces),
    ]


@pytest.mark.parametrize("suffix", [".ply", ".stl"])
def test_ply_and_stl_hold_the_posed_triangles(tmp_path, suffix):
    rig = grid_rig(colours=np.full((36, 3), [1.0, 0.2, 0.0]))
    path = tmp_path / f"bumpy{suffix}"
    write_model(rig, WEIGHTS, path)
    back = trimesh.load_mesh(path, process=False)
    assert np.allclose(back.triangles, rig.evaluate(WEIGHTS)[rig.triangles], atol=1e-6)
    if suffix == ".ply":
        assert np.array_equal(back.faces, rig.triangles)
        assert np.allclose(back.visual.vertex_colors[:, :3], [255, 51, 0])


@pytest.mark.parametrize("suffix", WRITERS)
def test_writing_is_all_or_nothing(tmp_path, monkeypatch, suffix):
    rig = grid_rig()
    path = tmp_path / f"face{suffix}"
    path.write_bytes(b"before")

    def full(handle):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(FacepinError, match="cannot be written: No space left"):
        write_model(rig, WEIGHTS, path)
    assert path.read_bytes() == b"before"
    assert list(tmp_path.iterdir()) == [path]


def test_other_suffixes_are_refused_by_name(tmp_path):
    for name in ("face.fbx", "face"):
        with pytest.raises(FacepinError, match=r"no writer for .*there are: \.glb, \.obj, \.ply, \.stl"):
            write_model(grid_rig(), WEIGHTS, tmp_path / name)


def test_glb_text_is_plain_json(tmp_path):
    write_model(grid_rig(), WEIGHTS, tmp_path / "f.glb")
    content = (tmp_path / "f.glb").read_bytes()
    length = struct.unpack_from("<I", content, 12)[0]
    assert json.loads(content[20 : 20 + length])["asset"]["version"] == "2.0"


def test_real_rigs_come_back(tmp_path, shared):
    rig = open_rig(shared / "models" / "ict-facekit" / "ict_expressions.glb")
    weights = np.linspace(0, 1, rig.shape_count)
    write_model(rig, weights, tmp_path / "ict.glb")
    back = open_rig(tmp_path / "ict.glb")
    assert back.shape_names == rig.shape_names
    assert (back.deltas != rig.deltas).nnz == 0
    assert np.array_equal(back.triangles, rig.triangles)
    assert back.rest_weights == pytest.approx(weights)


LONG = "Genesis9_head_bs_FACS_corrective_MouthSmileWide_MouthUpperUp_JawOpen_MouthStretch"
TRUE_NAMES = (
    f"{LONG}_Left",
    f"{LONG}_Right",
    "  leading space",
    "two  blanks",
    "zwj\u200dname",
    "mouth\x1b[2J",
)


def test_names_are_written_as_they_came_and_found_by_that(tmp_path):
    shapes = [(name, np.full((4, 3), at + 1.0)) for at, name in enumerate(TRUE_NAMES)]
    rig = build_rig("face", POSITIONS, TRIANGLES.ravel(), [3, 3], shapes)
    write_model(rig, np.zeros(rig.shape_count), tmp_path / "face.glb")
    again = open_rig(tmp_path / "face.glb")
    assert again.names_outside == again.file_names == TRUE_NAMES
    assert again.shape_names == rig.shape_names
    assert rig.shape_names == (*TRUE_NAMES[:2], "leading space", "two blanks", "zwjname", "mouth")
    saved = {"format": "facepin-pose", "version": 1, "weights": dict.fromkeys(TRUE_NAMES, 0.5)}
    for suffix, content in (
        ("json", json.dumps(saved)),
        ("csv", "shape,weight\n" + "".join(f'"{name}",0.5\n' for name in TRUE_NAMES)),
    ):
        (tmp_path / f"pose.{suffix}").write_text(content)
        pose, report = read_pose(tmp_path / f"pose.{suffix}", again)
        assert pose.weights.tolist() == [0.5] * 6, report


def test_a_name_that_repeats_is_written_as_it_is_told_apart_here(tmp_path):
    shapes = [(name, np.full((4, 3), at + 1.0)) for at, name in enumerate(["smile", "smile", ""])]
    rig = build_rig("face", POSITIONS, TRIANGLES.ravel(), [3, 3], shapes)
    assert rig.names_outside == rig.shape_names == ("smile", "smile 2", "shape_2")
