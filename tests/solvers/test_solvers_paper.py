"""The four solvers of the paper, against its formulas written out and against its own statements."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facepin.solvers import SOLVERS
from facepin.solvers.interface import Floats, PinSystem
from support.solver_systems import Problem, face_problem, random_problem


def solve(key: str, problem: Problem, **settings: object) -> Floats:
    kind = SOLVERS[key]
    return kind.prepare(problem.system, kind.settings(**settings))(
        problem.displacement, problem.start
    ).weights


def from_rest(problem: Problem) -> Problem:
    return problem._replace(start=np.zeros_like(problem.start))


problems = pytest.mark.parametrize(
    "problem",
    [random_problem(1), random_problem(2, rows=45, shapes=10), random_problem(3, rows=3, shapes=50)],
)


@problems
def test_pseudo_inverse_is_equation_3(problem: Problem) -> None:
    rows, displacement, start = problem.system.rows, problem.displacement, problem.start
    inverse = np.linalg.pinv(rows)
    np.testing.assert_allclose(solve("pseudo_inverse", from_rest(problem)), inverse @ displacement, rtol=1e-9)
    expected = start + inverse @ (displacement - rows @ start)
    np.testing.assert_allclose(solve("pseudo_inverse", problem), expected, rtol=1e-9, atol=1e-12)


@problems
@pytest.mark.parametrize("alpha", [1e-4, 0.001, 0.5])
def test_tikhonov_is_equation_4(problem: Problem, alpha: float) -> None:
    rows, displacement = problem.system.rows, problem.displacement
    square = rows.T @ rows + alpha * np.eye(rows.shape[1])
    for case in (problem, from_rest(problem)):
        expected = np.linalg.solve(square, rows.T @ displacement + alpha * case.start)
        np.testing.assert_allclose(solve("tikhonov", case, alpha=alpha), expected, rtol=1e-7, atol=1e-9)


def test_tikhonov_relative_means_the_same_in_any_unit() -> None:
    problem = random_problem(4)
    system = problem.system
    other = problem._replace(
        system=PinSystem(system.rows * 100, system.limits, system.scale * 1e4),
        displacement=problem.displacement * 100,
    )
    centimetres = solve("tikhonov", problem, alpha=0.1, relative=True)
    np.testing.assert_allclose(solve("tikhonov", other, alpha=0.1, relative=True), centimetres, rtol=1e-9)
    assert not np.allclose(solve("tikhonov", other, alpha=0.1), solve("tikhonov", problem, alpha=0.1))


@problems
def test_tikhonov_tends_to_equation_3(problem: Problem) -> None:
    inverse = solve("pseudo_inverse", problem)
    np.testing.assert_allclose(solve("tikhonov", problem, alpha=1e-12), inverse, rtol=1e-6, atol=1e-9)
    np.testing.assert_array_equal(solve("tikhonov", problem, alpha=0.0), inverse)


@problems
def test_transpose_with_unit_step_is_equation_6(problem: Problem) -> None:
    rows, displacement, start = problem.system.rows, problem.displacement, problem.start
    at_rest = solve("transpose", from_rest(problem), step="unit")
    # Equation 7 to the letter: each weight is the inner product of its shape's rows with the displacement.
    for j, weight in enumerate(at_rest):
        assert weight == pytest.approx(sum(b * m for b, m in zip(rows[:, j], displacement, strict=True)))
    expected = start + rows.T @ (displacement - rows @ start)
    np.testing.assert_allclose(solve("transpose", problem, step="unit"), expected, rtol=1e-9)


@problems
def test_transpose_steps(problem: Problem) -> None:
    rows, start = problem.system.rows, problem.start
    missing = problem.displacement - rows @ start
    direction = rows.T @ missing
    exact = solve("transpose", problem)
    tau = (direction @ direction) / np.sum((rows @ direction) ** 2)
    np.testing.assert_allclose(exact, start + tau * direction, rtol=1e-9)
    errors = [np.linalg.norm(missing - t * (rows @ direction)) for t in (0.99 * tau, tau, 1.01 * tau)]
    assert errors[1] == min(errors)
    spectral = solve("transpose", problem, step="spectral")
    np.testing.assert_allclose(spectral, start + direction / np.linalg.svd(rows)[1][0] ** 2, rtol=1e-9)


@pytest.mark.parametrize("step", ["exact", "spectral"])
def test_many_transposed_steps_tend_to_the_pseudo_inverse(step: str) -> None:
    """Section 3.2: iterated to convergence, Eq. 6 gives the answer of Eq. 3."""
    problem = random_problem(8, rows=6, shapes=40)
    inverse = solve("pseudo_inverse", problem)
    gaps = [
        np.linalg.norm(solve("transpose", problem, step=step, iterations=n) - inverse) for n in (1, 10, 200)
    ]
    assert gaps[0] > gaps[1] > gaps[2]
    assert gaps[2] < 1e-6


def test_exact_step_does_not_chase_rounding() -> None:
    """At the optimum the direction is rounding only; the step along it must not blow that up."""
    problem = random_problem(9, rows=30, shapes=8)
    best = problem._replace(start=np.linalg.lstsq(problem.system.rows, problem.displacement)[0])
    weights = solve("transpose", best, iterations=200)
    np.testing.assert_allclose(weights, best.start, atol=1e-12)


@problems
@pytest.mark.parametrize("step", ["exact", "spectral", "unit"])
def test_hybrid_is_equation_8(problem: Problem, step: str) -> None:
    rows, start = problem.system.rows, problem.start
    missing = problem.displacement - rows @ start
    moved = solve("transpose", problem, step=step) - start
    expected = start + 0.3 * np.linalg.pinv(rows) @ missing + 0.7 * moved
    mixed = solve("hybrid", problem, automatic=False, gamma=0.3, step=step)
    np.testing.assert_allclose(mixed, expected, rtol=1e-8, atol=1e-9)
    for gamma, key, settings in ((1.0, "pseudo_inverse", {}), (0.0, "transpose", {"step": step})):
        end = solve("hybrid", problem, automatic=False, gamma=gamma, step=step)
        np.testing.assert_allclose(end, solve(key, problem, **settings), rtol=1e-9, atol=1e-12)


def test_automatic_gamma_is_the_smallest_singular_value() -> None:
    kind = SOLVERS["hybrid"]

    def gamma(rows: Floats) -> float:
        shapes = rows.shape[1]
        system = PinSystem(rows, np.tile([0.0, 1.0], (shapes, 1)), 1.0)
        return kind.prepare(system, kind.settings())(np.zeros(len(rows)), np.zeros(shapes)).notes["gamma"]

    rows = random_problem(10, rows=12, shapes=20).system.rows
    smallest = [float(np.linalg.svd(rows[:n].T, compute_uv=False)[-1]) for n in (3, 6, 12)]
    assert smallest[0] > smallest[1] > smallest[2]
    for n, value in zip((3, 6, 12), smallest, strict=True):
        assert gamma(0.1 * rows[:n]) == pytest.approx(0.1 * value)
    assert gamma(1000 * rows) == 1.0
    assert gamma(0 * rows) == 0.0


def test_transposition_is_the_pseudo_inverse_of_an_orthonormal_basis() -> None:
    """The appendix, Eq. 10 to 12.

    Q (k, r) has orthonormal columns, so QᵀQ is the identity; where r = k, as the appendix has it, so is QQᵀ.
    """
    for rows_count, shapes in ((6, 6), (6, 15)):
        problem = random_problem(11, rows=rows_count, shapes=shapes)
        rows, displacement = problem.system.rows, problem.displacement
        q, r = np.linalg.qr(rows.T)
        np.testing.assert_allclose(q.T @ q, np.eye(rows_count), atol=1e-12)
        if rows_count == shapes:
            np.testing.assert_allclose(q @ q.T, np.eye(shapes), atol=1e-12)
            eq10 = np.linalg.inv(q @ q.T) @ q @ (r @ displacement)
            np.testing.assert_allclose(eq10, rows.T @ displacement, atol=1e-10)
        # Eq. 11: R = QᵀBᵀ minimises ‖Bᵀ - Q R‖ (to zero), so that Eq. 10 turns into Eq. 12, w = Bᵀm.
        np.testing.assert_allclose(r, q.T @ rows.T, atol=1e-12)
        best = np.linalg.lstsq(q, rows.T)[0]
        np.testing.assert_allclose(best, r, atol=1e-10)
        letter = solve("transpose", from_rest(problem), step="unit")
        np.testing.assert_allclose(q @ (r @ displacement), letter, atol=1e-10)
        # "When the basis is orthogonal, the pseudo-inverse can be reduced to the transposition approach."
        basis = PinSystem(q.T.copy(), problem.system.limits, 1.0)
        orthonormal = from_rest(problem)._replace(system=basis, displacement=r @ displacement)
        inverse = solve("pseudo_inverse", orthonormal)
        np.testing.assert_allclose(inverse, solve("transpose", orthonormal, step="unit"), atol=1e-12)


@pytest.mark.parametrize("shapes", [53, 153])
@pytest.mark.parametrize("pins", [1, 5, 15])
def test_formulas_hold_on_a_real_face(shared: Path, shapes: int, pins: int) -> None:
    problem = face_problem(shared, shapes, pins, seed=pins)
    rows, displacement = problem.system.rows, problem.displacement
    direction = rows.T @ displacement
    tau = (direction @ direction) / np.sum((rows @ direction) ** 2)
    inverse = np.linalg.pinv(rows)
    gamma = min(np.linalg.svd(rows.T, compute_uv=False)[-1], 1.0)
    eq3 = inverse @ displacement
    eq4 = np.linalg.solve(rows.T @ rows + 0.001 * np.eye(shapes), direction)
    eq8 = gamma * eq3 + (1 - gamma) * tau * direction
    expected = {"pseudo_inverse": eq3, "tikhonov": eq4, "transpose": tau * direction, "hybrid": eq8}
    for key, weights in expected.items():
        found = solve(key, problem)
        # γ J⁺ is the smallest singular value times its own inverse: all the rounding of both is in it.
        tolerance = 1e-6 if key == "hybrid" else 1e-9
        assert np.linalg.norm(found - weights) <= tolerance * np.linalg.norm(weights), key


def test_a_radius_rescales_the_shapes_by_their_locality() -> None:
    """w0 + S^½ y with y by transposition on J S^½, written out; without a radius nothing changes."""
    problem = random_problem(9)
    shares = np.random.default_rng(9).uniform(0, 1, len(problem.start))
    shares[2] = 0.0
    system = replace(problem.system, locality=shares)
    near = problem._replace(system=system)
    missing = problem.displacement - system.rows @ problem.start
    scaled = system.rows * np.sqrt(shares)
    y = scaled.T @ missing
    y *= (y @ y) / np.sum((scaled @ y) ** 2)
    weights = solve("transpose", near, radius=10.0)
    np.testing.assert_allclose(weights, problem.start + np.sqrt(shares) * y, rtol=1e-12)
    assert weights[2] == problem.start[2]
    np.testing.assert_array_equal(solve("transpose", near), solve("transpose", problem))


def test_many_localised_steps_reach_what_the_pins_can_reach() -> None:
    problem = random_problem(10)
    shares = np.random.default_rng(9).uniform(0.3, 1, len(problem.start))
    near = problem._replace(system=replace(problem.system, locality=shares))
    weights = solve("transpose", near, radius=10.0, iterations=200)
    np.testing.assert_allclose(problem.system.rows @ weights, problem.displacement, atol=0.02)
