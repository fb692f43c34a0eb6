"""What a solver gets to see of a rig and its pins: a linear problem of the shapes it may use."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats
from facepin.core.control import ShapeControl
from facepin.core.geodesic import shape_locality
from facepin.core.pose import Pin, pin_rows
from facepin.core.rig import Rig
from facepin.solvers.interface import PinSystem


@dataclass(frozen=True, eq=False)
class Problem:
    """Pins at their places: what stays the same on every frame of a drag.

    Shapes that are locked or silent are left out of the system, and what they do to the pins is taken from
    the displacement: no solver knows of them.
    """

    rows: Floats
    """(r, k) pin rows of all shapes."""
    system: PinSystem
    """The problem of the f free shapes."""
    free: NDArray[np.intp] | None
    """(f,) which they are; None for all."""
    share: Floats | None
    """(r,) what the others do to the pins; None for nothing."""

    def displacement(self, displacement: Floats) -> Floats:
        """Return of a displacement (r,) what is left to the free shapes."""
        return displacement if self.share is None else displacement - self.share

    def taken(self, weights: Floats) -> Floats:
        """Return the weights (f,) of the free shapes."""
        return weights if self.free is None else weights[self.free]

    def given_back(self, found: Floats, start: Floats) -> Floats:
        """Return all weights (k,): those found for the free shapes (f,), and the others as at the start."""
        if self.free is None:
            return found
        weights = start.copy()
        weights[self.free] = found
        return weights


def make_problem(
    rig: Rig, control: ShapeControl, pins: tuple[Pin, ...], start: Floats, radius: float
) -> Problem:
    """Set up the problem of moving `pins` from the weights `start` (k,).

    `radius` is how far around the pins shapes are asked how local they are, in % of the face height; 0 asks
    nothing.
    """
    rows = pin_rows(rig, pins)
    sizes, limits = rig.largest_moves, control.limits
    locality = None
    if radius > 0:
        locality = shape_locality(rig, [pin.vertex for pin in pins], radius / 100 * rig.height)
    if not control.held.any():
        return Problem(rows, PinSystem(rows, limits, rig.scale, sizes, locality), None, None)
    free, heard = control.free, control.heard(start)
    locality = None if locality is None else locality[free]
    system = PinSystem(rows[:, free], limits[free], rig.scale, sizes[free], locality)
    return Problem(rows, system, free, rows @ heard - system.rows @ heard[free])
