"""The commands without a window: all by name, and info, render and export themselves."""

import json
from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from facepin.core.errors import FacepinError
from facepin.core.look.shading import MODES
from facepin.options import (
    VIEWS,
    add_rig,
    add_turn,
    first_pose,
    open_with_bar,
    output_path,
    picture_size,
    png_path,
)
from facepin.solve_commands import solve, solve_options, tidy, tidy_options

MOST_SUPERSAMPLING = 8
"""How many times larger a picture may be drawn than it becomes."""


@dataclass(frozen=True)
class Command:
    """One word after `facepin`: its help, its options and what it does."""

    help: str
    add_options: Callable[[ArgumentParser], None]
    run: Callable[[Namespace], None]


def _info_options(parser: ArgumentParser) -> None:
    add_rig(parser)
    parser.add_argument("--json", action="store_true", help="print JSON only")


def _info(options: Namespace) -> None:
    from facepin.core.mesh.topology import edge_count

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
        "combinations": len(rig.combinations),
        "parts": [part.name for part in rig.parts],
        "warnings": list(rig.warnings),
    }
    if options.json:
        print(json.dumps(facts, indent=2, ensure_ascii=False))
        return
    for name in ("name", "vertices", "edges", "faces", "triangles"):
        value = facts[name]
        print(f"{name:10} {value if isinstance(value, str) else format(value, ',')}")
    share = deltas.nnz / max(deltas.shape[0] * deltas.shape[1], 1)
    print(f"{'memory':10} {memory / 1e6:.1f} MB, {share:.0%} of all deltas are not zero")
    print(f"{'height':10} {rig.height:.4g} (along y, in the file's unit)")
    print(f"{'shapes':10} {rig.shape_count}: {', '.join(rig.shown_names)}")
    if len(rig.combinations):
        print(f"{'combined':10} {len(rig.combinations)}: {', '.join(rig.combination_names)}")
    print(f"{'parts':10} {len(rig.parts)}: {', '.join(part.name for part in rig.parts)}")
    for line in rig.warnings:
        print(f"{'warning':10} {line}")


def _render_options(parser: ArgumentParser) -> None:
    add_rig(parser)
    add_turn(parser)
    parser.add_argument(
        "--pose", type=Path, metavar="FILE", help="pose file (default: the weights of the rig itself)"
    )
    parser.add_argument(
        "--size", type=picture_size, default=(1280, 720), metavar="WxH", help="pixels (default: 1280x720)"
    )
    parser.add_argument("--view", choices=VIEWS, default="front")
    parser.add_argument("--shading", choices=MODES, default="studio", help="how the face is coloured")
    parser.add_argument("--pins-shown", action="store_true", help="draw the pins of the pose file too")
    parser.add_argument("--transparent", action="store_true", help="leave out the background")
    parser.add_argument(
        "--supersampling",
        type=int,
        choices=range(1, MOST_SUPERSAMPLING + 1),
        default=1,
        metavar="N",
        help=f"draw N times larger both ways and average, 1 to {MOST_SUPERSAMPLING} (default: 1)",
    )
    parser.add_argument(
        "--scale",
        type=float,
        default=1.0,
        metavar="X",
        help="size of pins and edges; 2 looks like a HiDPI screen (default: 1)",
    )
    parser.add_argument("--out", type=png_path, required=True, metavar="PNG", help="where the picture goes")


def _render(options: Namespace) -> None:
    from facepin.core.look.camera import Camera, frame_points
    from facepin.core.look.heat import heat_scale
    from facepin.core.mesh.normals import NormalField
    from facepin.core.shapes.measures import moves
    from facepin.files.safely.atomic import atomic_write
    from facepin.gpu.markers import pin_markers
    from facepin.gpu.picture import open_context, png_bytes, render_picture

    if not 0.1 <= options.scale <= 100:
        raise FacepinError(f"--scale {options.scale:g}: allowed are 0.1 to 100")
    rig = open_with_bar(options.rig, options.neutral, options.turn)
    pose = first_pose(rig, options.pose, None)
    positions = rig.evaluate(pose.weights)
    width, height = options.size
    looking = Camera(radius=0.0).looking(options.view)
    camera = frame_points(positions[rig.head], width / height, looking)
    mode = MODES[options.shading]
    heat = None
    if mode.shading == "heat":
        heat = (moves(positions, rig.neutral) / heat_scale(rig.height).top).astype(np.float32)
    with open_context() as ctx:
        image = render_picture(
            ctx,
            rig,
            positions,
            NormalField(rig).normals(positions),
            camera,
            (width, height),
            transparent=options.transparent,
            supersampling=options.supersampling,
            heat=heat,
            wireframe=mode.wireframe,
            shading=mode.shading,
            scale=options.scale,
            markers=pin_markers(pose, positions) if options.pins_shown else None,
        )
    atomic_write(options.out, png_bytes(image))
    print(options.out)


def _export_options(parser: ArgumentParser) -> None:
    add_rig(parser)
    parser.add_argument(
        "--pose", type=Path, metavar="FILE", help="pose file (default: the weights of the rig itself)"
    )
    parser.add_argument(
        "--out",
        type=output_path,
        required=True,
        metavar="FILE",
        help="the suffix is the format: .glb, .obj, .ply or .stl",
    )


def _export(options: Namespace) -> None:
    from facepin.files.formats import write_model

    rig = open_with_bar(options.rig, options.neutral)
    pose = first_pose(rig, options.pose, None)
    write_model(rig, pose.weights, options.out)
    print(options.out)


def _compare_options(parser: ArgumentParser) -> None:
    from facepin.figures import compare

    compare.add_options(parser)


def _compare(options: Namespace) -> None:
    from facepin.figures import compare

    print(*compare.run(options), sep="\n")


def _study_options(parser: ArgumentParser) -> None:
    from facepin.figures.study import command

    command.add_options(parser)


def _study(options: Namespace) -> None:
    from facepin.figures.study import command

    command.run(options)


def _bench_options(parser: ArgumentParser) -> None:
    from facepin.figures.bench import command as bench

    bench.add_options(parser)


def _bench(options: Namespace) -> None:
    from facepin.figures.bench import command as bench

    bench.run(options)


def _figures_options(parser: ArgumentParser) -> None:
    from facepin.figures.paper import command as paper

    paper.add_options(parser)


def _figures(options: Namespace) -> None:
    from facepin.figures.paper import command as paper

    print(paper.run(options))


def _sheet_options(parser: ArgumentParser) -> None:
    from facepin.figures import contact

    contact.add_options(parser)


def _sheet(options: Namespace) -> None:
    from facepin.figures import contact

    print(*contact.run(options), sep="\n")


def _turntable_options(parser: ArgumentParser) -> None:
    from facepin.figures import turntable

    turntable.add_options(parser)


def _turntable(options: Namespace) -> None:
    from facepin.figures import turntable

    print(turntable.run(options))


def _movie_options(parser: ArgumentParser) -> None:
    from facepin.figures import movie

    movie.add_options(parser)


def _movie(options: Namespace) -> None:
    from facepin.figures import movie

    print(movie.run(options))


COMMANDS: dict[str, Command] = {
    "info": Command("say what is in a rig", _info_options, _info),
    "solve": Command("turn pins into weights and print them as JSON", solve_options, solve),
    "tidy": Command("find the fewest shapes that keep a pose as it is", tidy_options, tidy),
    "render": Command("draw one picture of a pose", _render_options, _render),
    "sheet": Command("draw all poses of a folder on one sheet", _sheet_options, _sheet),
    "turntable": Command("draw a pose from all round, animated", _turntable_options, _turntable),
    "movie": Command("draw pins being dragged and the face following, animated", _movie_options, _movie),
    "compare": Command("put solvers side by side: pictures, charts, poses", _compare_options, _compare),
    "study": Command("let a simulated animator pose or drag faces with every solver", _study_options, _study),
    "bench": Command("measure what a press and a drag frame cost", _bench_options, _bench),
    "figures": Command("remake the paper's figures and tables on a page", _figures_options, _figures),
    "export": Command("write the posed face as a model", _export_options, _export),
}
