"""The paper's figures, made again on any rig."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from facepin.core.arrays import Floats, frozen
from facepin.core.pose import Pin, Pose
from facepin.core.rig import Rig
from facepin.core.shapes.measures import moves
from facepin.figures.chart_style import number, write_chart
from facepin.figures.charts import gamma_chart
from facepin.figures.compare import (
    BEYOND,
    comparison_panes,
    made_folder,
    measured_lines,
    motion_panes,
    origin_line,
    settings_line,
    share,
    write_charts,
    write_numbers,
)
from facepin.figures.comparison import Comparison, compare
from facepin.figures.paper.page import Remake
from facepin.figures.pictures import Painter, heat_legend
from facepin.figures.posing import DELIGHT, dragged, handles, most_moved_in_sight, named_weights
from facepin.figures.study.animator import Protocol, drawable, make_task
from facepin.session.solving.solving import choose
from facepin.sheets import Pane, write_sheet
from facepin.solvers.colours import INKS, REFERENCE

if TYPE_CHECKING:
    import moderngl

PINS = 15
"""As many as the paper's high number."""
MANY_SHAPES = 100
"""Figure 5 is about rigs with more shapes than this."""
SMALL = (300, 360)
"""Pixels of a face in a row of seven."""

ANGER = {
    "browDownLeft": 0.9,
    "browDownRight": 0.9,
    "noseSneerLeft": 0.7,
    "noseSneerRight": 0.7,
    "mouthFrownLeft": 0.6,
    "mouthFrownRight": 0.6,
}
STEPS = {
    "browInnerUp": 0.8,
    "browOuterUpLeft": 0.8,
    "browOuterUpRight": 0.8,
    "mouthSmileLeft": 0.9,
    "mouthSmileRight": 0.9,
    "jawOpen": 0.6,
}
"""Figure 8's six steps, one shape's worth each."""
LOWER_LIP = {"mouthLowerDownLeft": 1.0}
QUIET = ("*eye*ook*", "*Eye*ook*", "*ongue*", "*identity*")
"""Shapes that a random pose leaves out: what moves eyes and tongue only, or makes another person."""


@dataclass(frozen=True, eq=False)
class Studio:
    """Where figures of one rig are made."""

    rig: Rig
    folder: Path
    seed: int
    front: Painter | None
    """None where there is no OpenGL: pictures of the face are left out."""
    ctx: "moderngl.Context | None"


def one_pin(studio: Studio) -> Remake:
    """Figures 2 and 3: one pin moved down and right, by transposition and by pseudo-inverse."""
    rig = studio.rig
    vertex = handles(rig, _expression(studio, LOWER_LIP))[0]
    goal = rig.neutral[vertex].astype(np.float64) + rig.height * np.array([0.035, -0.05, 0.0])
    x, y, z = goal.tolist()
    start = _neutral(rig, (Pin(vertex, (x, y, z)),))
    comparison = compare(rig, [choose("transpose"), choose("pseudo_inverse")], start)
    ours, theirs = comparison.answers
    return _remade(
        studio,
        "figure-2-3",
        comparison,
        ("sliders",),
        number="Figures 2 and 3",
        title="One pin, transposition against pseudo-inverse",
        text=(
            "One pin is dragged down and to the side, and both solvers get the same goal: the transposition "
            f"uses {ours.active} shapes and stops {share(comparison, ours.pin_error)} short of it, the "
            f"pseudo-inverse uses {theirs.active} and stops {share(comparison, theirs.pin_error)} short. "
            f"{_sentence(comparison)}"
        ),
        seeded=False,
    )


def target_pose(studio: Studio) -> Remake:
    """Figures 4 and 6: a target pose, four solvers, and the error of every weight."""
    rig = studio.rig
    meant = _random_weights(studio)
    wanted = rig.evaluate(meant)
    start = _neutral(rig, dragged(rig, most_moved_in_sight(rig, wanted, PINS), wanted))
    keys = ("transpose", "pseudo_inverse", "tikhonov", "sparse")
    comparison = compare(rig, [choose(key) for key in keys], start, meant)
    errors = _listed(f"{number(answer.e_rms or 0.0)} ({answer.key})" for answer in comparison.answers)
    return _remade(
        studio,
        "figure-4-6",
        comparison,
        ("weights", "errors"),
        number="Figures 4 and 6",
        title="A target pose, four solvers, and what each weight is off by",
        text=(
            f"A random pose of {np.count_nonzero(meant)} shapes is the target, and {len(start.pins)} pins "
            "are dragged to where it has them on screen, with the depth at which they were grabbed. "
            f"The error of the weights, E_RMS of Eq. 9, is {errors}."
        ),
        seeded=True,
    )


def many_shapes(studio: Studio) -> Remake:
    """Figure 5: more than a hundred shapes, the same pins, three solvers, seen from two sides."""
    rig = studio.rig
    meant = _expression(studio, DELIGHT)
    start = _neutral(rig, dragged(rig, handles(rig, meant), rig.evaluate(meant)))
    comparison = compare(
        rig, [choose(key) for key in ("transpose", "pseudo_inverse", "tikhonov")], start, meant
    )
    side: list[Pane] = []
    if studio.ctx is not None and studio.front is not None:
        painter = Painter(studio.ctx, rig, studio.front.size, "three-quarter")
        poses = [rig.evaluate(meant), *(answer.positions for answer in comparison.answers)]
        side = [Pane(painter.paint(positions), "") for positions in poses]
        painter.release()
    return _remade(
        studio,
        "figure-5",
        comparison,
        ("weights",),
        number="Figure 5",
        title=f"The same pins on a rig of {rig.shape_count} shapes",
        text=(
            f"{rig.shape_count} shapes can satisfy {len(start.pins)} pins in many ways, and each solver "
            f"chooses another. {_sentence(comparison)}"
        ),
        seeded=False,
        more=side,
    )


def hybrid_pins(studio: Studio) -> Remake:
    """Figure 7: the hybrid with 1, 2 and 15 pins, and γ."""
    rig = studio.rig
    folder = made_folder(studio.folder / "figure-7")
    meant = _expression(studio, ANGER)
    wanted = rig.evaluate(meant)
    pins = dragged(rig, most_moved_in_sight(rig, wanted, PINS), wanted)
    counts = [count for count in (1, 2, PINS) if count <= len(pins)]
    runs = [compare(rig, [choose("hybrid")], _neutral(rig, pins[:count]), meant) for count in counts]
    gammas = [float(run.answers[0].notes["gamma"]) for run in runs]
    origin = f"{origin_line(runs[-1])}; hybrid, γ automatic, step exact"
    images = []
    if studio.front is not None:
        panes = [
            Pane(
                studio.front.paint(wanted), "Reference", "what the pins are dragged to", (), REFERENCE.colour
            )
        ]
        for count, gamma, run in zip(counts, gammas, runs, strict=True):
            (answer,) = run.answers
            panes.append(
                Pane(
                    studio.front.paint(answer.positions, run.start.pins),
                    f"{count} pin{'s'[: count != 1]}",
                    f"γ = {gamma:.3f}",
                    measured_lines(run, answer, timed=False),
                    INKS["hybrid"].colour,
                )
            )
        images.append((write_sheet(folder / "comparison.png", panes, origin), "Hybrid, by number of pins"))
    rows = rig.slopes(rig.rows_at([pin.vertex for pin in pins]), np.zeros(rig.shape_count))
    smallest = [
        float(np.linalg.svd(rows[: 3 * count], compute_uv=False)[-1]) for count in range(1, len(pins) + 1)
    ]
    _, chart = write_chart(folder, "gamma", gamma_chart(smallest, origin))
    images.append((chart, "The smallest singular value of the pin rows, and γ, by number of pins"))
    mixtures = _listed(f"{gamma:.3f} with {count}" for gamma, count in zip(gammas, counts, strict=True))
    return Remake(
        "Figure 7",
        "The hybrid with few and with many pins",
        (
            "The paper mixes by the smallest singular value of the pin rows, at most 1, so that few pins "
            "should be solved rather by the pseudo-inverse and many by the transposition. "
            f"Here γ is {mixtures}; it has the rig's unit, so the same face in metres would have another."
        ),
        origin,
        tuple(images),
    )


def in_steps(studio: Studio) -> Remake:
    """Figure 8: from the neutral to an expression in six drags."""
    rig = studio.rig
    folder = made_folder(studio.folder / "figure-8")
    meant = _expression(studio, STEPS)
    wanted = rig.evaluate(meant)
    vertices = handles(rig, meant)
    pose = _neutral(rig, ())
    run = compare(rig, [choose("transpose")], pose, meant)
    stages: list[tuple[Pose, Comparison]] = []
    for pin in dragged(rig, vertices, wanted):
        run = compare(rig, [choose("transpose")], pose.with_pins((*pose.pins, pin)), meant)
        pose = run.start.with_weights(run.answers[0].weights)
        stages.append((pose, run))
    origin = f"{origin_line(run)}; {settings_line(run)}"
    images = []
    if studio.ctx is not None:
        painter = Painter(studio.ctx, rig, SMALL)
        panes = [Pane(painter.paint(rig.neutral), "Neutral", f"E_RMS {_e_rms(0 * meant, meant):.3f}")]
        for step, (stage, run_) in enumerate(stages, 1):
            (answer,) = run_.answers
            panes.append(
                Pane(
                    painter.paint(answer.positions, stage.pins[-1:]),
                    f"Step {step}",
                    f"E_RMS {answer.e_rms:.3f}",
                )
            )
        painter.release()
        images.append(
            (write_sheet(folder / "steps.png", panes, origin, columns=len(panes)), "One new pin in each step")
        )
    largest = float(moves(rig.evaluate(pose.weights), rig.neutral).max())
    return Remake(
        "Figure 8",
        f"From the neutral in {len(stages)} steps, by transposition",
        (
            f"{len(stages)} pins are placed and dragged one after the other, each solved from the weights "
            "before it while all earlier pins hold; the pin of the step is shown. "
            f"E_RMS to the expression that was meant goes from {_e_rms(0 * meant, meant):.3f} to "
            f"{_e_rms(pose.weights, meant):.3f}, and the face moves by up to "
            f"{100 * largest / rig.height:.1f} % of its height."
        ),
        origin,
        tuple(images),
    )


def _neutral(rig: Rig, pins: tuple[Pin, ...]) -> Pose:
    return Pose(frozen(np.zeros(rig.shape_count), np.float64), pins)


def _expression(studio: Studio, amounts: Mapping[str, float]) -> Floats:
    """Return the named expression on a rig that has its shapes, else a random one of as many shapes."""
    weights = named_weights(studio.rig, amounts)
    if np.count_nonzero(weights) < len(amounts):
        weights = _random_weights(studio, len(amounts))
    return frozen(weights, np.float64)


def _random_weights(studio: Studio, shapes: int = Protocol.shapes) -> Floats:
    """Draw a pose of `shapes` shapes that move the face, or of as many as there are."""
    protocol = Protocol(pins=1, shapes=0, seed=studio.seed, without=QUIET)
    if not drawable(studio.rig, protocol):
        protocol = replace(protocol, without=())
    there_are = len(drawable(studio.rig, protocol))
    return frozen(
        make_task(studio.rig, replace(protocol, shapes=min(shapes, there_are)), 0).reference, np.float64
    )


def _remade(
    studio: Studio,
    name: str,
    comparison: Comparison,
    shown: Sequence[str],
    *,
    number: str,
    title: str,
    text: str,
    seeded: bool,
    more: Sequence[Pane] = (),
) -> Remake:
    """Write all files of a comparison; the page shows the faces and the charts named in `shown`."""
    folder = made_folder(studio.folder / name)
    seed = f"; seed {studio.seed}" if seeded else ""
    images = []
    if studio.front is not None:
        panes = comparison_panes(comparison, studio.front, timed=False)
        columns = len(panes)
        images.append(
            (
                write_sheet(
                    folder / "comparison.png", [*panes, *more], origin_line(comparison) + seed, columns
                ),
                "The faces; orange: pins, with lines to their goals",
            )
        )
        motion = motion_panes(comparison, studio.front)
        images.append(
            (
                write_sheet(
                    folder / "motion.png",
                    motion,
                    f"{origin_line(comparison)}{seed}; {BEYOND}",
                    legend=heat_legend(comparison.rig),
                ),
                "How far each vertex moved",
            )
        )
    numbers = write_numbers(folder, comparison)
    paths = {path.name: path for path in write_charts(folder, comparison, seed)}
    captions = {
        "sliders": "Sliders, the most used first; red: out of range",
        "weights": "Weights of all shapes",
        "errors": "Errors of all weights, as marks and as lines",
    }
    images += [(paths[f"{chart}.svg"], captions[chart]) for chart in shown]
    made_by = f"{origin_line(comparison)}{seed}. {settings_line(comparison)}."
    return Remake(number, title, text, made_by, tuple(images), files=tuple(numbers))


def _sentence(comparison: Comparison) -> str:
    """Say how far each solver moves what should rest."""
    found = _listed(f"{share(comparison, answer.far_motion)} ({answer.key})" for answer in comparison.answers)
    meant = comparison.reference is not None
    return (
        f"What {'the expression leaves at rest' if meant else 'is far from the pin'} moves by up to {found}."
    )


def _listed(items: Iterable[str]) -> str:
    *first, last = items
    return f"{', '.join(first)} and {last}" if first else last


def _e_rms(weights: Floats, reference: Floats) -> float:
    return float(np.sqrt(np.mean((weights - reference) ** 2)))
