"""Shapes of lids, gaze and brows.  Only left and symmetrical ones; the right ones are their mirror images."""

from collections.abc import Callable

import numpy as np
from scipy.spatial import cKDTree

from generator.brows import AROUND, SECTIONS
from generator.character import Character
from generator.deformer import LidMove, SkinDeformer
from generator.shape import Shape
from generator.topology import EYE_LOOP
from generator.vectors import MIRROR, Array, columns, rotation, smoothstep, turn

LASH_TURN = 0.95
"""Share of the margin's turn by which the lashes tilt as well."""
LID_SHAPES = {
    "eyeBlinkLeft": (0.80, 0.20, 1.0, 0.0),
    "eyeWideLeft": (-0.26, -0.14, 0.0, 0.05),
    "eyeSquintLeft": (0.13, 0.36, 0.0, 0.0),
    "browDownLeft": (0.10, 0.03, 0.0, 0.0),
    "cheekSquintLeft": (0.05, 0.20, 0.0, 0.0),
    "mouthSmileLeft": (0.03, 0.07, 0.0, 0.0),
}
"""(upper, lower, blink, lift) of `SkinDeformer.lids`."""
GAZE = {
    "eyeLookDownLeft": ((1, 0, 0), 24, 0.36, -0.10, (0.0, 0.0)),
    "eyeLookUpLeft": ((1, 0, 0), -22, -0.17, 0.16, (0.0, 0.0)),
    "eyeLookInLeft": ((0, 1, 0), -29, 0.02, 0.0, (-0.05, 0.0)),
    "eyeLookOutLeft": ((0, 1, 0), 29, 0.02, 0.0, (0.05, 0.0)),
}
"""(axis, degrees of the eyeball, upper lid, lower lid, shift of the lids)"""


def lid_shapes(character: Character, deformer: SkinDeformer) -> dict[str, Shape]:
    """Return the motion of the lids in LID_SHAPES and in the four directions of gaze."""
    shapes = {
        name: lid_shape(character, deformer, deformer.lids(upper, lower, blink, lift=lift))
        for name, (upper, lower, blink, lift) in LID_SHAPES.items()
    }
    return shapes | {name: gaze_shape(character, deformer, name) for name in GAZE}


def gaze_shape(character: Character, deformer: SkinDeformer, name: str, share: float = 1.0) -> Shape:
    """Return a turn of the left eyeball by `share` of its angle in GAZE, with the lids that follow it."""
    axis, degrees, upper, lower, shift = GAZE[name]
    x, y = (share * s for s in shift)
    lift = 0.03 if upper < 0 else 0.0
    move = deformer.lids(share * upper, share * lower, shift=(x, y), lift=share * lift)
    shape = lid_shape(character, deformer, move)
    from_centre = character.place("eyeL") - np.array(character.anatomy.eye.centre)
    shape.parts["eyeL"] = from_centre @ rotation(axis, share * degrees).T - from_centre
    return shape


def lid_shape(character: Character, deformer: SkinDeformer, move: LidMove) -> Shape:
    """Add to a motion of the lids that of the lashes: they go with their roots and tilt."""
    place, roots = character.place("lashL"), character.lash_roots
    margin = np.tile(np.arange(EYE_LOOP // 2 + 1), len(place) // (EYE_LOOP // 2 + 1))
    from_root = place - deformer.vertices[roots]
    tilted = turn(from_root, move.axes[margin], move.angles[margin] * LASH_TURN)
    return Shape(move.skin, {"lashL": move.skin[roots] + tilted - from_root}, lid=move.skin)


def brow_shapes(character: Character, deformer: SkinDeformer) -> dict[str, Array]:
    """Return displacements of the skin for the brows."""

    def down(t: Array) -> Array:
        fall = -1.02 + 0.62 * smoothstep(0.2, 1, t)
        return columns(-0.32 * (1 - t) ** 1.2, fall, 0.22 * (1 - t))

    def outer_up(t: Array) -> Array:
        rise = 0.95 * smoothstep(-0.1, 0.85, t)
        return columns(0.05 * t, rise, -0.10 * smoothstep(0.1, 0.7, t))

    def inner_up(t: Array) -> Array:
        return columns(-0.12 * (1 - t), 1.15 * (1 - smoothstep(-0.05, 0.95, t)), -0.12 * (1 - t))

    return {
        "browDownLeft": brow_shape(character, deformer, down),
        "browOuterUpLeft": brow_shape(character, deformer, outer_up),
        "browInnerUp": brow_shape(character, deformer, inner_up, both=True),
    }


def brow_shape(
    character: Character, deformer: SkinDeformer, motion: Callable[[Array], Array], both: bool = False
) -> Array:
    """Move the skin under the left brow by `motion` of the place along it (0 inner .. 1 outer end)."""
    v = deformer.reference
    distance, nearest = cKDTree(character.place("browL")).query(deformer.vertices)
    along = np.clip((nearest // AROUND) / (SECTIONS - 1), 0, 1)
    under = (distance < 0.33) & (deformer.eye_ring > 4) & (v[:, 0] > 0)
    handles = np.flatnonzero(under)
    values = motion(along[handles])
    still = (deformer.eye_ring <= 2) | (v[:, 1] > 6.6) | (deformer.off_centre > 7.0)
    still |= (v[:, 1] < -0.6) | (v[:, 2] < 1.0)
    if both:
        other = deformer.mirror[handles]
        handles, values = np.r_[handles, other], np.r_[values, values * MIRROR]
    else:
        still |= v[:, 0] < -0.2
    still[handles] = False
    return deformer.spread(handles, values, still)


def beside_lids(deformer: SkinDeformer) -> Array:
    """Return (n,) 0 on the lids rising to 1 outside them: keeps brushes off the margins."""
    ring = deformer.eye_ring
    rising = smoothstep(2, 7, ring)
    return np.where(ring <= 2, 0, np.where(ring <= 6, rising, 1.0))
