"""The commands that find weights: solve and tidy."""

import json
import sys
from argparse import ArgumentParser, Namespace
from pathlib import Path

import numpy as np

from facepin.core.control import ShapeControl
from facepin.core.errors import FacepinError
from facepin.core.pose import Pose
from facepin.core.shapes.measures import active, moves, out_of_range, percent
from facepin.files.work.pins_file import held_vertices
from facepin.files.work.pose_file import check_suffix, write_pose
from facepin.options import add_rig, add_solver, first_pose, open_with_bar, output_path, solver_choices
from facepin.session.solving.solving import PinSolver, snapped
from facepin.session.solving.tidying import TOLERANCE, tidied
from facepin.solvers.settings import plain_settings


def solve_options(parser: ArgumentParser) -> None:
    """Declare the options of `facepin solve`."""
    add_rig(parser)
    parser.add_argument("--pins", type=Path, required=True, metavar="FILE", help="pins file (JSON)")
    add_solver(parser, "transpose")
    parser.add_argument(
        "--start", type=Path, metavar="POSE", help="pose to start from (default: the neutral)"
    )
    parser.add_argument(
        "--out",
        type=output_path,
        metavar="POSE",
        help="write the solved pose; with several solvers, one file each",
    )


def solve(options: Namespace) -> None:
    """Do `facepin solve`: turn pins into weights."""
    choices = solver_choices(options.solver, options.settings, options.limits)
    if options.out is not None:
        check_suffix(options.out)
    rig = open_with_bar(options.rig, options.neutral)
    start = Pose(np.zeros(rig.shape_count)) if options.start is None else first_pose(rig, options.start, None)
    pins = first_pose(rig, None, options.pins).pins
    held = held_vertices(options.pins, rig)
    grabbed = frozenset(pin.vertex for pin in pins) - held
    there = {pin.vertex: pin for pin in snapped(rig, start.with_pins(pins), ShapeControl.of(rig)).pins}
    found = {}
    failures: list[FacepinError] = []
    for choice in choices:
        solver = PinSolver(rig, choice)
        # What a hand holds besides is held where it is.
        asked = tuple(there[pin.vertex] if choice.kind.grasps and pin.vertex in held else pin for pin in pins)
        try:
            solver.solve(asked, start.weights, grabbed)  # once to prepare: what is timed is a drag frame
            solved = solver.solve(asked, start.weights, grabbed)
        except FacepinError as error:
            failures.append(error)
            if len(failures) == len(choices):
                raise
            print(f"facepin: {error}", file=sys.stderr)
            continue
        found[choice.kind.key] = {
            "weights": dict(zip(rig.shape_names, solved.weights.tolist(), strict=True)),
            "pin_error": solved.pin_error,
            "out_of_range": out_of_range(solved.weights, rig.limits),
            "milliseconds": solved.seconds * 1e3,
            "settings": {**plain_settings(choice.settings), "limits": choice.keep_limits},
            "notes": dict(solved.notes),
        }
        if options.out is not None:
            several = len(choices) > 1
            path = options.out.with_stem(f"{options.out.stem}-{choice.kind.key}") if several else options.out
            write_pose(path, rig, Pose(solved.weights, pins))
    print(json.dumps({"solvers": found}, indent=2, ensure_ascii=False))


def tidy_options(parser: ArgumentParser) -> None:
    """Declare the options of `facepin tidy`."""
    add_rig(parser)
    parser.add_argument(
        "--pose", type=Path, required=True, metavar="FILE", help="pose file, with or without pins"
    )
    parser.add_argument(
        "--tolerance",
        type=float,
        default=TOLERANCE,
        metavar="PERCENT",
        help="how far a pin, or without pins any place of the face, may go, in %% of the face height "
        "(default: %(default)g)",
    )
    parser.add_argument("--json", action="store_true", help="print JSON only")
    parser.add_argument("--out", type=output_path, required=True, metavar="POSE", help="where the pose goes")


def tidy(options: Namespace) -> None:
    """Do `facepin tidy`: find fewer shapes for a pose."""
    if not 0 < options.tolerance <= 100:
        raise FacepinError(
            f"--tolerance {options.tolerance:g}: allowed is more than 0, at most 100 (percent)"
        )
    check_suffix(options.out)
    rig = open_with_bar(options.rig, options.neutral)
    pose = first_pose(rig, options.pose, None)
    control = ShapeControl.of(rig)
    weights = tidied(rig, control, pose, options.tolerance)
    found = snapped(rig, pose.with_weights(weights), control)
    vertices = [pin.vertex for pin in pose.pins] or slice(None)
    gaps = moves(rig.evaluate(weights)[vertices], rig.evaluate(pose.weights)[vertices])
    moved = percent(float(gaps.max(initial=0.0)), rig.height)
    write_pose(options.out, rig, found)
    if options.json:
        told = {
            "weights": dict(zip(rig.shape_names, weights.tolist(), strict=True)),
            "active_before": active(pose.weights),
            "active": active(weights),
            "moved_percent": moved,
        }
        print(json.dumps(told, indent=2, ensure_ascii=False))
        return
    what = "pins" if pose.pins else "the face"
    print(
        f"{active(pose.weights)} active shapes became {active(weights)}; "
        f"{what} moved by {moved:.2g} % at most"
    )
    print(f"wrote {options.out}")
