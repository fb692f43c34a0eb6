"""Regions and sides of shapes: from their names, and from where they move a face."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facepin.core.rig import Rig
from facepin.core.shapes.regions import named_region, named_side, regions_and_sides, words_of
from facepin.files import open_rig
from facepin.resources import resource
from support.small_rigs import sheet


def nameless(rig: Rig) -> Rig:
    return replace(rig, shape_names=tuple(f"target{j:03}" for j in range(rig.shape_count)))


def builtin(name: str) -> Rig:
    return open_rig(resource("assets", f"faces/{name}.npz"))


@pytest.fixture(scope="module")
def rigs(shared: Path) -> dict[str, Rig]:
    folder = shared / "models/ict-facekit"
    return {
        "ada": builtin("ada"),
        "mira": builtin("mira"),
        "ict53": open_rig(folder / "ict_expressions.glb"),
        "ict153": open_rig(folder / "ict_full153.npz"),
    }


@pytest.mark.parametrize(
    "name, words",
    [
        ("eyeBlink_L", "eye blink l"),
        ("browDownLeft_noseSneerLeft", "brow down left nose sneer left"),
        ("Fcl_MTH_Angry", "fcl mth angry"),
        ("x.jawOpen50", "x jaw open 50"),
        ("まばたき", "まばたき"),
        ("", ""),
    ],
)
def test_names_fall_into_words(name: str, words: str) -> None:
    assert words_of(name) == words.split()


@pytest.mark.parametrize(
    "name, region",
    [
        ("cheekSquintLeft", "cheeks"),
        ("EyeBrowUp.L", "brows"),
        ("lipCornerPuller", "mouth"),
        ("l_eyelid_upper", "eyes"),
        ("chinRaise", "jaw"),
        ("identity012", "other"),
        ("target7", None),
        ("smileyness", None),
    ],
)
def test_the_first_telling_word_says_the_region(name: str, region: str | None) -> None:
    assert named_region(name) == region


@pytest.mark.parametrize(
    "name, side",
    [("eyeBlink_L", "left"), ("browUp.R", "right"), ("r_smile", "right"), ("lefty", None), ("L", None)],
)
def test_names_say_a_side(name: str, side: str | None) -> None:
    assert named_side(name) == side


@pytest.mark.parametrize("name, left, both", [("ada", 18, 16), ("mira", 55, 28), ("ict53", 20, 13)])
def test_sides_come_from_the_motion(rigs: dict[str, Rig], name: str, left: int, both: int) -> None:
    rig = rigs[name]
    sides = dict(zip(rig.shape_names, regions_and_sides(rig)[1], strict=True))
    counts = [list(sides.values()).count(side) for side in ("left", "right", "both")]
    assert counts == [left, left, both]
    assert sides["jawLeft"] == sides["mouthLeft"] == "both", "a direction is not a side"


def test_a_face_that_looks_away_has_its_left_where_its_names_say(rigs: dict[str, Rig]) -> None:
    rig = rigs["ada"]
    turned = replace(rig, neutral=np.ascontiguousarray(rig.neutral * np.float32([-1, 1, -1])))
    assert regions_and_sides(turned)[1] == regions_and_sides(rig)[1]


@pytest.mark.parametrize("name, least", [("ada", 0.95), ("mira", 0.8), ("ict53", 0.95), ("ict153", 0.95)])
def test_a_rig_with_meaningless_names_is_grouped_by_where_it_moves(
    rigs: dict[str, Rig], name: str, least: float
) -> None:
    rig = rigs[name]
    regions, sides = regions_and_sides(rig)
    found, found_sides = regions_and_sides(nameless(rig))
    agree = np.mean([a == b for a, b in zip(regions, found, strict=True)])
    assert agree >= least
    assert np.mean([a == b for a, b in zip(sides, found_sides, strict=True)]) >= 0.98


def test_whole_heads_are_no_region(rigs: dict[str, Rig]) -> None:
    rig = nameless(rigs["ict153"])
    regions, sides = regions_and_sides(rig)
    assert regions[53:].count("other") >= 95
    assert set(sides[53:]) == {"both"}


def test_no_face_no_regions() -> None:
    regions, sides = regions_and_sides(sheet(shapes=1))
    assert regions == ("other",)
    assert len(sides) == 1


def test_an_empty_shape_belongs_nowhere() -> None:
    rig = sheet(shapes=3)
    deltas = rig.deltas.copy()
    deltas.data[deltas.indptr[1] : deltas.indptr[2]] = 0
    regions, sides = regions_and_sides(replace(rig, deltas=deltas))
    assert regions[1] == "other" and sides[1] == "both"
