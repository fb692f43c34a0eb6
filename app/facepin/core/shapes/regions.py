"""Regions of the face and sides of it that shapes belong to, from their names and from where they move it."""

import re
from typing import Literal, get_args

import numpy as np

from facepin.core.rig import Rig
from facepin.core.shapes.motion import ShapePlaces, shape_places

Region = Literal["brows", "eyes", "cheeks", "nose", "mouth", "jaw", "tongue", "other"]
Side = Literal["left", "right", "both"]

REGIONS: tuple[Region, ...] = get_args(Region)
SIDES: tuple[Side, ...] = get_args(Side)

_WORDS: dict[Region, str] = {
    "brows": "brow brows eyebrow eyebrows forehead brw",
    "eyes": "eye eyes lid lids eyelid eyelids blink squint wink gaze look pupil iris lash eyelash",
    "cheeks": "cheek cheeks puff dimple",
    "nose": "nose nostril nostrils sneer",
    "mouth": "mouth lip lips smile frown pucker funnel kiss viseme mth",
    "jaw": "jaw chin",
    "tongue": "tongue",
    "other": "neck head identity ear hair teeth",
}
_REGION_OF: dict[str, Region] = {word: region for region, words in _WORDS.items() for word in words.split()}
_SIDE_OF: dict[str, Side] = {"left": "left", "l": "left", "right": "right", "r": "right"}

# Places on a face between the lower lip (0) and the brows (1), as measured on faces whose names are known.
LOW, TOP = 15, 98
"""Percentiles of the shapes' heights that stand for lower lip and brows: half of all shapes are a mouth's."""
BROWS, EYES, MIDFACE, NECK = 0.87, 0.57, 0.25, -0.3
"""Least heights of brows, of eyes, of nose and cheeks; below the last is no face any more."""
CHEEK = 0.28
"""Least distance of cheeks from the middle of the face."""
BEHIND = 0.08
"""How far the jaw's motion lies behind the lips'."""
WHOLE = 0.37
"""A shape that is spread wider than this over the height is of the head, not of a region."""
LOCAL = 0.12
"""The same as a share of the height of the model, to begin with."""
ONE_SIDE, LEANING = 0.8, 0.6
"""Share of the motion on one side that makes a shape one-sided, and that does if its name says so too."""


def words_of(name: str) -> list[str]:
    """Return the words of a shape's name in lower case: "eyeBlink_L" has eye, blink and l."""
    return [word.lower() for word in re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+|[^\W\d_a-zA-Z]+", name)]


def named_region(name: str) -> Region | None:
    """Return the region that the first telling word of a name says, or None."""
    words = words_of(name)
    pairs = [first + second for first, second in zip(words, [*words[1:], ""], strict=True)]
    for word, pair in zip(words, pairs, strict=True):
        found = _REGION_OF.get(pair) or _REGION_OF.get(word)
        if found:
            return found
    return None


def named_side(name: str) -> Side | None:
    """Return the side that the first or the last word of a name says, or None.

    jawLeft says left and means a direction: only the motion can tell.
    """
    words = words_of(name)
    return (_SIDE_OF.get(words[-1]) or _SIDE_OF.get(words[0])) if len(words) > 1 else None


def regions_and_sides(rig: Rig) -> tuple[tuple[Region, ...], tuple[Side, ...]]:
    """Return the region and the side of each of the k shapes.

    A name that tells its region is believed; the motion decides for the others.  For sides it is the other
    way round, and the names tell only which half of the face is called left.
    """
    places = shape_places(rig)
    placed = _placed_regions(places, rig.height)
    regions = tuple(
        named_region(name) or region for name, region in zip(rig.shape_names, placed, strict=True)
    )
    return regions, _sides(rig.shape_names, places)


def _placed_regions(places: ShapePlaces, model_height: float) -> list[Region]:
    """Return a region for each shape from its place alone."""
    local = places.spread < LOCAL * model_height
    if not local.any():
        return ["other"] * len(local)
    low, top = np.percentile(places.height[local], (LOW, TOP))
    unit = top - low
    if unit < LOCAL * model_height:  # all in one place: nothing tells which it is
        return ["other"] * len(local)
    height, out = (places.height - low) / unit, places.out / unit
    depth, spread = places.depth / unit, places.spread / unit
    lips = (spread < WHOLE) & (height < MIDFACE) & (height > NECK)
    front = float(np.median(depth[lips])) if lips.any() else 0.0

    def region(j: int) -> Region:
        if not spread[j] < WHOLE or height[j] < NECK:
            return "other"
        if height[j] > BROWS:
            return "brows"
        if height[j] > EYES:
            return "eyes"
        if out[j] > CHEEK:
            return "cheeks"
        if height[j] > MIDFACE:
            return "nose"
        return "jaw" if depth[j] < front - BEHIND else "mouth"

    return [region(j) for j in range(len(height))]


def _sides(names: tuple[str, ...], places: ShapePlaces) -> tuple[Side, ...]:
    """Return a side for each shape."""
    left = np.nan_to_num(places.left, nan=0.5)
    said = [named_side(name) for name in names]
    votes = sum(
        (share - 0.5) * (side == "left") - (share - 0.5) * (side == "right")
        for share, side in zip(left, said, strict=True)
    )
    if votes < 0:  # the face looks the other way
        left = 1.0 - left

    def side(share: float, word: Side | None) -> Side:
        if share >= (LEANING if word == "left" else ONE_SIDE):
            return "left"
        return "right" if 1.0 - share >= (LEANING if word == "right" else ONE_SIDE) else "both"

    return tuple(side(float(share), word) for share, word in zip(left, said, strict=True))
