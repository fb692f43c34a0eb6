"""What leaves the desk as files under names of the program's choosing: pictures, and poses nobody saved."""

from pathlib import Path

from facepin.core.camera import Camera, Viewport
from facepin.core.pose import Pose
from facepin.core.rig import Rig
from facepin.files.atomic import atomic_write
from facepin.files.pose_file import write_pose
from facepin.gpu.framing import frame
from facepin.gpu.picture import png_bytes
from facepin.panels.view import PaneView
from facepin.session.drag import DragTool
from facepin.stage import Stage

MOST_KEPT = 20
"""Unsaved poses that are kept; the oldest go first."""


def free_name(folder: Path, name: str, suffix: str) -> Path:
    """Return a path in `folder` that is not taken, NAME-001 and so on; the folder is made."""
    folder.mkdir(parents=True, exist_ok=True)
    number = 1
    while (path := folder / f"{name}-{number:03}{suffix}").exists():
        number += 1
    return path


def save_picture(
    stage: Stage,
    view: PaneView,
    camera: Camera,
    viewport: Viewport,
    folder: Path,
    tool: DragTool | None = None,
    samples: int = 4,
) -> Path:
    """Write what the active pane shows, without panels; return where.

    Pins are in it where a `tool` says how they are held.

    Raises
    ------
    FacepinError, OSError
        If it cannot be written.
    """
    framing = frame(camera, viewport)
    image = stage.picture(
        stage.session.active, view, camera, framing.rectangle[2:], tool=tool, samples=samples
    )
    path = free_name(folder, stage.session.rig.name, ".png")
    atomic_write(path, png_bytes(image))
    return path


def keep_pose(rig: Rig, pose: Pose, folder: Path) -> Path:
    """Write a pose that nobody saved, so that closing its rig loses nothing; return where.

    Raises
    ------
    FacepinError, OSError
        If it cannot be written.
    """
    path = free_name(folder, rig.name, ".json")
    write_pose(path, rig, pose)
    kept = sorted(folder.glob("*.json"), key=lambda file: file.stat().st_mtime_ns)
    for old in kept[:-MOST_KEPT]:
        old.unlink()
    return path
