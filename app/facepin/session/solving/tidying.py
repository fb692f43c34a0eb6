"""Tidying a pose up: fewer shapes that keep it as it looks."""

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.control import ShapeControl
from facepin.core.pose import Pose, pin_rows
from facepin.core.rig import Rig
from facepin.solvers.fewest import Places, fewest

TOLERANCE = 1.0
"""How far a pin, or any place of the face, may go from where it is, in per cent of the face height."""
LOOKS = 3
"""Times that combinations are looked at again in the pose that was found."""


def tidied(rig: Rig, control: ShapeControl, pose: Pose, tolerance: float = TOLERANCE) -> Floats:
    """Return weights (k,) of fewer shapes that keep every pin within a tolerance of where it is.

    Without pins they keep the whole face so.  Locked and silent shapes stay; the others may go to 0, but not
    beyond their limits.  Where no fewer shapes are found, the weights stay as they are.

    Parameters
    ----------
    tolerance : float
        Per cent of the face height, > 0.
    """
    free, allowed = control.free, tolerance / 100 * rig.height
    heard = control.heard(pose.weights)
    if pose.pins:
        rows = pin_rows(rig, pose.pins)
        sizes = [2 if pin.freedom == "screen" else 3 for pin in pose.pins]
    else:
        sentinels = rig.sentinels
        rows = sentinels.rows.reshape(-1, sentinels.rows.shape[2]).astype(np.float64)
        sizes = [3] * len(sentinels.places)
    if not sizes or not len(free):
        return pose.weights
    starts = np.cumsum([0, *sizes[:-1]], dtype=np.intp)
    there, weights = rows @ rig.amounts(heard), pose.weights
    for _ in range(LOOKS if len(rig.combinations) else 1):
        at = control.heard(weights)
        slopes = rig.slopes(rows, at)[:, free]
        share = rows @ rig.amounts(at) - slopes @ at[free]
        limits = control.limits_beside_locks(pose.weights)[free]
        limits = np.stack([np.minimum(limits[:, 0], 0.0), np.maximum(limits[:, 1], 0.0)], axis=1)
        places = Places(slopes, starts, there - share, limits, rig.largest_moves[free], rig.scale)
        found = fewest(places, np.zeros(len(free)), allowed)
        weights = pose.weights.copy()
        weights[free] = found
    missing = rows @ rig.amounts(control.heard(weights)) - there
    kept = np.sqrt(np.add.reduceat(missing**2, starts)).max() <= 1.5 * allowed
    fewer = np.count_nonzero(weights) < np.count_nonzero(pose.weights)
    return weights if kept and fewer else pose.weights
