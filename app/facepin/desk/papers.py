"""What leaves the desk as files under names of the program's choosing: pictures."""

from collections.abc import Callable
from pathlib import Path

from facepin.core.look.camera import Camera, Viewport
from facepin.desk.stage import Stage
from facepin.files.safely.atomic import atomic_write
from facepin.gpu.framing import frame
from facepin.gpu.picture import png_bytes
from facepin.panels.view import PaneView
from facepin.session.hand.drag import DragTool


def free_name(folder: Path, name: str, suffix: str) -> Path:
    """Return a path in `folder` that is not taken, NAME-001 and so on; the folder is made."""
    folder.mkdir(parents=True, exist_ok=True)
    number = 1
    while (path := folder / f"{name}-{number:03}{suffix}").exists():
        number += 1
    return path


def picture_of(
    stage: Stage,
    view: PaneView,
    camera: Camera,
    viewport: Viewport,
    folder: Path,
    tool: DragTool | None = None,
    samples: int = 4,
) -> Callable[[], str]:
    """Draw what the active pane shows, without panels.

    Pins are in it where a `tool` says how they are held.

    Returns
    -------
    callable
        Writes it, wherever it is called, and returns what to say then.  Raises FacepinError or OSError if it
        cannot be written.
    """
    framing = frame(camera, viewport)
    image = stage.picture(
        stage.session.active, view, camera, framing.rectangle[2:], tool=tool, samples=samples
    )
    name = stage.session.rig.name

    def write() -> str:
        content = png_bytes(image)
        path = free_name(folder, name, ".png")
        atomic_write(path, content)
        return f"Saved {path}"

    return write
