"""Where drags begin: what is not in the hand is held where it is."""

import numpy as np
import pytest

from facepin.core.pose import Pin
from facepin.session.edit import Edit
from facepin.session.session import Session
from facepin.session.solving.solving import choose
from facepin.solvers import SOLVERS
from support.small_rigs import sheet

RIG = sheet()
FROM_THE_PRESS = [key for key, kind in SOLVERS.items() if not kind.afresh]


def place(session: Session, vertex: int) -> np.ndarray:
    return RIG.evaluate(session.pose.weights)[vertex].astype(float)


def pulled(session: Session, vertex: int, move: tuple[float, float, float]) -> tuple[Pin, ...]:
    """All pins as at the press, with the one on a vertex (a new one where there is none) moved from there."""
    pose = session.committed.panes[0].pose
    pins = {pin.vertex: pin for pin in pose.pins}
    start = pins[vertex].goal if vertex in pins else RIG.evaluate(pose.weights)[vertex].astype(float)
    x, y, z = np.add(start, move).tolist()
    pins[vertex] = Pin(vertex, (x, y, z))
    return tuple(pins.values())


def dragged(session: Session, vertex: int, move: tuple[float, float, float], final: bool = True) -> None:
    session.apply(Edit("Drag pin", final, pulled(session, vertex, move), solve=True))


@pytest.mark.parametrize("key", FROM_THE_PRESS)
def test_a_press_on_a_new_pin_moves_nothing_whatever_other_pins_miss(key: str) -> None:
    session = Session(RIG, [choose(key)])
    dragged(session, 40, (0.0, 5.0, 0.0))  # far beyond reach: it lags
    before = session.pose.weights
    dragged(session, 20, (0.0, 0.0, 0.0), final=False)
    np.testing.assert_allclose(session.pose.weights, before, atol=1e-9)
    dragged(session, 20, (1e-4, 0.0, 0.0))
    assert np.abs(session.pose.weights - before).max() < 0.05


@pytest.mark.parametrize("key", FROM_THE_PRESS)
def test_held_goals_go_to_where_their_points_are(key: str) -> None:
    session = Session(RIG, [choose(key)])
    dragged(session, 40, (0.0, 5.0, 0.0))
    there = place(session, 40)
    dragged(session, 20, (0.0, 0.0, 0.2))
    held = next(pin for pin in session.pose.pins if pin.vertex == 40)
    np.testing.assert_allclose(held.goal, there, atol=1e-5)


@pytest.mark.parametrize("key", SOLVERS)
def test_after_a_pin_is_removed_a_nudge_of_another_is_a_nudge(key: str) -> None:
    session = Session(RIG, [choose(key, keep_limits=True)])
    dragged(session, 40, (0.0, 5.0, 0.0))
    dragged(session, 20, (0.0, 0.0, 0.2))
    session.apply(Edit("Remove pin", True, tuple(pin for pin in session.pose.pins if pin.vertex == 20)))
    before = session.pose.weights
    dragged(session, 20, (1e-5, 0.0, 0.0))
    assert np.abs(session.pose.weights - before).max() < 1e-2


def test_a_pin_that_was_met_and_is_taken_again_can_be_put_back_exactly() -> None:
    session = Session(RIG, [choose("tikhonov")])
    session.apply(Edit("Set", True, weights=np.array([0.1, 0.2, 0.3, 0.4])))
    start = session.pose.weights
    dragged(session, 40, (0.05, 0.05, 0.0))
    assert not np.allclose(session.pose.weights, start, atol=1e-3)
    dragged(session, 40, (-0.05, -0.05, 0.0))
    np.testing.assert_allclose(session.pose.weights, start, atol=1e-6)
    assert len(session.steps) == 4


def test_a_pin_that_lags_begins_anew_from_where_it_is() -> None:
    session = Session(RIG, [choose("hand")])
    dragged(session, 40, (0.0, 5.0, 0.0))
    before, there = session.pose.weights, place(session, 40)
    dragged(session, 40, (0.0, -1e-4, 0.0))
    np.testing.assert_allclose(session.pose.pins[0].goal, there, atol=1e-3)
    np.testing.assert_allclose(session.pose.weights, before, atol=1e-2)


def test_each_pane_moves_its_own_point_as_far_as_the_hand() -> None:
    session = Session(RIG, [choose("tikhonov"), choose("transpose")])
    dragged(session, 40, (0.1, 0.3, 0.0))
    before = [pane.pose.weights for pane in session.panes]
    assert not np.allclose(*before, atol=1e-3)
    dragged(session, 20, (0.0, 0.0, 0.0), final=False)
    for pane, weights in zip(session.panes, before, strict=True):
        np.testing.assert_allclose(pane.pose.weights, weights, atol=1e-6)
