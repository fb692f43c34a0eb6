"""A pose to measure others against."""

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.control import ShapeControl
from facepin.core.rig import Rig


def random_reference(rig: Rig, shapes: int, random: np.random.Generator) -> Floats:
    """Return weights (k,) of some shapes, uniform in 0.4 .. 1 as in the study but within limits; others 0."""
    weights = np.zeros(rig.shape_count)
    chosen = random.choice(rig.shape_count, min(shapes, rig.shape_count), replace=False)
    weights[chosen] = random.uniform(0.4, 1.0, len(chosen))
    return ShapeControl.of(rig).clipped(weights, np.zeros(rig.shape_count))
