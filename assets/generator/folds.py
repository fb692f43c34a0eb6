"""The folds that skin makes where a muscle pushes it together: beside nose and mouth, under the eye."""

from dataclasses import dataclass

import numpy as np

from generator.deformer import SkinDeformer
from generator.skin import NASOLABIAL
from generator.vectors import Array, beside_line, bump, smoothstep

FRONT = 2.0
"""Skin farther back than this on the reference face has no folds."""
SMOOTHINGS = 2
"""How often its height is averaged over neighbours: where vertices lie far apart, a groove would break up."""


@dataclass(frozen=True)
class Fold:
    """A soft groove on the left side, and the flesh that rolls over it."""

    line: tuple[tuple[float, float], ...]
    """x and y on the reference face; the flesh lies on the left of its direction."""
    width: float
    depth: float
    height: float
    """Of the flesh over the skin."""


UNDER_EYE = ((5.3, -1.0), (4.4, -1.45), (3.5, -1.55), (2.7, -1.35), (2.1, -0.9))
FOLDS: dict[str, tuple[Fold, ...]] = {
    "mouthSmileLeft": (Fold(NASOLABIAL, 0.34, 0.30, 0.26),),
    "noseSneerLeft": (
        Fold(((1.0, -0.2), (1.3, -1.5), (1.8, -2.6), (2.4, -3.6), (3.0, -4.7)), 0.36, 0.36, 0.40),
        Fold(((1.25, -0.1), (0.8, -0.35), (0.25, -0.4)), 0.24, 0.18, 0.12),
    ),
    "mouthUpperUpLeft": (Fold(NASOLABIAL[:3], 0.32, 0.12, 0.10),),
    "mouthDimpleLeft": (Fold(((2.75, -5.0), (2.9, -5.9), (2.75, -6.8)), 0.30, 0.12, 0.10),),
    "mouthStretchLeft": (Fold(((2.6, -4.4), (3.2, -5.4), (3.2, -6.8)), 0.36, 0.10, 0.08),),
    "eyeSquintLeft": (Fold(UNDER_EYE, 0.26, 0.16, 0.08),),
    "cheekSquintLeft": (Fold(UNDER_EYE, 0.28, 0.26, 0.16),),
}
"""Shape -> its folds."""


def folded(deformer: SkinDeformer, fold: Fold) -> Array:
    """Return the (n, 3) displacement of a fold, which runs out softly at both ends of its line."""
    place = deformer.reference
    share, across, beyond = beside_line(place[:, :2], np.array(fold.line))
    strength = smoothstep(0, 0.25, share) * smoothstep(1, 0.6, share) * bump(beyond, 0, fold.width)
    strength = strength * (place[:, 2] > FRONT) * (deformer.vertices[:, 0] > 0)
    flesh = fold.height * bump(across, 1.7 * fold.width, 1.4 * fold.width)
    height = strength * (flesh - fold.depth * bump(across, 0, fold.width))
    for _ in range(SMOOTHINGS):
        height = deformer.averaged(height)
    off_the_margin = smoothstep(1, 4, deformer.eye_ring)
    return deformer.normals * (height * off_the_margin)[:, None]
