import numpy as np
import pytest

from facepin.core.errors import FacepinError
from facepin.core.pose import Pin, pin_displacement, pin_rows
from facepin.session.edit import Edit
from facepin.session.session import Session
from facepin.session.solving.solving import PinSolver, choose
from facepin.solvers import SOLVERS
from facepin.solvers.interface import PinSystem, Solution, Solve, SolverKind
from support.small_rigs import sheet

RIG = sheet()


def held(vertex: int, move: tuple[float, float, float], **more: object) -> Pin:
    x, y, z = (RIG.neutral[vertex].astype(float) + move).tolist()
    return Pin(vertex, (x, y, z), **more)


def towards(shape: int, weight: float) -> Pin:
    """A pin where a shape moves most, with its goal where the shape would bring it."""
    moves = RIG.deltas[:, [shape]].toarray().reshape(-1, 3)
    vertex = int(np.argmax(np.linalg.norm(moves, axis=1)))
    return held(vertex, tuple((weight * moves[vertex]).tolist()))


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


def test_a_gesture_that_another_one_interrupts_is_a_step_of_its_own() -> None:
    session = Session(RIG, [choose("transpose")])
    before = session.work
    session.apply(Edit("Set shape1", False, weights=np.array([0, 0.4, 0, 0])))
    session.settle()
    assert not session.in_gesture and session.undo_label == "Set shape1"
    set_by_hand = session.work
    session.settle()
    assert session.work is set_by_hand, "with nothing in hand nothing happens"
    session.apply(Edit("Place pin", True, (held(40, (0, 0, 0)),)))
    assert session.undo() and session.work is set_by_hand
    assert session.undo() and session.work is before


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


def test_choosing_another_solver_moves_nothing() -> None:
    session = Session(RIG, [choose("transpose")])
    session.apply(Edit("Drag pin", True, (held(30, (0.2, 0.1, 0)),), solve=True))
    pose = session.pose
    session.choose_solver(0, choose("tikhonov"))
    assert session.pose is pose
    assert session.pane.choice == choose("tikhonov")
    session.choose_solver(0, choose("tikhonov", keep_limits=True))
    assert session.pose is pose, "no drag was its own yet"


def test_what_a_setting_does_is_seen_on_the_last_drag() -> None:
    pins = (held(30, (0.2, 0.1, 0)),)
    session, other = (
        Session(RIG, [choose("tikhonov", SOLVERS["tikhonov"].settings(alpha))]) for alpha in (0.001, 5.0)
    )
    for one in (session, other):
        one.apply(Edit("Drag pin", True, pins, solve=True))
    session.choose_solver(0, other.pane.choice)
    np.testing.assert_array_equal(session.pose.weights, other.pose.weights)


def test_in_a_comparison_another_solver_is_asked_for_the_same_drag() -> None:
    pins = (held(30, (0.2, 0.1, 0)),)
    session = Session(RIG, [choose("transpose"), choose("sparse")])
    session.apply(Edit("Set", True, weights=np.array([0.5, 0, 0, 0])))
    session.apply(Edit("Drag pin", True, pins, solve=True))
    session.choose_solver(0, choose("tikhonov"))
    other = Session(RIG, [choose("tikhonov"), choose("sparse")])
    other.apply(Edit("Set", True, weights=np.array([0.5, 0, 0, 0])))
    other.apply(Edit("Drag pin", True, pins, solve=True))
    np.testing.assert_array_equal(session.pose.weights, other.pose.weights)
    assert session.undo_label == f"Solve with {SOLVERS['tikhonov'].title}"
    there = session.work
    session.choose_solver(0, choose("hybrid"), final=False)
    session.choose_solver(0, choose("tikhonov"))
    assert session.work is there, "slid to and fro, it is no step"


def _broken(weights: object) -> SolverKind:
    def prepare(system: PinSystem, settings: object) -> Solve:
        def solve(displacement: object, start: np.ndarray) -> Solution:
            if isinstance(weights, Exception):
                raise weights
            return Solution(np.full_like(start, weights))

        return solve

    kind = SOLVERS["transpose"]
    return SolverKind("broken", "Broken", "", kind.settings, prepare)


@pytest.mark.parametrize("key", SOLVERS)
@pytest.mark.parametrize("far", [np.nan, np.inf, -np.inf, 1e200, 1e9])
def test_a_goal_that_is_nowhere_is_refused_by_every_solver(key: str, far: float) -> None:
    session = Session(RIG, [choose(key)])
    before = session.pose.weights
    session.apply(Edit("Drag pin", False, (Pin(30, (far, 0.0, 0.0)),), solve=True))
    np.testing.assert_array_equal(session.pose.weights, before)
    assert "the pin on vertex 30 should be at" in session.message


@pytest.mark.parametrize("weights", [np.nan, np.inf, 2e6, np.linalg.LinAlgError("singular")])
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


def test_a_solver_that_takes_all_pins_afresh_does_not_jump_at_a_press() -> None:
    session = Session(RIG, [choose("sparse")])
    session.apply(Edit("Set", True, weights=np.array([0.0, 0.0, 0.6, 0.0])))
    first = towards(1, 0.6)
    session.apply(Edit("Drag pin", True, (first,), solve=True))
    before = session.pose
    x, y, z = RIG.evaluate(before.weights)[41].astype(float).tolist()
    session.apply(Edit("Place pin", True, (first, Pin(41, (x, y, z)))))
    assert session.pose.weights is before.weights
    session.apply(Edit("Drag pin", True, session.pose.pins, solve=True))
    np.testing.assert_allclose(session.pose.weights, before.weights, atol=1e-6)


def test_the_order_of_the_drags_leaves_no_trace_in_such_a_solver() -> None:
    one, two = towards(1, 0.6), towards(2, 0.8)
    ends = []
    for order in ((one, two), (two, one)):
        session = Session(RIG, [choose("sparse")])
        for count in (1, 2):
            session.apply(Edit("Drag pin", True, order[:count], solve=True))
        ends.append(session.pose.weights)
    np.testing.assert_allclose(ends[0], ends[1], atol=1e-6)


@pytest.mark.parametrize("solver", ["sparse", "transpose"])
def test_what_a_removed_pin_made_stays(solver: str) -> None:
    session = Session(RIG, [choose(solver)])
    session.apply(Edit("Drag pin", True, (towards(1, 0.6),), solve=True))
    made = session.pose.weights
    assert made.any()
    session.apply(Edit("Remove pin", True, ()))
    assert session.pose.weights is made
    x, y, z = RIG.evaluate(made)[41].astype(float).tolist()
    session.apply(Edit("Drag pin", True, (Pin(41, (x, y, z)),), solve=True))
    np.testing.assert_allclose(session.pose.weights, made, atol=1e-6)


def test_panes_are_added_closed_and_kept_with_undo() -> None:
    session = Session(RIG, [choose("transpose")])
    session.apply(Edit("Drag pin", True, (held(30, (0.2, 0.1, 0)),), solve=True))
    session.add_pane(choose("tikhonov"))
    assert [pane.choice.kind.key for pane in session.panes] == ["transpose", "tikhonov"]
    # The new pane shows what its solver makes of the drag that was just done.
    alone = Session(RIG, [choose("tikhonov")])
    alone.apply(Edit("Drag pin", True, (held(30, (0.2, 0.1, 0)),), solve=True))
    np.testing.assert_array_equal(session.pose.weights, alone.pose.weights)
    session.close_pane(0)
    assert [pane.choice.kind.key for pane in session.panes] == ["tikhonov"]
    session.undo()
    session.undo()
    assert [pane.choice.kind.key for pane in session.panes] == ["transpose"]
    for key in ("tikhonov", "hybrid", "sparse"):
        session.add_pane(choose(key))
    with pytest.raises(FacepinError, match="4 panes"):
        session.add_pane(choose("bounded"))


def test_a_random_walk_is_undone_and_redone_exactly() -> None:
    random = np.random.default_rng(3)
    session = Session(RIG, [choose("transpose")])
    seen = [session.work]
    for _ in range(60):
        pins = tuple(held(int(v), tuple(random.uniform(-0.2, 0.2, 3))) for v in random.choice(81, 3, False))
        match random.integers(5):
            case 0:
                session.apply(Edit("Set", True, weights=random.uniform(0, 1, 4)))
            case 1:
                session.apply(Edit("Place pin", True, pins))
            case 2:
                session.choose_solver(0, choose(str(random.choice(list(SOLVERS)))))
            case 3:
                session.set_reference(random.uniform(0, 1, 4))
            case _:
                session.apply(Edit("Drag pin", False, pins, solve=True))
                session.apply(Edit("Drag pin", True, pins, solve=True))
        if session.work is not seen[-1]:  # the solver may be the one that is there already
            seen.append(session.work)
    assert len(seen) > 50
    for work in reversed(seen[:-1]):
        assert session.undo()
        assert session.work is work
    for work in seen[1:]:
        assert session.redo()
        assert session.work is work


@pytest.mark.parametrize(("closed", "active"), [(0, 1), (2, 1), (1, 0), (1, 2)])
def test_closing_another_pane_leaves_the_active_one_active(closed: int, active: int) -> None:
    session = Session(RIG, [choose(key) for key in ("transpose", "tikhonov", "sparse")])
    session.active = active
    kept = session.pane
    session.close_pane(closed)
    assert session.pane is kept


@pytest.mark.parametrize("weight", [np.nan, np.inf, -3e38])
def test_no_weight_that_nothing_can_be_drawn_with_gets_in(weight: float) -> None:
    session = Session(RIG, [choose("transpose")])
    before = session.work
    weights = np.array([0.1, weight, 0.0, 0.0])
    session.apply(Edit("Set", False, weights=weights))
    session.apply(Edit("Set", True, weights=weights))
    assert session.work is before
    assert not session.in_gesture
    assert RIG.shape_names[1] in session.message


@pytest.mark.parametrize("step", ["set_reference", "add_pane", "reset", "arrange", "compare", "set_control"])
def test_what_is_begun_while_a_slider_is_on_its_way_leaves_it_there(step: str) -> None:
    session = Session(RIG, [choose("transpose")])
    slid = np.array([0.5, 0, 0, 0])
    session.apply(Edit("Slide", False, weights=slid))
    match step:
        case "set_reference":
            session.set_reference(slid)
        case "add_pane":
            session.add_pane(choose("hybrid"))
        case "reset":
            session.reset()
        case "arrange":
            session.arrange("Remove", {"smile": None})
        case "compare":
            session.compare("Compare", slid, slid)
        case _:
            session.set_control("Control", session.control)
    assert session.steps[1].label == "Slide"
    assert session.steps[1].value.panes[0].pose.weights.tolist() == slid.tolist()


def test_undo_says_what_it_takes_back_in_a_gesture_too() -> None:
    session = Session(RIG, [choose("transpose")])
    session.apply(Edit("Set", True, weights=np.array([0.5, 0, 0, 0])))
    session.apply(Edit("Slide", False, weights=np.array([0.6, 0, 0, 0])))
    assert session.undo_label == "Slide"
    assert session.undo()
    assert session.undo_label == "Set"
    session.apply(Edit("Too far", False, weights=np.array([1e9, 0, 0, 0])))
    assert not session.in_gesture, "what was refused is no gesture"
    session.keep_pane(0)
    assert session.undo_label == "Set", "there is one pane already"
