"""Pin systems for the tests of solvers: random ones, awkward ones, and real ones from a scanned face."""

from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from facepin.solvers.interface import Floats, PinSystem


class Problem(NamedTuple):
    """A pin system with one displacement and a start within limits."""

    system: PinSystem
    displacement: Floats
    start: Floats


def random_problem(seed: int, rows: int = 9, shapes: int = 14, lowest: float = 0.0) -> Problem:
    """A well-posed problem whose solution leaves some limits."""
    rng = np.random.default_rng(seed)
    jacobian = rng.normal(size=(rows, shapes))
    limits = np.tile([lowest, 1.0], (shapes, 1))
    scale = float(np.mean(np.sum(jacobian**2, axis=0)))
    start = rng.uniform(0.0, 1.0, shapes) * rng.integers(0, 2, shapes)
    return Problem(PinSystem(jacobian, limits, scale), rng.normal(size=rows) * 2, start)


def awkward_problems() -> dict[str, Problem]:
    """Every degenerate input a face and a hand can produce, by name."""
    rng = np.random.default_rng(5)
    tall = random_problem(6, rows=30, shapes=4)
    plain = random_problem(7)
    rows = plain.system.rows

    def like(changed: Floats, displacement: Floats | None = None) -> Problem:
        system = PinSystem(changed, np.tile([0.0, 1.0], (changed.shape[1], 1)), plain.system.scale)
        start = plain.start[: changed.shape[1]]
        return Problem(system, rng.normal(size=len(changed)) if displacement is None else displacement, start)

    dead_vertex = rows.copy()
    dead_vertex[:3] = 0.0
    dead_shape = rows.copy()
    dead_shape[:, 2] = 0.0
    equal = rows.copy()
    equal[:, 3] = equal[:, 4] = rows[:, 5]
    everything = np.zeros_like(rows)
    twice = np.concatenate([rows[:3], rows[:3], rows[3:]])
    return {
        "no pins": like(rows[:0]),
        "no shapes": like(rows[:, :0]),
        "a pin no shape moves": like(dead_vertex),
        "only pins no shape moves": like(everything),
        "a shape that moves nothing": like(dead_shape),
        "equal shapes": like(equal),
        "two pins on one vertex": like(twice),
        "two pins on one vertex, torn apart": like(twice, np.arange(12.0)),
        "more rows than shapes": tall,
        "one row": like(rows[:1]),
        "one shape": like(rows[:, :1]),
        "a displacement no shape goes along": like(
            np.outer([1.0, 1.0, 0.0], rows[0]), np.array([1.0, -1.0, 0.0])
        ),
        "micrometres": scaled(plain, 1e6),
        "kilometres": scaled(plain, 1e-6),
        "astronomical": scaled(plain, 1e30),
        "subatomic": scaled(plain, 1e-30),
        "a mouse far away": like(rows, plain.displacement * 1e6),
        "a shape with traces of noise": like(np.where(np.arange(14) == 2, rows * 1e-9, rows)),
    }


def scaled(problem: Problem, factor: float) -> Problem:
    """The same problem with lengths in another unit."""
    system = problem.system
    sizes = None if system.sizes is None else system.sizes * factor
    other = PinSystem(system.rows * factor, system.limits, system.scale * factor**2, sizes)
    return Problem(other, problem.displacement * factor, problem.start)


@cache
def _scan(shared: Path) -> tuple[Floats, Floats]:
    with np.load(shared / "models" / "ict-facekit" / "ict_full153.npz") as data:
        return data["neutral"].astype(np.float64), data["deltas"]


def face_problem(shared: Path, shapes: int, pins: int, seed: int, screen: bool = False) -> Problem:
    """Pins on a real face, pulled towards a pose of four expressions with a little noise."""
    neutral, deltas = _scan(shared)
    rng = np.random.default_rng(seed)
    vertices = rng.choice(np.flatnonzero(neutral[:, 2] > 2.0), pins, replace=False)
    part = deltas[:shapes, vertices].astype(np.float64)[:, :, : 2 if screen else 3]
    rows = np.ascontiguousarray(part.reshape(shapes, -1).T)
    largest = np.sqrt((deltas[:shapes].astype(np.float32) ** 2).sum(axis=2).max(axis=1))
    weights = np.zeros(shapes)
    weights[rng.choice(53, 4, replace=False)] = rng.uniform(0.4, 1.0, 4)
    displacement = rows @ weights + rng.normal(0, 0.05, len(rows))
    limits = np.tile([0.0, 1.0], (shapes, 1))
    system = PinSystem(rows, limits, float(np.mean(largest**2)), largest.astype(np.float64))
    return Problem(system, displacement, np.zeros(shapes))
