"""Combinations of shapes in files: read from archives, baked into glTF and found again there."""

import json
import struct
from pathlib import Path

import numpy as np
import pytest

from facepin.core.errors import FacepinError
from facepin.core.rig import Rig
from facepin.files import open_rig, write_model
from facepin.files.gltf.targets import COMBINATIONS
from support.sample_files import face_arrays

PAIRS = np.array([[1, 0]], np.int32)
BOTH = np.array([[[0, 0, 1], [0, 0, 0], [0, 2, 0], [0, 0, 0]]], np.float32)
WEIGHTS = np.array([0.5, 0.8])


def archive(path: Path, **changes: object) -> Path:
    arrays = face_arrays() | {"combo_pairs": PAIRS, "combo_deltas": BOTH} | changes
    np.savez(path, **{key: array for key, array in arrays.items() if array is not None})
    return path


@pytest.fixture
def rig(tmp_path: Path) -> Rig:
    return open_rig(archive(tmp_path / "face.npz"))


def test_an_archive_with_combinations(rig: Rig) -> None:
    plain = face_arrays()
    expected = plain["neutral"] + np.einsum("k,kni->ni", WEIGHTS, plain["deltas"]) + 0.4 * BOTH[0]
    np.testing.assert_allclose(rig.evaluate(WEIGHTS), expected, atol=1e-6)
    assert rig.combination_names == ("smile*blink",)
    assert rig.warnings == ()


@pytest.mark.parametrize(
    ("changes", "line"),
    [
        ({"combo_pairs": None}, "combo_deltas without the other of combo_pairs and combo_deltas"),
        ({"combo_deltas": None}, "combo_pairs without the other"),
        (
            {"combo_pairs": PAIRS.astype(float)},
            r"combo_pairs are float64 \(1, 2\), allowed: whole numbers \(c, 2\)",
        ),
        ({"combo_pairs": PAIRS[0]}, r"combo_pairs are int32 \(2,\)"),
        ({"combo_pairs": PAIRS[:, :1]}, r"combo_pairs are int32 \(1, 1\)"),
        (
            {"combo_pairs": np.array([[0, 2]])},
            "combination 0 is of the shapes 0 and 2, allowed are .* of 0 to 1",
        ),
        ({"combo_pairs": np.array([[-1, 0]])}, "shapes -1 and 0"),
        ({"combo_pairs": np.array([[1, 1]])}, "two different ones"),
        ({"combo_deltas": BOTH[:, :3]}, r"combo_deltas are float32 \(1, 3, 3\), allowed: floats \(1, 4, 3\)"),
        ({"combo_deltas": np.concatenate([BOTH, BOTH])}, r"\(2, 4, 3\), allowed: floats \(1, 4, 3\)"),
        ({"combo_deltas": BOTH.astype(int)}, "combo_deltas are int64"),
        ({"combo_deltas": BOTH * np.nan}, r"combination smile\*blink: x of vertex 0 is nan"),
    ],
)
def test_combinations_that_do_not_fit_are_refused(
    tmp_path: Path, changes: dict[str, np.ndarray | None], line: str
) -> None:
    with pytest.raises(FacepinError, match=line):
        open_rig(archive(tmp_path / "face.npz", **changes))


def test_no_combinations_at_all_are_none(tmp_path: Path) -> None:
    empty = open_rig(archive(tmp_path / "f.npz", combo_pairs=PAIRS[:0], combo_deltas=BOTH[:0]))
    assert empty.combinations.shape == (0, 2)
    assert empty.amounts(WEIGHTS) is WEIGHTS


def document(path: Path) -> dict:
    content = path.read_bytes()
    return json.loads(content[20 : 20 + struct.unpack_from("<I", content, 12)[0]])


def rewritten(path: Path, extras: dict) -> Path:
    """The same file with other extras of its mesh."""
    content = path.read_bytes()
    size = struct.unpack_from("<I", content, 12)[0]
    root = json.loads(content[20 : 20 + size])
    root["meshes"][0]["extras"] = extras
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + content[20 + size :]
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
    return path


def test_a_viewer_that_adds_up_targets_shows_the_true_face(tmp_path: Path, rig: Rig) -> None:
    path = tmp_path / "face.glb"
    write_model(rig, WEIGHTS, path)
    mesh = document(path)["meshes"][0]
    assert mesh["extras"]["targetNames"] == ["smile", "blink", "smile*blink"]
    assert mesh["extras"][COMBINATIONS] == [{"target": 2, "shapes": [0, 1]}]
    # Without the extras any reader takes all targets for shapes: a plain sum of them.
    plain = open_rig(rewritten(path, {}))
    assert plain.shape_count == 3
    assert not len(plain.combinations)
    np.testing.assert_allclose(plain.evaluate(plain.rest_weights), rig.evaluate(WEIGHTS), atol=1e-6)


def test_combinations_come_back_from_our_own_file(tmp_path: Path, rig: Rig) -> None:
    path = tmp_path / "face.glb"
    write_model(rig, WEIGHTS, path)
    back = open_rig(path)
    assert back.shape_names == rig.shape_names
    np.testing.assert_array_equal(back.combinations, rig.combinations)
    np.testing.assert_array_equal(back.deltas.toarray(), rig.deltas.toarray())
    np.testing.assert_array_equal(back.rest_weights, WEIGHTS)
    np.testing.assert_array_equal(back.limits, rig.limits)
    again = tmp_path / "again.glb"
    write_model(back, WEIGHTS, again)
    assert document(again)["meshes"][0]["extras"] == document(path)["meshes"][0]["extras"]


@pytest.mark.parametrize(
    ("noted", "line"),
    [
        ([{"target": 3, "shapes": [0, 1]}], "target is 3, allowed: a whole number 0 to 2"),
        ([{"target": 2, "shapes": [0, 3]}], "shapes is a list of 2, allowed: a list of whole numbers 0 to 2"),
        ([{"target": 2, "shapes": [0]}], "two different targets"),
        ([{"target": 2, "shapes": [0, 0]}], "two different targets"),
        ([{"target": 2, "shapes": [0, 2]}], "that are no combinations"),
        ([{"target": 2, "shapes": [0, 1]}, {"target": 1, "shapes": [0, 2]}], "that are no combinations"),
        ({"target": 2}, "allowed: a list of objects"),
        ([7], "allowed: an object"),
    ],
)
def test_notes_that_do_not_fit_the_targets_are_refused(
    tmp_path: Path, rig: Rig, noted: object, line: str
) -> None:
    path = tmp_path / "face.glb"
    write_model(rig, WEIGHTS, path)
    with pytest.raises(FacepinError, match=line):
        open_rig(rewritten(path, {"targetNames": ["a", "b", "c"], COMBINATIONS: noted}))


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".stl"])
def test_a_posed_mesh_is_the_true_face(tmp_path: Path, rig: Rig, suffix: str) -> None:
    import trimesh

    write_model(rig, WEIGHTS, tmp_path / f"face{suffix}")
    mesh = trimesh.load(tmp_path / f"face{suffix}", process=False)
    np.testing.assert_allclose(
        np.ptp(mesh.vertices, axis=0), np.ptp(rig.evaluate(WEIGHTS), axis=0), atol=1e-5
    )
