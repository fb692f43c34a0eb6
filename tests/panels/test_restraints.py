"""Locks, mutes and limits at work: what solvers, edits and undo make of them."""

from dataclasses import replace

import numpy as np
import pytest

from facepin.core.control import ShapeControl
from facepin.core.pose import Pin, Pose, pin_displacement, pin_rows
from facepin.core.rig import Rig
from facepin.core.shapes.measures import pin_error
from facepin.session.edit import Edit
from facepin.session.session import Session
from facepin.session.solving.solving import PinSolver, choose
from facepin.solvers import SOLVERS
from support.small_rigs import sheet

RIG = sheet(shapes=6)
PINS = tuple(
    Pin(vertex, tuple((RIG.neutral[vertex] + move).tolist()))
    for vertex, move in ((30, (0.2, 0.1, 0.1)), (41, (-0.1, 0.2, 0.0)), (52, (0.1, 0.1, -0.1)))
)
START = np.array([0.3, 0.1, 0.6, 0.0, 0.2, 0.4])


def control(**flags: list[int]) -> ShapeControl:
    made = {name: np.isin(np.arange(6), shapes) for name, shapes in flags.items()}
    return replace(ShapeControl.of(RIG), **made)


def without(rig: Rig, shapes: list[int]) -> Rig:
    """The rig that never had those shapes, but the same scale."""
    kept = np.setdiff1d(np.arange(rig.shape_count), shapes)
    fewer = replace(
        rig,
        deltas=rig.deltas[:, kept],
        shape_names=tuple(rig.shape_names[j] for j in kept),
        limits=rig.limits[kept],
        rest_weights=rig.rest_weights[kept],
    )
    fewer.__dict__["scale"] = rig.scale
    return fewer


@pytest.mark.parametrize("key", SOLVERS)
def test_a_lock_is_a_rig_without_the_shape_whose_neutral_has_its_share(key: str) -> None:
    locked = [1, 4]
    solved = PinSolver(RIG, choose(key), control(locked=locked)).solve(PINS, START)
    np.testing.assert_array_equal(solved.weights[locked], START[locked])

    share = np.where(np.isin(np.arange(6), locked), START, 0)
    other = without(replace(RIG, neutral=RIG.evaluate(share)), locked)
    kept = np.setdiff1d(np.arange(6), locked)
    alone = PinSolver(other, choose(key)).solve(PINS, START[kept])
    np.testing.assert_allclose(solved.weights[kept], alone.weights, atol=2e-5)
    assert abs(solved.weights[kept] - START[kept]).max() > 0.01
    assert solved.pin_error == pytest.approx(pin_error(RIG.evaluate(solved.weights), PINS), abs=1e-6)


@pytest.mark.parametrize("key", SOLVERS)
def test_a_muted_shape_has_no_share_at_all(key: str) -> None:
    muted = [0, 2]
    restrained = control(muted=muted)
    solved = PinSolver(RIG, choose(key), restrained).solve(PINS, START)
    np.testing.assert_array_equal(solved.weights[muted], START[muted])
    kept = np.setdiff1d(np.arange(6), muted)
    alone = PinSolver(without(RIG, muted), choose(key)).solve(PINS, START[kept])
    np.testing.assert_allclose(solved.weights[kept], alone.weights, atol=1e-9)
    seen = RIG.evaluate(restrained.heard(solved.weights))
    assert solved.pin_error == pytest.approx(pin_error(seen, PINS), abs=1e-6)


def test_a_solver_that_is_kept_notices_other_locked_weights() -> None:
    solver = PinSolver(RIG, choose("pseudo_inverse"), control(locked=[2]))
    first = solver.solve(PINS, START)
    other = START.copy()
    other[2] = 0.0
    again = solver.solve(PINS, other)
    fresh = PinSolver(RIG, choose("pseudo_inverse"), control(locked=[2])).solve(PINS, other)
    np.testing.assert_array_equal(again.weights, fresh.weights)
    assert abs(again.weights - first.weights).max() > 0.01


@pytest.mark.parametrize("key", SOLVERS)
def test_with_every_shape_locked_nothing_moves(key: str) -> None:
    solved = PinSolver(RIG, choose(key), control(locked=list(range(6)))).solve(PINS, START)
    np.testing.assert_array_equal(solved.weights, START)
    expected = pin_rows(RIG, PINS) @ START - pin_displacement(RIG, PINS)
    assert solved.pin_error == pytest.approx(np.linalg.norm(expected.reshape(-1, 3), axis=1).mean())


@pytest.mark.parametrize("key", ["sparse", "bounded", "pseudo_inverse"])
def test_limits_of_the_control_are_obeyed(key: str) -> None:
    limits = np.tile([0.1, 0.3], (6, 1))
    tight = replace(ShapeControl.of(RIG), limits=limits)
    far = tuple(replace(pin, goal=tuple(3 * x for x in pin.goal)) for pin in PINS)
    weights = PinSolver(RIG, choose(key, keep_limits=True), tight).solve(far, START).weights
    low, high = np.minimum(0.1, START), np.maximum(0.3, START)
    assert ((weights >= low) & (weights <= high)).all()
    assert (np.isclose(weights, low) | np.isclose(weights, high)).any()


def session(*keys: str) -> Session:
    made = Session(RIG, [choose(key) for key in keys or ["transpose"]], Pose(START))
    made.set_control("Lock shape2", control(locked=[2]))
    return made


def test_control_is_undone_and_redone() -> None:
    made = session()
    before = made.control
    made.set_control("Mute shape1", control(muted=[1]))
    assert made.control.muted[1]
    assert made.undo()
    assert made.control is before
    assert made.undo_label == "Lock shape2"
    assert made.undo()
    assert not made.control.locked.any()
    assert made.redo()
    assert made.control is before


def test_control_of_another_rig_is_a_bug() -> None:
    with pytest.raises(ValueError, match="4 shapes for 6"):
        session().set_control("Lock", ShapeControl.of(sheet()))


def test_an_edit_of_a_locked_shape_alone_is_refused() -> None:
    made = session()
    work, weights = made.work, START.copy()
    weights[2] = 0.9
    made.apply(Edit("Set shape2", False, weights=weights))
    assert made.message == "shape2 is locked"
    made.apply(Edit("Set shape2", True, weights=weights))
    assert made.work is work
    assert made.undo_label == "Lock shape2"


def test_a_loaded_pose_and_a_reset_leave_locked_weights_and_say_so() -> None:
    made = session()
    made.apply(Edit("Load smile.json", True, (), weights=np.full(6, 0.5)))
    assert made.message == "shape2 is locked"
    np.testing.assert_array_equal(made.pose.weights, [0.5, 0.5, 0.6, 0.5, 0.5, 0.5])
    made.reset()
    assert made.message == "shape2 is locked"
    np.testing.assert_array_equal(made.pose.weights, [0, 0, 0.6, 0, 0, 0])
    made.set_control("Unlock shape2", ShapeControl.of(RIG))
    made.reset()
    assert not made.message
    assert not made.pose.weights.any()


def test_an_edit_that_leaves_the_lock_alone_says_nothing() -> None:
    made = session()
    weights = START.copy()
    weights[1] = 0.9
    made.apply(Edit("Set shape1", True, weights=weights))
    assert not made.message
    np.testing.assert_array_equal(made.pose.weights, weights)


@pytest.mark.parametrize("key", SOLVERS)
def test_a_weight_that_a_drag_made_stays_once_it_is_locked(key: str) -> None:
    made = Session(RIG, [choose(key)])
    made.apply(Edit("Drag pin", True, PINS, solve=True))
    shape = int(np.argmax(abs(made.pose.weights)))
    value = made.pose.weights[shape]
    made.set_control("Lock", control(locked=[shape]))
    assert made.pose.weights[shape] == value
    made.choose_solver(0, choose(key, keep_limits=True))
    assert made.pose.weights[shape] == value, "asking for the same drag in another way"
    moved = (replace(PINS[0], goal=(0.0, 0.0, 0.2)), *PINS[1:])
    made.apply(Edit("Drag pin", True, moved, solve=True))
    assert made.pose.weights[shape] == value


def test_goals_snap_to_what_is_seen() -> None:
    made = Session(RIG, [choose("transpose")])
    made.apply(Edit("Drag pin", True, PINS, solve=True))
    goals = [pin.goal for pin in made.pose.pins]
    muted = control(muted=[0, 3])
    made.set_control("Mute", muted)
    assert [pin.goal for pin in made.pose.pins] == goals, "to mute and to hear again changes nothing"
    made.apply(Edit("Set", True, weights=START))
    seen = RIG.evaluate(muted.heard(START))
    for pin in made.pose.pins:
        np.testing.assert_allclose(pin.goal, seen[pin.vertex], atol=1e-6)


def test_panes_share_the_control() -> None:
    made = session("transpose", "bounded")
    made.apply(Edit("Drag pin", True, PINS, solve=True))
    assert [pane.pose.weights[2] for pane in made.panes] == [0.6, 0.6]
