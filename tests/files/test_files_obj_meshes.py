"""Folders of .obj files whose meshes are not all the same, and what else people have in them."""

import numpy as np
import pytest

from facepin.core.errors import FacepinError
from facepin.files import open_rig
from facepin.files.obj.neutral_file import NeutralUnknown
from support.sample_files import BLINK, POSITIONS, SMILE, dense, face_folder, obj_lines

SIDE = 6


def opened(folder, **more):
    return open_rig(folder, cache=False, **more)


def grid():
    """A bulging square of 6 x 6 vertices and its 25 quads, none like another."""
    y, x = np.divmod(np.arange(SIDE * SIDE), SIDE)
    points = np.stack([x, y, 0.1 * x * x - 0.05 * x * y], axis=1).astype(float)
    quads = [(i, i + 1, i + SIDE + 1, i + SIDE) for i in range(SIDE * (SIDE - 1)) if i % SIDE < SIDE - 1]
    return points, quads


def written(path, points, faces, more=""):
    lines = "".join("f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces)
    path.write_text(obj_lines(points, more + lines))


@pytest.fixture
def folder(tmp_path):
    points, quads = grid()
    folder = tmp_path / "face"
    folder.mkdir()
    written(folder / "neutral.obj", points, quads)
    written(folder / "lift.obj", points + lift(), quads)
    return folder


def lift():
    moved = np.zeros((SIDE * SIDE, 3))
    moved[3:9, 1] = np.arange(1, 7) / 8
    return moved


def shuffled(seed=2):
    """The lifted grid with its vertices in another order: points, quads."""
    points, quads = grid()
    order = np.random.default_rng(seed).permutation(len(points))
    return (points + lift())[order], [tuple(np.argsort(order)[list(quad)].tolist()) for quad in quads]


def test_a_shape_in_another_order_is_left_out_and_named(folder):
    points, quads = shuffled()
    written(folder / "knot.obj", points, quads[::-1])
    rig = opened(folder)
    assert rig.shape_names == ("lift",)
    (warning,) = rig.warnings
    assert warning.startswith("left out: knot.obj:37: face 0 joins other vertices than those of neutral.obj")
    (folder / "lift.obj").unlink()
    with pytest.raises(FacepinError, match=r"^knot\.obj:37: face 0 .* another order"):
        opened(folder)


def test_another_order_is_undone_where_the_faces_tell_it(folder):
    written(folder / "again.obj", *shuffled())
    rig = opened(folder)
    assert rig.shape_names == ("again", "lift")
    np.testing.assert_allclose(dense(rig)[0], lift(), atol=1e-6)
    warning, _ = rig.warnings  # and that it equals the other
    assert "again.obj: its vertices are in another order than those of neutral.obj" in warning


def test_one_piece_in_another_order_is_noticed_too(folder):
    points, quads = grid()
    points = np.concatenate([points, points + np.array([0, 0, 5])])
    both = [*quads, *(tuple(i + SIDE * SIDE for i in quad) for quad in quads)]
    order = np.arange(2 * SIDE * SIDE)
    order[SIDE * SIDE :] = SIDE * SIDE + np.random.default_rng(1).permutation(SIDE * SIDE)
    written(folder / "neutral.obj", points, both)
    written(
        folder / "half.obj", points[order], [tuple(np.argsort(order)[list(q)].tolist()) for q in both][::-1]
    )
    written(folder / "lift.obj", points + np.tile(lift(), (2, 1)), both)
    rig = opened(folder)
    assert rig.shape_names == ("lift",)
    assert "half.obj" in rig.warnings[0]


@pytest.mark.parametrize("kind", ["backwards", "triangles", "some", "none", "turned", "counted back"])
def test_the_same_vertices_with_faces_written_otherwise_are_a_shape(folder, kind):
    points, quads = grid()
    faces = {
        "backwards": quads[::-1],
        "triangles": [part for a, b, c, d in quads for part in ((a, b, c), (a, c, d))],
        "some": quads[:7],
        "none": [],
        "turned": [(b, c, d, a) for a, b, c, d in quads],
        "counted back": [tuple(i - SIDE * SIDE - 1 for i in quad) for quad in quads],
    }[kind]
    written(folder / "other.obj", points + lift(), faces)
    rig = opened(folder)
    assert rig.shape_names == ("lift", "other")
    np.testing.assert_allclose(dense(rig)[1], lift(), atol=1e-6)
    assert all("equal shapes" in line for line in rig.warnings)


def test_another_mesh_beside_is_drawn_still(folder, tmp_path):
    eye = np.array([[1, 1, 2], [2, 1, 2], [2, 2, 2], [1, 2, 2], [1.5, 1.5, 2.5]])
    written(folder / "eye.obj", eye, [(0, 1, 2, 3), (0, 1, 4)])
    rig = opened(folder)
    assert (rig.vertex_count, rig.shape_names) == (SIDE * SIDE + 5, ("lift",))
    assert [(part.name, len(part.faces)) for part in rig.parts] == [("face", 25), ("eye", 2)]
    np.testing.assert_array_equal(rig.evaluate(np.ones(1))[-5:], eye)
    np.testing.assert_array_equal(rig.corners[-3:], np.array([0, 1, 4]) + SIDE * SIDE)
    assert not rig.warnings
    cache = tmp_path / "cache"
    first, second = (open_rig(folder, cache_folder=cache) for _ in range(2))
    assert first.fingerprint == second.fingerprint == rig.fingerprint
    assert [part.name for part in second.parts] == ["face", "eye"]


def test_another_topology_of_the_same_face_is_no_mesh_beside(folder):
    points, quads = grid()
    finer = np.concatenate([points, points[:5] + 0.01])
    written(folder / "finer.obj", finer, quads)
    with pytest.raises(FacepinError, match=r"^finer\.obj: 41 vertices, neutral\.obj has 36$"):
        opened(folder)


def test_decimal_commas_are_read(tmp_path):
    folder = face_folder(tmp_path / "f")
    for file in folder.iterdir():
        file.write_text(file.read_text().replace(".", ","))
    rig = opened(folder)
    np.testing.assert_array_equal(rig.neutral, POSITIONS)
    np.testing.assert_array_equal(dense(rig), [BLINK, SMILE])


def test_subfolders_are_named(tmp_path):
    for name, files in (("neutral", 1), ("shapes", 2)):
        (tmp_path / name).mkdir()
        for number in range(files):
            (tmp_path / name / f"{number}.obj").write_text(obj_lines(POSITIONS))
    with pytest.raises(FacepinError, match=r"neutral \(1\), shapes \(2\): put neutral and shapes into one"):
        opened(tmp_path)
    (tmp_path / "neutral" / "0.obj").unlink()
    with pytest.raises(FacepinError, match="in its subfolder shapes: open that"):
        opened(tmp_path)


COLOURS = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [0.2, 0.4, 1]])


@pytest.mark.parametrize("way", ["numbers", "bytes", "polypaint"])
def test_colours_of_vertices(tmp_path, way):
    folder = face_folder(tmp_path / "f")
    levels = np.rint(255 * COLOURS).astype(int)
    further = {"numbers": COLOURS, "bytes": levels, "polypaint": np.zeros((4, 0))}[way]
    rows = np.concatenate([POSITIONS, further], axis=1)
    text = "".join("v " + " ".join(f"{x:g}" for x in row) + "\n" for row in rows)
    if way == "polypaint":
        text += "#MRGB " + "".join(f"ff{r:02x}{g:02X}{b:02x}" for r, g, b in levels) + "\n"
    (folder / "face_neutral.obj").write_text(text + "f 1 2 3 4\n")
    for rig in (opened(folder), *(open_rig(folder, cache_folder=tmp_path / "cache") for _ in range(2))):
        np.testing.assert_allclose(rig.colours, COLOURS, atol=1e-6)


def test_a_reference_is_a_neutral_and_a_sequence_has_to_be_asked_for(tmp_path):
    for name in ("head-02", "head-10", "head-1"):
        (tmp_path / f"{name}.obj").write_text(obj_lines(POSITIONS, "f 1 2 3\n"))
    with pytest.raises(NeutralUnknown, match="--neutral") as refused:
        opened(tmp_path)
    assert refused.value.names == ("head-1.obj", "head-02.obj", "head-10.obj")
    assert refused.value.likely == "head-1.obj"
    assert refused.value.folder == tmp_path
    assert opened(tmp_path, neutral="head-1").shape_names == ("head-02", "head-10")
    (tmp_path / "head-reference.obj").write_text(obj_lines(POSITIONS, "f 1 2 3\n"))
    assert opened(tmp_path).shape_names == ("head-1", "head-02", "head-10")


def test_the_cases_people_reported(shared):
    cases = shared / "cases" / "files"
    if not cases.is_dir():
        pytest.skip("the reported cases are missing")
    folders = [path for path in sorted(cases.glob("obj_*")) if path.name != "obj_subfolders"]
    shapes = {folder.name: opened(folder).shape_names for folder in folders}
    assert shapes.pop("obj_neutral_called_reference") == ("head-01-anger", "head-02-cry")
    assert set(shapes.values()) == {("jawOpen",)}


def test_the_head_of_a_file_tells_that_it_is_no_text(tmp_path):
    folder = face_folder(tmp_path / "f")
    with (folder / "smile.obj").open("wb") as file:
        file.truncate(1 << 40)  # a hole: far more than fits into memory
    with pytest.raises(FacepinError, match=r"smile\.obj: UTF-16 or binary content"):
        opened(folder)


LIBRARY = """# colours
newmtl skin
Kd 0.8 0.5 0.25
newmtl the eye
Kd 0 0 0
map_Kd eye.png
newmtl tear
Kd 0.5 0.5 1
d 0.25
newmtl odd
Kd a b
"""


def test_parts_have_the_colours_of_their_materials(tmp_path):
    folder = face_folder(tmp_path / "f")
    faces = "".join(f"usemtl {name}\nf 1 2 3\n" for name in ("skin", "the eye", "tear", "odd", "none"))
    text = "mtllib face colours.mtl\nmtllib ../out.mtl lost.mtl\n" + obj_lines(POSITIONS, faces)
    (folder / "face_neutral.obj").write_text(text)
    (folder / "face colours.mtl").write_text(LIBRARY)
    for rig in (opened(folder), *(open_rig(folder, cache_folder=tmp_path / "cache") for _ in range(2))):
        assert [part.colour for part in rig.parts] == [(0.8, 0.5, 0.25), None, (0.5, 0.5, 1), None, None]
        assert [(part.opacity, part.blends) for part in rig.parts][1:3] == [(1, False), (0.25, True)]
        out, textures = rig.warnings
        assert "out.mtl' is not in the folder" in out
        assert "(map_Kd) are left out, of the materials the eye" in textures
    (folder / "face colours.mtl").write_text(LIBRARY.replace("0.8", "0.9 "))
    assert open_rig(folder, cache_folder=tmp_path / "cache").parts[0].colour == (0.9, 0.5, 0.25)
