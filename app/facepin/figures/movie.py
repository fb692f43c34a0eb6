"""The command `movie`: pins being dragged one after the other, the face and its sliders following."""

from argparse import ArgumentParser, Namespace
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.errors import FacepinError
from facepin.core.look.camera import Viewport
from facepin.core.pose import Pin, Pose, as_vector
from facepin.core.rig import Rig
from facepin.core.shapes.measures import REST
from facepin.figures.compare import progress_line
from facepin.figures.pictures import Painter
from facepin.figures.posing import DELIGHT, dragged, handles, named_weights
from facepin.files.animation import Animation
from facepin.options import (
    add_solver,
    add_turn,
    add_view,
    count,
    first_pose,
    open_with_bar,
    picture_size,
    png_path,
    rig_path,
    solver_choices,
)
from facepin.session.edit import Edit
from facepin.session.session import Session
from facepin.session.solving.solving import SolverChoice
from facepin.sheets import Image, font, font_for, shortened

if TYPE_CHECKING:
    from PIL.Image import Image as Picture
    from PIL.ImageDraw import ImageDraw

SECONDS = 1 / 18
"""How long each picture is shown."""
REST_FRAMES = 7
"""Pictures between two drags, and three times as many at the end."""
SLIDERS = 0.34
"""Share of the width that the sliders take."""
MOST_SLIDERS = 12
PAPER, TROUGH, WORDS, BAR = "#202124", "#2d2f34", "#e6e7ea", "#fa9e3d"
ARROW = ((0, 0), (0, 17), (4, 13), (7, 20), (10, 19), (7, 12), (12, 12))
"""Outline of a mouse pointer, its tip first, in pixels of a picture 480 high."""


@dataclass(frozen=True, eq=False)
class Moment:
    """What one picture shows."""

    pose: Pose
    held: int | None
    """Vertex of the pin in the hand."""


def add_options(parser: ArgumentParser) -> None:
    """Declare the options of `facepin movie`."""
    parser.add_argument(
        "rig", type=rig_path, nargs="?", metavar="RIG", help="face to pose (default: the built-in one)"
    )
    parser.add_argument("--neutral", metavar="NAME", help="file with the neutral in a folder of .obj files")
    add_turn(parser)
    add_view(parser)
    parser.add_argument(
        "--pins", type=Path, metavar="FILE", help="what is dragged, pin by pin (default: a delighted face)"
    )
    add_solver(parser, "sparse")
    parser.add_argument(
        "--frames", type=count, default=16, metavar="N", help="pictures of each drag (default: 16)"
    )
    parser.add_argument(
        "--size", type=picture_size, default=(720, 440), metavar="WxH", help="pixels (default: 720x440)"
    )
    parser.add_argument("--out", type=png_path, required=True, metavar="PNG", help="the animated picture")


def run(options: Namespace) -> Path:
    """Do `facepin movie`; return what was written."""
    from facepin.gpu.picture import open_context

    choices = solver_choices(options.solver, options.settings, options.limits)
    if len(choices) != 1:
        raise FacepinError(f"a movie shows one solver at work, found {len(choices)}: '{options.solver}'")
    rig = open_with_bar(options.rig, options.neutral, options.turn)
    if not rig.shape_count or rig.largest_moves.max() < REST * rig.height:
        raise FacepinError(f"{rig.name}: no shape moves the face, so there is nothing to be seen in a movie")
    pins = _delight(rig) if options.pins is None else first_pose(rig, None, options.pins).pins
    if not pins:
        raise FacepinError(f"{rig.name}: there are no pins to drag: name some with --pins FILE")
    moments = list(played(rig, choices[0], pins, options.frames))
    with progress_line() as tell, open_context() as ctx:
        width, height = options.size
        face = (max(round(width * (1 - SLIDERS)), 1), height)
        painter = Painter(ctx, rig, face, options.view)
        shapes = _shapes(rig, moments)
        animation, picture = Animation(), None
        for number, moment in enumerate(moments):
            tell(f"Picture {number + 1} of {len(moments)}")
            if picture is None or moment is not moments[number - 1]:
                picture = _picture(rig, painter, moment, shapes, (width, height))
            animation.add(picture)
        painter.release()
    animation.write(options.out, SECONDS)
    return Path(options.out)


def _delight(rig: Rig) -> tuple[Pin, ...]:
    """Return the pins of a delighted face, none on a rig that lacks its shapes."""
    meant = named_weights(rig, DELIGHT)
    return dragged(rig, handles(rig, meant), rig.evaluate(meant), "screen")


def played(rig: Rig, choice: SolverChoice, pins: Sequence[Pin], frames: int) -> Iterator[Moment]:
    """Drag pins to their goals one after the other, as a hand would: each from where its vertex is by then.

    What happens to the pose is what happens in the window: the same edits, carried out by a session.
    """
    session = Session(rig, [choice])
    yield from [Moment(session.pose, None)] * REST_FRAMES
    for pin in pins:
        start = rig.evaluate(session.pose.weights)[pin.vertex].astype(np.float64)
        placed = replace(pin, goal=as_vector(start))
        others = session.pose.pins
        session.apply(Edit("Place pin", True, (*others, placed)))
        for frame in range(1, frames + 1):
            way = frame / frames
            eased = way * way * (3 - 2 * way)
            goal = (1 - eased) * start + eased * np.asarray(pin.goal)
            held = replace(pin, goal=as_vector(goal))
            session.apply(Edit("Drag pin", frame == frames, (*others, held), solve=True))
            if session.message:
                raise FacepinError(session.message)
            yield Moment(session.pose, pin.vertex)
        yield from [Moment(session.pose, None)] * REST_FRAMES
    yield from [Moment(session.pose, None)] * (2 * REST_FRAMES)


def _shapes(rig: Rig, moments: Sequence[Moment]) -> tuple[int, ...]:
    """Return the shapes that are used most, in the order of the rig."""
    most = np.max([np.abs(moment.pose.weights) for moment in moments], axis=0)
    return tuple(sorted(np.argsort(-most, kind="stable")[:MOST_SLIDERS].tolist()))


def _picture(
    rig: Rig, painter: Painter, moment: Moment, shapes: Sequence[int], size: tuple[int, int]
) -> Image:
    """Return the face beside its sliders, (h, w, 3) uint8."""
    from PIL import Image as Pillow
    from PIL import ImageDraw

    paper = Pillow.new("RGB", size, PAPER)
    face = painter.paint(rig.evaluate(moment.pose.weights), moment.pose.pins)
    paper.paste(Pillow.fromarray(face[..., :3]), (0, 0))
    draw = ImageDraw.Draw(paper)
    left = painter.size[0]
    _sliders(draw, rig, moment.pose.weights, shapes, (left, 0, size[0] - left, size[1]))
    if moment.held is not None:
        (goal,) = (pin.goal for pin in moment.pose.pins if pin.vertex == moment.held)
        x, y, _ = painter.camera.project([goal], Viewport(0, 0, *painter.size))[0].tolist()
        _arrow(paper, x, y, size[1] / 480)
    return np.asarray(paper)


def _sliders(
    draw: "ImageDraw",
    rig: Rig,
    weights: Floats,
    shapes: Sequence[int],
    box: tuple[int, int, int, int],
) -> None:
    """Draw a bar for the weight of each shape; box is left, top, width, height."""
    left, top, width, height = box
    pad = round(0.05 * min(width, height))
    step = (height - 2 * pad) / max(len(shapes), 10)
    words = font("Regular", max(min(0.5 * step, 0.062 * width), 1.0))
    split = left + pad + 0.6 * (width - 2 * pad)
    right = left + width - pad
    for row, j in enumerate(shapes):
        y = top + pad + row * step
        name = rig.shape_names[j]
        its_font = font_for(name, words)
        draw.text(
            (left + pad, y + 0.45 * step),
            shortened(name, its_font, split - left - 1.6 * pad),
            WORDS,
            its_font,
            anchor="lm",
        )
        inset = 0.22 * step
        draw.rounded_rectangle((split, y + inset, right, y + 0.9 * step - inset), 0.1 * step, TROUGH)
        low, high = float(rig.limits[j, 0]), float(rig.limits[j, 1])
        low, high = min(low, 0.0, float(weights[j])), max(high, 0.0, float(weights[j]), 1e-9)
        ends = [
            split + (right - split) * (at - low) / (high - low) for at in sorted((0.0, float(weights[j])))
        ]
        if ends[1] - ends[0] >= 1:
            draw.rounded_rectangle((ends[0], y + inset, ends[1], y + 0.9 * step - inset), 0.1 * step, BAR)


def _arrow(paper: "Picture", x: float, y: float, scale: float) -> None:
    """Draw a mouse pointer whose tip is at (x, y), smooth: four times as large, then shrunk."""
    from PIL import Image as Pillow
    from PIL import ImageDraw

    fine = 4
    side = round(26 * scale) + 2
    mask = Pillow.new("LA", (fine * side, fine * side), 0)
    draw = ImageDraw.Draw(mask)
    at = (x - int(x), y - int(y))
    outline = [(fine * (1 + at[0] + scale * px), fine * (1 + at[1] + scale * py)) for px, py in ARROW]
    draw.polygon(outline, fill=(255, 255))
    draw.line([*outline, outline[0]], fill=(0, 255), width=max(round(1.4 * fine * scale), 1), joint="curve")
    pointer = mask.resize((side, side), Pillow.Resampling.BOX).convert("RGBA")
    paper.paste(pointer, (int(x) - 1, int(y) - 1), pointer)
