"""The solver for the hand: its forces against scipy, and what a hand may rely on."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import minimize

from facepin.core.control import ShapeControl
from facepin.core.pose import FRONT_AXES, Pin, as_vector
from facepin.core.rig import Rig
from facepin.core.shapes.motion import shape_moves
from facepin.files.formats import open_rig
from facepin.resources import resource
from facepin.session.solving.solving import PinSolver, choose
from facepin.solvers.forces import Pulls, Springs, balance
from facepin.solvers.hand import HandSettings

RIGHT, UP, LEFT, DOWN = (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)


@pytest.fixture(scope="module")
def ada() -> Rig:
    return open_rig(resource("assets", "faces/ada.npz"))


def a_problem(random: np.random.Generator, shapes: int) -> tuple[Pulls, Springs, np.ndarray]:
    sizes = random.integers(1, 4, random.integers(1, 5))
    one_sided = (sizes == 1) & (random.random(len(sizes)) < 0.5)
    count = len(sizes)
    starts = np.cumsum([0, *sizes[:-1]])
    rows = random.normal(size=(int(sizes.sum()), shapes)) * (random.random(shapes) < 0.8)
    pulls = Pulls(rows, starts, random.uniform(0.3, 2, count), random.uniform(0.001, 0.1, count), one_sided)
    springs = Springs(
        random.uniform(0, 1, shapes),
        random.uniform(0, 1, shapes),
        random.uniform(0.02, 1, shapes),
        -random.uniform(0, 1, shapes),
        random.uniform(0, 1, shapes),
    )
    return pulls, springs, random.normal(size=len(rows))


def objective(pulls: Pulls, springs: Springs, wanted: np.ndarray, x: np.ndarray) -> float:
    """Written down again from the formula, group by group."""
    total = 0.0
    for group, start in enumerate(pulls.starts):
        stop = [*pulls.starts, len(wanted)][group + 1]
        missing = wanted[start:stop] - pulls.rows[start:stop] @ x
        length = max(missing[0], 0.0) if pulls.one_sided[group] else float(np.linalg.norm(missing))
        slack = pulls.slacks[group]
        total += pulls.strengths[group] * (length - slack / 2 if length > slack else length**2 / (2 * slack))
    return total + float(
        np.sum(np.where(x > 0, springs.raising * x, -springs.lowering * x) + springs.stiffness * x**2 / 2)
    )


@pytest.mark.parametrize("seed", range(40))
def test_forces_balance_where_the_objective_is_lowest(seed: int) -> None:
    random = np.random.default_rng(seed)
    pulls, springs, wanted = a_problem(random, shapes := int(random.integers(1, 12)))
    found = balance(pulls, springs, wanted, np.zeros(len(wanted)))
    value = objective(pulls, springs, wanted, found.change)
    assert found.gap <= 1e-9
    assert ((found.change >= springs.low) & (found.change <= springs.high)).all()

    # Up and down as two variables make it smooth: another method, another implementation.
    def split(z: np.ndarray) -> float:
        x = z[:shapes] - z[shapes:]
        smooth = objective(pulls, springs, wanted, x) - np.sum(
            np.where(x > 0, springs.raising * x, -springs.lowering * x)
        )
        return float(smooth + springs.raising @ z[:shapes] + springs.lowering @ z[shapes:])

    bounds = [(0.0, high) for high in springs.high] + [(0.0, -low) for low in springs.low]
    best = min(
        (
            minimize(split, start, bounds=bounds, method="L-BFGS-B", options={"maxiter": 5000, "ftol": 1e-15})
        ).fun
        for start in (
            np.zeros(2 * shapes),
            np.concatenate([np.maximum(found.change, 0), np.maximum(-found.change, 0)]),
        )
    )
    assert value <= best + 1e-7 * max(1.0, abs(best))
    # Other forces to begin with lead to the same answer.
    again = balance(pulls, springs, wanted, random.normal(size=len(wanted)))
    np.testing.assert_allclose(again.change, found.change, atol=1e-5)


class Face:
    """A face whose points are dragged on the screen, from the front."""

    def __init__(self, rig: Rig, **settings: float) -> None:
        self.rig = rig
        self.solver = PinSolver(rig, choose("hand", HandSettings(**settings), keep_limits=True))

    def drag(
        self,
        vertex: int,
        move: tuple[float, float],
        start: np.ndarray | None = None,
        held: tuple[Pin, ...] = (),
    ) -> np.ndarray:
        """Weights after a drag by a share of the face height."""
        weights = np.zeros(self.rig.shape_count) if start is None else start
        place = self.rig.evaluate(weights)[vertex].astype(float)
        goal = place + self.rig.height * np.array([*move, 0.0])
        pins = (*held, Pin(vertex, as_vector(goal), "screen", FRONT_AXES))
        return self.solver.solve(pins, weights, frozenset({vertex})).weights

    def moved(self, vertex: int, weights: np.ndarray) -> np.ndarray:
        return (self.rig.evaluate(weights) - self.rig.neutral)[vertex, :2] / self.rig.height

    def most_moved(self, shape: str) -> int:
        alone = np.zeros(self.rig.shape_count)
        alone[self.rig.shape_names.index(shape)] = 1.0
        return int(np.linalg.norm(self.rig.evaluate(alone) - self.rig.neutral, axis=1).argmax())

    def used(self, weights: np.ndarray) -> list[str]:
        """Names of active shapes, the largest first."""
        return [self.rig.shape_names[j] for j in np.argsort(-weights) if weights[j] > 0.05]


@pytest.mark.parametrize("seed", range(40))
def test_forces_of_hands_on_soft_shapes_turn_until_they_balance(seed: int) -> None:
    """A little turn of a full force changes much here: what only follows the miss goes round in circles."""
    random = np.random.default_rng(seed)
    shapes, pins = 12, int(random.integers(1, 5))
    rows = random.normal(size=(3 * pins, shapes)) * random.choice([0.05, 1.0], shapes)
    starts, free = np.arange(0, 3 * pins, 3), np.zeros(pins, np.bool_)
    pulls = Pulls(rows, starts, random.uniform(0.3, 1.0, pins), np.full(pins, 0.05), free)
    price = random.uniform(0.06, 0.9, shapes) * np.abs(rows).max(axis=0)
    springs = Springs(price, price, np.full(shapes, 0.01), np.zeros(shapes), np.ones(shapes))
    wanted = random.normal(size=3 * pins) * np.repeat(random.choice([0.0, 0.3, 1.0], pins), 3)
    assert balance(pulls, springs, wanted, np.zeros(3 * pins)).gap <= 1e-5


def test_many_pins_on_a_tied_shape_are_solved_in_few_steps(ada: Rig) -> None:
    """The shape is just about to move, and its tie is stiff."""
    moved = shape_moves(ada, ada.shape_names.index("mouthClose"))
    for way in (0.01, 0.05, 0.3):
        pins = tuple(
            Pin(vertex, as_vector(ada.neutral[vertex] + (0.0, way * ada.height, 0.0)), "screen", FRONT_AXES)
            for vertex in np.argsort(-moved)[:25].tolist()
        )
        solved = PinSolver(ada, choose("hand"), ShapeControl.of(ada)).solve(pins, np.zeros(ada.shape_count))
        assert solved.notes["steps"] <= 30
        assert solved.notes["gap"] <= 1e-4
        for tied, other in ShapeControl.of(ada).ties:
            assert solved.weights[tied] <= solved.weights[other]


def test_a_press_moves_nothing_and_so_does_coming_back(ada: Rig) -> None:
    face = Face(ada)
    start = np.zeros(ada.shape_count)
    start[[3, 10, 20]] = 0.3, 0.6, 0.2
    vertex = face.most_moved("jawOpen")
    np.testing.assert_array_equal(face.drag(vertex, (0.0, 0.0), start), start)
    face.drag(vertex, (0.03, -0.05), start)
    np.testing.assert_array_equal(face.drag(vertex, (0.0, 0.0), start), start)


def test_the_answer_depends_on_where_the_mouse_is_and_not_on_its_path(ada: Rig) -> None:
    vertex = Face(ada).most_moved("mouthSmileLeft")
    wandering = Face(ada)
    for angle in np.linspace(0, 6, 40):
        wandering.drag(vertex, (0.05 * np.cos(angle), 0.05 * np.sin(angle)))
    np.testing.assert_allclose(
        wandering.drag(vertex, (0.02, 0.02)), Face(ada).drag(vertex, (0.02, 0.02)), atol=1e-6
    )


def test_the_point_follows_and_the_shape_meant_is_used(ada: Rig) -> None:
    face = Face(ada)
    for shape, direction, share in (("jawOpen", DOWN, 0.3), ("eyeBlinkLeft", DOWN, 0.5)):
        vertex = face.most_moved(shape)
        alone = np.zeros(ada.shape_count)
        alone[ada.shape_names.index(shape)] = share
        move = tuple(face.moved(vertex, alone).tolist())
        assert np.dot(move, direction) > 0
        weights = face.drag(vertex, move)
        assert np.linalg.norm(face.moved(vertex, weights) - move) < 0.1 * np.linalg.norm(move)
        assert face.used(weights)[0] == shape
        assert len(face.used(weights)) <= 3


def test_pulling_far_beyond_reach_changes_nothing_more(ada: Rig) -> None:
    # With combinations the face is another one at the answer, and a second look may see a little more.
    plain = replace(ada, deltas=ada.deltas[:, : ada.shape_count], combinations=ada.combinations[:0])
    face = Face(plain)
    for shape in ("mouthSmileLeft", "browInnerUp", "noseSneerRight"):
        vertex = face.most_moved(shape)
        for direction in (RIGHT, UP, LEFT, DOWN):
            far, further = (face.drag(vertex, (r * direction[0], r * direction[1])) for r in (0.5, 3.0))
            np.testing.assert_allclose(further, far, atol=1e-6)


def test_weights_do_not_jump_where_the_mouse_turns(ada: Rig) -> None:
    face, pixel = Face(ada), 1 / 720
    for shape in ("mouthSmileLeft", "jawOpen", "browInnerUp"):
        vertex, size = face.most_moved(shape), 0.03
        angles = np.arange(0.0, 2 * np.pi, pixel / size)
        path = [face.drag(vertex, (size * np.cos(a), size * np.sin(a))) for a in angles]
        assert np.abs(np.diff(path, axis=0)).max() < 0.5


def test_one_side_is_used_for_a_pin_on_one_side_and_both_in_the_middle(ada: Rig) -> None:
    face = Face(ada)
    left = face.most_moved("mouthSmileLeft")
    assert not any(name.endswith("Right") for name in face.used(face.drag(left, (0.015, 0.02))))
    middle = int(
        np.argmin(
            np.abs(ada.neutral[:, 0])
            + np.linalg.norm(ada.neutral - ada.neutral[face.most_moved("jawOpen")], axis=1)
        )
    )
    assert abs(ada.neutral[middle, 0]) < 0.01 * ada.height
    weights = face.drag(middle, (0.0, 0.01))
    names = list(ada.shape_names)
    for name in face.used(weights):
        if name.endswith("Left"):
            twin = names.index(name.replace("Left", "Right"))
            assert weights[names.index(name)] == pytest.approx(weights[twin], abs=0.1)


def test_limits_locks_and_ties_are_obeyed(ada: Rig) -> None:
    face, random = Face(ada), np.random.default_rng(3)
    moving = np.flatnonzero(
        np.abs(ada.evaluate(np.full(ada.shape_count, 0.3)) - ada.neutral).sum(axis=1) > 0.2
    )
    tied = ada.shape_names.index("mouthClose"), ada.shape_names.index("jawOpen")
    for vertex in random.choice(moving, 12, replace=False).tolist():
        weights = face.drag(vertex, tuple(random.normal(0, 0.1, 2).tolist()))
        low, high = ada.limits.T
        assert ((weights >= low - 1e-9) & (weights <= high + 1e-9)).all()
        assert weights[tied[0]] <= weights[tied[1]] + 1e-6


def test_held_pins_resist(ada: Rig) -> None:
    face = Face(ada)
    chin, lip = face.most_moved("jawOpen"), face.most_moved("mouthLowerDownLeft")
    alone = face.drag(chin, (0.0, -0.03))
    place = as_vector(ada.neutral[lip].astype(float))
    together = face.drag(chin, (0.0, -0.03), held=(Pin(lip, place, "screen", FRONT_AXES, stiffness=10.0),))
    assert np.linalg.norm(face.moved(lip, together)) < 0.5 * np.linalg.norm(face.moved(lip, alone))


def test_the_rest_goes_along_as_far_as_it_may(ict_rig: Rig) -> None:
    """The corner of the mouth pulled down and the jaw, which moves the chin much further."""
    strict, free = Face(ict_rig, along=0.2), Face(ict_rig, along=3.0)
    corner = strict.most_moved("mouthSmile_L")
    away = np.linalg.norm(ict_rig.neutral - ict_rig.neutral[corner], axis=1) > 0.25 * ict_rig.height

    def far(face: Face) -> float:
        weights = face.drag(corner, (0.0, -0.03))
        moved = np.linalg.norm(ict_rig.evaluate(weights) - ict_rig.neutral, axis=1)
        return float(moved[away].max()) / ict_rig.height

    assert far(strict) < 0.015 + 0.2 * 0.03 + 0.003
    assert far(free) > far(strict)


@pytest.fixture(scope="module")
def ict_rig() -> Rig:
    path = Path(__file__).resolve().parents[3] / "shared/models/ict-facekit/ict_expressions.glb"
    if not path.exists():
        pytest.skip("needs ict_expressions.glb, which is not part of the project")
    return open_rig(path)
