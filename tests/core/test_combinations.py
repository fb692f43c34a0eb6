"""Combinations: what two shapes do together, from the formula to the solvers."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facepin.core.control import ShapeControl
from facepin.core.errors import FacepinError
from facepin.core.mesh.geodesic import shape_locality
from facepin.core.mesh.topology import weld_map
from facepin.core.pose import Pin, as_vector, pin_displacement, pin_rows
from facepin.core.rig import Rig
from facepin.core.rig_builder import build_rig
from facepin.core.shapes.deform import Deformer
from facepin.core.shapes.measures import pin_error
from facepin.files import open_rig
from facepin.session.edit import Edit
from facepin.session.session import Session
from facepin.session.solving.solving import PinSolver, choose
from facepin.solvers import SOLVERS
from facepin.solvers.hand import FREE, HandSettings
from support.small_rigs import sheet

PAIRS = [(0, 1), (3, 1), (2, 4)]
PLAIN = sheet(shapes=6)
ADA = Path(__file__).resolve().parents[2] / "assets/faces/ada.npz"


def deltas(rig: Rig, columns: range) -> list[np.ndarray]:
    return [rig.deltas[:, [j]].toarray().reshape(-1, 3) for j in columns]


def combined(pairs: list[tuple[int, int]] = PAIRS) -> Rig:
    """The sheet of six shapes, and what pairs of them do together."""
    products = deltas(sheet(shapes=len(pairs), seed=7), range(len(pairs)))
    return build_rig(
        "combined",
        PLAIN.neutral,
        PLAIN.corners,
        PLAIN.face_sizes,
        zip(PLAIN.shape_names, deltas(PLAIN, range(6)), strict=True),
        combinations=zip(pairs, products, strict=True),
    )


RIG = combined()
WEIGHTS = np.array([0.5, 0.8, 0.3, -0.4, 1.2, 0.1])


def by_formula(rig: Rig, weights: np.ndarray) -> np.ndarray:
    """f0 + B w + Σ wₐ w_b c_ab, term by term in double precision."""
    face = rig.neutral.astype(np.float64)
    for weight, delta in zip(weights, deltas(rig, range(6)), strict=True):
        face = face + weight * delta
    for (a, b), delta in zip(rig.combinations, deltas(rig, range(6, 6 + len(rig.combinations))), strict=True):
        face = face + weights[a] * weights[b] * delta
    return face


def test_evaluation_is_the_formula() -> None:
    np.testing.assert_allclose(RIG.evaluate(WEIGHTS), by_formula(RIG, WEIGHTS), atol=1e-6)
    assert RIG.combinations.tolist() == [[0, 1], [1, 3], [2, 4]]
    assert RIG.combination_names == ("shape0*shape1", "shape1*shape3", "shape2*shape4")
    assert RIG.shape_count == 6 == len(RIG.largest_moves)
    assert RIG.scale == pytest.approx(PLAIN.scale)


def test_a_rig_without_combinations_pays_nothing() -> None:
    assert PLAIN.amounts(WEIGHTS) is WEIGHTS
    rows = PLAIN.rows_at([3, 4])
    assert PLAIN.slopes(rows, WEIGHTS) is rows
    assert PLAIN.slope_deltas(WEIGHTS) is PLAIN.deltas


def test_a_deformer_follows_products_through_drags_and_jumps() -> None:
    deformer, random = Deformer(RIG), np.random.default_rng(2)
    directions = random.normal(size=(2, 6))
    drag = [WEIGHTS + x * directions[0] + y * directions[1] for x, y in random.normal(size=(30, 2))]
    for weights in [*drag, *random.uniform(-1, 2, (10, 6)), np.zeros(6)]:
        np.testing.assert_allclose(deformer.deform(weights), by_formula(RIG, weights), atol=3e-6)


def test_slopes_are_the_differences_of_the_face() -> None:
    vertices, step = [30, 41, 52], 1e-4
    rest = RIG.neutral[vertices].ravel().astype(np.float64)
    slopes = RIG.slopes(RIG.rows_at(vertices), WEIGHTS)
    whole = RIG.slope_deltas(WEIGHTS).toarray()
    for j in range(6):
        nudge = step * (np.arange(6) == j)
        change = (by_formula(RIG, WEIGHTS + nudge) - by_formula(RIG, WEIGHTS - nudge)) / (2 * step)
        np.testing.assert_allclose(slopes[:, j], change[vertices].ravel(), atol=1e-7)
        np.testing.assert_allclose(whole[:, j], change.ravel(), atol=1e-6)
    moves = RIG.rows_at(vertices) @ RIG.amounts(WEIGHTS)
    np.testing.assert_allclose(rest + moves, by_formula(RIG, WEIGHTS)[vertices].ravel(), atol=1e-6)


def test_locality_is_that_of_the_shapes_as_they_are_at_the_pose() -> None:
    vertices, radius = [30, 50], 0.8
    at_pose = build_rig(
        "at the pose",
        RIG.neutral,
        RIG.corners,
        RIG.face_sizes,
        ((f"{j}", column.reshape(-1, 3)) for j, column in enumerate(RIG.slope_deltas(WEIGHTS).toarray().T)),
    )
    np.testing.assert_allclose(
        shape_locality(RIG, vertices, radius, WEIGHTS),
        shape_locality(at_pose, vertices, radius, WEIGHTS),
        rtol=1e-5,
    )
    np.testing.assert_array_equal(
        shape_locality(RIG, vertices, radius, np.zeros(6)),
        shape_locality(PLAIN, vertices, radius, np.zeros(6)),
    )


def test_vertices_that_only_a_combination_parts_are_not_one() -> None:
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 0, 0]], np.float32)
    lift = np.zeros((4, 3))
    lift[3, 2] = 1
    shapes = [("a", square), ("b", 2 * square)]
    faces = [0, 1, 2, 3, 1, 2], [3, 3]
    assert weld_map(build_rig("one", square, *faces, shapes))[3] == 0
    assert weld_map(build_rig("two", square, *faces, shapes, combinations=[((0, 1), lift)]))[3] == 3


START = np.array([0.3, 0.6, 0.4, 0.5, 0.2, 0.1])


def pins_at(rig: Rig, wanted: np.ndarray, vertices: tuple[int, ...] = (30, 41, 52)) -> tuple[Pin, ...]:
    face = rig.evaluate(wanted).astype(np.float64)
    return tuple(Pin(vertex, as_vector(face[vertex])) for vertex in vertices)


@pytest.mark.parametrize("key", ["pseudo_inverse", "tikhonov", "transpose", "hybrid"])
def test_a_solver_of_the_paper_sees_the_linear_face_at_the_start(key: str) -> None:
    pins = pins_at(RIG, START + 0.5)
    solved = PinSolver(RIG, choose(key)).solve(pins, START)
    # The linear rig with the same slopes and the same face at the start, built independently.
    slopes = RIG.slope_deltas(START).toarray()
    neutral = RIG.evaluate(START) - (slopes @ START).reshape(-1, 3)
    shapes = ((f"{j}", slopes[:, j].reshape(-1, 3)) for j in range(6))
    linear = build_rig("linear", neutral, RIG.corners, RIG.face_sizes, shapes)
    linear.__dict__["scale"] = RIG.scale
    expected = PinSolver(linear, choose(key)).solve(pins, START)
    np.testing.assert_allclose(solved.weights, expected.weights, atol=2e-5)
    assert solved.pin_error == pytest.approx(pin_error(RIG.evaluate(solved.weights), pins), abs=1e-6)
    assert abs(solved.pin_error - expected.pin_error) > 1e-5, "the true error is not that of the linear face"


@pytest.mark.parametrize("key", SOLVERS)
def test_where_pins_are_at_their_goals_nothing_moves(key: str) -> None:
    if SOLVERS[key].afresh:
        pytest.skip("starts afresh: the start is no answer")
    solved = PinSolver(RIG, choose(key)).solve(pins_at(RIG, START), START)
    np.testing.assert_allclose(solved.weights, START, atol=1e-6)


@pytest.mark.parametrize("key", ["sparse", "bounded"])
def test_a_solver_that_starts_afresh_looks_again_where_it_comes_to(key: str) -> None:
    wanted = np.array([0.7, 0.9, 0.0, 0.6, 0.8, 0.0])
    pins = pins_at(RIG, wanted, (21, 30, 41, 52, 60))
    solver = PinSolver(RIG, choose(key))
    once, weights = solver.solve(pins, np.zeros(6)), np.zeros(6)
    # A single look from the neutral is the problem without combinations.
    single = PinSolver(PLAIN, choose(key)).solve(pins, np.zeros(6)).weights
    assert once.pin_error < 0.9 * pin_error(RIG.evaluate(single), pins)
    # Many looks, by hand, come to an answer that the few are near to.
    slopes = pin_rows(RIG, pins)
    for _ in range(30):
        rows = RIG.slopes(slopes, weights)
        share = slopes @ RIG.amounts(weights) - rows @ weights
        system = replace(_system(RIG), rows=rows)
        kind = SOLVERS[key]
        weights = kind.prepare(system, kind.settings())(
            pin_displacement(RIG, pins) - share, np.zeros(6)
        ).weights
    assert np.abs(once.weights - weights).max() < 0.25 * np.abs(single - weights).max()


def _system(rig: Rig):
    from facepin.solvers.interface import PinSystem

    return PinSystem(np.zeros((0, 6)), rig.limits, rig.scale, rig.largest_moves)


def test_pins_that_no_combination_moves_are_solved_as_ever() -> None:
    still = replace(RIG, deltas=RIG.deltas.copy())
    idle = [v for v in range(81) if not RIG.rows_at([v])[:, 6:].any() and RIG.rows_at([v]).any()]
    pins = tuple(Pin(v, (0.3, 0.2, 0.4)) for v in idle[:2])
    assert pins
    for key in SOLVERS:
        # What lies far from the hand is moved by combinations all the same.
        choice = choose("hand", HandSettings(along=FREE)) if key == "hand" else choose(key)
        ours, plain = (PinSolver(rig, choice).solve(pins, START).weights for rig in (still, PLAIN))
        np.testing.assert_array_equal(ours, plain)


def test_locks_and_mutes_reach_products() -> None:
    control = replace(ShapeControl.of(RIG), locked=np.arange(6) == 1, muted=np.arange(6) == 3)
    heard = control.heard(START)
    wanted = START.copy()
    wanted[[0, 2]] += 0.05
    pins = pins_at(RIG, control.heard(wanted))
    solved = PinSolver(RIG, choose("pseudo_inverse"), control).solve(pins, START)
    assert solved.weights[1] == START[1]
    assert solved.weights[3] == START[3]
    # Shape 1 being locked, its products are linear in their partners: the answer is the exact one.
    assert solved.pin_error < 1e-6
    np.testing.assert_allclose(
        solved.pin_error, pin_error(RIG.evaluate(control.heard(solved.weights)), pins), atol=1e-6
    )
    assert heard[3] == 0


def test_a_solver_that_is_kept_notices_another_start() -> None:
    solver, pins = PinSolver(RIG, choose("tikhonov")), pins_at(RIG, START + 0.2)
    solver.solve(pins, START)
    again = solver.solve(pins, WEIGHTS)
    np.testing.assert_array_equal(
        again.weights, PinSolver(RIG, choose("tikhonov")).solve(pins, WEIGHTS).weights
    )


def test_what_is_near_is_asked_again_at_another_start() -> None:
    choice = choose("transpose", SOLVERS["transpose"].settings(radius=20.0))
    vertex = next(v for v in range(RIG.vertex_count) if not RIG.rows_at([v])[:, RIG.shape_count :].any())
    x, y, z = RIG.neutral[vertex].astype(float).tolist()
    pins = (Pin(vertex, (x + 0.3, y, z)),)
    used = PinSolver(RIG, choice)
    used.solve(pins, np.zeros(6))
    np.testing.assert_array_equal(
        used.solve(pins, WEIGHTS).weights, PinSolver(RIG, choice).solve(pins, WEIGHTS).weights
    )


def test_goals_snap_to_the_true_face() -> None:
    session = Session(RIG, [choose("transpose")])
    session.apply(Edit("Place pin", True, pins_at(RIG, np.zeros(6))))
    session.apply(Edit("Set", True, weights=START))
    for pin in session.pose.pins:
        np.testing.assert_allclose(pin.goal, by_formula(RIG, START)[pin.vertex], atol=1e-6)


@pytest.mark.parametrize("pair", [(0, 0), (-1, 2), (0, 6)])
def test_combinations_of_shapes_that_are_not_there_are_refused(pair: tuple[int, int]) -> None:
    with pytest.raises(FacepinError, match=r"combination 0 is of the shapes .*two different ones of 0 to 5"):
        combined([pair])


def test_combinations_that_are_no_numbers_or_do_nothing() -> None:
    broken = np.full((81, 3), np.nan)
    pieces = (PLAIN.neutral, PLAIN.corners, PLAIN.face_sizes)
    shapes = list(zip(PLAIN.shape_names, deltas(PLAIN, range(6)), strict=True))
    with pytest.raises(FacepinError, match=r"combination shape0\*shape1: x of vertex 0 is nan"):
        build_rig("r", *pieces, shapes, combinations=[((1, 0), broken)])
    with pytest.raises(FacepinError, match="has 2 vertices, the neutral has 81"):
        build_rig("r", *pieces, shapes, combinations=[((1, 0), np.zeros((2, 3)))])
    rig = build_rig("r", *pieces, shapes, combinations=[((1, 0), np.zeros((81, 3)))])
    assert rig.warnings[-1] == "combinations that move nothing: shape0*shape1"
    np.testing.assert_array_equal(rig.evaluate(WEIGHTS), PLAIN.evaluate(WEIGHTS))


def test_the_built_in_face_is_what_its_file_says() -> None:
    rig = open_rig(ADA)
    weights = np.random.default_rng(1).uniform(0, 1, rig.shape_count)
    with np.load(ADA) as stored:
        face = stored["neutral"] + np.einsum("k,kni->ni", weights, stored["deltas"].astype(np.float64))
        a, b = stored["combo_pairs"].T
        face += np.einsum("c,cni->ni", weights[a] * weights[b], stored["combo_deltas"].astype(np.float64))
    np.testing.assert_allclose(rig.evaluate(weights), face, atol=1e-5)
    assert len(rig.combinations) == len(a) > 0


def test_weights_whose_products_cannot_be_drawn_are_refused() -> None:
    rig = combined()
    first, second = rig.combinations[0].tolist()
    rows = np.zeros(rig.shape_count)
    rows[[first, second]] = 1.5e6
    vertex = int(np.argmax(np.abs(rig.rows_at(range(rig.vertex_count))[:, first]))) // 3
    goal = as_vector(by_formula(rig, 0 * rows)[vertex] + rig.rows_at([vertex])[:, : rig.shape_count] @ rows)
    with pytest.raises(FacepinError, match="times as far as they go"):
        PinSolver(rig, choose("pseudo_inverse")).solve((Pin(vertex, goal),), np.zeros(rig.shape_count))
