"""The one door to a rig."""

import numpy as np
import pytest

from facepin.core.errors import FacepinError
from facepin.core.look.face_view import face_camera
from facepin.core.names import clean_name, clean_names, listed, shown_name
from facepin.core.rig_builder import PartLook, build_rig
from support.sample_files import dense

NEUTRAL = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0]], np.float32)
CORNERS = np.array([0, 1, 2, 3, 1, 4, 2])
SIZES = np.array([4, 3])


def rig_with(*deltas, names=None, **more):
    names = names or [f"s{j}" for j in range(len(deltas))]
    return build_rig("face", NEUTRAL, CORNERS, SIZES, zip(names, deltas, strict=True), **more)


def random_deltas(seed, count):
    generator = np.random.default_rng(seed)
    deltas = generator.normal(size=(count, len(NEUTRAL), 3)).astype(np.float32)
    deltas[generator.random(deltas.shape) < 0.6] = 0.0
    return deltas


def test_columns_are_the_deltas_without_their_zeros():
    deltas = random_deltas(1, 7)
    rig = rig_with(*deltas)
    assert np.array_equal(dense(rig), deltas)
    assert rig.deltas.nnz == np.count_nonzero(deltas)
    assert rig.deltas.dtype == np.float32
    assert rig.deltas.indices.dtype == np.int32
    for j in range(7):
        run = rig.deltas.indices[rig.deltas.indptr[j] : rig.deltas.indptr[j + 1]]
        assert (np.diff(run) > 0).all()
    rng_weights = np.random.default_rng(2).random(7)
    expected = NEUTRAL + np.tensordot(rng_weights, deltas, 1)
    assert np.allclose(rig.evaluate(rng_weights), expected, atol=1e-5)


def test_a_pair_in_any_order_is_the_same_as_the_full_delta():
    full = random_deltas(3, 1)[0]
    full[2] = 0.0
    chosen = np.array([4, 0, 3, 1])
    pair = rig_with((chosen, full[chosen]))
    assert np.array_equal(dense(pair)[0], full)
    assert np.array_equal(pair.deltas.indices, rig_with(full).deltas.indices)


def test_shapes_may_come_from_an_iterator_and_in_other_number_types():
    deltas = random_deltas(4, 3)
    rig = build_rig(
        "f", NEUTRAL, CORNERS, SIZES, ((f"s{j}", d.astype(np.float64)) for j, d in enumerate(deltas))
    )
    assert np.array_equal(dense(rig), deltas)


def test_everything_is_read_only_and_not_shared():
    neutral = NEUTRAL.copy()
    rig = build_rig("f", neutral, CORNERS, SIZES, [("s", NEUTRAL)], colours=np.ones((5, 3)))
    neutral[:] = 9.0
    assert np.array_equal(rig.neutral, NEUTRAL)
    arrays = (
        rig.neutral,
        rig.corners,
        rig.face_sizes,
        rig.triangles,
        rig.limits,
        rig.rest_weights,
        rig.colours,
        rig.deltas.data,
        rig.deltas.indices,
        rig.deltas.indptr,
    )
    assert not any(array.flags.writeable for array in arrays)


def test_polygons_become_fans():
    rig = rig_with(NEUTRAL)
    assert rig.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [1, 4, 2]]
    pentagon = build_rig("f", NEUTRAL, [0, 1, 4, 2, 3], [5], [("s", NEUTRAL)])
    assert pentagon.triangles.tolist() == [[0, 1, 4], [0, 4, 2], [0, 2, 3]]


def test_faces_are_grouped_by_part_and_vertices_stay():
    corners = [0, 1, 2, 1, 4, 2, 0, 1, 2, 3]
    looks = [PartLook("skin"), PartLook("unused"), PartLook("eye", (1.0, 0.5, 0.0), 0.1)]
    rig = build_rig("f", NEUTRAL, corners, [3, 3, 4], [("s", NEUTRAL)], parts=looks, face_parts=[2, 0, 2])
    assert rig.corners.tolist() == [1, 4, 2, 0, 1, 2, 0, 1, 2, 3]
    assert rig.face_sizes.tolist() == [3, 3, 4]
    assert [(part.name, part.faces, part.triangles) for part in rig.parts] == [
        ("skin", range(1), range(1)),
        ("eye", range(1, 3), range(1, 4)),
    ]
    assert (rig.parts[1].colour, rig.parts[1].roughness) == ((1.0, 0.5, 0.0), 0.1)
    assert np.array_equal(rig.neutral, NEUTRAL)


def test_limits_are_widened_by_rest_weights_and_never_clip_them():
    deltas = random_deltas(5, 3)
    rig = rig_with(*deltas, rest_weights=[-0.5, 0.2, 1.1])
    assert rig.limits.tolist() == [[-0.5, 1.0], [0.0, 1.0], [0.0, 1.1]]
    assert rig.rest_weights.tolist() == [-0.5, 0.2, 1.1]


def test_equal_and_still_shapes_are_told_by_their_final_names():
    one = random_deltas(6, 1)[0]
    rig = rig_with(one, np.zeros_like(one), one, names=["{a}", "b", "{a}"])
    assert rig.shape_names == ("{a}", "b", "{a} 2")
    assert any("{a} and {a} 2" in line for line in rig.warnings)
    assert any("move nothing: b" in line for line in rig.warnings)
    assert not rig_with(*random_deltas(7, 20)).warnings


def test_warnings_stay_few():
    assert len(rig_with(NEUTRAL, warnings=[f"w{i}" for i in range(1000)]).warnings) < 50


@pytest.mark.parametrize(
    ("raw", "clean"),
    [
        ("jawOpen", "jawOpen"),
        ("  two\t words\n", "two words"),
        ("a\x00b\x1b[31mc\u202ed\u200be", "abcde"),
        ("Lächeln 笑", "Lächeln 笑"),
        ("../../x", "../../x"),
        ("\ud800", ""),
    ],
)
def test_names_become_printable(raw, clean):
    assert clean_name(raw) == clean


def test_long_names_are_shortened():
    assert len(clean_name("x" * 100_000)) == 64


def test_what_is_shown_of_long_names_has_both_ends():
    left, right = (f"{'long_' * 30}{side}" for side in ("Left", "Right"))
    assert len(shown_name(left)) == 64
    assert shown_name(left) != shown_name(right)
    assert shown_name(" a  b ") == "a b"
    assert max(map(len, listed([left, right]).split(", "))) == 64


def test_names_become_unique_without_taking_a_name_that_is_there():
    names, remarks = clean_names(["a", "a", "a 2", "", "a", "shape_3"])
    assert names == ["a", "a 3", "a 2", "shape_3_", "a 4", "shape_3"]
    assert len(set(names)) == 6
    assert len(remarks) == 2
    assert clean_names(["x", "y"]) == (["x", "y"], [])


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"neutral": NEUTRAL[:, :2]}, "neutral must be"),
        ({"neutral": np.zeros((0, 3))}, "no vertices"),
        ({"neutral": np.full((5, 3), np.nan)}, "x of vertex 0 is nan"),
        ({"neutral": np.full((5, 3), 1e39)}, "allowed are finite numbers"),
        ({"neutral": NEUTRAL.astype(str)}, "neutral must be"),
        ({"corners": [0, 1, 2, 3, 1, 5, 2]}, "face 1 refers to vertex 5, allowed are 0 to 4"),
        ({"corners": [0, 1, 2, -1, 1, 4, 2]}, "face 0 refers to vertex -1"),
        ({"corners": np.array([0, 1, 2, 3, 1, 4, 2.5])}, "whole numbers"),
        ({"face_sizes": [4, 2]}, "face 1 has 2 corners"),
        ({"face_sizes": [4, 4]}, "ask for 8 corners, found 7"),
        ({"corners": np.zeros(0, int), "face_sizes": np.zeros(0, int)}, "no faces"),
        ({"shapes": []}, "no shapes"),
        ({"shapes": [("s", NEUTRAL[:4])]}, "shape s has 4 vertices, the neutral has 5"),
        ({"shapes": [("s", np.full((5, 3), np.inf))]}, "shape s: x of vertex 0 is inf"),
        ({"shapes": [("s", ([3], [[0, np.nan, 0]]))]}, "y of vertex 3 is nan"),
        ({"shapes": [("s", ([5], [[0, 1, 0]]))]}, "moves vertex 5"),
        ({"shapes": [("s", ([1, 1], np.ones((2, 3))))]}, "twice"),
        ({"shapes": [("s", ([1, 2], np.ones((3, 3))))]}, "do not fit"),
        ({"rest_weights": [0.0, 0.0]}, "rest weights"),
        ({"rest_weights": [np.nan]}, "rest weights"),
        ({"limits": [[0.0, 1.0, 2.0]]}, "limits"),
        ({"limits": [[1.0, 0.5]]}, "limits of s are"),
        ({"colours": np.zeros((4, 3))}, "colours"),
        ({"face_parts": [0]}, "face_parts"),
        ({"face_parts": [0, 1]}, "face_parts"),
    ],
)
def test_refuses_with_the_place_and_what_is_allowed(change, words):
    pieces = {"neutral": NEUTRAL, "corners": CORNERS, "face_sizes": SIZES, "shapes": [("s", NEUTRAL)]}
    with pytest.raises(FacepinError, match=words):
        build_rig("face", **(pieces | change))


def test_an_error_is_one_printable_line_whatever_it_quotes():
    line = str(FacepinError("a\nb\x1b[0m\u202e" + "x" * 10_000))
    assert line.isprintable()
    assert len(line) == 400


@pytest.mark.parametrize("size", [0.1, 20.0])
def test_the_height_of_what_is_flat_is_its_extent(size: float) -> None:
    points = size * np.array([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]])
    rig = build_rig("flat", points, [0, 1, 2, 3], [4], [("move", np.ones((4, 3)))])
    assert rig.height == pytest.approx(size)


def test_shapes_in_another_unit_or_out_of_sight_are_told() -> None:
    points = np.concatenate([np.asarray(NEUTRAL, float), [[0, 1000, 0]]])
    wide = 100 * points
    wide[-1] = 0
    lines = np.zeros_like(points)
    lines[-1] = 1
    shapes = [("fine", 0.5 * points), ("wide", wide), ("lines", lines), ("still", np.zeros_like(points))]
    rig = build_rig("face", points, CORNERS, SIZES, shapes)
    far, unseen, still = (
        [line for line in rig.warnings if words in line]
        for words in ("another unit: wide", "in no face, so nothing is seen: lines", "move nothing: still")
    )
    assert len(far) == len(unseen) == len(still) == 1
    assert len(rig.warnings) == 3


def test_a_vertex_in_no_face_counts_for_nothing() -> None:
    alone = build_rig("face", NEUTRAL, CORNERS, SIZES, [("s", 0.5 * np.asarray(NEUTRAL))])
    points = np.concatenate([np.asarray(NEUTRAL, float), [[300, 1000, 0]]])
    rig = build_rig("face", points, CORNERS, SIZES, [("s", 0.5 * points)])
    assert rig.height == alone.height
    assert rig.drawn.tolist() == [True] * len(NEUTRAL) + [False]
    ours, theirs = (face_camera(one, (400, 300)) for one in (rig, alone))
    assert (ours.target, ours.distance) == (theirs.target, theirs.distance)


def test_a_face_in_one_point_is_told() -> None:
    rig = build_rig("dot", np.ones((5, 3)), CORNERS, SIZES, [("s", np.ones((5, 3)))])
    assert rig.warnings == ("all faces of the neutral are in one point, so nothing of it can be seen",)
