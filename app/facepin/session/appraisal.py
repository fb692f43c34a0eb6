"""What a pane's title says of its pose, measured while it is dragged."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats, Points
from facepin.core.control import ShapeControl
from facepin.core.pose import Pin
from facepin.core.rig import Rig
from facepin.core.shapes import measures
from facepin.session.work import Pane

NEAR_PINS = 0.15
"""Without a reference pose, what is further from every pin than this share of the face height should rest."""


@dataclass(frozen=True)
class Appraisal:
    """Figures of one pane; lengths in per cent of the face height."""

    pin_error: float
    far_motion: float
    out_of_range: int
    active: int
    e_rms: float | None
    """Against the reference (Eq. 9); None without one."""


class Appraiser:
    """Measures poses of one rig; keeps what depends on the reference and the pins' places only."""

    def __init__(self, rig: Rig) -> None:
        self._rig = rig
        self._reference: Floats | None = None
        self._places: tuple[int, ...] | None = None
        self._resting: NDArray[np.intp] = np.zeros(0, np.intp)

    def appraise(
        self, pane: Pane, control: ShapeControl, positions: Points, reference: Floats | None
    ) -> Appraisal:
        """Measure a pane.

        Parameters
        ----------
        pane : Pane
            Weights and pins.
        control : ShapeControl
            Whose limits count.
        positions : (n, 3) float32
            Its posed vertices.
        reference : (k,) float64
            Weights to measure against, or None.
        """
        rig, weights, pins = self._rig, pane.pose.weights, pane.pose.pins
        self._find_resting(pins, reference)
        # As measures.far_motion, in float32 and without a square root per vertex: it is done on every frame.
        moved = positions - rig.neutral
        far = float(np.einsum("ij,ij->i", moved, moved)[self._resting].max(initial=0.0)) ** 0.5
        return Appraisal(
            measures.percent(measures.pin_error(positions, pins), rig.height),
            measures.percent(far, rig.height),
            measures.out_of_range(weights, control.limits_at(weights)),
            measures.active(weights),
            None if reference is None else measures.e_rms(weights, reference),
        )

    def _find_resting(self, pins: tuple[Pin, ...], reference: Floats | None) -> None:
        """Find the vertices that should not move, by the reference or else by the distance to the pins."""
        places = tuple(pin.vertex for pin in pins) if reference is None else ()
        if reference is not self._reference or places != self._places:
            rig = self._rig
            if reference is not None:
                mask = measures.resting(rig.evaluate(reference), rig.neutral, rig.height)
            else:
                mask = measures.far_from_pins(rig.neutral, pins, NEAR_PINS * rig.height)
            self._reference, self._places, self._resting = reference, places, np.flatnonzero(mask)
