"""What leaves the desk as files under names of the program's choosing: pictures."""

from pathlib import Path

from facepin.core.camera import Camera, Viewport
from facepin.files.atomic import atomic_write
from facepin.gpu.picture import draw_picture, png_bytes
from facepin.panels.view import PaneView
from facepin.stage import Stage


def free_name(folder: Path, name: str, suffix: str) -> Path:
    """Return a path in `folder` that is not taken, NAME-001 and so on; the folder is made."""
    folder.mkdir(parents=True, exist_ok=True)
    number = 1
    while (path := folder / f"{name}-{number:03}{suffix}").exists():
        number += 1
    return path


def save_picture(stage: Stage, view: PaneView, camera: Camera, viewport: Viewport, folder: Path) -> Path:
    """Write what the active pane shows, without pins and panels; return where.

    Raises
    ------
    FacepinError, OSError
        If it cannot be written.
    """
    while not stage.refined:
        stage.refine()
    active = stage.session.active
    size = (max(round(viewport.width), 1), max(round(viewport.height), 1))
    image = draw_picture(stage.mesh(active), camera, size, overlays=stage.overlays(active, view))
    path = free_name(folder, stage.session.rig.name, ".png")
    atomic_write(path, png_bytes(image))
    return path
