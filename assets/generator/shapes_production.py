"""What a production rig adds to the ARKit shapes: halves, finer muscles, in-betweens and correctives.

All are plain shapes.  Those that end in _50 are in-betweens, to be added while another shape passes one half;
those that join two names are correctives, to be added by the product of both.
"""

import numpy as np

from generator.anatomy import Eye
from generator.character import Character
from generator.deformer import Lips, SkinDeformer
from generator.shape import Shape
from generator.shapes_eyes import GAZE, LID_SHAPES, brow_shape, gaze_shape, lid_shape
from generator.shapes_jaw import OPEN_ANGLE, OPEN_SHIFT, Jaw, seal
from generator.shapes_mouth import Motion, beside_lips, left_side, middle
from generator.vectors import Array, columns, mix, smoothstep

HALVED = (
    "browInnerUp",
    "cheekPuff",
    "mouthFunnel",
    "mouthPucker",
    "mouthRollLower",
    "mouthRollUpper",
    "mouthShrugLower",
    "mouthShrugUpper",
)
"""Symmetrical shapes that also come as a left and a right half."""
FADE, LIPS_FADE = 0.7, 2.0
"""How far from the middle one half fades into the other; a shorter way would crease lips that go forward."""
LID_PARTS = {"eyeUpperUpLeft": (-0.22, 0.0), "eyeUpperDownLeft": (0.40, 0.0), "eyeLowerUpLeft": (0.0, 0.35)}
"""Single lids: (upper, lower) of `SkinDeformer.lids`."""
PUPILS = {"eyePupilWideLeft": 0.35, "eyePupilNarrowLeft": -0.35}
"""How much wider the pupil gets, in pupil radii."""
BRUSHES = {
    "noseDilateLeft": (((1.15, -2.95, 7.4), (0.6, 0.6, 0.9), (0.20, 0.03, 0.02)),),
    "noseCompressLeft": (((1.15, -2.95, 7.4), (0.6, 0.6, 0.9), (-0.16, -0.02, 0.02)),),
    "noseWrinkleLeft": (
        ((0.6, -0.6, 7.2), (0.7, 0.9, 1.2), (0.05, 0.26, 0.10)),
        ((1.0, -2.6, 7.5), (0.8, 0.8, 1.2), (0.02, 0.20, 0.0)),
    ),
    "cheekSuckLeft": (((3.9, -5.2, 4.4), (1.6, 1.7, 2.4), (-0.75, 0.05, -0.30)),),
    "jawClenchLeft": (((5.0, -4.9, 1.2), (1.3, 1.6, 1.8), (0.35, 0, 0.05)),),
    "neckTightenLeft": (((2.2, -11.0, 0.4), (0.8, 2.4, 1.6), (0.22, -0.05, 0.22)),),
    "chinRaise": (((0.0, -8.4, 7.0), (1.4, 1.0, 2.0), (0.0, 0.38, 0.14)),),
    "jawOpen_mouthSmileLeft": (((3.5, -4.8, 5.4), (1.2, 1.2, 1.8), (-0.14, 0.10, 0.16)),),
    "jawOpen_mouthStretchLeft": (((3.2, -6.2, 5.4), (1.2, 1.2, 1.8), (-0.08, 0.12, -0.12)),),
    "mouthSmileLeft_cheekSquintLeft": (((3.9, -2.8, 5.2), (1.6, 1.0, 2.5), (0.05, -0.16, 0.18)),),
    "browDownLeft_noseSneerLeft": (((0.8, 1.6, 6.9), (0.8, 1.0, 1.6), (0.06, 0.10, 0.16)),),
}
"""Shape -> (centre, radii, displacement) on the left side of the reference face; off the lips."""


def tighten_upper(lip: Lips) -> Array:
    """One half of the upper lip thins."""
    on = (lip.side > 0) * smoothstep(-0.35, 0.35, lip.across) * middle(lip.across)
    return columns(0, -0.22 * lip.depth * lip.height * on, -0.06 * on)


def tighten_lower(lip: Lips) -> Array:
    """One half of the lower lip thins."""
    on = (lip.side < 0) * smoothstep(-0.35, 0.35, lip.across) * middle(lip.across)
    return columns(0, 0.26 * lip.depth * lip.height * on, -0.06 * on)


def corner_up(lip: Lips) -> Array:
    """The corner goes straight up."""
    corner = left_side(lip.across, 0.1, 1.0) ** 1.6
    return columns(0.06 * corner, 0.55 * corner, -0.10 * corner)


def corner_down(lip: Lips) -> Array:
    """The corner goes straight down."""
    corner = left_side(lip.across, 0.1, 1.0) ** 1.6
    return columns(0.04 * corner, -0.55 * corner, -0.06 * corner)


def sharp_pull(lip: Lips) -> Array:
    """The corner goes sharply up and back, as in contempt."""
    corner = left_side(lip.across, 0.35, 1.0) ** 1.8
    return columns(0.48 * corner, 0.36 * corner, -0.45 * corner)


def narrow_corner(lip: Lips) -> Array:
    """One corner goes in, without a pout."""
    x = lip.across
    return columns(-0.55 * left_side(x, -0.05, 1.0), 0, 0.22 * left_side(x, 0, 1))


def upper_out(lip: Lips) -> Array:
    """One half of the upper lip goes forward."""
    on = (lip.side > 0) * smoothstep(-0.4, 0.4, lip.across) * middle(lip.across)
    return columns(0, 0.06 * on * lip.depth, 0.30 * on * mix(0.5, 1, lip.depth))


def lower_out(lip: Lips) -> Array:
    """One half of the lower lip goes forward."""
    on = (lip.side < 0) * smoothstep(-0.4, 0.4, lip.across) * middle(lip.across)
    return columns(0, -0.06 * on * lip.depth, 0.34 * on * mix(0.5, 1, lip.depth))


def upwards(lip: Lips) -> Array:
    """The whole mouth goes up."""
    return columns(0, 0.34 + 0 * lip.across, -0.04)


def downwards(lip: Lips) -> Array:
    """The whole mouth goes down."""
    return columns(0, -0.34 + 0 * lip.across, -0.04)


MOTIONS: dict[str, Motion] = {
    "mouthTightenUpperLeft": tighten_upper,
    "mouthTightenLowerLeft": tighten_lower,
    "mouthCornerUpLeft": corner_up,
    "mouthCornerDownLeft": corner_down,
    "mouthSharpPullLeft": sharp_pull,
    "mouthNarrowLeft": narrow_corner,
    "mouthUpperOutLeft": upper_out,
    "mouthLowerOutLeft": lower_out,
    "mouthUp": upwards,
    "mouthDown": downwards,
}


def production_shapes(
    character: Character, deformer: SkinDeformer, arkit: dict[str, Shape]
) -> dict[str, Shape]:
    """Return the additional shapes, left and symmetrical ones; `arkit` are those of the basic set."""
    shapes = {name: Shape(deformer.mouth(motion)) for name, motion in MOTIONS.items()}
    keep = beside_lips(deformer)
    for name, brushes in BRUSHES.items():
        skin = np.zeros_like(deformer.vertices)
        for centre, radii, displacement in brushes:
            strength = deformer.brush(centre, radii, left_only=True) * keep
            skin += strength[:, None] * np.array(displacement)
        shapes[name] = Shape(deformer.slide_on_eyes(skin))
    for name in HALVED:
        reach = LIPS_FADE if name.startswith("mouth") else FADE
        left = smoothstep(-reach, reach, deformer.reference[:, 0])[:, None]
        parts = {part: moved / 2 for part, moved in arkit[name].parts.items()}
        shapes[name + "Left"] = Shape(arkit[name].skin * left, parts)
    shapes["browLateralLeft"] = Shape(brow_shape(character, deformer, _frown_lines))
    for name, (upper, lower) in LID_PARTS.items():
        lift = 0.03 if upper < 0 else 0.0
        shapes[name] = lid_shape(character, deformer, deformer.lids(upper, lower, lift=lift))
    for name, wider in PUPILS.items():
        still = np.zeros_like(deformer.vertices)
        shapes[name] = Shape(still, {"eyeL": _pupil(character.place("eyeL"), character.anatomy.eye, wider)})
    still = np.zeros_like(deformer.vertices)
    shapes |= {name: Shape(still, {"tongue": moved}) for name, moved in _tongue(character).items()}
    return shapes | _jaw_and_halfway(character, deformer, arkit)


def _frown_lines(t: Array) -> Array:
    """The inner end of the brow goes to the middle."""
    return columns(-0.42 * (1 - t) ** 1.3, -0.10 * (1 - t), 0.16 * (1 - t))


def _pupil(place: Array, eye: Eye, wider: float) -> Array:
    """Slide the inner rings of the iris over the eyeball."""
    offset = place - np.array(eye.centre)
    angle = np.arctan2(np.hypot(offset[:, 0], offset[:, 1]), offset[:, 2])
    inner = smoothstep(eye.iris, eye.pupil, angle)
    wanted = angle * (1 + wider * inner)
    size = np.linalg.norm(offset, axis=1)
    across = np.sin(wanted) / np.maximum(np.sin(angle), 1e-9)
    moved = np.c_[offset[:, :2] * across[:, None], size * np.cos(wanted)] - offset
    return np.where((angle < eye.iris)[:, None], moved, 0)


def _tongue(character: Character) -> dict[str, Array]:
    """Move the front of the tongue inside the mouth."""
    place = character.place("tongue")
    depth = place[:, 2].max() - place[:, 2]
    front = smoothstep(3.2, 0.2, depth)
    x, zero = place[:, 0], np.zeros(len(place))
    return {
        "tongueUp": columns(zero, 0.55 * front, -0.15 * front),
        "tongueDown": columns(zero, -0.35 * front, zero),
        "tongueTipLeft": columns(0.60 * front, zero, -0.10 * front),
        "tongueCurl": columns(zero, 0.60 * front**3, -0.45 * front**3),
        "tongueWide": columns(0.16 * x * front, -0.06 * front, zero),
        "tongueNarrow": columns(-0.28 * x * front, 0.05 * front, 0.12 * front),
    }


def _jaw_and_halfway(
    character: Character, deformer: SkinDeformer, arkit: dict[str, Shape]
) -> dict[str, Shape]:
    """Return jawBack, and the in-betweens that turn a straight path into the arc of jaw, lids and eyes."""
    jaw = Jaw(character, deformer)
    back = jaw.moved(shift=(0, 0.04, -0.40))
    halfway = jaw.moved(OPEN_ANGLE / 2, (0, OPEN_SHIFT[1] / 2, OPEN_SHIFT[2] / 2))
    fully = jaw.moved(OPEN_ANGLE, OPEN_SHIFT)
    shapes = {
        "jawBack": Shape(back.skin + seal(deformer, back.skin, (0.5, 0.5, 0.5)), back.parts),
        "jawOpen_50": _between(halfway, fully),
    }
    upper, lower, blink, _ = LID_SHAPES["eyeBlinkLeft"]
    half_blink = lid_shape(character, deformer, deformer.lids(upper / 2, lower / 2, blink / 2))
    shapes["eyeBlinkLeft_50"] = _between(half_blink, arkit["eyeBlinkLeft"])
    for name in GAZE:
        shapes[name + "_50"] = _between(gaze_shape(character, deformer, name, 0.5), arkit[name])
    return shapes


def _between(halfway: Shape, fully: Shape) -> Shape:
    """Return what the half of `fully` lacks to be `halfway`."""
    parts = {name: moved - fully.parts[name] / 2 for name, moved in halfway.parts.items()}
    return Shape(halfway.skin - fully.skin / 2, parts)
