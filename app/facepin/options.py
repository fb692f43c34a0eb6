"""What several commands share: options, and opening what they name."""

import sys
from argparse import ArgumentParser, ArgumentTypeError
from pathlib import Path

from facepin.core.errors import FacepinError
from facepin.core.look.camera import View
from facepin.core.pose import Pose, rest_pose
from facepin.core.rig import Rig
from facepin.core.turn import Turn, parse_turn
from facepin.resources import BUILTIN, builtin_faces, resource
from facepin.session.solving.solving import SolverChoice, choose
from facepin.solvers import SOLVERS
from facepin.solvers.settings import parse_settings

VIEWS: tuple[View, ...] = ("front", "left", "right", "three-quarter")
"""From where pictures may be taken."""
LARGEST_PICTURE = 32768
MOST = 1000
"""Pictures of one series."""


def open_with_bar(path: Path | None, neutral: str | None = None, turn: Turn | None = None) -> Rig:
    """Open a rig (the built-in face for None), with a progress bar where a person is watching."""
    from facepin.files.upright import open_upright

    path = path or resource("assets", BUILTIN)
    if not sys.stderr.isatty():
        return open_upright(path, neutral=neutral, turn=turn, settings=settings_folder())
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(f"Opening {path.name}", total=1.0)
        return open_upright(
            path,
            neutral=neutral,
            turn=turn,
            settings=settings_folder(),
            progress=lambda done, line: bar.update(task, completed=done, description=line),
        )


def settings_folder() -> Path:
    """Return the folder that remembers what the user chose."""
    from platformdirs import user_config_path

    return user_config_path("facepin", appauthor=False)


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
    from facepin.files.work.pins_file import read_pins
    from facepin.files.work.pose_file import read_pose

    start = rest_pose(rig)
    if pose is not None:
        start, report = read_pose(pose, rig)
        if report:
            print(f"facepin: {pose.name}: {report}", file=sys.stderr)
    return start if pins is None else start.with_pins(read_pins(pins, rig))


def add_rig(parser: ArgumentParser) -> None:
    """Add RIG and --neutral."""
    parser.add_argument("rig", type=rig_path, metavar="RIG", help=_rig_help())
    parser.add_argument("--neutral", metavar="NAME", help="file with the neutral in a folder of .obj files")


def add_turn(parser: ArgumentParser) -> None:
    """Add --turn."""
    parser.add_argument(
        "--turn",
        type=_turn,
        metavar="TURN",
        help="how the face lies compared with its file: file, or quarter turns such as x-90 or x90,y180 "
        "(default: as it was turned in the window, else upright)",
    )


def add_view(parser: ArgumentParser) -> None:
    """Add --view."""
    parser.add_argument("--view", choices=VIEWS, default="front", help="from where (default: front)")


def _turn(text: str) -> Turn:
    try:
        return parse_turn(text)
    except ValueError as error:
        raise ArgumentTypeError(str(error)) from error


def add_rigs(parser: ArgumentParser) -> None:
    """Add one RIG or several, and --neutral."""
    parser.add_argument("rigs", type=rig_path, nargs="+", metavar="RIG", help=_rig_help())
    parser.add_argument("--neutral", metavar="NAME", help="file with the neutral in folders of .obj files")


def _rig_help() -> str:
    return f"a .glb, .gltf, .vrm, .npz or folder of .obj files; or {', '.join(builtin_faces())}"


def rig_path(text: str) -> Path:
    """Read the path of a rig, or the name of a built-in face where there is no such file."""
    path = Path(text)
    return path if path.exists() else builtin_faces().get(text, path)


def output_path(text: str) -> Path:
    """Read the path of what is to be written: it is better to know before the work than after it."""
    path = Path(text)
    if not path.name:
        raise ArgumentTypeError(f"found '{text}', allowed: the name of a file or a folder")
    if not path.parent.is_dir():
        raise ArgumentTypeError(f"found '{text}', but there is no folder {path.parent}")
    return path


def picture_size(text: str) -> tuple[int, int]:
    """Read WxH, the width and height of a picture in pixels."""
    width, _, height = text.lower().partition("x")
    if not all(side.isdecimal() and 1 <= int(side) <= LARGEST_PICTURE for side in (width, height)):
        raise ArgumentTypeError(f"found '{text}', allowed: WIDTHxHEIGHT, each 1 to {LARGEST_PICTURE}")
    return int(width), int(height)


def png_path(text: str) -> Path:
    """Read the path of a picture that is to be written."""
    output_path(text)
    if Path(text).suffix.lower() != ".png":
        raise ArgumentTypeError(f"found '{text}', allowed: a path that ends in .png")
    return Path(text)


def count(text: str) -> int:
    """Read how many of something there should be."""
    if not text.isdecimal() or not 1 <= int(text) <= MOST:
        raise ArgumentTypeError(f"found '{text}', allowed: a whole number 1 to {MOST}")
    return int(text)


def add_solver(parser: ArgumentParser, default: str, flag: str = "--solver") -> None:
    """Add --solver (or another flag for it), --set and --limits."""
    keys = ", ".join(SOLVERS)
    parser.add_argument(
        flag,
        dest="solver",
        default=default,
        metavar="KEY",
        help=f"{keys}; several with commas, or all (default: {default})",
    )
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        dest="settings",
        help="a setting of the solvers, e.g. alpha=0.01 or transpose.step=unit; may be repeated",
    )
    parser.add_argument(
        "--limits", action="store_true", help="keep all weights within the limits of their shapes"
    )
