"""The built-in faces: the files are what the generator makes, and an animator can work with them."""

import sys
from itertools import product
from pathlib import Path

import numpy as np
import pytest

ASSETS = Path(__file__).resolve().parents[2] / "assets"
BLINKS = np.arange(0.1, 1.01, 0.1)
GAZES = [
    {name + "Left": 1 if "" in pair else 0.7 for name in pair if name}
    for pair in product(("", "eyeLookUp", "eyeLookDown"), ("", "eyeLookIn", "eyeLookOut"))
]
"""Straight on, the four directions, and between them."""
LID_COMPANIONS = ("eyeSquint", "eyeWide", "browDown", "cheekSquint", "mouthSmile")
CLOSED_MOUTHS = (
    {"jawOpen": 1, "mouthClose": 1},
    {"jawOpen": 0.5, "mouthClose": 0.5},
    {"mouthPucker": 1},
    {"mouthRollLower": 1, "mouthRollUpper": 1},
    {"mouthRollLower": 1},
    {"mouthRollUpper": 1},
    {"mouthSmile": 1},
    {"mouthFrown": 1},
    {"mouthPress": 1},
    {"mouthSmile": 1, "mouthPress": 0.6},
)
BEHIND_THE_LIPS = ("teethUpper", "teethLower", "gums", "tongue")
EXPRESSIONS = {
    "joy": {
        "mouthSmile": 0.95,
        "cheekSquint": 0.55,
        "jawOpen": 0.34,
        "mouthUpperUp": 0.22,
        "browInnerUp": 0.35,
    },
    "laugh": {"mouthSmile": 1, "jawOpen": 0.7, "eyeSquint": 0.8, "cheekSquint": 0.8},
    "sadness": {"browInnerUp": 0.95, "mouthFrown": 0.85, "mouthShrugLower": 0.45, "eyeBlink": 0.22},
    "crying": {"browInnerUp": 1, "mouthStretch": 0.7, "eyeBlink": 0.7, "cheekSquint": 0.5, "jawOpen": 0.2},
    "anger": {"browDown": 1, "eyeSquint": 0.35, "noseSneer": 0.6, "mouthFrown": 0.45, "mouthLowerDown": 0.45},
    "shout": {"jawOpen": 1, "mouthUpperUp": 0.55, "mouthLowerDown": 0.5, "browDown": 0.8, "noseSneer": 0.5},
    "surprise": {"browInnerUp": 0.8, "browOuterUp": 0.8, "eyeWide": 1, "jawOpen": 0.6, "mouthFunnel": 0.5},
    "disgust": {"noseSneer": 1, "browDown": 0.6, "mouthUpperUp": 0.65, "eyeSquint": 0.5, "mouthFrown": 0.45},
    "fear": {"browInnerUp": 1, "eyeWide": 0.85, "mouthStretch": 0.85, "jawOpen": 0.25, "mouthLowerDown": 0.3},
    "wink": {"eyeBlinkLeft": 1, "cheekSquintLeft": 0.7, "mouthSmileLeft": 0.9, "browOuterUpRight": 0.6},
    "kiss": {"mouthPucker": 1, "eyeBlink": 0.45, "browInnerUp": 0.35, "cheekPuff": 0.1},
    "smirk": {"mouthSmileLeft": 0.85, "mouthDimpleLeft": 0.5, "mouthLeft": 0.25, "browOuterUpLeft": 0.7},
    "doubt": {"browDownLeft": 0.8, "browOuterUpRight": 0.9, "mouthRight": 0.6, "mouthShrugLower": 0.5},
    "sleepy": {"eyeBlink": 0.6, "eyeLookDown": 0.5, "jawOpen": 0.1},
    "oh": {"jawOpen": 0.7, "mouthFunnel": 0.8, "browOuterUp": 0.4},
    "oo": {"jawOpen": 0.35, "mouthPucker": 0.9},
    "yawn": {"jawOpen": 1, "eyeBlink": 0.9, "browInnerUp": 0.6, "mouthFunnel": 0.3},
    "whistle": {"mouthPucker": 0.8, "mouthFunnel": 0.4, "eyeLookUp": 0.7, "browOuterUp": 0.5},
    "sealed": {"mouthPress": 0.8, "mouthRollLower": 0.5, "mouthRollUpper": 0.5, "browDown": 0.3},
    "puffed": {"cheekPuff": 1, "mouthPucker": 0.5, "eyeWide": 0.4},
    "tongue": {"tongueOut": 1, "eyeSquint": 0.6, "mouthSmile": 0.3},
    "sideways": {"jawLeft": 0.8, "mouthLeft": 0.6, "eyeLookInLeft": 1, "eyeLookOutRight": 1},
}


@pytest.fixture(scope="module")
def generator():
    """Put the generator on the import path."""
    sys.path.insert(0, str(ASSETS))
    yield
    sys.path.remove(str(ASSETS))


@pytest.fixture(scope="module", params=["ada", "bruno", "mira"])
def model(request, generator):
    """A character made afresh."""
    from generator.assembly import build_model
    from generator.character import build_character
    from generator.characters import CHARACTERS, PRODUCTION

    return build_model(build_character(CHARACTERS[request.param]), production=request.param in PRODUCTION)


def height(model):
    """Chin to crown: what "face height" means in the limits below."""
    return float(np.ptp(model.character.skin.vertices[:, 1]))


def test_committed_file_is_what_the_generator_makes(model, request):
    from generator.assembly import arrays

    made = arrays(model)
    name = request.node.callspec.params["model"]
    with np.load(ASSETS / "faces" / f"{name}.npz", allow_pickle=False) as stored:
        assert set(stored.files) == set(made)
        for key, array in made.items():
            if array.dtype.kind == "f":
                np.testing.assert_allclose(stored[key], array, atol=1e-3, err_msg=key)
            else:
                np.testing.assert_array_equal(stored[key], array, err_msg=key)


def test_files_depend_on_the_arrays_only(generator, tmp_path):
    from generator.archive import write_archive

    for name in ("one.npz", "two.npz"):
        write_archive(tmp_path / name, {"a": np.arange(3), "b": np.eye(2)})
    assert (tmp_path / "one.npz").read_bytes() == (tmp_path / "two.npz").read_bytes()


def test_size_and_names(model):
    assert 8_000 <= len(model.character.vertices) <= 14_000
    from generator.assembly import ARKIT

    assert len(ARKIT) == 52
    assert set(ARKIT) <= set(model.names)
    assert len(set(model.names)) == len(model.names)


def test_every_part_is_there_with_its_colours(model):
    from generator.character import MATERIALS
    from generator.checks import part_triangles

    character = model.character
    for part in MATERIALS:
        assert len(part_triangles(model, part)), part
    assert np.isfinite(character.colours).all()
    assert character.colours.min() >= 0
    assert character.colours.max() <= 1
    for side, sign in (("eyeL", 1), ("eyeR", -1)):
        eye, place = character.anatomy.eye, character.place(side)
        away = place - np.array(eye.centre) * (sign, 1, 1)
        angle = np.arctan2(np.hypot(away[:, 0], away[:, 1]), away[:, 2])
        colours = character.colours[character.at(side)]
        assert colours[angle < eye.pupil - 0.02].max() < 0.05
        iris = colours[(angle > eye.pupil + 0.05) & (angle < eye.iris - 0.1)]
        assert (iris.max(1) - iris.min(1)).min() > 0.1
        assert colours[(angle > eye.iris + 0.05) & (angle < 0.8)].min() > 0.6


def test_production_character_has_many_shapes_and_all_fit_in_the_package():
    with np.load(ASSETS / "faces" / "mira.npz", allow_pickle=False) as stored:
        assert len(stored["names"]) > 120
    assert sum(path.stat().st_size for path in ASSETS.rglob("*") if path.is_file()) < 12e6


def test_left_and_right_are_mirror_images(model):
    from generator.checks import asymmetry

    neutral, shapes = asymmetry(model)
    assert neutral < 1e-5 * height(model)
    assert shapes < 1e-5 * height(model)


def test_no_slivers_and_nothing_inverted_torn_or_bunched(model):
    from generator.checks import edges_of, flipped, stretch, triangle_quality, visible_skin

    neutral, triangles = model.character.vertices, model.character.triangles
    skin = triangles[visible_skin(model)]
    edges = edges_of(skin)
    assert triangle_quality(neutral, triangles).min() > 0.02
    assert triangle_quality(neutral, skin).min() > 0.08
    for name in model.names:
        posed = model.posed({name: 1})
        assert flipped(neutral, posed, skin) == 0, name
        assert triangle_quality(posed, skin).min() > 0.02, name
        longer = stretch(neutral, posed, edges)
        assert longer.min() > 0.12, name
        assert longer.max() < 5, name


def test_lids_close_without_gap_or_poke(model):
    from generator.checks import lid_clearance, lid_gap

    others = [*GAZES, *({name + "Left": 1} for name in LID_COMPANIONS)]
    for other in others:
        for blink in (0, *BLINKS):
            posed = model.posed({**other, "eyeBlinkLeft": blink})
            assert lid_clearance(model, posed) > 0, (blink, other)
        assert lid_gap(model, posed) < 0.01, other


def test_every_step_of_a_blink_closes_the_eye_further(model):
    from generator.checks import lid_gap

    gaps = [lid_gap(model, model.posed({"eyeBlinkLeft": blink})) for blink in (0, *BLINKS)]
    assert np.all(np.diff(gaps) < 0)
    assert gaps[5] < 0.6 * gaps[0]


def test_lips_meet_and_do_not_cross(model):
    from generator.checks import crossings, lip_gap, lips, part_triangles, uncovered

    upper, lower = lips(model)
    both = np.concatenate([upper, lower])
    behind = np.concatenate([part_triangles(model, part) for part in BEHIND_THE_LIPS])
    for weights in ({}, *CLOSED_MOUTHS, {"mouthFunnel": 1}):
        posed = model.posed(weights)
        lowest, highest = lip_gap(model, posed)
        assert lowest > 0, weights
        assert highest < 0.02 or "mouthFunnel" in weights, weights
        assert uncovered(model, posed) < 0, weights
        assert crossings(posed, upper, lower) == 0, weights
        assert crossings(posed, both, behind) == 0, weights


def test_neutral_neither_smiles_nor_frowns(model):
    from generator.checks import corner_lift, eye_corner_facing

    assert abs(corner_lift(model)) < 0.003 * height(model)
    assert eye_corner_facing(model) > 0.65


def test_squints_lift_the_cheek(model):
    from generator.checks import cheek_move

    for name, least in (("cheekSquintLeft", 0.5), ("eyeSquintLeft", 0.25), ("mouthSmileLeft", 0.2)):
        across, up, forward = cheek_move(model, model.posed({name: 1}))
        assert up > least, name
        assert forward > 0, name
        assert up > 2 * abs(across), name
    both = cheek_move(model, model.posed({"cheekSquintLeft": 1, "eyeSquintLeft": 1}))[1]
    assert both < 1.4 * cheek_move(model, model.posed({"cheekSquintLeft": 1}))[1]


def test_smile_and_sneer_fold_the_skin_beside_nose_and_mouth(model):
    from generator.checks import fold_angles
    from generator.folds import FOLDS

    neutral = model.character.vertices
    for name, least in (("mouthSmileLeft", 18), ("noseSneerLeft", 10)):
        line = FOLDS[name][0].line
        deeper = fold_angles(model, model.posed({name: 1}), line) - fold_angles(model, neutral, line)
        assert deeper.min() > 0, name
        assert deeper.mean() > least, name


def test_a_funnel_parts_the_teeth(model):
    from generator.checks import lip_gap, teeth_gap

    posed = model.posed({"mouthFunnel": 1})
    assert teeth_gap(model, posed) > 0.35
    assert lip_gap(model, posed)[1] > teeth_gap(model, posed)


def test_closed_lashes_end_at_the_corner_of_the_eye(model):
    from generator.checks import lash_tail

    assert lash_tail(model, model.posed({"eyeBlinkLeft": 1})) < 0.04


def test_a_smile_moves_its_corner_up_and_out(model):
    skin = model.character.skin
    corner = skin.mouth_rings[0][len(skin.mouth_rings[0]) // 2]
    moved = model.deltas[model.names.index("mouthSmileLeft")]
    lengths = np.linalg.norm(moved, axis=1)
    across, up, _ = moved[corner]
    assert min(across, up) > 0.5 * lengths[corner]
    assert lengths[corner] > 0.85 * lengths.max()
    assert lengths[skin.mirror[corner]] < 0.01 * lengths.max()


def test_tongue_comes_out_between_the_lips(model):
    from generator.checks import crossings, lips, part_triangles

    posed = model.posed({"tongueOut": 1})
    tongue = part_triangles(model, "tongue")
    assert posed[tongue, 2].max() > posed[np.concatenate(lips(model)), 2].max()
    assert crossings(posed, np.concatenate(lips(model)), tongue) == 0
    for jaw in ("teethUpper", "teethLower"):
        assert crossings(posed, part_triangles(model, jaw), tongue) == 0, jaw


def test_brows_neither_float_nor_sink(model):
    from generator.checks import brow_slip

    for name in ("browDownLeft", "browInnerUp", "browOuterUpLeft", "eyeBlinkLeft", "noseSneerLeft"):
        assert brow_slip(model, model.posed({name: 1})) < 0.1, name


def test_shapes_are_local(model):
    from generator.checks import far_share, moved_share

    for k, name in enumerate(model.names):
        assert 0.001 < moved_share(model, k) < 0.25, name
        assert far_share(model, k) < 0.02, name


@pytest.mark.parametrize("name", EXPRESSIONS)
def test_expressions_stay_clean(model, name):
    from generator.checks import (
        crossings,
        flipped,
        lid_clearance,
        lips,
        part_triangles,
        triangle_quality,
        visible_skin,
    )

    neutral, posed = model.character.vertices, model.posed(EXPRESSIONS[name])
    skin = model.character.triangles[visible_skin(model)]
    assert flipped(neutral, posed, skin) <= 4
    assert triangle_quality(posed, skin).min() > 0.015
    assert lid_clearance(model, posed) > 0
    upper, lower = lips(model)
    assert crossings(posed, upper, lower) == 0
    teeth = [part_triangles(model, part) for part in ("teethUpper", "teethLower")]
    assert crossings(posed, np.concatenate([upper, lower]), np.concatenate(teeth)) == 0
