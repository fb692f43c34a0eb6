"""What is shown as colours on the face of a pane: how far it moved, how far a solver's radius reaches."""

import numpy as np

from facepin.core.arrays import Floats, Points
from facepin.core.control import ShapeControl
from facepin.core.look.heat import heat_scale
from facepin.core.mesh.geodesic import geodesic_distances
from facepin.core.rig import Rig
from facepin.core.shapes.measures import moves
from facepin.core.shapes.motion import shape_moves
from facepin.session.work import Pane


class HeatGauge:
    """Measures one pane; keeps the answer, and where the drag began."""

    def __init__(self, rig: Rig) -> None:
        self._rig = rig
        self._top = heat_scale(rig.height).top
        self._began: Floats | None = None
        self._control: ShapeControl | None = None
        self._origin: Points = rig.neutral
        self._measured: tuple[Points, Points] | None = None
        self._heat: Points = np.zeros(rig.vertex_count, np.float32)
        self._reached: tuple[tuple[int, ...], float] | None = None
        self._reach: Points = self._heat
        self._shape: tuple[int, Points] | None = None

    def heat(self, pane: Pane, control: ShapeControl, positions: Points) -> Points:
        """Return the moves of the vertices in shares of the top of the heat scale, (n,) float32.

        Parameters
        ----------
        pane : Pane
            Its last drag tells where moves are measured from; without one it is the neutral.
        control : ShapeControl
            Which shapes are to be seen.
        positions : (n, 3) float32
            Its posed vertices.

        Returns
        -------
        (n,) float32
            A new array only when the moves are others than in the call before.
        """
        began = None if pane.began is None else pane.began.weights
        if began is not self._began or control is not self._control:
            self._began, self._control = began, control
            neutral = self._rig.neutral
            self._origin = neutral if began is None else self._rig.evaluate(control.heard(began))
        measured = (positions, self._origin)
        if self._measured is None or any(
            new is not old for new, old in zip(measured, self._measured, strict=True)
        ):
            self._measured = measured
            self._heat = (moves(positions, self._origin) / self._top).astype(np.float32)
        return self._heat

    def reach(self, pane: Pane) -> Points:
        """Return how much each vertex counts with the radius of the pane's solver, 1 at a pin, (n,) float32.

        Zeros without a radius or without pins; a new array only when pins or radius are others than before.
        """
        places = tuple(pin.vertex for pin in pane.pose.pins)
        radius = getattr(pane.choice.settings, "radius", 0.0) / 100 * self._rig.height
        if (places, radius) != self._reached:
            self._reached = places, radius
            self._reach = np.zeros(self._rig.vertex_count, np.float32)
            if radius > 0:
                distances = geodesic_distances(self._rig, places, radius)
                self._reach = (1.0 - np.minimum(distances / radius, 1.0)).astype(np.float32)
        return self._reach

    def shape(self, shape: int) -> Points:
        """Return how far a shape alone moves each vertex, 1 where it moves it most, (n,) float32.

        A new array only when the shape is another than before.
        """
        if self._shape is None or self._shape[0] != shape:
            lengths = shape_moves(self._rig, shape)
            self._shape = shape, (lengths / max(lengths.max(initial=0.0), 1e-30)).astype(np.float32)
        return self._shape[1]
