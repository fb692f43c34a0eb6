"""The command `sheet`: all poses of a folder as one picture with their names, or as one picture each."""

import sys
from argparse import ArgumentParser, Namespace
from pathlib import Path

from facepin.core.errors import FacepinError
from facepin.core.saved_pose import SavedPose
from facepin.figures.compare import made_folder, progress_line
from facepin.figures.pictures import Painter
from facepin.files.safely.atomic import atomic_write
from facepin.files.work.pose_library import saved_poses
from facepin.options import VIEWS, add_rig, add_turn, count, open_with_bar, picture_size, png_path
from facepin.session.shelf import standing
from facepin.sheets import Pane, contact_columns, write_sheet


def add_options(parser: ArgumentParser) -> None:
    """Declare the options of `facepin sheet`."""
    add_rig(parser)
    add_turn(parser)
    parser.add_argument(
        "--poses", type=Path, required=True, metavar="FOLDER", help="pose files, as a library has them"
    )
    parser.add_argument(
        "--size", type=picture_size, default=(320, 360), metavar="WxH", help="of each picture (320x360)"
    )
    parser.add_argument("--columns", type=count, default=0, metavar="N", help="pictures in a row")
    parser.add_argument("--view", choices=VIEWS, default="front")
    parser.add_argument("--transparent", action="store_true", help="of --each: leave out the background")
    parser.add_argument("--each", type=Path, metavar="FOLDER", help="write a picture of each pose there too")
    parser.add_argument("--out", type=png_path, required=True, metavar="PNG", help="where the sheet goes")


def run(options: Namespace) -> list[Path]:
    """Do `facepin sheet`; return what was written."""
    from facepin.gpu.picture import open_context, png_bytes

    if not options.poses.is_dir():
        raise FacepinError(f"{options.poses}: no such folder")
    rig = open_with_bar(options.rig, options.neutral, options.turn)
    poses: dict[str, SavedPose] = {}
    for found in saved_poses(options.poses, rig):
        if isinstance(found, FacepinError):
            sys.stderr.write(f"facepin: left out: {found}\n")
            continue
        poses[found.key] = found
        if found.report:
            sys.stderr.write(f"facepin: {found.key}: {found.report}\n")
    if not poses:
        raise FacepinError(f"{options.poses}: there are no poses in this folder")
    if options.each is not None:
        made_folder(options.each)
    panes, written = [], []
    with progress_line() as tell, open_context() as ctx:
        painter = Painter(ctx, rig, options.size, options.view)
        for pose in standing(poses, {}):
            tell(pose.title)
            positions = rig.evaluate(pose.weights)
            panes.append(Pane(painter.paint(positions), pose.title, ", ".join(pose.tags)))
            if options.each is not None:
                image = painter.paint(positions, transparent=True) if options.transparent else panes[-1].image
                written.append(options.each / f"{pose.key}.png")
                atomic_write(written[-1], png_bytes(image))
        painter.release()
    columns = options.columns or contact_columns(len(panes), options.size[0] / options.size[1])
    return [write_sheet(options.out, panes, f"{rig.name}: {len(panes)} poses", columns), *written]
