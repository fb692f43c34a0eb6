"""The two solvers within limits: optimality against independent solvers, and steadiness along a drag."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import lsq_linear, minimize

from facepin.solvers import SOLVERS
from facepin.solvers.boxed import TOLERANCE
from facepin.solvers.interface import Floats, PinSystem
from facepin.solvers.sparse import RIDGE
from support.solver_systems import Problem, face_problem, random_problem

REAL = [(53, 15, False), (53, 15, True), (153, 15, False), (153, 5, True), (153, 1, False)]
real_faces = pytest.mark.parametrize(("shapes", "pins", "screen"), REAL)


def solve(key: str, problem: Problem, **settings: object) -> Floats:
    kind = SOLVERS[key]
    solution = kind.prepare(problem.system, kind.settings(**settings))(problem.displacement, problem.start)
    assert solution.notes["optimality"] <= TOLERANCE
    return solution.weights


def bounded_by_scipy(problem: Problem, alpha: float) -> Floats:
    """½‖Jw - d‖² + ½α‖w - w0‖² as one stacked least-squares problem, by scipy's active-set method."""
    system = problem.system
    ridge = np.sqrt(alpha * system.scale)
    shapes = system.rows.shape[1]
    rows = np.concatenate([system.rows, ridge * np.eye(shapes)])
    wanted = np.concatenate([problem.displacement, ridge * problem.start])
    return lsq_linear(rows, wanted, system.limits.T, method="bvls", tol=1e-14, max_iter=2000).x


def sparse_prices(system: PinSystem, price: float) -> Floats:
    sizes = np.sqrt(system.scale) if system.sizes is None else system.sizes
    least = np.sqrt(system.scale) / 3
    return price * np.sqrt(system.scale) * np.maximum(sizes, least) * np.ones(system.rows.shape[1])


def sparse_objective(problem: Problem, weights: Floats, price: float) -> float:
    system, start = problem.system, problem.start
    missing = system.rows @ weights - problem.displacement
    paid = np.where(start > 0, np.maximum(weights - start, 0.0), np.abs(weights - start))
    ridge = RIDGE * system.scale
    return float(
        0.5 * missing @ missing
        + sparse_prices(system, price) @ paid
        + 0.5 * ridge * np.sum((weights - start) ** 2)
    )


def sparse_by_scipy(problem: Problem, price: float) -> Floats:
    """Smooth because every weight is split at its kink: w = w0 + p - q with p, q ≥ 0, by L-BFGS-B."""
    system, start = problem.system, problem.start
    low, high = system.limits.T
    up = sparse_prices(system, price)
    down = np.where(start <= 0, up, 0.0)
    ridge = RIDGE * system.scale

    def value(split: Floats) -> tuple[float, Floats]:
        p, q = np.split(split, 2)
        weights = start + p - q
        missing = system.rows @ weights - problem.displacement
        gradient = system.rows.T @ missing + ridge * (weights - start)
        size = 0.5 * missing @ missing + up @ p + down @ q + 0.5 * ridge * np.sum((weights - start) ** 2)
        return size, np.concatenate([gradient + up, down - gradient])

    bounds = np.stack([np.zeros(2 * len(start)), np.concatenate([high - start, start - low])], axis=1)
    options = {"maxiter": 20000, "maxfun": 40000, "ftol": 1e-16, "gtol": 1e-11, "maxcor": 40}
    found = minimize(
        value, np.zeros(2 * len(start)), jac=True, method="L-BFGS-B", bounds=bounds, options=options
    )
    p, q = np.split(found.x, 2)
    return start + p - q


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("alpha", [1e-4, 0.01, 1.0])
def test_bounded_is_optimal(seed: int, alpha: float) -> None:
    for problem in (random_problem(seed), random_problem(seed, rows=30, shapes=12, lowest=-0.5)):
        expected = bounded_by_scipy(problem, alpha)
        np.testing.assert_allclose(solve("bounded", problem, alpha=alpha), expected, atol=1e-7)


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("sized", [False, True])
def test_sparse_is_optimal(seed: int, sized: bool) -> None:
    for problem in (random_problem(seed), random_problem(seed, rows=30, shapes=12)):
        if sized:
            sizes = np.random.default_rng(seed).uniform(0.1, 3.0, problem.system.rows.shape[1])
            problem = problem._replace(system=replace(problem.system, sizes=sizes))
        for price in (0.01, 0.1, 0.5):
            weights = solve("sparse", problem, price=price)
            expected = sparse_by_scipy(problem, price)
            ours, theirs = (sparse_objective(problem, w, price) for w in (weights, expected))
            assert ours <= theirs * (1 + 1e-12)
            np.testing.assert_allclose(weights, expected, atol=2e-4)


@pytest.mark.parametrize("seed", range(1, 5))
def test_sparse_prices_both_signs_where_limits_allow_them(seed: int) -> None:
    problem = random_problem(seed, lowest=-1.0)
    rest = problem._replace(start=np.zeros_like(problem.start))
    weights = solve("sparse", rest, price=0.2)
    np.testing.assert_allclose(weights, sparse_by_scipy(rest, 0.2), atol=2e-4)
    assert weights.min() < 0 < weights.max()
    assert np.count_nonzero(weights) < len(weights)


@real_faces
def test_optimal_on_a_real_face(shared: Path, shapes: int, pins: int, screen: bool) -> None:
    problem = face_problem(shared, shapes, pins, seed=pins, screen=screen)
    expected = bounded_by_scipy(problem, 0.01)
    np.testing.assert_allclose(solve("bounded", problem, alpha=0.01), expected, atol=1e-7)
    weights = solve("sparse", problem, price=0.03)
    ours = sparse_objective(problem, weights, 0.03)
    theirs = sparse_objective(problem, sparse_by_scipy(problem, 0.03), 0.03)
    assert ours <= theirs * (1 + 1e-9)
    assert np.count_nonzero(weights > 0.05) <= 20


def test_an_exorbitant_price_stops_everything_and_no_price_nothing() -> None:
    problem = random_problem(2)._replace(start=np.zeros(14))
    assert not solve("sparse", problem, price=10.0).any()
    free = solve("sparse", problem, price=0.0)
    np.testing.assert_allclose(free, bounded_by_scipy(problem, RIDGE), atol=1e-6)


def test_equal_shapes_share_the_work() -> None:
    """Among equally good answers the ridge picks the one that treats equal shapes alike."""
    problem = random_problem(4)._replace(start=np.zeros(14))
    rows = problem.system.rows
    rows[:, 1] = rows[:, 0] = rows.T @ problem.displacement @ rows.T / 20
    for key in ("sparse", "bounded"):
        weights = solve(key, problem)
        assert weights[0] > 0
        assert weights[0] == pytest.approx(weights[1], abs=1e-6)


@pytest.mark.parametrize("key", ["sparse", "bounded"])
def test_weights_no_pin_can_feel_are_kept(key: str) -> None:
    problem = random_problem(5)
    problem.system.rows[:, 3] = 0.0
    problem.start[3] = 0.7
    assert solve(key, problem)[3] == 0.7


def test_the_price_is_for_motion_not_for_travel_of_a_slider() -> None:
    """The same face with half of its shapes cut in two moves alike."""
    problem = random_problem(8, rows=30, shapes=8)._replace(start=np.zeros(8))
    system = problem.system
    sizes = np.linalg.norm(system.rows, axis=0)
    whole = solve("sparse", problem._replace(system=replace(system, sizes=sizes)))
    cut = np.array([1.0, 2.0] * 4)
    limits = system.limits * cut[:, None]
    small = PinSystem(system.rows / cut, limits, system.scale, sizes / cut)
    np.testing.assert_allclose(solve("sparse", problem._replace(system=small)) / cut, whole, atol=1e-4)


@pytest.mark.parametrize("key", ["sparse", "bounded"])
@pytest.mark.parametrize(("shapes", "pins", "screen"), REAL[:3])
def test_a_drag_is_steady_and_forgets_its_path(
    shared: Path, key: str, shapes: int, pins: int, screen: bool
) -> None:
    """Between frames the pins' vertices move no further than the goals, and weights within the bound that
    strong convexity gives, ‖Δd‖ / 2√α; a solver that saw the whole drag answers like one that saw nothing."""
    kind = SOLVERS[key]
    problem = face_problem(shared, shapes, pins, seed=3, screen=screen)
    system = problem.system
    ridge = {"sparse": RIDGE, "bounded": kind.settings().__dict__.get("alpha", 0.0)}[key] * system.scale
    rng = np.random.default_rng(4)
    solve_frame = kind.prepare(system, kind.settings())
    weights = solve_frame(np.zeros(len(system.rows)), problem.start).weights
    before = np.zeros(len(system.rows))
    for frame in range(1, 41):
        goals = problem.displacement * (frame / 40) + rng.normal(0, 0.03, len(before))
        solution = solve_frame(goals, problem.start)
        moved, pulled = solution.weights - weights, np.linalg.norm(goals - before)
        assert np.linalg.norm(system.rows @ moved) <= pulled * (1 + 1e-9)
        assert np.linalg.norm(moved) <= pulled / (2 * np.sqrt(ridge)) * (1 + 1e-9)
        assert solution.notes["optimality"] <= TOLERANCE
        afresh = kind.prepare(system, kind.settings())(goals, problem.start).weights
        np.testing.assert_allclose(solution.weights, afresh, atol=1e-7)
        weights, before = solution.weights, goals


@pytest.mark.parametrize("key", ["sparse", "bounded"])
def test_ends_where_careful_steps_are_needed(monkeypatch: pytest.MonkeyPatch, key: str) -> None:
    """With bold steps switched off the answer is the same."""
    for seed in range(6):
        problem = random_problem(seed, rows=12, shapes=40)
        bold = solve(key, problem)
        with monkeypatch.context() as patched:
            patched.setattr("facepin.solvers.boxed.BOLD_STEPS", 0)
            np.testing.assert_allclose(solve(key, problem), bold, atol=1e-8)
