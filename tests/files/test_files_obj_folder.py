"""Rigs from folders of .obj files."""

import tarfile

import numpy as np
import pytest

from facepin.core.errors import FacepinError
from facepin.files import open_rig
from support.sample_files import BLINK, POSITIONS, SMILE, dense, face_folder, obj_lines


def opened(folder, **more):
    return open_rig(folder, cache=False, **more)


def neutral_text(folder, text):
    path = folder / "face_neutral.obj"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return folder


def test_one_file_is_the_neutral_and_each_other_a_shape(tmp_path):
    rig = opened(face_folder(tmp_path / "girl"))
    assert (rig.name, rig.shape_names) == ("girl", ("blink", "smile"))
    assert np.array_equal(rig.neutral, POSITIONS)
    assert np.array_equal(dense(rig), [BLINK, SMILE])
    assert rig.face_sizes.tolist() == [4]
    assert rig.corners.tolist() == [0, 1, 2, 3]


def test_other_files_hidden_files_and_capital_suffixes(tmp_path):
    folder = face_folder(tmp_path / "f")
    (folder / "smile.obj").rename(folder / "smile.OBJ")
    (folder / "._blink.obj").write_bytes(b"\0\0")
    (folder / "notes.txt").write_text("hello")
    (folder / "sub.obj").mkdir()
    assert opened(folder).shape_names == ("blink", "smile")


ODD = {
    "carriage returns": "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0.5\r\nf 1 2 3 4\r\n",
    "old carriage returns": "v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0.5\rf 1 2 3 4\r",
    "no final newline": "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3 4",
    "tabs, blanks, indentation": "v\t0  0\t0 \n  v 1 0 0\n\tv 1 1 0\nv 0 1 .5\n  f  1\t2 3 4 \n",
    "colours and weights": "v 0 0 0 1 .5 0\nv 1 0 0 1\nv 1 1 0 0 0 0\nv 0 1 0.5\nf 1 2 3 4\n",
    "texture and normal numbers": "v 0 0 0\nvt 0 0\nv 1 0 0\nvn 0 0 1\nv 1 1 0\n"
    "v 0 1 5e-1\nf 1/1/1 2//1 3/1 4/1/1\n",
    "relative numbers": "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf -4 -3//-1 -2/1 -1\n",
    "faces between vertices": "v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0.5\nf 1 3 4\n",
    "continued lines": "v 0 \\\n0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 \\\r\n3 \\\n4\n",
    "comments": "# v 9 9 9\nv 0 0 0 # first\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3 4 # f 7 8 9\n",
    "byte order mark": "\ufeffv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3 4\n",
    "other lines": "mtllib none.mtl\ns 1\nvp 1 2\nl 1 2\no x\nv 0 0 0\nv 1 0 0\nv 1 1 0\n"
    "v 0 1 0.5\nf 1 2 3 4\nfoo\n",
}


@pytest.mark.parametrize("text", ODD.values(), ids=ODD.keys())
def test_odd_but_valid(tmp_path, text):
    rig = opened(neutral_text(face_folder(tmp_path / "f"), text))
    assert np.array_equal(rig.neutral, POSITIONS)
    assert rig.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert np.array_equal(dense(rig), [BLINK, SMILE])


def test_parts_are_materials_in_order_of_appearance(tmp_path):
    text = obj_lines(
        POSITIONS, "f 1 2 3\nusemtl the eye\nf 2 3 4\nusemtl lip\nf 1 2 4\nusemtl the eye\nf 1 3 4\n"
    )
    rig = opened(neutral_text(face_folder(tmp_path / "f"), text))
    assert [part.name for part in rig.parts] == ["rest", "the eye", "lip"]
    assert [part.faces for part in rig.parts] == [range(1), range(1, 3), range(3, 4)]
    assert rig.triangles.tolist() == [[0, 1, 2], [1, 2, 3], [0, 2, 3], [0, 1, 3]]


def test_numbers_are_read_as_exactly_as_python_does(tmp_path):
    generator = np.random.default_rng(3)
    folder = tmp_path / "f"
    folder.mkdir()
    texts = [[f"{x:.{generator.integers(1, 12)}g}" for x in row] for row in generator.normal(0, 50, (200, 3))]
    moved = [[f"{float(x) + 1e-3:.9f}" for x in row] for row in texts]
    for name, rows in (("neutral", texts), ("s", moved)):
        (folder / f"{name}.obj").write_text("".join(f"v {' '.join(row)}\n" for row in rows) + "f 1 2 3\n")
    rest, shape = np.array(texts, np.float64), np.array(moved, np.float64)
    rig = opened(folder)
    assert np.array_equal(rig.neutral, rest.astype(np.float32))
    assert np.array_equal(dense(rig)[0], (shape - rest).astype(np.float32))


@pytest.mark.parametrize(
    ("names", "neutral"),
    [
        (["a", "MyNeutralFace", "base"], "MyNeutralFace"),
        (["neutral", "mouth_neutral"], "neutral"),
        (["smile", "face_Basis", "interest"], "face_Basis"),
        (["rest.001", "blink"], "rest.001"),
        (["head-base", "database"], "head-base"),
    ],
)
def test_which_file_is_the_neutral(tmp_path, names, neutral):
    for name in names:
        (tmp_path / f"{name}.obj").write_text(obj_lines(POSITIONS + len(name), "f 1 2 3\n"))
    rig = opened(tmp_path)
    assert set(rig.shape_names) == set(names) - {neutral}
    assert np.array_equal(rig.neutral, POSITIONS + len(neutral))


@pytest.mark.parametrize("wanted", ["b", "B.obj", "b.OBJ"])
def test_the_neutral_can_be_named(tmp_path, wanted):
    for name in ("a_neutral", "b", "c"):
        (tmp_path / f"{name}.obj").write_text(obj_lines(POSITIONS, "f 1 2 3\n"))
    assert opened(tmp_path, neutral=wanted).shape_names == ("a_neutral", "c")


def test_what_to_do_when_no_file_or_several_can_be_the_neutral(tmp_path):
    for name in ("a", "b"):
        (tmp_path / f"{name}.obj").write_text(obj_lines(POSITIONS, "f 1 2 3\n"))
    with pytest.raises(FacepinError, match=r"--neutral: a\.obj, b\.obj"):
        opened(tmp_path)
    with pytest.raises(FacepinError, match=r"no file 'x' .* a\.obj, b\.obj"):
        opened(tmp_path, neutral="x")
    for name in ("neutral_a", "neutral_b"):
        (tmp_path / f"{name}.obj").write_text(obj_lines(POSITIONS, "f 1 2 3\n"))
    with pytest.raises(FacepinError, match=r"several .*--neutral: neutral_a\.obj, neutral_b\.obj"):
        opened(tmp_path)
    assert "neutral_a" in opened(tmp_path / "neutral_b.obj").shape_names


def test_opening_one_of_the_files_opens_its_folder(tmp_path):
    folder = face_folder(tmp_path / "f")
    assert opened(folder / "smile.obj").shape_names == ("blink", "smile")
    (folder / "face_neutral.obj").rename(folder / "face.obj")
    assert opened(folder / "face.obj").shape_names == ("blink", "smile")


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (
            obj_lines(POSITIONS, "f 1 2\n"),
            r"face_neutral\.obj:5: found 'f 1 2', allowed: f and three or more",
        ),
        (obj_lines(POSITIONS, "f 1 2 3\nf 1 2 5\n"), r":6: found 'f 1 2 5', allowed: vertex numbers 1 to 4"),
        (obj_lines(POSITIONS, "f 0 1 2\n"), ":5:"),
        (obj_lines(POSITIONS, "f -5 1 2\n"), ":5:"),
        (obj_lines(POSITIONS, "f 1 2 9999999999999999999999\n"), ":5:"),
        (obj_lines(POSITIONS, "f a b c\n"), ":5:"),
        (obj_lines(POSITIONS, "f 1.5 2 3\n"), ":5:"),
        (obj_lines(POSITIONS, "f 1 2 f\n"), ":5:"),
        (obj_lines(POSITIONS, "f\t\n"), ":5:"),
        ("\\\n# x \\\n\nv 1 2 3\nv nan 0 0\n", r":5: found 'v nan 0 0'"),
        ("v 1 2 3\nv 1e999 0 0\n", ":2:"),
        ("v 1 2 3\nv 1_0 0 0\n", ":2:"),
        ("v 1 2 3\nv 0x10 0 0\n", ":2:"),
        ("v 1 2 3\nv 1,000.5 0 0\n", ":2:"),
        ("v 1 2 3\nv 1 2\nv 1 2 3 4\n", ":2:"),
        ("v \n", ":1:"),
        ("", "no vertices"),
        ("hello", "no vertices"),
        (obj_lines(POSITIONS), "no faces"),
        (obj_lines(POSITIONS, "f 1 2 3\n").encode("utf-16"), "UTF-16"),
        (bytes(range(256)), "UTF-16 or binary"),
    ],
)
def test_refuses_with_file_and_line(tmp_path, text, line):
    with pytest.raises(FacepinError, match=line):
        opened(neutral_text(face_folder(tmp_path / "f"), text))


def test_refuses_other_counts_links_and_lonely_files(tmp_path):
    folder = face_folder(tmp_path / "f")
    (folder / "blink.obj").write_text(obj_lines(POSITIONS[:3]))
    with pytest.raises(FacepinError, match=r"blink\.obj: 3 vertices, face_neutral\.obj has 4"):
        opened(folder)
    (folder / "blink.obj").unlink()
    (tmp_path / "outside.obj").write_text(obj_lines(POSITIONS))
    (folder / "blink.obj").symlink_to(tmp_path / "outside.obj")
    with pytest.raises(FacepinError, match="leads out of the folder"):
        opened(folder)
    (folder / "blink.obj").unlink()
    (folder / "smile.obj").unlink()
    with pytest.raises(FacepinError, match=r"one \.obj file more for each shape"):
        opened(folder)
    (folder / "face_neutral.obj").rename(folder / "face.glb")
    with pytest.raises(FacepinError, match=r"no \.obj files.*face\.glb"):
        opened(folder)


def test_many_continued_lines_take_no_long_time(tmp_path):
    text = obj_lines(POSITIONS, "f 1 2 3 4\n") + "# " + "\\\n" * 300_000
    assert opened(neutral_text(face_folder(tmp_path / "f"), text)).shape_count == 2


def test_a_real_folder_is_the_same_as_the_archive(tmp_path, shared):
    models = shared / "models" / "ict-facekit"
    with tarfile.open(models / "ict_narrowface_expressions.tar.xz") as archive:
        archive.extractall(tmp_path, filter="data")
    (folder,) = (path for path in tmp_path.iterdir() if path.is_dir())
    rig = opened(folder)
    whole = open_rig(models / "ict_full153.npz")
    count = rig.vertex_count
    assert (count, rig.shape_count, len(rig.face_sizes)) == (6706, 53, 6560)
    assert rig.shape_names == whole.shape_names[:53]
    assert np.allclose(rig.neutral, whole.neutral[:count], atol=1e-5)
    assert np.array_equal(rig.corners, whole.corners[: len(rig.corners)])
    assert abs(rig.deltas - whole.deltas[: 3 * count, :53]).max() < 5e-3
