"""Faces with several pins: what a press, a removal and the next drag do to what is held already.

All of it goes through a session, as in the window: what is undone, snapped or kept is up to that.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import pi

import numpy as np

from facepin.core.arrays import Floats, Points
from facepin.core.pose import FRONT_AXES, Pin, Pose, as_vector, with_changed
from facepin.core.rig import Rig
from facepin.core.shapes import measures
from facepin.figures.study.drags import PIXEL, Method
from facepin.session.edit import Edit
from facepin.session.session import Session

DRAGS = 8
"""Drags of a sequence, each of another point; all pins stay."""
POSED = 3
"""Drags after which pins are placed and removed on trial."""
NEAR_NUDGE = 0.1
"""Within this share of the face height of a pin that is nudged, skin may move with it."""


@dataclass(frozen=True, eq=False)
class Case:
    """What came of one sequence, in per cent; empty where there are too few points."""

    press_jump: Floats
    """(≤ 1,) largest move of a vertex as a pin is placed and the mouse has not moved, of the face height."""
    removal_jump: Floats
    """(≤ 3,) largest move of a vertex away from a pin nudged by a pixel, after another one was removed."""
    slip: Floats
    """How far each held pin's vertex moves over the screen in each drag, of the drag."""
    lag: Floats
    """(≤ `DRAGS`,) what remains between the dragged vertex and its goal, of the drag."""


class Poser:
    """A session in which pins are placed, dragged and removed, seen straight from the front."""

    def __init__(self, rig: Rig, method: Method) -> None:
        choice, self._freedom = method
        self._rig = rig
        self._rows: dict[int, Floats] = {}
        self.session = Session(rig, [choice], Pose(np.zeros(rig.shape_count)))

    @property
    def face(self) -> Points:
        """(n, 3) as it is shown."""
        return self._rig.evaluate(self.session.pose.weights)

    def place(self, vertex: int) -> Floats:
        """Return where a vertex is, (3,) float64."""
        if vertex not in self._rows:
            self._rows[vertex] = self._rig.rows_at([vertex])
        amounts = self._rig.amounts(self.session.pose.weights)
        place: Floats = self._rows[vertex] @ amounts + self._rig.neutral[vertex]
        return place

    def drag(self, vertex: int, move: Floats, *, final: bool = True) -> None:
        """Press on a vertex and move the mouse by (2,); without `final`, the mouse is not released yet."""
        session, here = self.session, as_vector(self.place(vertex))
        if all(pin.vertex != vertex for pin in session.pose.pins):
            new = Pin(vertex, here, self._freedom, FRONT_AXES)
            session.apply(Edit("Place pin", False, (*session.pose.pins, new)))

        def pulled(pin: Pin) -> Pin:
            return replace(pin, goal=as_vector(np.asarray(pin.goal) + np.append(move, 0.0)))

        pins = with_changed(session.pose.pins, {vertex}, pulled)
        session.apply(Edit("Drag pin", final, pins, solve=True))

    def remove(self, vertex: int) -> None:
        """Remove the pin on a vertex."""
        pins = tuple(pin for pin in self.session.pose.pins if pin.vertex != vertex)
        self.session.apply(Edit("Remove pin", True, pins))


def hold(rig: Rig, method: Method, points: Sequence[int], percent: float, seed: int, case: int) -> Case:
    """Drag up to 8 of the points one after the other, each into a random direction, from the neutral.

    After the third drag the next pin is placed without moving the mouse, and each of the pins is removed and
    another one nudged; these trials are taken back.

    Parameters
    ----------
    points : sequence of int
        Vertices to choose from.
    percent : float
        Length of the drags, of the face height.
    seed, case : int
        Other numbers draw other points and directions; the same for every method.
    """
    random = np.random.default_rng([seed, 1, case])
    vertices = random.permutation(np.array(points))[:DRAGS].tolist()
    size = percent / 100 * rig.height
    angles = random.uniform(0.0, 2 * pi, len(vertices))
    moves = size * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    poser = Poser(rig, method)
    press, removals, slips, lags = [], [], [], []
    for at, (vertex, move) in enumerate(zip(vertices, moves, strict=True)):
        held = vertices[:at]
        if at == POSED:
            press.append(press_jump(rig, poser, vertex))
            removals += [removal_jump(rig, poser, held[i], held[i - 1]) for i in range(POSED)]
        before = [poser.place(each)[:2] for each in (*held, vertex)]
        poser.drag(vertex, move)
        after = [poser.place(each)[:2] for each in (*held, vertex)]
        way = np.array(after) - before
        slips += np.linalg.norm(way[:-1], axis=1).tolist()
        lags.append(np.linalg.norm(move - way[-1]))
    of_drag, of_face = 100 / size, 100 / rig.height
    return Case(
        np.array(press) * of_face,
        np.array(removals) * of_face,
        np.array(slips) * of_drag,
        np.array(lags) * of_drag,
    )


def press_jump(rig: Rig, poser: Poser, vertex: int) -> float:
    """Return the largest move of a vertex when a pin is pressed and the mouse has not moved, a length."""
    before = poser.face
    poser.drag(vertex, np.zeros(2), final=False)
    jump = float(measures.moves(poser.face, before).max())
    poser.session.cancel()
    return jump


def removal_jump(rig: Rig, poser: Poser, removed: int, nudged: int) -> float:
    """Return the largest move of a vertex, far from a pin that is nudged, after another was removed."""
    before, step = poser.face, poser.session.step
    poser.remove(removed)
    poser.drag(nudged, np.array([PIXEL * rig.height, 0.0]), final=False)
    away = measures.moves(rig.neutral, rig.neutral[nudged]) > NEAR_NUDGE * rig.height
    jump = float(measures.moves(poser.face, before)[away].max(initial=0.0))
    poser.session.go_to(step)
    return jump
