"""Rigs from numpy archives."""

import io
import pickle
import struct
import tracemalloc
import zipfile

import numpy as np
import pytest

from facepin.core.errors import FacepinError
from facepin.files import open_rig, write_model
from support.sample_files import BLINK, POSITIONS, SMILE, TRIANGLES, dense, face_arrays


def saved(path, compressed=True, **changes):
    arrays = {key: array for key, array in (face_arrays() | changes).items() if array is not None}
    (np.savez_compressed if compressed else np.savez)(path, **arrays)
    return path


@pytest.mark.parametrize("kind", ["<f2", "<f4", "<f8", ">f4", ">f8"])
@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("compressed", [True, False])
def test_any_floats_in_any_order(tmp_path, kind, order, compressed):
    deltas = np.asarray(np.stack([SMILE, BLINK]), kind, order=order)
    rig = open_rig(saved(tmp_path / "f.npz", compressed, deltas=deltas, neutral=POSITIONS.astype(kind)))
    assert np.array_equal(rig.neutral, POSITIONS)
    assert np.array_equal(dense(rig), [SMILE, BLINK])
    assert np.array_equal(rig.triangles, TRIANGLES)
    assert (rig.shape_names, rig.warnings) == (("smile", "blink"), ())


def test_polygons_are_filled_up_with_minus_one(tmp_path):
    faces = np.array([[0, 1, 2, 3], [1, 2, 3, -1]], np.int16)
    rig = open_rig(saved(tmp_path / "f.npz", faces=faces))
    assert rig.face_sizes.tolist() == [4, 3]
    assert rig.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [1, 2, 3]]


@pytest.mark.parametrize("word", ["part", "region"])
def test_a_face_belongs_to_the_part_of_its_first_corner(tmp_path, word):
    more = {word: np.array([2, 0, 0, 1], np.uint8), f"{word}_names": np.array(["skin", "none", "eye"])}
    more[f"{word}_colours"] = np.array([[0, 0, 0], [0, 0, 0], [255, 51, 0]], np.uint8)
    faces = np.array([[0, 1, 2], [1, 2, 3], [2, 3, 0]])
    rig = open_rig(saved(tmp_path / "f.npz", faces=faces, **more))
    assert [(part.name, part.faces) for part in rig.parts] == [("skin", range(2)), ("eye", range(2, 3))]
    assert rig.triangles.tolist() == [[1, 2, 3], [2, 3, 0], [0, 1, 2]]
    assert rig.parts[1].colour == pytest.approx((1.0, 0.2, 0.0))
    assert np.array_equal(rig.neutral, POSITIONS)


@pytest.mark.parametrize("word", ["colors", "colours"])
def test_vertex_colours_as_bytes_or_floats(tmp_path, word):
    colours = np.array([[0, 51, 255]] * 4, np.uint8)
    as_bytes = open_rig(saved(tmp_path / "b.npz", **{word: colours}))
    as_floats = open_rig(saved(tmp_path / "f.npz", **{word: colours / 255}))
    assert np.allclose(as_bytes.colours, [[0, 0.2, 1]] * 4)
    assert np.array_equal(as_bytes.colours, as_floats.colours)
    as_words = open_rig(saved(tmp_path / "w.npz", **{word: colours.astype(np.uint16) * 257}))
    assert np.allclose(as_words.colours, as_floats.colours)


@pytest.mark.parametrize(
    ("names", "expected"),
    [
        (np.array([b"smile", b"blink"]), ("smile", "blink")),
        (np.array(["smile", "blink"], ">U5"), ("smile", "blink")),
        (np.array(["eyeBlink_L", "Lächeln"]), ("eyeBlink_L", "Lächeln")),
        (None, ("shape_0", "shape_1")),
        (np.array(["only one"]), ("shape_0", "shape_1")),
        (np.array(["a", None], object), ("shape_0", "shape_1")),
        (np.array([1.0, 2.0]), ("shape_0", "shape_1")),
        (np.frombuffer(b"\xff\xff\xff\x7fa\0\0\0", "<U1"), ("\ufffd", "a")),
    ],
)
def test_names(tmp_path, names, expected):
    rig = open_rig(saved(tmp_path / "f.npz", names=names))
    assert rig.shape_names == expected
    assert bool(rig.warnings) == ("shape_0" in expected)


@pytest.mark.parametrize(
    "extra",
    [
        {"colors": np.ones((3, 3))},
        {"colors": np.full((4, 3), np.nan)},
        {"weights": np.ones(3)},
        {"part": np.array([0, 1, 2, 3])},
        {"part": np.array([0, 1, 0, 9]), "part_names": np.array(["a", "b"])},
        {"part": np.array([0, 0, 0, -1]), "part_names": np.array(["a"])},
        {"region": np.zeros(3, int), "region_names": np.array(["a"])},
    ],
)
def test_extra_arrays_that_do_not_fit_are_left_out_with_a_warning(tmp_path, extra):
    rig = open_rig(saved(tmp_path / "f.npz", **extra))
    assert len(rig.warnings) == 1
    assert "ignored" in rig.warnings[0]
    assert (rig.colours, len(rig.parts), rig.rest_weights.tolist()) == (None, 1, [0.0, 0.0])


def test_rest_weights(tmp_path):
    assert open_rig(saved(tmp_path / "f.npz", weights=np.array([0.5, 0.0]))).rest_weights.tolist() == [
        0.5,
        0.0,
    ]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"neutral": None}, "no array 'neutral', there are: faces, deltas, names"),
        ({"neutral": POSITIONS[:, :2]}, r"neutral is float32 \(4, 2\)"),
        ({"neutral": POSITIONS.astype(int)}, "neutral is int64"),
        ({"faces": TRIANGLES.astype(float)}, "faces are float64"),
        ({"faces": TRIANGLES[:, :2]}, "faces are"),
        ({"faces": np.array([[0, -1, 2]])}, "-1 after their last corner only"),
        ({"faces": np.array([[0, 1, -1]])}, "face 0 has 2 corners"),
        ({"faces": np.array([[-1, -1, -1]])}, "face 0 has 0 corners"),
        ({"faces": np.array([[0, 1, -2]])}, "face 0 refers to vertex -2"),
        ({"faces": np.array([[0, 1, 4]])}, "face 0 refers to vertex 4"),
        ({"faces": np.zeros((0, 3), int)}, "no faces"),
        ({"deltas": np.zeros((2, 3, 3))}, r"deltas are float64 \(2, 3, 3\), allowed: floats \(k, 4, 3\)"),
        ({"deltas": np.zeros((0, 4, 3))}, "k > 0"),
        ({"deltas": np.array(5.0)}, "deltas are"),
        ({"deltas": np.full((2, 4, 3), np.nan)}, "shape smile: x of vertex 0 is nan"),
        ({"deltas": np.array([{}])}, "nothing is unpickled"),
        ({"deltas": np.zeros(3, [("a", "f4")])}, "not one of plain numbers"),
    ],
)
def test_refuses(tmp_path, changes, words):
    with pytest.raises(FacepinError, match=words):
        open_rig(saved(tmp_path / "f.npz", **changes))


class Trap:
    def __reduce__(self):
        return (pytest.fail, ("it was unpickled",))


@pytest.mark.parametrize("key", ["neutral", "names", "part"])
def test_nothing_is_unpickled(tmp_path, key):
    path = saved(tmp_path / "f.npz", **{key: None})
    trap = io.BytesIO()
    np.lib.format.write_array(trap, np.array([Trap()], object), allow_pickle=True)
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr(f"{key}.npy", trap.getvalue())
    if key == "neutral":
        with pytest.raises(FacepinError, match="nothing is unpickled"):
            open_rig(path)
    else:
        assert any("nothing is unpickled" in line for line in open_rig(path).warnings)
    path.write_bytes(pickle.dumps(Trap()))
    with pytest.raises(FacepinError, match=r"not a sound \.npz"):
        open_rig(path)


def npy(descr, shape, content=b"", version=1, fortran=False):
    header = f"{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}\n".encode()
    size = struct.pack("<H" if version == 1 else "<I", len(header))
    return b"\x93NUMPY" + bytes([version, 0]) + size + header + content


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (npy("<f4", "(100000, 1000000, 3)", bytes(12)), "declares 1200000000"),
        (npy("<f4", "(2, 4, 3)", bytes(95)), "header declares"),
        (npy("<f4", "(2, 4, 3)", bytes(97)), "header declares"),
        (npy("<f4", "(99999999999999999999999999, 4, 3)"), "header declares"),
        (npy("|O", "(2, 4, 3)"), "nothing is unpickled"),
        (npy("f4,f4", "(2, 4, 3)"), "nothing is unpickled"),
        (npy("<f4", "(2 2, 4, 3)"), "not a sound"),
        (npy("<f4", "(-2, 4, 3)"), "plain numbers"),
        (npy("<f4", "(2, 4, 3).__class__"), "plain numbers"),
        (npy("<f4", "(2, 4, 3)", version=9), "version 1 to 3"),
        (b"\x93NUMPY\x02\x00\xff\xff\xff\xff", "array header of 4294967295 bytes"),
        (b"\x93NUM", r"not a \.npy array"),
        (b"", r"not a \.npy array"),
    ],
)
def test_headers_that_lie(tmp_path, content, words):
    path = saved(tmp_path / "f.npz", deltas=None)
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr("deltas.npy", content)
    with pytest.raises(FacepinError, match=words):
        open_rig(path)


@pytest.mark.parametrize("version", [1, 2, 3])
def test_headers_of_all_versions(tmp_path, version):
    path = saved(tmp_path / "f.npz", deltas=None)
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr("deltas.npy", npy("<f4", "(1, 4, 3)", SMILE.tobytes(), version))
    assert np.array_equal(dense(open_rig(path))[0], SMILE)


def test_an_unusual_packing_is_refused(tmp_path):
    path = saved(tmp_path / "f.npz", deltas=None)
    with zipfile.ZipFile(path, "a", zipfile.ZIP_LZMA) as archive:
        archive.writestr("deltas.npy", npy("<f4", "(1, 4, 3)", SMILE.tobytes()))
    with pytest.raises(FacepinError, match="zip method 14"):
        open_rig(path)


def test_shapes_are_inflated_one_at_a_time(tmp_path):
    vertices, shapes = 20_000, 400
    neutral = np.random.default_rng(1).normal(size=(vertices, 3)).astype(np.float32)
    deltas = np.zeros((shapes, vertices, 3), np.float32)
    deltas[:, 7] = 1.0
    names = np.array([f"s{j}" for j in range(shapes)])
    path = saved(tmp_path / "f.npz", neutral=neutral, deltas=deltas, names=names)
    del deltas
    tracemalloc.start()
    rig = open_rig(path)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert rig.deltas.nnz == 3 * shapes
    assert peak < 10e6  # the deltas take 96 MB


def test_a_neutral_out_of_proportion_is_refused(tmp_path):
    neutral = np.zeros((2_000_000, 3), np.float32)
    path = saved(tmp_path / "f.npz", neutral=neutral, deltas=None)
    with zipfile.ZipFile(path, "a", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("deltas.npy", npy("<f4", "(1, 2000000, 3)", bytes(24_000_000)))
    tracemalloc.start()
    with pytest.raises(FacepinError, match="out of proportion"):
        open_rig(path)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 2e6


@pytest.mark.skipif(np.dtype(np.longdouble).itemsize <= 8, reason="long doubles are doubles here")
@pytest.mark.parametrize("key", ["neutral", "deltas", "weights", "part_mats"])
def test_long_doubles_are_numbers_like_others(tmp_path, key):
    more = {"part": np.zeros(4, int), "part_names": np.array(["skin"]), "part_mats": np.full((1, 3), 0.25)}
    more |= {"weights": np.array([0.5, 0.0])}
    arrays = face_arrays() | more
    more[key] = arrays[key].astype(np.longdouble)
    rig = open_rig(saved(tmp_path / "f.npz", **more))
    assert rig.parts[0].roughness == 0.25
    write_model(rig, rig.rest_weights, tmp_path / "f.glb")
    again = open_rig(tmp_path / "f.glb")
    assert np.array_equal(dense(again), [SMILE, BLINK])
    assert again.rest_weights.tolist() == [0.5, 0.0]
