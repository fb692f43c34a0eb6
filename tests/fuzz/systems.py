"""Random pin systems of every awkward kind, and what an answer to any of them has to be.

PYTHONPATH=tests python -m fuzz.systems --count 100000
"""

import argparse
import sys
from collections.abc import Iterator
from time import process_time

import numpy as np
from scipy.optimize import linprog

from facepin.solvers import SOLVERS
from facepin.solvers.bounded import BoundedSettings
from facepin.solvers.boxed import TOLERANCE
from facepin.solvers.interface import Floats, PinSystem
from facepin.solvers.sparse import LEAST, RIDGE, SparseSettings
from support.solver_systems import Problem

KEYS = ("sparse", "bounded")
SHARES = (0.3, 1.0, -1.0)
"""Goals of one system, one after the other as in a drag."""
MOST_TIME = 0.05
"""Seconds of processor time for one answer at up to 53 shapes."""
NEARLY = 1e-5
"""Optimality of answers that are as good as the minimum."""
LEAST_GAIN = 1e-5
"""Slope that may be rounding."""
UNITS = (1e-6, 1e-3, 1.0, 1.0, 1.0, 1e2, 1e4)


def any_problem(seed: int) -> Problem:
    """Draw a system: dependent, opposite, dead and tiny shapes, far goals, limits of no width, many ties."""
    rng = np.random.default_rng(seed)
    shapes = int(rng.choice([1, 2, 5, 14, 53, 53, 53]))
    count = int(rng.choice([0, 1, 1, 2, 3, 5, 15])) * int(rng.choice([2, 3]))
    rows = _rows(rng, count, shapes)
    unit = float(rng.choice(UNITS))
    rows *= unit
    low = np.where(rng.random(shapes) < 0.2, -rng.random(shapes), 0.0)
    high = np.where(rng.random(shapes) < 0.1, low, 1.0)
    if rng.random() < 0.1:
        low, high = np.full(shapes, -10.0), np.full(shapes, 10.0)
    start = np.clip(rng.uniform(-0.3, 1.3, shapes) * (rng.random(shapes) < 0.5), low, high)
    if rng.random() < 0.1:
        start = rng.uniform(-2, 2, shapes)  # beyond its limits
    sizes = np.maximum(np.abs(rows).max(axis=0, initial=0.0), 1e-3 * unit) * rng.uniform(1, 3, shapes)
    ties: tuple[tuple[int, int], ...] = ()
    if shapes > 1 and rng.random() < 0.6:
        pairs = rng.integers(0, shapes, (int(rng.choice([1, 1, 2, 4, 20])), 2)).tolist()
        ties = tuple({(a, b) for a, b in pairs if a != b})
    far = 10.0 ** rng.uniform(-3, 5)
    wanted = rows @ np.clip(rng.normal(size=shapes), -1, 2)
    goals = rng.normal(size=count) * unit * far if rng.random() < 0.7 else wanted
    system = PinSystem(rows, np.stack([low, high], axis=1), float(np.mean(sizes**2)), sizes, ties=ties)
    return Problem(system, goals, start)


def _rows(rng: np.random.Generator, count: int, shapes: int) -> Floats:
    rows = rng.normal(size=(count, shapes))
    kind = int(rng.integers(0, 5))
    if kind == 1:
        return rows * 10.0 ** rng.uniform(-4, 0, shapes)
    if kind == 2 and count:
        rank = min(3, count)
        return rng.normal(size=(count, rank)) @ rng.normal(size=(rank, shapes))
    if kind == 3:
        rows[:, rng.random(shapes) < 0.5] = 0.0
    if kind == 4 and shapes > 1:
        some = rng.integers(0, shapes, (2, shapes // 2 + 1))
        rows[:, some[0]] = rows[:, some[1]] * rng.choice([1.0, -1.0, 1.0 + 1e-9])
    return rows


def faults(problem: Problem, key: str, *, proved: bool, timed: bool = True) -> Iterator[str]:
    """Name what is wrong with the answers of a solver.

    `proved` asks for a proof that they are the minimum, `timed` for an answer within `MOST_TIME`.
    """
    system, start = problem.system, problem.start
    kind = SOLVERS[key]
    solve, again = (kind.prepare(system, kind.settings()) for _ in range(2))
    low, high = np.minimum(system.limits[:, 0], start), np.maximum(system.limits[:, 1], start)
    for share in SHARES:
        took = np.inf
        for answer in (solve, again):  # the machine may have been busy
            began = process_time()
            found = answer(share * problem.displacement, start)
            took = min(took, process_time() - began)
        weights, where = found.weights, f"{key}, goals times {share}"
        if not np.isfinite(weights).all():
            yield f"{where}: not finite"
            continue
        if ((weights < low) | (weights > high)).any():
            yield f"{where}: beyond a limit by {max((low - weights).max(), (weights - high).max()):.1e}"
        over = [weights[a] - weights[b] - max(0.0, start[a] - start[b]) for a, b in system.ties]
        if max(over, default=0.0) > 1e-12:
            yield f"{where}: beyond a tie by {max(over):.1e}"
        if found.notes["optimality"] > NEARLY:
            yield f"{where}: gave up after {found.notes['steps']:.0f} steps"
        elif proved and found.notes["optimality"] <= TOLERANCE:
            gain = could_fall(problem, key, share * problem.displacement, weights)
            if gain > LEAST_GAIN:
                yield f"{where}: not the minimum, falls by {gain:.1e} of what pulls"
        if timed and took > MOST_TIME:
            yield f"{where}: took {1000 * took:.0f} ms in {found.notes['steps']:.0f} steps"


def could_fall(problem: Problem, key: str, displacement: Floats, weights: Floats) -> float:
    """Return how steeply the objective falls at best from weights (k,), as a share of what pulls at them.

    Over all directions that limits and ties allow, by linear programming: 0 at the minimum, the objective
    being convex.
    """
    system, start = problem.system, problem.start
    seen = np.flatnonzero(system.rows.any(axis=0))
    rows, here, origin = system.rows[:, seen], weights[seen], start[seen]
    if not len(seen):
        return 0.0
    assert system.sizes is not None
    unit = system.scale**0.5
    if key == "sparse":
        ridge = RIDGE * system.scale
        price = SparseSettings().price * unit * np.maximum(system.sizes, LEAST * unit)[seen]
    else:
        ridge, price = BoundedSettings().alpha * system.scale, np.zeros(len(seen))
    gradient = (rows @ weights[seen] - displacement) @ rows + ridge * (here - origin)
    raising, lowering = np.where(origin >= 0, price, 0.0), np.where(origin <= 0, price, 0.0)
    near = 1e-7
    up = gradient + np.where(here > origin - near, raising, -lowering)
    down = np.where(here < origin + near, lowering, -raising) - gradient
    low = np.minimum(system.limits[seen, 0], origin)
    high = np.maximum(system.limits[seen, 1], origin)
    room = np.concatenate([high - here > near, here - low > near]).astype(np.float64)
    place = {j: at for at, j in enumerate(seen.tolist())}
    tight = []
    for a, b in system.ties:
        if weights[a] - weights[b] - max(0.0, start[a] - start[b]) > -near:
            row = np.zeros(2 * len(seen))
            for shape, sign in ((a, 1.0), (b, -1.0)):
                if shape in place:
                    row[place[shape]] += sign
                    row[len(seen) + place[shape]] -= sign
            tight.append(row)
    # What pulls: opposing pulls of this size are what an answer balances.
    pulls = np.abs(displacement) @ np.abs(rows) + (rows * rows).sum(axis=0) + ridge + price
    slopes = np.concatenate([up, down]) / pulls.max()
    found = linprog(
        slopes,
        A_ub=np.array(tight) if tight else None,
        b_ub=np.zeros(len(tight)) if tight else None,
        bounds=np.stack([np.zeros(2 * len(seen)), room], axis=1),
    )
    return float(-found.fun)


def main() -> int:
    """Draw systems until one is at fault, or until there were enough."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=100_000, help="systems to draw")
    parser.add_argument("--seed", type=int, default=0, help="of the first one")
    parser.add_argument("--proved", type=int, default=50, help="prove the minimum for one system in so many")
    chosen = parser.parse_args()
    wrong = 0
    for seed in range(chosen.seed, chosen.seed + chosen.count):
        problem = any_problem(seed)
        for key in KEYS:
            for fault in faults(problem, key, proved=seed % chosen.proved == 0):
                wrong += 1
                print(f"seed {seed}: {fault}", flush=True)
    print(f"{chosen.count} systems, {wrong} faults")
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main())
