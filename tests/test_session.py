import numpy as np
import pytest

from facepin.core.errors import FacepinError
from facepin.core.pose import Pin, pin_displacement, pin_rows
from facepin.session.edit import Edit
from facepin.session.session import Session
from facepin.session.solving import PinSolver, choose
from facepin.solvers import SOLVERS
from facepin.solvers.interface import PinSystem, Solution, Solve, SolverKind
from small_rigs import sheet

RIG = sheet()


def held(vertex: int, move: tuple[float, float, float], **more: object) -> Pin:
    x, y, z = (RIG.neutral[vertex].astype(float) + move).tolist()
    return Pin(vertex, (x, y, z), **more)


def test_a_drag_is_solved_from_where_it_began_whatever_its_path() -> None:
    far, goal = held(30, (0.9, 0.4, -0.3)), held(30, (0.2, 0.1, 0.0))
    direct, wandering = (Session(RIG, [choose("tikhonov")]) for _ in range(2))
    direct.apply(Edit("Drag pin", True, (goal,), solve=True))
    for _ in range(5):
        wandering.apply(Edit("Drag pin", False, (far,), solve=True))
    wandering.apply(Edit("Drag pin", True, (goal,), solve=True))
    assert direct.pose.weights.any()
    np.testing.assert_array_equal(direct.pose.weights, wandering.pose.weights)


def test_a_gesture_is_one_undo_step_and_undo_returns_the_same_pose() -> None:
    session = Session(RIG, [choose("transpose")])
    before = session.pose
    for step in range(10):
        session.apply(Edit("Drag pin", step == 9, (held(30, (0.02 * step, 0, 0)),), solve=True))
    after = session.pose
    assert session.undo_label == "Drag pin"
    assert session.undo()
    assert session.pose is before
    assert not session.undo()
    assert session.redo()
    assert session.pose is after


def test_cancel_restores_exactly() -> None:
    session = Session(RIG, [choose("transpose")])
    before = session.pose
    session.apply(Edit("Drag pin", False, (held(30, (0.3, 0, 0)),), solve=True))
    assert session.in_gesture
    assert session.pose is not before
    session.cancel()
    assert session.pose is before
    assert session.undo_label is None


def test_goals_follow_their_vertices_when_weights_are_set_by_hand() -> None:
    session = Session(RIG, [choose("transpose")])
    session.apply(Edit("Place pin", True, (held(30, (0, 0, 0)), held(41, (0, 0, 0)))))
    weights = np.array([0.3, 0.9, 0.1, 0.5])
    session.apply(Edit("Set shape1", True, weights=weights))
    positions = RIG.evaluate(weights)
    for pin in session.pose.pins:
        np.testing.assert_allclose(pin.goal, positions[pin.vertex], atol=1e-6)
    # So the next drag starts with nothing to catch up on.
    session.apply(Edit("Drag pin", True, session.pose.pins, solve=True))
    np.testing.assert_allclose(session.pose.weights, weights, atol=1e-6)


def test_weights_and_pins_can_be_loaded_together() -> None:
    session = Session(RIG, [choose("transpose")])
    pins = (held(30, (0.5, 0.5, 0.5)),)
    session.apply(Edit("Load", True, pins, weights=np.full(4, 0.25)))
    assert session.pose.pins == pins
    assert session.pose.weights.tolist() == [0.25] * 4


def test_another_solver_is_asked_for_the_same_drag() -> None:
    pins = (held(30, (0.2, 0.1, 0)),)
    session = Session(RIG, [choose("transpose")])
    session.apply(Edit("Set", True, weights=np.array([0.5, 0, 0, 0])))
    session.apply(Edit("Drag pin", True, pins, solve=True))
    session.choose_solver(0, choose("tikhonov"))
    other = Session(RIG, [choose("tikhonov")])
    other.apply(Edit("Set", True, weights=np.array([0.5, 0, 0, 0])))
    other.apply(Edit("Drag pin", True, pins, solve=True))
    np.testing.assert_array_equal(session.pose.weights, other.pose.weights)
    assert session.undo_label == "Solve with Tikhonov"


def _broken(weights: object) -> SolverKind:
    def prepare(system: PinSystem, settings: object) -> Solve:
        def solve(displacement: object, start: np.ndarray) -> Solution:
            if isinstance(weights, Exception):
                raise weights
            return Solution(np.full_like(start, weights))

        return solve

    kind = SOLVERS["transpose"]
    return SolverKind("broken", "Broken", "", kind.settings, prepare)


@pytest.mark.parametrize("weights", [np.nan, np.inf, np.linalg.LinAlgError("singular")])
def test_a_solver_that_fails_keeps_the_last_good_pose_and_says_so(weights: object) -> None:
    choice = choose("transpose")
    session = Session(RIG, [choice])
    session.apply(Edit("Drag pin", True, (held(30, (0.1, 0, 0)),), solve=True))
    good = session.pose
    session.choose_solver(0, type(choice)(_broken(weights), choice.settings))
    assert session.pose is good
    session.apply(Edit("Drag pin", False, (held(30, (0.2, 0, 0)),), solve=True))
    session.apply(Edit("Drag pin", True, (held(30, (0.3, 0, 0)),), solve=True))
    assert session.pose is good
    assert "Broken" in session.message


def test_keep_within_limits_clips_and_leaves_what_began_outside() -> None:
    pins = (held(30, (3.0, 3.0, 3.0)), held(41, (-2.0, 1.0, 0.0)))
    start = np.array([1.7, 0, 0, 0])
    free = PinSolver(RIG, choose("pseudo_inverse")).solve(pins, start).weights
    kept = PinSolver(RIG, choose("pseudo_inverse", keep_limits=True)).solve(pins, start).weights
    assert (free < 0).any() or (free > 1).any()
    np.testing.assert_array_equal(kept, np.clip(free, 0, [1.7, 1, 1, 1]))


@pytest.mark.parametrize("freedom", ["space", "screen"])
def test_pin_error_is_the_distance_that_is_left(freedom: str) -> None:
    pins = (
        held(30, (0.5, 0.2, 0.7), freedom=freedom, stiffness=4.0),
        held(41, (-0.3, 0.1, 0.2), freedom=freedom),
    )
    solved = PinSolver(RIG, choose("transpose")).solve(pins, np.zeros(4))
    positions = RIG.evaluate(solved.weights).astype(float)
    miss = np.array([np.subtract(pin.goal, positions[pin.vertex]) for pin in pins])
    if freedom == "screen":
        miss = miss[:, :2]  # seen from the front, depth is free
    assert solved.pin_error == pytest.approx(np.linalg.norm(miss, axis=1).mean(), rel=1e-5)


def test_screen_pins_constrain_what_the_screen_shows() -> None:
    axes = ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0))  # seen from the character's left
    pins = (held(30, (9.0, 0.2, 0.3), freedom="screen", axes=axes, stiffness=2.25),)
    rows, displacement = pin_rows(RIG, pins), pin_displacement(RIG, pins)
    assert rows.shape == (2, 4)
    space = RIG.rows_at([30])
    np.testing.assert_allclose(rows, 1.5 * np.stack([-space[2], space[1]]))
    np.testing.assert_allclose(displacement, 1.5 * np.array([-0.3, 0.2]), atol=1e-7)


def test_an_unknown_solver_is_refused_with_the_known_ones() -> None:
    with pytest.raises(FacepinError, match=r"no solver 'magic'.*transpose"):
        choose("magic")
