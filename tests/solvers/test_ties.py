"""Weights that are the limits of others: solved exactly, clipped, shown."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import minimize

from facepin.core.control import ShapeControl
from facepin.core.pose import Pin
from facepin.core.rig_builder import build_rig
from facepin.session.solving.solving import PinSolver, choose
from facepin.solvers import SOLVERS
from facepin.solvers.bounded import BoundedSettings
from facepin.solvers.interface import PinSystem
from facepin.solvers.sparse import LEAST, RIDGE, SparseSettings
from support.small_rigs import sheet

TIE = ((0, 1),)


def system(seed: int, ties: tuple[tuple[int, int], ...] = TIE) -> tuple[PinSystem, np.ndarray]:
    """A problem whose answer within the limits alone has the tied weights where they should not be."""
    random = np.random.default_rng(seed)
    rows = random.normal(size=(9, 7))
    limits = np.tile([0.0, 1.0], (7, 1))
    limits[3] = -0.5, 0.5
    wanted = random.uniform(0, 1, 7)
    for tied, other in ties:
        wanted[[tied, other]] = 0.9, 0.2
    return PinSystem(rows, limits, 0.7, ties=ties), rows @ wanted


def minimum(problem: PinSystem, objective, start: np.ndarray) -> np.ndarray:
    """The minimum by a general method that knows nothing of ours."""
    slack = [max(0.0, start[a] - start[b]) for a, b in problem.ties]
    bounds = np.stack(
        [np.minimum(problem.limits[:, 0], start), np.maximum(problem.limits[:, 1], start)], axis=1
    )
    ties = [
        {"type": "ineq", "fun": lambda w, a=a, b=b, s=s: w[b] - w[a] + s}
        for (a, b), s in zip(problem.ties, slack, strict=True)
    ]
    found = minimize(
        objective,
        start,
        method="SLSQP",
        bounds=bounds,
        constraints=ties,
        options={"ftol": 1e-15, "maxiter": 999},
    )
    assert found.status in (0, 8), found.message  # 8: it can't get any lower, up to its differences
    return found.x


STARTS = {
    "neutral": np.zeros(7),
    "within": np.array([0.1, 0.4, 0.3, 0.1, 0.0, 0.2, 0.0]),
    "beyond the tie": np.array([0.5, 0.3, 0.0, 0.0, 0.2, 0.0, 0.1]),
}


@pytest.mark.parametrize("start", STARTS.values(), ids=STARTS.keys())
@pytest.mark.parametrize("seed", range(4))
def test_bounded_finds_the_minimum_under_the_tie(seed: int, start: np.ndarray) -> None:
    problem, displacement = system(seed)
    settings = BoundedSettings(alpha=0.05)

    def objective(w: np.ndarray) -> float:
        return 0.5 * np.sum((problem.rows @ w - displacement) ** 2) + 0.5 * 0.05 * 0.7 * np.sum(
            (w - start) ** 2
        )

    found = SOLVERS["bounded"].prepare(problem, settings)(displacement, start).weights
    np.testing.assert_allclose(found, minimum(problem, objective, start), atol=2e-6)
    assert found[0] <= found[1] + max(0.0, start[0] - start[1]) + 1e-12
    free = SOLVERS["bounded"].prepare(replace(problem, ties=()), settings)(displacement, start).weights
    assert free[0] > free[1] + 0.05, "the tie is in the way"


@pytest.mark.parametrize("start", STARTS.values(), ids=STARTS.keys())
@pytest.mark.parametrize("seed", range(4))
def test_sparse_finds_the_minimum_under_the_tie(seed: int, start: np.ndarray) -> None:
    problem, displacement = system(seed)
    unit = 0.7**0.5
    price = 0.1 * unit * max(unit, LEAST * unit)

    def objective(w: np.ndarray) -> float:
        away = np.where(start > 0, np.maximum(w - start, 0), np.abs(w))
        return (
            0.5 * np.sum((problem.rows @ w - displacement) ** 2)
            + 0.5 * RIDGE * 0.7 * np.sum((w - start) ** 2)
            + price * away.sum()
        )

    found = SOLVERS["sparse"].prepare(problem, SparseSettings(price=0.1))(displacement, start).weights
    other = minimum(problem, objective, start)
    # A general method stops short of kinks, so ours may only be better.
    assert objective(found) <= objective(other) + 1e-9
    assert found[0] <= found[1] + max(0.0, start[0] - start[1]) + 1e-12
    np.testing.assert_allclose(found, other, atol=0.02)


@pytest.mark.parametrize("ties", [((0, 1), (2, 4)), ((0, 1), (1, 2)), ((0, 2), (1, 2))], ids=str)
def test_several_ties_hold_at_once(ties: tuple[tuple[int, int], ...]) -> None:
    problem, displacement = system(5, ties)
    start = np.zeros(7)

    def objective(w: np.ndarray) -> float:
        return 0.5 * np.sum((problem.rows @ w - displacement) ** 2) + 0.5 * 0.05 * 0.7 * np.sum(w**2)

    found = SOLVERS["bounded"].prepare(problem, BoundedSettings(alpha=0.05))(displacement, start).weights
    np.testing.assert_allclose(found, minimum(problem, objective, start), atol=2e-6)


@pytest.mark.parametrize("key", ["sparse", "bounded"])
def test_a_tie_that_is_not_in_the_way_changes_nothing(key: str) -> None:
    problem, displacement = system(1, ((1, 0),))
    displacement = problem.rows @ np.array([0.8, 0.3, 0.1, 0.0, 0.4, 0.0, 0.2])
    free = replace(problem, ties=())
    answers = [
        SOLVERS[key].prepare(each, SOLVERS[key].settings())(displacement, np.zeros(7)).weights
        for each in (problem, free)
    ]
    np.testing.assert_array_equal(*answers)


@pytest.mark.parametrize("key", ["sparse", "bounded"])
@pytest.mark.parametrize("unseen", [0, 1, [0, 1]], ids=str)
def test_a_tie_holds_with_shapes_that_move_no_pin(key: str, unseen: object) -> None:
    problem, displacement = system(2)
    rows = problem.rows.copy()
    rows[:, unseen] = 0
    found = SOLVERS[key].prepare(replace(problem, rows=rows), SOLVERS[key].settings())(
        displacement, np.zeros(7)
    )
    assert np.isfinite(found.weights).all()
    assert found.weights[0] <= found.weights[1] + 1e-12


def arkit():
    rig = sheet(shapes=5)
    deltas = [rig.deltas[:, [j]].toarray().reshape(-1, 3) for j in range(5)]
    names = ["cheekPuff", "MouthClose", "x.jawOpen", "mouthLeft", "mouthRight"]
    return build_rig("face", rig.neutral, rig.corners, rig.face_sizes, zip(names, deltas, strict=True))


RIG = arkit()
TIED = ShapeControl.of(RIG)


def flags(*shapes: int) -> np.ndarray:
    return np.isin(np.arange(5), shapes)


def test_the_tie_of_mouth_close_is_found_by_name_in_any_spelling() -> None:
    assert RIG.ties == ((1, 2),)
    assert sheet().ties == ()


def test_the_limit_of_a_tied_shape_is_the_weight_of_the_other() -> None:
    limits = TIED.limits_at(np.array([0, 0.2, 0.6, 0, 0]))
    np.testing.assert_array_equal(limits[:, 1], [1, 0.6, 1, 1, 1])
    np.testing.assert_array_equal(TIED.limits_at(np.array([0, 0, 3.0, 0, 0])), RIG.limits)
    np.testing.assert_array_equal(TIED.limits_at(np.array([0, 0, -3.0, 0, 0]))[1], [0, 0])
    untied = replace(TIED, ties=())
    assert untied.limits_at(np.zeros(5)) is untied.limits


def test_clipping_obeys_the_tie_and_leaves_what_began_beyond() -> None:
    zero = np.zeros(5)
    np.testing.assert_array_equal(TIED.clipped(np.array([2, 0.9, 0.4, 0, 0]), zero), [1, 0.4, 0.4, 0, 0])
    np.testing.assert_array_equal(TIED.clipped(np.array([0, 0.9, -1, 0, 0]), zero), [0, 0, 0, 0, 0])
    beyond = np.array([0, 0.8, 0.2, 0, 0])
    np.testing.assert_array_equal(TIED.clipped(beyond, beyond), beyond)


PINS = (Pin(30, (0.4, 0.3, 0.4)), Pin(50, (-0.3, 0.1, 0.2)), Pin(40, (0.2, 0.2, 0.3)))


@pytest.mark.parametrize("key", ["pseudo_inverse", "transpose", "sparse", "bounded"])
@pytest.mark.parametrize("locks", [flags(), flags(1), flags(2), flags(1, 2), flags(0)], ids=str)
def test_every_answer_within_limits_obeys_the_tie_beside_locks(key: str, locks: np.ndarray) -> None:
    solver = PinSolver(RIG, choose(key, keep_limits=True), replace(TIED, locked=locks))
    random = np.random.default_rng(3)
    for start in (np.zeros(5), np.array([0, 0.3, 0.5, 0.1, 0.0])):
        for _ in range(20):
            pins = tuple(replace(pin, goal=tuple(random.normal(size=3).tolist())) for pin in PINS)
            weights = solver.solve(pins, start).weights
            assert weights[1] <= weights[2] + 1e-12
            np.testing.assert_array_equal(weights[locks], start[locks])
            assert ((weights >= -1e-12) & (weights <= 1 + 1e-12)).all()


@pytest.mark.parametrize("key", ["transpose", "sparse", "bounded", "hand"])
@pytest.mark.parametrize("heights", [1.0, 21.0, 1e3, 1e5])
def test_the_tie_holds_however_far_the_goals(key: str, heights: float) -> None:
    solver = PinSolver(RIG, choose(key, keep_limits=True), TIED)
    closed = RIG.evaluate(np.array([0, 1.0, 0, 0, 0])) - RIG.neutral
    share = heights * RIG.height / np.abs(closed).max()
    for sign in (1, -1):
        goals = RIG.neutral + sign * share * closed
        pins = tuple(replace(pin, goal=tuple(goals[pin.vertex].astype(float).tolist())) for pin in PINS)
        for start in (np.zeros(5), np.array([0.2, 0.3, 0.5, 0.1, 0.0])):
            weights = solver.solve(pins, start).weights
            assert weights[1] <= weights[2] + 1e-6
            assert ((weights >= -1e-9) & (weights <= 1 + 1e-9)).all()


@pytest.mark.parametrize("key", ["transpose", "sparse", "bounded", "hand"])
def test_what_is_tied_to_a_muted_shape_stays_shut(key: str) -> None:
    """The jaw is open in numbers only, so the lips have nowhere to go."""
    control = replace(TIED, muted=flags(2))
    start = np.array([0, 0, 0.8, 0, 0])
    assert control.limits_at(start)[1].tolist() == [0, 0]
    closed = RIG.evaluate(np.array([0, 0.8, 0, 0, 0])).astype(float)
    pins = tuple(replace(pin, goal=tuple(closed[pin.vertex].tolist())) for pin in PINS)
    weights = PinSolver(RIG, choose(key, keep_limits=True), control).solve(pins, start).weights
    assert weights[1] <= 1e-6
    assert weights[2] == 0.8


def test_a_muted_shape_holds_no_other_open() -> None:
    control = replace(TIED, muted=flags(1))
    weights = np.array([0, 0.6, 0.7, 0, 0])
    np.testing.assert_array_equal(control.limits_beside_locks(weights), RIG.limits)
    np.testing.assert_array_equal(control.limits_at(weights), RIG.limits)


@pytest.mark.parametrize("key", ["pseudo_inverse", "sparse", "bounded"])
def test_the_formulas_know_of_no_tie_unless_limits_are_asked_for(key: str) -> None:
    closed = RIG.evaluate(np.array([0, 0.8, 0, 0, 0])).astype(float)
    pins = tuple(replace(pin, goal=tuple(closed[pin.vertex].tolist())) for pin in PINS)
    bare, kept = (PinSolver(RIG, choose(key, keep_limits=keep)).solve(pins, np.zeros(5)) for keep in (0, 1))
    assert bare.weights[1] > bare.weights[2] + 0.1
    assert kept.weights[1] <= kept.weights[2] + 1e-12


def test_a_drag_over_the_tie_and_back_leaves_no_trace() -> None:
    solver = PinSolver(RIG, choose("bounded"), TIED)
    closed = RIG.evaluate(np.array([0, 0.8, 0, 0, 0])).astype(float)

    def at(share: float) -> np.ndarray:
        goals = RIG.neutral + share * (closed - RIG.neutral)
        pins = tuple(replace(pin, goal=tuple(goals[pin.vertex].tolist())) for pin in PINS)
        return solver.solve(pins, np.zeros(5)).weights

    there = [at(share) for share in np.linspace(-1, 1, 21)]
    back = [at(share) for share in np.linspace(1, -1, 21)]
    np.testing.assert_allclose(there, back[::-1], atol=1e-8)
