"""Which shapes answer a hand: those of eyes and tongue are none of the skin's business."""

from collections.abc import Collection

import numpy as np

from facepin.core.control import Flags
from facepin.core.regions import words_of
from facepin.core.rig import Rig

GAZE = frozenset({"look", "looks", "gaze", "eyeball", "eyeballs", "pupil", "pupils"})
TONGUE = frozenset({"tongue"})
"""Words in the names of such shapes."""
MAINLY = 0.25
"""A shape is also of a point's part if it moves the point by this share of what it moves most."""


def gaze_shapes(rig: Rig) -> Flags:
    """Return which shapes (k,) turn the eyes, by their names."""
    return _named(rig, GAZE)


def tongue_shapes(rig: Rig) -> Flags:
    """Return which shapes (k,) move the tongue, by their names."""
    return _named(rig, TONGUE)


def answering(rig: Rig, vertices: Collection[int]) -> Flags:
    """Return which shapes (k,) may follow a hand that holds some vertices.

    Shapes of gaze and tongue move lids, lips and chin along, and skin must not be got by them: geometry
    cannot tell (the eyeballs of some faces do not move at all), so names do.  Where they are what moves a
    point most it is an eye's or a tongue's; there they answer, and of the others only those that are much of
    that part too, as the jaw is of the tongue.  All shapes answer where else none would move anything.
    """
    gaze, tongue = gaze_shapes(rig), tongue_shapes(rig)
    special = gaze | tongue
    answers = np.zeros(rig.shape_count, np.bool_)
    everything = np.ones(rig.shape_count, np.bool_)
    if not special.any():
        return everything
    for vertex in vertices:
        moved = np.linalg.norm(rig.rows_at([vertex])[:, : rig.shape_count], axis=0)
        own = next((kind for kind in (gaze, tongue) if moved[kind].max(initial=0.0) >= moved.max()), None)
        if not moved.any():
            continue
        if own is None:
            answers |= ~special
        else:
            answers |= own | (~special & (moved >= MAINLY * rig.largest_moves) & (moved > 0))
    return answers if answers.any() else everything


def _named(rig: Rig, words: frozenset[str]) -> Flags:
    return np.array([not words.isdisjoint(words_of(name)) for name in rig.shape_names], np.bool_)
