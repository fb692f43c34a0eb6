"""A pose to measure others against."""

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.rig import Rig

SHAPES = 4
"""Active shapes of a random reference pose."""


def random_reference(rig: Rig, random: np.random.Generator) -> Floats:
    """Return weights (k,) of four shapes, uniform in 0.4 .. 1, the others 0: as the study draws its poses."""
    weights = np.zeros(rig.shape_count)
    shapes = random.choice(rig.shape_count, min(SHAPES, rig.shape_count), replace=False)
    weights[shapes] = random.uniform(0.4, 1.0, len(shapes))
    return weights
