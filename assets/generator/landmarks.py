"""Carries places between faces, so that brushes, limits and blush are given once, on the reference face."""

import numpy as np
from scipy.interpolate import RBFInterpolator

from generator.anatomy import Anatomy
from generator.vectors import MIRROR, Array

REFERENCE = Anatomy()
"""The face whose coordinates the shapes are written in: an `Anatomy` as it comes."""


def landmarks(anatomy: Anatomy) -> Array:
    """Return (k, 3) points that every face has, of both sides."""
    skull, mouth, nose, brow = anatomy.skull, anatomy.mouth, anatomy.nose, anatomy.brow
    lips_z = skull.muzzle.centre[2] + skull.muzzle.radii[2]
    left = np.array(
        [
            anatomy.eye.centre,
            (brow.x[0][1], brow.y[0][1], skull.brow_ridge.start[2]),
            (brow.x[-1][1], brow.y[-1][1], skull.brow_ridge.end[2]),
            (mouth.half_width, mouth.height, lips_z - 1.0),
            nose.wing.centre,
            skull.jaw.start,
            skull.jaw.end,
            skull.cheek.centre,
            skull.buccal.centre,
        ]
    )
    middle = np.array(
        [
            (0, mouth.height, lips_z),
            nose.tip.centre,
            nose.bridge.start,
            skull.chin.centre,
            skull.forehead.centre,
            skull.cranium.centre,
            skull.neck.start,
            skull.neck.end,
        ]
    )
    return np.concatenate([left, left * MIRROR, middle])


class FaceMap:
    """A smooth map of space that takes the landmarks of a character to those of the reference face."""

    def __init__(self, anatomy: Anatomy) -> None:
        here, there = landmarks(anatomy), landmarks(REFERENCE)
        self._to_reference = RBFInterpolator(here, there, kernel="linear", degree=1)
        mouth, usual = anatomy.mouth, REFERENCE.mouth
        self.mouth_scale = mouth.half_width / usual.half_width
        self.upper_lip_scale = mouth.upper_lip / usual.upper_lip / self.mouth_scale
        self.lower_lip_scale = mouth.lower_lip / usual.lower_lip / self.mouth_scale

    def to_reference(self, points: Array) -> Array:
        """Return where (n, 3) points of the character lie on the reference face."""
        result: Array = self._to_reference(points)
        return result
