"""What every solver promises, checked over the registry."""

import subprocess
import sys

import numpy as np
import pytest

from facepin.solvers import SOLVERS
from facepin.solvers.interface import SolverKind
from support.solver_systems import Problem, awkward_problems, random_problem

AWKWARD = awkward_problems()

every_solver = pytest.mark.parametrize("kind", SOLVERS.values(), ids=SOLVERS)
never_worse = pytest.mark.parametrize("key", ["pseudo_inverse", "tikhonov", "transpose", "sparse", "bounded"])


def variants(kind: SolverKind) -> list[object]:
    """The default settings, each end of each range, and each choice."""
    about = {
        field.name: (field.default, field.metadata) for field in kind.settings.__dataclass_fields__.values()
    }
    made = [kind.settings()]
    for name, (default, metadata) in about.items():
        values = list(metadata["choices"]) or [metadata["low"], metadata["high"]]
        if isinstance(default, bool):
            values = [not default]
        made += [kind.settings(**{name: value}) for value in values]
    return made


def test_registry_is_keyed_and_described() -> None:
    assert list(SOLVERS) == ["pseudo_inverse", "tikhonov", "transpose", "hybrid", "sparse", "bounded", "hand"]
    for key, kind in SOLVERS.items():
        assert kind.key == key
        assert kind.title and kind.summary.endswith(".")
        for field in kind.settings.__dataclass_fields__.values():
            about = field.metadata
            assert about["help"].endswith(".")
            if about["low"] is not None:
                assert about["low"] <= field.default <= about["high"]
            if about["when"] is not None:
                assert about["when"][0] in kind.settings.__dataclass_fields__


@every_solver
@pytest.mark.parametrize("problem", AWKWARD.values(), ids=AWKWARD)
def test_weights_are_finite_whatever_the_input(kind: SolverKind, problem: Problem) -> None:
    for settings in variants(kind):
        if getattr(settings, "step", "") == "unit" and problem is AWKWARD["astronomical"]:
            continue  # the paper's letter: one step of τ = 1 per unit squared
        solve = kind.prepare(problem.system, settings)
        for displacement in (problem.displacement, -problem.displacement, 0 * problem.displacement):
            weights = solve(displacement, problem.start).weights
            assert weights.shape == problem.start.shape
            assert weights.dtype == np.float64
            assert np.isfinite(weights).all()


@every_solver
def test_without_pins_the_start_stays(kind: SolverKind) -> None:
    problem = AWKWARD["no pins"]
    for settings in variants(kind):
        solution = kind.prepare(problem.system, settings)(problem.displacement, problem.start)
        np.testing.assert_array_equal(solution.weights, problem.start)


@every_solver
@pytest.mark.parametrize("seed", range(3))
def test_no_displacement_from_rest_gives_rest(kind: SolverKind, seed: int) -> None:
    system = random_problem(seed).system
    nothing, rest = np.zeros(system.rows.shape[0]), np.zeros(system.rows.shape[1])
    for settings in variants(kind):
        np.testing.assert_array_equal(kind.prepare(system, settings)(nothing, rest).weights, rest)


@every_solver
@pytest.mark.parametrize("seed", range(3))
def test_goals_at_their_vertices_leave_the_start(kind: SolverKind, seed: int) -> None:
    """Nothing jumps at the press."""
    system, _, start = random_problem(seed)
    for settings in variants(kind):
        weights = kind.prepare(system, settings)(system.rows @ start, start).weights
        np.testing.assert_allclose(weights, start, atol=1e-9)


@every_solver
def test_the_same_question_gets_the_same_answer(kind: SolverKind) -> None:
    """Whatever was asked in between, and without touching its input."""
    system, displacement, start = random_problem(12)
    copies = system.rows.copy(), displacement.copy(), start.copy()
    for array in (system.rows, system.limits, displacement, start):
        array.flags.writeable = False
    for settings in variants(kind):
        solve = kind.prepare(system, settings)
        first = solve(displacement, start).weights
        for factor in (3.0, -1.0, 0.5, 100.0):
            solve(factor * displacement, 0 * start)
        np.testing.assert_allclose(solve(displacement, start).weights, first, atol=1e-8)
        np.testing.assert_array_equal(kind.prepare(system, settings)(displacement, start).weights, first)
    for before, after in zip(copies, (system.rows, displacement, start), strict=True):
        np.testing.assert_array_equal(before, after)


@never_worse
@pytest.mark.parametrize("seed", range(5))
def test_pins_are_not_further_than_at_the_start(key: str, seed: int) -> None:
    kind = SOLVERS[key]
    for problem in (random_problem(seed), random_problem(seed, rows=30, shapes=6)):
        solve = kind.prepare(problem.system, kind.settings())
        weights = solve(problem.displacement, problem.start).weights
        before = np.linalg.norm(problem.system.rows @ problem.start - problem.displacement)
        assert np.linalg.norm(problem.system.rows @ weights - problem.displacement) <= before


@every_solver
def test_limits_are_kept_by_those_that_claim_it(kind: SolverKind) -> None:
    outside = 0
    for seed in range(5):
        problem = random_problem(seed, lowest=-0.25)
        for settings in variants(kind):
            solve = kind.prepare(problem.system, settings)
            weights = solve(3 * problem.displacement, problem.start).weights
            low, high = problem.system.limits.T
            outside += np.count_nonzero((weights < low) | (weights > high))
    assert (outside == 0) == kind.obeys_limits


@pytest.mark.parametrize("key", ["pseudo_inverse", "transpose", "sparse", "bounded"])
def test_units_do_not_matter_where_strengths_are_relative(key: str) -> None:
    kind = SOLVERS[key]
    one, other = random_problem(7), AWKWARD["micrometres"]
    weights = [kind.prepare(p.system, kind.settings())(p.displacement, p.start).weights for p in (one, other)]
    np.testing.assert_allclose(*weights, rtol=1e-7, atol=1e-9)


def test_solvers_load_nothing_but_numpy() -> None:
    check = "import sys, facepin.solvers; print(*(m for m in ('scipy', 'facepin.core') if m in sys.modules))"
    ran = subprocess.run([sys.executable, "-c", check], capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == ""


def test_a_system_may_have_a_start_outside_its_limits() -> None:
    """A weight loaded outside its limits is not clipped behind the user's back, and can still come back."""
    system, _, start = random_problem(3)
    start = start.copy()
    start[4] = 1.5
    for key in ("sparse", "bounded"):
        kind = SOLVERS[key]
        solve = kind.prepare(system, kind.settings())
        assert solve(system.rows @ start, start).weights[4] == pytest.approx(1.5, abs=1e-6)
        lower = solve(system.rows @ start - system.rows[:, 4], start).weights[4]
        assert lower < 1.2
