"""Shapes of jaw and tongue, and mouthClose, which seals the lips of an open jaw."""

from collections.abc import Callable

import numpy as np

from generator.character import Character
from generator.deformer import Lips, SkinDeformer
from generator.shape import Shape
from generator.shapes_mouth import middle
from generator.skin import LIP_PROFILE
from generator.topology import MOUTH_LOOP
from generator.vectors import Array, Vector, bump, columns, mix, rotation, smoothstep

OPEN_ANGLE = 17.5
OPEN_SHIFT: Vector = (0, -0.35, 0.45)
FUNNEL_OPENS = 0.32
"""How far mouthFunnel opens the jaw: the teeth part, else they would show clenched in its ring."""
TONGUE_OUT_OPENS = 0.42
"""How far tongueOut opens the jaw, so that the tongue clears the teeth."""


class Jaw:
    """Rigid motion of the lower jaw, fading out over the skin."""

    def __init__(self, character: Character, deformer: SkinDeformer) -> None:
        self._character, self._vertices = character, deformer.vertices
        self._weights = deformer.jaw_weights()

    def moved(self, open_by: float = 0, shift: Vector = (0, 0, 0), yaw: float = 0) -> Shape:
        """Return the shape of a jaw opened by `open_by`, shifted, and turned sideways by `yaw` (degrees)."""
        hinge = np.array(self._character.anatomy.skull.jaw_hinge)
        matrix = rotation((1, 0, 0), open_by) @ rotation((0, 1, 0), yaw)

        def motion(points: Array) -> Array:
            result: Array = (points - hinge) @ matrix.T + hinge + np.array(shift) - points
            return result

        gums = motion(self._character.place("gums"))
        gums[: self._character.upper_gum_count] = 0
        parts = {
            "teethLower": motion(self._character.place("teethLower")),
            "tongue": motion(self._character.place("tongue")) * 0.93,
            "gums": gums,
        }
        return Shape(motion(self._vertices) * self._weights[:, None], parts)


def narrow(lip: Lips) -> Array:
    """Corners of an opening mouth go in a little."""
    x = lip.across
    return columns(-0.22 * np.sign(x) * np.abs(x) ** 1.5, 0, 0.05 * np.abs(x))


def tongue_lips(lip: Lips) -> Array:
    """Lips make room for the tongue."""
    m, low, high = middle(lip.across), lip.side < 0, lip.side > 0
    return columns(0, -0.34 * low * m + 0.10 * high * m, 0.10 * low * m)


def round_pucker(lip: Lips) -> Array:
    """Lips that are both puckered and opened by the jaw make an O, not a slot."""
    x = lip.across
    wide = 0.34 * x + 0.25 * np.sign(x) * bump(np.abs(x), 0.62, 0.32)
    return columns(wide, -0.14 * lip.side * bump(x, 0, 0.7), -0.10 * (1 - x**2))


def round_funnel(lip: Lips) -> Array:
    """The same for a funnel, which is open already and opens less."""
    x = lip.across
    wide = 0.32 * x + 0.30 * np.sign(x) * bump(np.abs(x), 0.62, 0.32)
    return columns(wide, -0.30 * lip.side * bump(x, 0, 0.7), -0.14 * (1 - x**2))


ROUNDED: dict[str, Callable[[Lips], Array]] = {"mouthPucker": round_pucker, "mouthFunnel": round_funnel}
"""What the product of these shapes and jawOpen adds."""


def jaw_shapes(character: Character, deformer: SkinDeformer) -> dict[str, Shape]:
    """Return jawOpen, jawForward, jawLeft, mouthClose and tongueOut."""
    jaw = Jaw(character, deformer)
    open_ = jaw.moved(OPEN_ANGLE, OPEN_SHIFT)
    open_ = Shape(open_.skin + deformer.mouth(narrow), open_.parts)
    aside, forward = jaw.moved(shift=(0.55, 0, 0), yaw=4.5), jaw.moved(shift=(0, -0.12, 0.85))
    return {
        "jawOpen": open_,
        "jawForward": Shape(forward.skin + seal(deformer, forward.skin, (0.5, 0.3, 0.4)), forward.parts),
        "jawLeft": Shape(aside.skin + seal(deformer, aside.skin, (0.5, 0.5, 0.5)), aside.parts),
        "mouthFunnel": jaw.moved(OPEN_ANGLE * FUNNEL_OPENS),
        "mouthClose": Shape(seal(deformer, open_.skin, (0.4, 0.30, 0.06))),
        "tongueOut": _tongue_out(character, deformer, jaw),
    }


def seal(deformer: SkinDeformer, opened: Array, upper_share: Vector) -> Array:
    """Return what brings both contact lines of `opened` together; the upper goes `upper_share` of the way."""
    moved = np.zeros_like(deformer.vertices)
    order = np.arange(MOUTH_LOOP)
    opposite = order[::-1]
    upper = (order <= MOUTH_LOOP // 2)[:, None]
    for right in (False, True):
        contact = opened[deformer.lip_ring(0, right)]
        of_upper, of_lower = (
            np.where(upper, contact, contact[opposite]),
            np.where(upper, contact[opposite], contact),
        )
        meeting = of_upper + np.array(upper_share) * (of_lower - of_upper)
        for k, t in enumerate((*LIP_PROFILE, 1)):
            ring = deformer.lip_ring(k, right)
            moved[ring] = np.where(upper, meeting - of_upper, meeting - of_lower) * mix(1, 0.72, t)
    v = deformer.reference
    handles = np.flatnonzero(deformer.around_lip)
    q = (v - np.array([0, -5.8, 5.5])) / np.array([5.6, 4.6, 6.5])
    still = ((q**2).sum(1) > 1) | (v[:, 1] > -2.2) | (v[:, 1] < -8.6) | deformer.inside
    return deformer.follow_inside(deformer.spread(handles, moved[handles], still & ~deformer.around_lip))


def _tongue_out(character: Character, deformer: SkinDeformer, jaw: Jaw) -> Shape:
    """Open the jaw a little and push the tongue out over the lower lip."""
    opened = jaw.moved(OPEN_ANGLE * TONGUE_OUT_OPENS, (0, -0.12, 0.15))
    place = character.place("tongue")
    f = np.clip((place[:, 2] - (place[:, 2].max() - 4.3)) / 4.3, 0, 1)  # 0 root .. 1 tip
    drop = -1.0 * smoothstep(0.55, 1.05, f) ** 1.3 + 0.70 * smoothstep(0.10, 0.5, f)
    flatten = -0.42 * (place[:, 1] - place[:, 1].mean()) * smoothstep(0.1, 0.5, f)
    out = columns(0.10 * place[:, 0] * smoothstep(0.5, 1, f), drop + flatten, 2.75 * smoothstep(0, 0.9, f))
    return Shape(
        opened.skin + deformer.mouth(tongue_lips),
        {**opened.parts, "tongue": opened.parts["tongue"] + out},
    )
