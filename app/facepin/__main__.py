"""The command line: `facepin [RIG]` opens the window, `facepin COMMAND …` does one thing without it."""

import os

# Two BLAS threads make products of this size slower.  Has to be said before numpy is imported.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import sys
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections.abc import Sequence
from io import TextIOWrapper
from multiprocessing import freeze_support
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from facepin import __version__
from facepin.commands import COMMANDS
from facepin.core.errors import FacepinError
from facepin.files.work.scene_file import SUFFIX
from facepin.options import first_pose, rig_path, solver_choices
from facepin.resources import BUILTIN, builtin_faces

if TYPE_CHECKING:
    from facepin.session.session import Session


class _Parser(ArgumentParser):
    """Says what is wrong in one line, like every other error of the program."""

    def error(self, message: str) -> NoReturn:
        raise FacepinError(f"{message} (see {self.prog} --help)")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program; return its exit status: 0, or 2 after an error in one line on stderr."""
    if getattr(sys, "frozen", False):  # an installer's program is what its own processes start, too
        freeze_support()
    words = list(sys.argv[1:] if arguments is None else arguments)
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:  # Windows gives none to a program without a console
            nowhere = Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115  # to the very end
            setattr(sys, name, nowhere)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):  # names of shapes may be in any script, whatever the terminal's
            stream.reconfigure(encoding="utf-8", errors="backslashreplace")
    try:
        if words and words[0] in COMMANDS:
            command = COMMANDS[words[0]]
            parser = _Parser(prog=f"facepin {words[0]}", description=command.help)
            command.add_options(parser)
            command.run(parser.parse_args(words[1:]))
        else:
            if words and not words[0].startswith("-"):
                _check_rig(rig_path(words[0]))
            _window(_window_parser().parse_args(words))
        sys.stdout.flush()
    except FacepinError as error:
        print(f"facepin: {error}", file=sys.stderr)
        return 2
    except MemoryError as error:
        print(f"facepin: there is not enough memory for this: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        has_gone = isinstance(error, BrokenPipeError)  # whoever read the output
        if not has_gone:
            print(f"facepin: {error}", file=sys.stderr)
        if (output := sys.__stdout__) is not None and output is sys.stdout:
            # What is still to be flushed at exit must go somewhere.
            os.dup2(os.open(os.devnull, os.O_WRONLY), output.fileno())
        return 0 if has_gone else 2
    except KeyboardInterrupt:
        return 130
    return 0


def _window_parser() -> ArgumentParser:
    lines = [f"  {name:9} {command.help}" for name, command in COMMANDS.items()]
    parser = _Parser(
        prog="facepin",
        description="Pose a blendshape face by pinning points on it and dragging them.",
        epilog="commands (each has --help):\n" + "\n".join(lines),
        formatter_class=RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"facepin {__version__}")
    parser.add_argument(
        "rig",
        nargs="?",
        type=rig_path,
        metavar="RIG",
        help=f"face or scene to open, or one of {', '.join(builtin_faces())} (default: {Path(BUILTIN).stem})",
    )
    parser.add_argument("--neutral", metavar="NAME", help="file with the neutral in a folder of .obj files")
    parser.add_argument("--solver", metavar="KEY", help="solver to begin with (default: the last one used)")
    parser.add_argument("--compare", metavar="KEY,KEY", help="up to four solvers side by side")
    parser.add_argument("--pins", type=Path, metavar="FILE", help="pins file to begin with")
    parser.add_argument("--pose", type=Path, metavar="FILE", help="pose file to begin with")
    return parser


def _check_rig(path: Path) -> None:
    if not path.exists():
        raise FacepinError(f"'{path}' is neither a rig nor a command (commands: {', '.join(COMMANDS)})")


def _window(options: Namespace) -> None:
    """Open the window; without a display, run the demonstration instead."""
    if options.rig is not None:
        _check_rig(options.rig)
    if options.solver and options.compare:
        raise FacepinError("--solver and --compare both name solvers to begin with, allowed is one of them")
    is_scene = options.rig is not None and options.rig.suffix.lower() == SUFFIX
    own = [name for name in ("neutral", "solver", "compare", "pins", "pose") if getattr(options, name)]
    if is_scene and own:
        raise FacepinError(f"{options.rig.name} is a scene, which has its own --{' and --'.join(own)}")
    from platformdirs import user_config_path, user_pictures_path

    from facepin.files.work.preferences import read_preferences
    from facepin.session.work import MOST_PANES
    from facepin.solvers import SOLVERS

    try:
        from facepin.main_loop import Start, run
        from facepin.window import NoDisplay, Window
    except ImportError as error:  # a system without X11 has no library to link the window to
        _demonstrate(f"no window is possible here ({error})", options)
        return
    settings = user_config_path("facepin", appauthor=False)
    remembered = read_preferences(settings / "preferences.json")[0]
    usual = remembered.solver if remembered.solver in SOLVERS else "hand"
    keys = options.compare or options.solver or usual
    # Who poses a face wants one that can be made; who compares solvers wants them as they are.
    choices = solver_choices(keys, [], keep_limits=not options.compare)
    if len(choices) > MOST_PANES:
        raise FacepinError(f"{len(choices)} solvers do not fit side by side, {MOST_PANES} do: '{keys}'")
    start = Start(
        choices,
        options.rig,
        lambda rig: first_pose(rig, options.pose, options.pins),
        settings,
        user_pictures_path() / "Facepin",
        neutral=options.neutral,
        solve_first=options.pins is not None,
        chart_writer=_write_charts,
    )
    try:
        window = Window("Facepin", remembered.window)
    except NoDisplay as error:
        _demonstrate(str(error), options)
        return
    with window:
        run(window, start)


def _demonstrate(reason: str, options: Namespace) -> None:
    """Do without a window: say why, and run the demonstration.

    Raises
    ------
    FacepinError
        When something was asked for that the demonstration would not show.
    """
    if any(value is not None for value in vars(options).values()):
        raise FacepinError(f"{reason}; without one there are the commands {', '.join(COMMANDS)}")
    from facepin.figures.demonstration import demonstrate

    folder = demonstrate(Path("facepin-demonstration"))
    print(f"facepin: {reason}; the built-in demonstration was run instead: see {folder.resolve()}")


def _write_charts(session: "Session", folder: Path) -> None:
    """Write charts; what draws them is loaded when they are asked for."""
    from facepin.figures.live import write_session_charts

    write_session_charts(session, folder)


if __name__ == "__main__":
    sys.exit(main())
