"""A pose to measure others against."""

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.rig import Rig

RANDOM_SHAPES = (1, 2, 4, 8, 12)
"""Sizes of random reference poses on offer."""


def random_reference(rig: Rig, shapes: int, random: np.random.Generator) -> Floats:
    """Return weights (k,) of some shapes, uniform in 0.4 .. 1, the others 0: as the study draws its poses."""
    weights = np.zeros(rig.shape_count)
    chosen = random.choice(rig.shape_count, min(shapes, rig.shape_count), replace=False)
    weights[chosen] = random.uniform(0.4, 1.0, len(chosen))
    return weights
