"""The simulated animator: Figure 4 of the paper without a human, the same on every machine.

A reference pose is drawn by chance, pins are put where it moves the face most, and each pin in turn is
dragged until it looks right from the front, while the earlier ones keep their goals.  The animator
watches the screen: depth is not seen and stays as it was grabbed, and a vertex that lags behind its goal
is pulled further.  The hand trembles around the place it means.  All solving, and where each drag starts,
is as in the window.
"""

from contextlib import suppress
from dataclasses import dataclass, replace
from fnmatch import fnmatch

import numpy as np

from facepin.core.arrays import Floats, Points
from facepin.core.control import ShapeControl
from facepin.core.errors import FacepinError
from facepin.core.pose import FRONT_AXES, Freedom, Pin, Pose, as_vector
from facepin.core.rig import Rig
from facepin.core.shapes import measures
from facepin.session.solving.solving import PinSolver, SolverChoice, snapped

FRAMES = 20
"""Frames that every pin is dragged for."""
PULL = 0.25
"""Share of what still misses on screen by which the cursor moves in a frame."""
WEAKEST, STRONGEST = 0.4, 1.0
"""Range of the weights of a reference pose, as shares of their limit."""
EDGE = 0.5
"""How far beyond the neutral the screen reaches, as a share of the face height: there the mouse ends."""
SPACING = 0.06
"""Least distance of two pins on the neutral, as a share of the face height."""


@dataclass(frozen=True)
class Protocol:
    """What is simulated."""

    pins: int = 15
    shapes: int = 4
    """Active shapes of a reference pose."""
    noise: float = 0.3
    """Standard deviation of the hand, in per cent of the face height, per frame and direction."""
    seed: int = 1
    without: tuple[str, ...] = ()
    """Patterns of shape names that no reference pose has (the solvers still have them)."""


@dataclass(frozen=True, eq=False)
class Task:
    """One thing for the animator to do: the same for every solver."""

    reference: Floats
    """(k,) weights w̄."""
    wanted: Points
    """(n, 3) positions of the reference pose."""
    vertices: tuple[int, ...]
    """Where the pins go, in the order of their turns."""
    tremor: Floats
    """(pins, `FRAMES`, 2) by how much the hand misses, in the rig's unit."""


@dataclass(frozen=True)
class Outcome:
    """How far the animator got, in the units of the study's table."""

    e_rms: float
    pin_error_percent: float
    """Mean distance on screen of the pins from where the reference has them, of the face height."""
    vertex_error_percent: float
    far_motion_percent: float
    out_of_range: float
    active: float
    travel: float
    milliseconds: float
    """Median of the solves."""


def drawable(rig: Rig, protocol: Protocol) -> list[int]:
    """Return the shapes a reference pose may have: those that move the face and are not excluded by name.

    Raises
    ------
    FacepinError
        When there are fewer than the protocol wants.
    """
    moving = rig.largest_moves >= measures.REST * rig.height
    found = [
        j
        for j, name in enumerate(rig.shape_names)
        if moving[j] and not any(fnmatch(name, pattern) for pattern in protocol.without)
    ]
    if len(found) < protocol.shapes:
        raise FacepinError(
            f"a reference pose of {protocol.shapes} shapes was asked for, found {len(found)} that may be used"
        )
    return found


def make_task(rig: Rig, protocol: Protocol, trial: int, reference: Floats | None = None) -> Task:
    """Draw the reference pose, where none is given, the pins and the hand's noise of one trial."""
    random = np.random.default_rng([protocol.seed, trial])
    if reference is None:
        reference = _drawn(rig, protocol, random)
    wanted = rig.evaluate(reference)
    vertices = most_moved(rig, wanted, protocol.pins)
    tremor = random.normal(0.0, protocol.noise / 100 * rig.height, (len(vertices), FRAMES, 2))
    return Task(reference, wanted, vertices, tremor)


def _drawn(rig: Rig, protocol: Protocol, random: np.random.Generator) -> Floats:
    """Return the weights (k,) of a few shapes, the others 0."""
    chosen = random.choice(drawable(rig, protocol), protocol.shapes, replace=False)
    low, high = rig.limits[chosen].T
    reference = np.zeros(rig.shape_count)
    reference[chosen] = random.uniform(WEAKEST, STRONGEST, len(chosen)) * np.where(high > 0, high, low)
    return reference


def most_moved(rig: Rig, wanted: Points, count: int) -> tuple[int, ...]:
    """Choose up to `count` vertices: always the one that moves most of those far enough from all before.

    There are fewer when nothing that moves is far enough from the others.
    """
    moved = measures.moves(wanted, rig.neutral)
    moved[measures.resting(wanted, rig.neutral, rig.height)] = 0.0
    chosen: list[int] = []
    while len(chosen) < count and moved.any():
        vertex = int(np.argmax(moved))
        chosen.append(vertex)
        moved[measures.moves(rig.neutral, rig.neutral[vertex]) <= SPACING * rig.height] = 0.0
    return tuple(chosen)


def animate(rig: Rig, task: Task, choice: SolverChoice, freedom: Freedom) -> Outcome:
    """Let the animator make the reference pose with one solver, from the neutral."""
    solver, free = PinSolver(rig, choice), ShapeControl.of(rig)
    weights = by_hand = np.zeros(rig.shape_count)
    held: tuple[Pin, ...] = ()
    path, times = [weights], []
    margin = EDGE * rig.height
    lowest, highest = rig.neutral.min(axis=0)[:2] - margin, rig.neutral.max(axis=0)[:2] + margin
    for vertex, tremor in zip(task.vertices, task.tremor, strict=True):
        rows, rest = rig.rows_at([vertex]), rig.neutral[vertex].astype(np.float64)
        start = by_hand if choice.kind.afresh else weights
        at = rows @ rig.amounts(weights) + rest
        if not choice.kind.afresh:  # what is held at a press is held where it is
            held = snapped(rig, Pose(weights, held), free).pins
        aim, pin = at.copy(), Pin(vertex, as_vector(at), freedom, FRONT_AXES)
        for shake in tremor:
            aim[:2] = np.clip(aim[:2] + PULL * (task.wanted[vertex, :2] - at[:2]), lowest, highest)
            pin = replace(pin, goal=as_vector(aim + np.append(shake, 0.0)))
            # A solver that fails leaves the face as it is, here as in the window.
            with suppress(FacepinError):
                solved = solver.solve((*held, pin), start, frozenset({vertex}))
                weights = solved.weights
                times.append(solved.seconds)
            at = rows @ rig.amounts(weights) + rest
            path.append(weights)
        held = (*held, pin)
    return _measure(rig, task, np.array(path), times)


def _measure(rig: Rig, task: Task, path: Floats, times: list[float]) -> Outcome:
    weights = path[-1]
    positions = rig.evaluate(weights)
    at_rest = measures.resting(task.wanted, rig.neutral, rig.height)
    pins = tuple(Pin(v, as_vector(task.wanted[v]), "screen", FRONT_AXES) for v in task.vertices)

    def percent(length: float) -> float:
        return measures.percent(length, rig.height)

    return Outcome(
        e_rms=measures.e_rms(weights, task.reference),
        pin_error_percent=percent(measures.pin_error(positions, pins)),
        vertex_error_percent=percent(measures.vertex_error(positions, task.wanted)),
        far_motion_percent=percent(measures.far_motion(positions, rig.neutral, at_rest)),
        out_of_range=measures.out_of_range(weights, rig.limits),
        active=measures.active(weights),
        travel=measures.travel(path),
        milliseconds=1e3 * float(np.median(times)) if times else 0.0,
    )
