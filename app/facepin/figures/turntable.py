"""The command `turntable`: a pose from all round, as an animated picture or as numbered ones."""

from argparse import ArgumentParser, Namespace
from math import pi
from pathlib import Path

from facepin.core.errors import FacepinError
from facepin.core.look.camera import Camera, frame_points
from facepin.figures.compare import made_folder, progress_line
from facepin.figures.pictures import Painter
from facepin.files.animation import Animation
from facepin.files.safely.atomic import atomic_write
from facepin.options import add_rig, count, first_pose, open_with_bar, picture_size

SECONDS = 2.4
"""Of one turn."""


def add_options(parser: ArgumentParser) -> None:
    """Declare the options of `facepin turntable`."""
    add_rig(parser)
    parser.add_argument(
        "--pose", type=Path, metavar="FILE", help="pose file (default: the weights of the rig itself)"
    )
    parser.add_argument(
        "--frames", type=count, default=36, metavar="N", help="pictures of one turn (default: 36)"
    )
    parser.add_argument(
        "--size", type=picture_size, default=(480, 480), metavar="WxH", help="pixels (default: 480x480)"
    )
    parser.add_argument("--transparent", action="store_true", help="leave out the background")
    parser.add_argument(
        "--out",
        type=Path,
        required=True,
        metavar="PATH",
        help="a .png becomes an animated PNG, a name without suffix a folder of numbered ones",
    )


def run(options: Namespace) -> Path:
    """Do `facepin turntable`; return what was written."""
    from facepin.gpu.picture import open_context, png_bytes

    suffix = options.out.suffix.lower()
    if suffix not in (".png", ""):
        raise FacepinError(
            f"{options.out.name}: a turntable is an animated .png or a folder, found '{options.out.suffix}'"
        )
    rig = open_with_bar(options.rig, options.neutral)
    pose = first_pose(rig, options.pose, None)
    positions = rig.evaluate(pose.weights)
    camera = frame_points(positions[rig.drawn], options.size[0] / options.size[1], Camera(radius=0.0))
    animation = Animation()
    if not suffix:
        made_folder(options.out)
    with progress_line() as tell, open_context() as ctx:
        painter = Painter(ctx, rig, options.size)
        for number in range(options.frames):
            tell(f"Picture {number + 1} of {options.frames}")
            painter.camera = camera.orbited(2 * pi * number / options.frames, 0.0)
            image = painter.paint(positions, transparent=options.transparent)
            if suffix:
                animation.add(image)
            else:
                atomic_write(options.out / f"{number:03}.png", png_bytes(image))
        painter.release()
    if suffix:
        animation.write(options.out, SECONDS / options.frames)
    return Path(options.out)
