"""Shapes of the lips: each is a motion of the lip rings, and sometimes brushes on the skin beside them."""

from collections.abc import Callable

import numpy as np

from generator.deformer import Lips, SkinDeformer
from generator.folds import FOLDS, folded
from generator.shapes_eyes import beside_lids
from generator.topology import LIP_RINGS
from generator.vectors import Array, bump, columns, mix, smoothstep

Motion = Callable[[Lips], Array]
WIDE = (6.2, 5.2, 6.5)


def left_side(across: Array, start: float = -0.12, stop: float = 0.95) -> Array:
    """Return 0 on the right side rising to 1 at the left corner."""
    return smoothstep(start, stop, across)


def middle(across: Array) -> Array:
    """Return 1 in the middle of the lip falling to 0 at both corners."""
    result: Array = 1 - np.abs(across) ** 3
    return result


def smile(lip: Lips) -> Array:
    """Corner out, up and back; the lip between bends as one curve."""
    x = lip.across
    corner = left_side(x) ** 1.5
    between, middle_ = bump(x, 0.5, 0.4), bump(x, 0, 0.5)
    up = 0.82 * left_side(x, 0, 1.06) ** 1.8 - 0.04 * between + 0.02 * middle_
    thin = -0.13 * lip.side * lip.depth * lip.height * (between + 0.5 * middle_) * (1 - x**4)
    back = -0.72 * corner**1.4 - 0.10 * between - 0.04 * middle_
    return columns(0.78 * corner, up + thin, back)


def frown(lip: Lips) -> Array:
    """Corner down."""
    x = lip.across
    corner = left_side(x) ** 1.5
    arch = 0.10 * (1 - np.abs(x) ** 2) * smoothstep(-0.5, 0.5, x) * (1 - 0.5 * lip.depth)
    out = 0.06 * (lip.side < 0) * lip.depth * bump(x, 0.3, 0.4)
    return columns(0.10 * corner, -0.70 * corner**1.1 + arch, -0.10 * corner + out)


def dimple(lip: Lips) -> Array:
    """Corner straight back."""
    x = lip.across
    up = 0.20 * left_side(x) ** 1.6 - 0.06 * lip.side * lip.depth * bump(x, 0.5, 0.4)
    return columns(0.50 * left_side(x, -0.1) ** 1.6, up, -0.62 * left_side(x, 0.1, 1) ** 1.4)


def stretch(lip: Lips) -> Array:
    """Corner out and a little down; the lips thin."""
    x = lip.across
    up = -0.22 * left_side(x) ** 1.6 - 0.10 * lip.side * lip.depth * bump(x, 0.4, 0.5)
    up += -0.10 * (lip.side < 0) * bump(x, 0.45, 0.35) + 0.06 * (lip.side > 0) * bump(x, 0.45, 0.3)
    back = -0.55 * left_side(x) ** 1.3 - 0.06 * bump(x, 0.4, 0.4)
    return columns(0.85 * left_side(x, -0.2) ** 1.3, up, back)


def press(lip: Lips) -> Array:
    """Lips pressed together, the red thin."""
    x = lip.across
    on = smoothstep(-0.35, 0.35, x)
    up = -lip.side * 0.52 * lip.rise * on * middle(x)
    back = -0.13 * (1 - 0.6 * lip.depth) * on * (1 - 0.6 * np.abs(x))
    return columns(0.10 * left_side(x, -0.3), up, back)


def lower_down(lip: Lips) -> Array:
    """Lower lip down on one side, showing the teeth."""
    x, low = lip.across, lip.side < 0
    down = 0.74 * bump(x, 0.40, 0.58) * (1 - np.abs(x) ** 3.2) * mix(1, 0.85, lip.depth)
    out = low * (0.02 + 0.10 * lip.depth) * bump(x, 0.36, 0.5)
    return columns(0.05 * bump(x, 0.4, 0.4) * low, -(low * down) - 0.10 * bump(x, 1, 0.35), out)


def upper_up(lip: Lips) -> Array:
    """Upper lip up on one side."""
    x, high = lip.across, lip.side > 0
    up = 0.66 * bump(x, 0.42, 0.60) * (1 - np.abs(x) ** 3.2) * mix(1, 0.90, lip.depth)
    out = high * (0.02 + 0.10 * lip.depth) * bump(x, 0.4, 0.5)
    return columns(0.03 * bump(x, 0.4, 0.4) * high, high * up + 0.14 * bump(x, 1, 0.4), out)


def sneer(lip: Lips) -> Array:
    """The upper lip pulled by the wing of the nose."""
    x, high = lip.across, lip.side >= 0
    up = 0.30 * high * bump(x, 0.42, 0.42) * mix(0.45, 1, lip.depth)
    return columns(0, up, 0.05 * high * bump(x, 0.42, 0.4))


def pucker(lip: Lips) -> Array:
    """Corners in, lips out: a kiss."""
    x, side, t = lip.across, lip.side, lip.depth
    a = np.abs(x)
    up = -0.02 + side * t * (0.06 + 0.10 * bump(a, 0.6, 0.4)) * (1 - a**4) + 0.05 * bump(a, 0, 0.25) * (1 - t)
    return columns(-1.10 * x, up, 0.90 - 0.26 * t * (1 - a**3) - 0.06 * a**2)


def funnel(lip: Lips) -> Array:
    """Lips out and apart: an open O."""
    x, side, t = lip.across, lip.side, lip.depth
    a = np.abs(x)
    round_ = np.sqrt(np.clip(1 - a**2.4, 0, 1))
    open_ = side * 0.12 * round_ * mix(1, 0.84, t)
    return columns(-1.05 * x, -0.12 * a**2 + open_, 0.72 + 0.10 * a - 0.06 * t + 0.10 * round_ * t)


def roll_lower(lip: Lips) -> Array:
    """Lower lip rolled in over the teeth."""
    m, low, t = middle(lip.across) ** 2, lip.side < 0, lip.depth
    back = low * mix(-0.29, -0.14, t) - 0.06 * (lip.side > 0) * (1 - t)
    return columns(0, 0.68 * low * m * lip.rise, m * back)


def roll_upper(lip: Lips) -> Array:
    """Upper lip rolled in over the teeth."""
    m, high, t = middle(lip.across) ** 2, lip.side > 0, lip.depth
    back = high * mix(-0.27, -0.10, t) - 0.06 * (lip.side < 0) * (1 - t)
    return columns(0, -0.68 * high * m * lip.rise, m * back)


def shrug_lower(lip: Lips) -> Array:
    """Lower lip pushed up and out by the chin; the upper lip rides on it."""
    m, low, t = middle(lip.across) ** 2, lip.side < 0, lip.depth
    up = 0.95 * np.where(low, mix(0.34, 0.52, t), mix(0.34, 0.24, t))
    return columns(0, m * up, m * np.where(low, mix(0.14, 0.26, t), mix(0.14, 0.10, t)))


def shrug_upper(lip: Lips) -> Array:
    """Upper lip pushed up and out."""
    m, high, t = middle(lip.across), lip.side > 0, lip.depth
    up = np.where(high, mix(0.30, 0.40, t), 0.16 * (1 - t))
    return columns(0, m * up, m * np.where(high, mix(0.12, 0.22, t), 0.03))


def sideways(lip: Lips) -> Array:
    """The whole mouth to the left."""
    x = lip.across
    return columns(0.92 - 0.10 * np.abs(x), 0.10 * x - 0.02 + 0.10 * np.clip(x, 0, 1), -0.10 - 0.28 * x)


def puff(lip: Lips) -> Array:
    """Lips pushed out by air."""
    x = lip.across
    return columns(0.06 * x, 0.05 * lip.side * lip.depth, 0.26 * (0.6 + 0.4 * lip.depth))


MOTIONS: dict[str, tuple[Motion, tuple[float, float, float]]] = {
    "mouthSmileLeft": (smile, WIDE),
    "mouthFrownLeft": (frown, (5.4, 4.4, 6.0)),
    "mouthDimpleLeft": (dimple, (5.4, 4.4, 6.0)),
    "mouthStretchLeft": (stretch, (6.0, 4.8, 6.5)),
    "mouthPressLeft": (press, (5.4, 4.4, 6.0)),
    "mouthLowerDownLeft": (lower_down, (5.4, 4.4, 6.0)),
    "mouthUpperUpLeft": (upper_up, (5.4, 4.4, 6.0)),
    "noseSneerLeft": (sneer, (5.4, 4.4, 6.0)),
    "mouthPucker": (pucker, (5.6, 4.4, 6.5)),
    "mouthFunnel": (funnel, (5.2, 4.2, 6.5)),
    "mouthRollLower": (roll_lower, (5.4, 4.4, 6.0)),
    "mouthRollUpper": (roll_upper, (5.4, 4.4, 6.0)),
    "mouthShrugLower": (shrug_lower, (5.4, 4.4, 6.0)),
    "mouthShrugUpper": (shrug_upper, (5.4, 4.4, 6.0)),
    "mouthLeft": (sideways, (6.4, 5.0, 6.5)),
    "cheekPuff": (puff, (5.4, 4.0, 6.0)),
}
"""Shape -> motion of the lips and half axes of the region that gives way."""

BRUSHES: dict[str, tuple[tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...], str], ...]] = {
    "mouthSmileLeft": (
        ((4.0, -2.5, 5.2), (2.0, 1.5, 3.0), (0.04, 0.30, 0.20), "lips lids"),
        ((1.2, -3.2, 7.4), (0.7, 0.7, 1.2), (0.10, 0.06, -0.04), ""),
    ),
    "mouthFrownLeft": (((2.9, -7.7, 5.6), (1.1, 1.1, 2), (0.1, -0.12, 0.12), "lips"),),
    "mouthDimpleLeft": (((3.5, -6.0, 5.2), (0.9, 1.1, 1.8), (0.10, 0, 0.16), "lips"),),
    "mouthPressLeft": (((3.2, -6.3, 5.6), (1.0, 1.2, 1.8), (0.04, 0, 0.10), "lips"),),
    "mouthUpperUpLeft": (
        ((2.2, -4.0, 6.4), (0.9, 0.9, 1.6), (0.06, 0.22, 0.14), "lips"),
        ((1.1, -3.3, 7.5), (0.6, 0.6, 1.0), (0.05, 0.06, 0.02), ""),
    ),
    "noseSneerLeft": (
        ((1.15, -3.0, 7.4), (0.75, 0.90, 1.3), (0.14, 0.42, 0.03), ""),
        ((2.1, -2.7, 6.4), (1.1, 1.3, 1.8), (0, 0.46, 0.16), "lips lids"),
        ((0.55, 0.9, 7.0), (0.6, 1.1, 1.6), (0, -0.16, 0.07), "lids"),
        ((1.6, 2.2, 6.6), (1.2, 0.9, 1.6), (-0.1, -0.24, 0.05), "lids"),
    ),
    "eyeSquintLeft": (((3.7, -2.6, 5.2), (1.8, 1.3, 3.0), (0, 0.36, 0.18), "lids lips"),),
    "cheekSquintLeft": (
        ((3.7, -3.1, 5.2), (1.9, 1.8, 3.0), (0.02, 0.80, 0.16), "lids lips"),
        ((3.5, -2.9, 5.6), (1.5, 1.2, 2.0), (0.04, 0.0, 0.40), "lids lips"),
    ),
}
"""Shape -> (centre, radii, displacement, what the brush keeps off) on the left side."""


def beside_lips(deformer: SkinDeformer) -> Array:
    """Return (n,) 0 on the lips and in the mouth rising to 1 outside them: keeps brushes off the lips."""
    k = deformer.mouth_ring
    rising = np.where(k < LIP_RINGS + 4, smoothstep(LIP_RINGS - 1, LIP_RINGS + 4, k), 1.0)
    return np.where(deformer.inside | deformer.lip, 0, rising)


def mouth_shapes(deformer: SkinDeformer) -> dict[str, Array]:
    """Return displacements of the skin by MOTIONS, BRUSHES and FOLDS; chin and cheeks on both sides."""
    shapes = {name: deformer.mouth(motion, reach) for name, (motion, reach) in MOTIONS.items()}
    keep = {"lips": beside_lips(deformer), "lids": beside_lids(deformer)}
    for name, brushes in BRUSHES.items():
        moved = shapes.setdefault(name, np.zeros_like(deformer.vertices))
        for centre, radii, displacement, keep_off in brushes:
            strength = deformer.brush(centre, radii, left_only=True)
            for region in keep_off.split():
                strength = strength * keep[region]
            moved += strength[:, None] * np.array(displacement)
    for name, folds in FOLDS.items():
        for fold in folds:
            shapes[name] += folded(deformer, fold) * keep["lips"][:, None]
    chin = deformer.brush((0, -8.7, 7.0), (1.7, 1.0, 2.0)) * keep["lips"]
    shapes["mouthShrugLower"] += chin[:, None] * np.array([0, 0.42, 0.12])
    cheeks = deformer.brush((3.7, -4.9, 4.7), (1.9, 1.9, 2.6)) * keep["lips"]
    shapes["cheekPuff"] += deformer.normals * (cheeks * 1.0)[:, None]
    return shapes
