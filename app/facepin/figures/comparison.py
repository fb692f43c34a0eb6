"""The same drag through several solvers, and what is measured about each answer.  Numbers only."""

import csv
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from io import StringIO
from statistics import median
from typing import Any

from facepin.core.arrays import Floats, Points
from facepin.core.names import without_author
from facepin.core.pose import Pin, Pose
from facepin.core.rig import Rig
from facepin.core.shapes import measures
from facepin.session.solving.solving import PinSolver, Solved, SolverChoice
from facepin.solvers.settings import plain_settings

FRAMES = 20
"""Frames of the drag that carries the pins to their goals; its solves are what is timed."""
FAR = 0.25
"""Without a reference pose, what is further than this share of the face height from every pin should rest."""

GREEK = {"alpha": "α", "gamma": "γ"}


@dataclass(frozen=True, eq=False)
class Answer:
    """What one solver made of the pins.  Lengths are in the rig's unit."""

    choice: SolverChoice
    weights: Floats
    """(k,)"""
    positions: Points
    """(n, 3) the posed face."""
    notes: Mapping[str, float]
    """What the solver says about its answer: gamma, step, …"""
    milliseconds: float
    """Median solve of a drag frame."""
    pin_error: float
    far_motion: float
    """Largest move, since the start, of a vertex that should rest (see `compare`)."""
    out_of_range: int
    active: int
    e_rms: float | None
    """Eq. 9; None without a reference, like the next."""
    vertex_error: float | None

    @property
    def key(self) -> str:
        """The solver's key in the registry."""
        return self.choice.kind.key

    @property
    def title(self) -> str:
        """What the solver does and what it is called."""
        return without_author(self.choice.kind.title)

    @property
    def settings_line(self) -> str:
        """The settings in short, e.g. "automatic, γ 0.083": the main one, and what is not as usual."""
        settings = self.choice.settings
        parts: list[str] = []
        for at, field in enumerate(fields(settings)):
            value = getattr(settings, field.name)
            other = field.metadata["when"]
            idle = other is not None and getattr(settings, other[0]) != other[1]
            usual = at > 0 and other is None and value == field.default
            if idle or usual or value is False:
                continue
            shown = value if isinstance(value, str) else f"{value:g}"
            name = GREEK.get(field.name, field.name)
            parts.append(name if value is True else f"{name} {shown}")
        if getattr(settings, "automatic", False) and "gamma" in self.notes:
            parts.append(f"γ {self.notes['gamma']:.3f}")
        if self.choice.keep_limits and not self.choice.kind.obeys_limits:
            parts.append("kept within limits")
        return ", ".join(parts)


@dataclass(frozen=True, eq=False)
class Comparison:
    """Several answers to the same pins from the same start."""

    rig: Rig
    start: Pose
    """Weights before the drag; its pins are those that are dragged."""
    reference: Floats | None
    """(k,) the weights that were meant, or None."""
    answers: tuple[Answer, ...]

    @property
    def far_name(self) -> str:
        """What `Answer.far_motion` is called."""
        return "far motion" if self.reference is not None else "motion far from pins"

    def percent(self, length: float) -> float:
        """Return a length in per cent of the face height."""
        return measures.percent(length, self.rig.height)


def compare(
    rig: Rig,
    choices: Sequence[SolverChoice],
    start: Pose,
    reference: Floats | None = None,
    *,
    progress: Callable[[str], None] = lambda title: None,
) -> Comparison:
    """Drag the pins of `start` to their goals with every solver.

    Parameters
    ----------
    rig : Rig
        The face.
    choices : sequence of SolverChoice
        Solvers with their settings.
    start : Pose
        Weights at the press, and the pins with their goals.
    reference : (k,) float64
        Weights of the pose that was meant.  What it leaves at rest should rest; without it, what is far from
        all pins (`FAR`) should.
    progress : callable
        Told the title of each solver before it begins.

    Raises
    ------
    FacepinError
        When a solver fails.
    """
    origin = rig.evaluate(start.weights)
    meant = None if reference is None else rig.evaluate(reference)
    if meant is None:
        at_rest = measures.far_from_pins(rig.neutral, start.pins, FAR * rig.height)
    else:
        at_rest = measures.resting(meant, origin, rig.height)
    answers = []
    for choice in choices:
        progress(choice.kind.title)
        solved, milliseconds = drag(rig, choice, start, origin)
        positions = rig.evaluate(solved.weights)
        answers.append(
            Answer(
                choice,
                solved.weights,
                positions,
                solved.notes,
                milliseconds,
                solved.pin_error,
                measures.far_motion(positions, origin, at_rest),
                measures.out_of_range(solved.weights, rig.limits),
                measures.active(solved.weights),
                None if reference is None else measures.e_rms(solved.weights, reference),
                None if meant is None else measures.vertex_error(positions, meant),
            )
        )
    return Comparison(rig, start, reference, tuple(answers))


def drag(rig: Rig, choice: SolverChoice, start: Pose, origin: Points) -> tuple[Solved, float]:
    """Carry the pins from where their vertices are to their goals in `FRAMES` even frames.

    Returns
    -------
    solved : Solved
        The answer at the goals.  A frame is solved from the weights at the press, so the way does not matter.
    milliseconds : float
        Median time of a frame.
    """
    solver = PinSolver(rig, choice)
    solved = solver.solve(start.pins, start.weights)  # once to prepare: what is timed is a drag frame
    times = []
    for frame in range(1, FRAMES + 1):
        solved = solver.solve(_on_the_way(start.pins, origin, frame / FRAMES), start.weights)
        times.append(1e3 * solved.seconds)
    return solved, median(times)


def _on_the_way(pins: tuple[Pin, ...], origin: Points, share: float) -> tuple[Pin, ...]:
    """Return the pins with goals part of the way; at 1, the very goals."""
    if share == 1:
        return pins
    moved = []
    for pin in pins:
        x, y, z = (float(a + share * (b - a)) for a, b in zip(origin[pin.vertex], pin.goal, strict=True))
        moved.append(replace(pin, goal=(x, y, z)))
    return tuple(moved)


def weights_csv(comparison: Comparison) -> bytes:
    """Return all weights: a row per shape, a column per solver, the reference first if there is one."""
    columns: dict[str, Floats] = {} if comparison.reference is None else {"reference": comparison.reference}
    columns |= {answer.key: answer.weights for answer in comparison.answers}
    table = StringIO()
    writer = csv.writer(table, lineterminator="\n")
    writer.writerow(["shape", *columns])
    for name, *row in zip(
        comparison.rig.shape_names, *(column.tolist() for column in columns.values()), strict=True
    ):
        writer.writerow([name, *row])
    return table.getvalue().encode()


def as_json(comparison: Comparison) -> dict[str, Any]:
    """Return the figures of a comparison as plain values."""
    rig = comparison.rig
    solvers = {}
    for answer in comparison.answers:
        solvers[answer.key] = {
            "title": answer.title,
            "settings": {**plain_settings(answer.choice.settings), "limits": answer.choice.keep_limits},
            "pin_error": answer.pin_error,
            "pin_error_percent": comparison.percent(answer.pin_error),
            "far_motion": answer.far_motion,
            "far_motion_percent": comparison.percent(answer.far_motion),
            "out_of_range": answer.out_of_range,
            "active": answer.active,
            "milliseconds": answer.milliseconds,
            "notes": dict(answer.notes),
        }
        if answer.e_rms is not None and answer.vertex_error is not None:
            solvers[answer.key] |= {
                "e_rms": answer.e_rms,
                "vertex_error": answer.vertex_error,
                "vertex_error_percent": comparison.percent(answer.vertex_error),
            }
    return {
        "rig": {
            "name": rig.name,
            "vertices": rig.vertex_count,
            "shapes": rig.shape_count,
            "height": rig.height,
        },
        "pins": len(comparison.start.pins),
        "far_motion_is": (
            f"largest move of a vertex further than {FAR:.0%} of the height from every pin"
            if comparison.reference is None
            else "largest move of a vertex that the reference leaves at rest"
        ),
        "solvers": solvers,
    }
