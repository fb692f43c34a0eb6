from dataclasses import replace

import numpy as np
import pytest

from facepin.core.pose import Pin
from facepin.core.rig import Rig
from facepin.core.rig_builder import build_rig
from facepin.session.edit import Edit
from facepin.session.session import Session
from facepin.session.solving import reasons
from facepin.session.solving.reasons import reason
from facepin.session.solving.solving import SolverChoice, choose
from facepin.solvers import SOLVERS


def strip(*deltas: tuple[str, dict[int, tuple[float, float, float]]]) -> Rig:
    """Six triangles in a row, two units high, whose shapes move single vertices."""
    neutral = np.array([(i / 2, i % 2 * 2.0, 0.0) for i in range(8)])
    triangles = np.array([(i, i + 1, i + 2) for i in range(6)])
    dense = []
    for name, moves in deltas:
        delta = np.zeros_like(neutral)
        for vertex, move in moves.items():
            delta[vertex] = move
        dense.append((name, delta))
    return build_rig("strip", neutral, triangles.ravel(), np.full(6, 3), dense)


UP = strip(("up", {2: (0, 0.5, 0)}), ("side", {5: (0.5, 0, 0)}))
HAND = choose("hand")
BOTH = strip(("up", {2: (0, 0.5, 0), 5: (0, 0.5, 0)}))


def pin(rig: Rig, vertex: int, move: tuple[float, float, float]) -> Pin:
    x, y, z = (rig.neutral[vertex].astype(float) + move).tolist()
    return Pin(vertex, (x, y, z))


def after(rig: Rig, *pins: Pin, solver: SolverChoice = HAND, locked: bool = False) -> str:
    """Drag the last pin while the others are held where they are; say why it stayed behind."""
    session = Session(rig, [solver])
    rest = tuple(pin(rig, one.vertex, (0, 0, 0)) for one in pins[:-1])
    session.apply(Edit("Place", True, rest))
    if locked:
        held = np.ones(rig.shape_count, np.bool_)
        session.set_control("Lock", replace(session.control, locked=held))
    session.apply(Edit("Drag", True, (*rest, pins[-1]), solve=True))
    return reason(rig, session.control, session.pane, session.pose.pins[-1])


def test_a_pin_that_is_there_needs_no_reason() -> None:
    assert after(UP, pin(UP, 2, (0, 0.3, 0))) == ""


def test_beyond_the_end_of_its_shapes() -> None:
    assert after(UP, pin(UP, 2, (0, 2.0, 0))) == reasons.ENDS


def test_where_no_shape_goes() -> None:
    assert after(UP, pin(UP, 2, (0, 0, 1.0))) == reasons.NOTHING


def test_what_is_locked() -> None:
    assert after(UP, pin(UP, 2, (0, 0.3, 0)), locked=True) == reasons.LOCKED


def test_what_another_pin_holds() -> None:
    stiff = replace(pin(BOTH, 5, (0, 0, 0)), stiffness=20.0)
    assert after(BOTH, stiff, pin(BOTH, 2, (0, 0.5, 0)), solver=choose("bounded")) == reasons.OTHER


def test_a_solver_that_goes_part_of_the_way() -> None:
    calm = choose("tikhonov", SOLVERS["tikhonov"].settings(alpha=5.0), keep_limits=True)
    assert after(UP, pin(UP, 2, (0, 0.4, 0)), solver=calm) == reasons.HALFWAY


@pytest.mark.parametrize("solver", ["hand", "sparse"])
def test_nobody_is_blamed_for_a_pose_by_hand(solver: str) -> None:
    session = Session(UP, [choose(solver)])
    session.apply(Edit("Place", True, (pin(UP, 2, (0, 1.0, 0)),)))
    assert reason(UP, session.control, session.pane, session.pose.pins[0]) == ""


def test_what_the_rest_of_the_face_keeps_back() -> None:
    rig = strip(("up", {2: (0, 0.25, 0), 5: (0, 0.75, 0)}))
    assert after(rig, pin(rig, 2, (0, 0.25, 0))) == reasons.REST
