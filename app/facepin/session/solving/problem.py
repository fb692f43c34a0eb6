"""What a solver gets to see of a rig and its pins: a linear problem of the shapes it may use."""

from collections.abc import Collection
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats
from facepin.core.control import ShapeControl
from facepin.core.mesh.geodesic import shape_locality
from facepin.core.pose import Pin, pin_rows
from facepin.core.rig import Rig
from facepin.core.shapes.answering import answering
from facepin.core.shapes.measures import moves
from facepin.solvers.interface import Grasp, PinSystem

FAR = 0.24
"""What is further from every pin in the hand than this share of the face height should not go along."""


@dataclass(frozen=True, eq=False)
class LinearProblem:
    """The pins as f free shapes move them."""

    system: PinSystem
    """Of the free shapes."""
    free: NDArray[np.intp] | None
    """(f,) which they are; None for all."""
    share: Floats | None
    """(r,) moves of the pins, from their places at rest, when all free weights are 0; None for nothing."""

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


class PinProblem:
    """Pins at their places, before it is said where they should go.

    Shapes that are locked or silent are left out of the system, and what they do to the pins is taken from
    the displacement: no solver knows of them.  Nor does it know of combinations: the face is taken for the
    linear one that agrees with it, in places and slopes, at a pose.
    """

    def __init__(
        self,
        rig: Rig,
        control: ShapeControl,
        pins: tuple[Pin, ...],
        start: Floats,
        *,
        radius: float = 0.0,
        grabbed: Collection[int] | None = None,
    ) -> None:
        """Look at `pins` from the pose (k,) in which a drag begins.

        `radius` is how far around the pins shapes are asked how local they are, in % of the face height; 0
        asks nothing.  `grabbed` are the vertices of the pins in the hand, for solvers that want to know; None
        asks nothing.
        """
        self.rows = pin_rows(rig, pins)
        """(r, k + c) pin rows of all shapes and combinations."""
        self.curved = bool(self.rows[:, rig.shape_count :].any())
        """Whether combinations move a pin."""
        local = radius > 0 and bool(len(rig.combinations))  # what combinations do depends on the pose
        held_back = grabbed is not None and bool(len(rig.combinations))
        self.follows_start = self.curved or local or held_back or bool(control.held.any())
        """Whether it is another problem when the drag begins at other weights."""
        self._rig, self._control, self._start = rig, control, start
        self._locality = None
        if radius > 0:
            vertices = [pin.vertex for pin in pins]
            reach = radius / 100 * rig.height
            self._locality = shape_locality(rig, vertices, reach, control.heard(start))
        self._grasp = None if grabbed is None else _grasp(rig, pins, grabbed, control.heard(start))

    def linear_at(self, weights: Floats, forces: Floats | None = None) -> LinearProblem:
        """Return the problem that is exact at a pose (k,), near an answer with forces (r,) on the rows."""
        rig, control, ties = self._rig, self._control, self._control.ties
        heard = control.heard(weights)
        slopes = rig.slopes(self.rows, heard)
        sizes, limits, locality = rig.largest_moves, control.limits, self._locality
        if not self.follows_start:
            system = PinSystem(slopes, limits, rig.scale, sizes, locality, ties, grasp=self._grasp)
            return LinearProblem(system, None, None)
        free = control.free
        limits = control.limits_beside_locks(self._start)[free]
        place = {j: at for at, j in enumerate(free.tolist())}
        ties = tuple((place[a], place[b]) for a, b in ties if a in place and b in place)
        locality = None if locality is None else locality[free]
        guess = weights[free]
        grasp = None if self._grasp is None else _of_free(self._grasp, free)
        system = PinSystem(
            slopes[:, free], limits, rig.scale, sizes[free], locality, ties, guess, forces, grasp
        )
        return LinearProblem(system, free, self.rows @ rig.amounts(heard) - system.rows @ heard[free])

    def amounts(self, weights: Floats) -> Floats:
        """Return how much of each shape and combination a pose (k,) has, (k + c,)."""
        return self._rig.amounts(weights)

    def moves(self, weights: Floats) -> Floats:
        """Return the moves of the pins at a pose (k,) from their places at rest, (r,): the true ones."""
        moves: Floats = self.rows @ self._rig.amounts(self._control.heard(weights))
        return moves


def _grasp(rig: Rig, pins: tuple[Pin, ...], grabbed: Collection[int], heard: Floats) -> Grasp:
    """Return what a hand holds, and what lies far from it, seen from a pose (k,)."""
    sizes = [2 if pin.freedom == "screen" else 3 for pin in pins]
    held = np.array([pin.vertex in grabbed for pin in pins], np.bool_)
    sentinels = rig.sentinels
    away = np.ones(len(sentinels.places), np.bool_)
    for vertex in grabbed:
        away &= moves(sentinels.places, rig.neutral[vertex]) > FAR * rig.height
    rows = sentinels.rows[sentinels.telling(away)].astype(np.float64)
    return Grasp(
        starts=np.cumsum([0, *sizes[:-1]], dtype=np.intp)[: len(pins)],
        grabbed=held,
        stiffness=np.array([pin.stiffness for pin in pins], np.float64),
        height=rig.height,
        far=rig.slopes(rows.reshape(-1, rows.shape[2]), heard).reshape(-1, 3, rig.shape_count),
        likeness=sentinels.likeness,
        answers=answering(rig, grabbed),
    )


def _of_free(grasp: Grasp, free: NDArray[np.intp]) -> Grasp:
    """Return what a hand holds for some of the shapes (f,)."""
    if len(free) == len(grasp.likeness):  # the far rows are many: they are not copied for nothing
        return grasp
    answers = None if grasp.answers is None else grasp.answers[free]
    return replace(
        grasp, far=grasp.far[:, :, free], likeness=grasp.likeness[np.ix_(free, free)], answers=answers
    )
