"""The commands without a window: info, solve, render, export."""

import json
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from facepin.core.errors import FacepinError
from facepin.core.pose import Pose, rest_pose
from facepin.core.rig import Rig
from facepin.resources import resource
from facepin.session.solving import PinSolver, SolverChoice, choose
from facepin.solvers import SOLVERS
from facepin.solvers.settings import parse_settings, plain_settings

BUILTIN = "faces/ada.npz"


@dataclass(frozen=True)
class Command:
    """One word after `facepin`: its help, its options and what it does."""

    help: str
    add_options: Callable[[ArgumentParser], None]
    run: Callable[[Namespace], None]


def open_with_bar(path: Path | None, neutral: str | None = None) -> Rig:
    """Open a rig (the built-in face for None), with a progress bar where a person is watching."""
    from facepin.files import open_rig

    path = path or resource("assets", BUILTIN)
    if not sys.stderr.isatty():
        return open_rig(path, neutral=neutral)
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(f"Opening {path.name}", total=1.0)
        return open_rig(
            path, neutral=neutral, progress=lambda done, line: bar.update(task, completed=done, description=line)
        )


def solver_choices(keys: str, settings: list[str], keep_limits: bool) -> list[SolverChoice]:
    """Return the solvers of a comma-separated list (or "all") with `name=value` settings.

    Raises
    ------
    FacepinError
        Naming the solvers or settings that exist.
    """
    names = list(SOLVERS) if keys == "all" else [key.strip() for key in keys.split(",") if key.strip()]
    if not names:
        raise FacepinError(f"no solver was named (there are: {', '.join(SOLVERS)})")
    kinds = {name: choose(name).kind for name in names}
    try:
        parsed = parse_settings(kinds.values(), settings)
    except ValueError as error:
        raise FacepinError(str(error)) from error
    return [choose(name, parsed[name], keep_limits) for name in names]


def first_pose(rig: Rig, pose: Path | None, pins: Path | None) -> Pose:
    """Return the pose that files ask for: weights from a pose file, pins from a pins file."""
    from facepin.files.pose_file import read_pins, read_pose

    start = rest_pose(rig)
    if pose is not None:
        start, report = read_pose(pose, rig)
        if report:
            print(f"facepin: {pose.name}: {report}", file=sys.stderr)
    return start if pins is None else start.with_pins(read_pins(pins, rig))


def add_rig(parser: ArgumentParser) -> None:
    """Add RIG and --neutral."""
    parser.add_argument("rig", type=Path, metavar="RIG", help="a .glb, .gltf, .vrm, .npz or folder of .obj files")
    parser.add_argument("--neutral", metavar="NAME", help="file with the neutral in a folder of .obj files")


def add_solver(parser: ArgumentParser, default: str) -> None:
    """Add --solver, --set and --limits."""
    keys = ", ".join(SOLVERS)
    parser.add_argument(
        "--solver", default=default, metavar="KEY", help=f"{keys}; several with commas, or all (default: {default})"
    )
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        dest="settings",
        help="a setting of the solvers, e.g. alpha=0.01 or transpose.step=unit; may be repeated",
    )
    parser.add_argument("--limits", action="store_true", help="keep all weights within the limits of their shapes")


def _info_options(parser: ArgumentParser) -> None:
    add_rig(parser)
    parser.add_argument("--json", action="store_true", help="print JSON only")


def _info(options: Namespace) -> None:
    from facepin.core.topology import edge_count

    rig = open_with_bar(options.rig, options.neutral)
    deltas = rig.deltas
    memory = deltas.data.nbytes + deltas.indices.nbytes + deltas.indptr.nbytes + rig.neutral.nbytes
    facts: dict[str, Any] = {
        "name": rig.name,
        "vertices": rig.vertex_count,
        "edges": edge_count(rig),
        "faces": len(rig.face_sizes),
        "triangles": len(rig.triangles),
        "shapes": list(rig.shape_names),
        "parts": [part.name for part in rig.parts],
        "warnings": list(rig.warnings),
    }
    if options.json:
        print(json.dumps(facts, indent=2, ensure_ascii=False))
        return
    for name in ("name", "vertices", "edges", "faces", "triangles"):
        value = facts[name]
        print(f"{name:10} {value if isinstance(value, str) else format(value, ',')}")
    share = deltas.nnz / max(3 * rig.vertex_count * rig.shape_count, 1)
    print(f"{'memory':10} {memory / 1e6:.1f} MB, {share:.0%} of all deltas are not zero")
    print(f"{'height':10} {rig.height:.4g} (along y, in the file's unit)")
    print(f"{'shapes':10} {rig.shape_count}: {', '.join(rig.shape_names)}")
    print(f"{'parts':10} {len(rig.parts)}: {', '.join(part.name for part in rig.parts)}")
    for line in rig.warnings:
        print(f"{'warning':10} {line}")


def _solve_options(parser: ArgumentParser) -> None:
    add_rig(parser)
    parser.add_argument("--pins", type=Path, required=True, metavar="FILE", help="pins file (JSON)")
    add_solver(parser, "transpose")
    parser.add_argument("--start", type=Path, metavar="POSE", help="pose to start from (default: the neutral)")
    parser.add_argument(
        "--out", type=Path, metavar="POSE", help="write the solved pose; with several solvers, one file each"
    )


def _solve(options: Namespace) -> None:
    from facepin.core.measures import out_of_range
    from facepin.files.pose_file import write_pose

    choices = solver_choices(options.solver, options.settings, options.limits)
    rig = open_with_bar(options.rig, options.neutral)
    start = Pose(np.zeros(rig.shape_count)) if options.start is None else first_pose(rig, options.start, None)
    pins = first_pose(rig, None, options.pins).pins
    found = {}
    for choice in choices:
        solver = PinSolver(rig, choice)
        solver.solve(pins, start.weights)  # once to prepare: what is timed is a drag frame
        solved = solver.solve(pins, start.weights)
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


def _render_options(parser: ArgumentParser) -> None:
    add_rig(parser)
    parser.add_argument("--pose", type=Path, metavar="FILE", help="pose file (default: the neutral)")
    parser.add_argument("--size", type=_size, default=(1280, 720), metavar="WxH", help="pixels (default: 1280x720)")
    parser.add_argument("--view", choices=("front", "left", "right", "three-quarter"), default="front")
    parser.add_argument("--transparent", action="store_true", help="leave out the background")
    parser.add_argument("--out", type=Path, required=True, metavar="PNG", help="where the picture goes")


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.lower().partition("x")
    if not (width.isdecimal() and height.isdecimal() and 1 <= int(width) <= 32768 and 1 <= int(height) <= 32768):
        raise ValueError(text)
    return int(width), int(height)


def _render(options: Namespace) -> None:
    from facepin.core.camera import Camera, frame_points
    from facepin.core.normals import NormalField
    from facepin.files.atomic import atomic_write
    from facepin.gpu.picture import open_context, png_bytes, render_picture

    if options.out.suffix.lower() != ".png":
        raise FacepinError(f"{options.out.name}: pictures are written as .png, found '{options.out.suffix}'")
    rig = open_with_bar(options.rig, options.neutral)
    pose = first_pose(rig, options.pose, None)
    positions = rig.evaluate(pose.weights)
    width, height = options.size
    looking = Camera(radius=0.0).looking(options.view)
    camera = frame_points(positions, width / height, looking)
    with open_context() as ctx:
        image = render_picture(
            ctx,
            rig,
            positions,
            NormalField(rig).normals(positions),
            camera,
            (width, height),
            transparent=options.transparent,
        )
    atomic_write(options.out, png_bytes(image))


def _export_options(parser: ArgumentParser) -> None:
    add_rig(parser)
    parser.add_argument("--pose", type=Path, metavar="FILE", help="pose file (default: the neutral)")
    parser.add_argument(
        "--out", type=Path, required=True, metavar="FILE", help="the suffix is the format: .glb, .obj, .ply or .stl"
    )


def _export(options: Namespace) -> None:
    from facepin.files.formats import write_model

    rig = open_with_bar(options.rig, options.neutral)
    pose = first_pose(rig, options.pose, None)
    write_model(rig, pose.weights, options.out)


COMMANDS: dict[str, Command] = {
    "info": Command("say what is in a rig", _info_options, _info),
    "solve": Command("turn pins into weights and print them as JSON", _solve_options, _solve),
    "render": Command("draw one picture of a pose", _render_options, _render),
    "export": Command("write the posed face as a model", _export_options, _export),
}
