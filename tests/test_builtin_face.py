"""The built-in faces: the files are what the generator makes, and an animator can work with them."""

import sys
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

ASSETS = Path(__file__).resolve().parents[1] / "assets"
BLINKS = np.arange(0.1, 1.01, 0.1)
LID_COMPANIONS = ("eyeLookUp", "eyeLookDown", "eyeLookIn", "eyeLookOut", "eyeSquint", "eyeWide", "browDown")
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
)
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


def test_production_character_has_many_shapes_and_all_fit_in_the_package():
    with np.load(ASSETS / "faces" / "mira.npz", allow_pickle=False) as stored:
        assert len(stored["names"]) > 120
    assert sum(path.stat().st_size for path in ASSETS.rglob("*") if path.is_file()) < 12e6


def test_left_and_right_are_mirror_images(model):
    from generator.checks import asymmetry

    neutral, shapes = asymmetry(model)
    assert neutral < 1e-5 * height(model)
    assert shapes < 1e-5 * height(model)


def test_no_slivers_and_nothing_inverted(model):
    from generator.checks import flipped, triangle_quality, visible_skin

    triangles = model.character.triangles
    skin = visible_skin(model)
    assert triangle_quality(model.character.vertices, triangles).min() > 0.02
    assert triangle_quality(model.character.vertices, triangles[skin]).min() > 0.08
    for name in model.names:
        posed = model.posed({name: 1})
        assert flipped(model, posed) == 0, name
        assert triangle_quality(posed, triangles[skin]).min() > 0.02, name


def test_lids_close_without_gap_or_poke(model):
    from generator.checks import lid_clearance, lid_gap

    assert lid_gap(model, model.posed({"eyeBlinkLeft": 1})) < 0.01
    for blink in BLINKS:
        assert lid_clearance(model, model.posed({"eyeBlinkLeft": blink})) > 0, blink
        for other in LID_COMPANIONS:
            posed = model.posed({"eyeBlinkLeft": blink, other + "Left": 1})
            assert lid_clearance(model, posed) > 0, (blink, other)
    for other in LID_COMPANIONS:
        assert lid_clearance(model, model.posed({other + "Left": 1})) > 0, other
        assert lid_gap(model, model.posed({"eyeBlinkLeft": 1, other + "Left": 1})) < 0.01, other
    for up_or_down, in_or_out in (pair for pair in combinations(LID_COMPANIONS[:4], 2) if pair[0][7] in "UD"):
        posed = model.posed({up_or_down + "Left": 0.7, in_or_out + "Left": 0.7})
        assert lid_clearance(model, posed) > 0, (up_or_down, in_or_out)


def test_lips_meet_and_do_not_cross(model):
    from generator.checks import lip_gap, uncovered

    for weights in ({}, *CLOSED_MOUTHS):
        posed = model.posed(weights)
        lowest, highest = lip_gap(model, posed)
        assert lowest > 0, weights
        assert highest < 0.02, weights
        assert uncovered(model, posed) < 0, weights
    lowest, _ = lip_gap(model, model.posed({"mouthFunnel": 1}))
    assert lowest > 0
    assert uncovered(model, model.posed({"mouthFunnel": 1})) < 0


def test_shapes_are_local(model):
    from generator.checks import moved_share

    for k, name in enumerate(model.names):
        assert 0.001 < moved_share(model, k) < 0.25, name


@pytest.mark.parametrize("name", EXPRESSIONS)
def test_expressions_stay_clean(model, name):
    from generator.checks import flipped, lid_clearance, triangle_quality, visible_skin

    posed = model.posed(EXPRESSIONS[name])
    skin = visible_skin(model)
    assert flipped(model, posed) <= 4
    assert triangle_quality(posed, model.character.triangles[skin]).min() > 0.015
    assert lid_clearance(model, posed) > 0
