"""What a picture of a face costs in each shading mode and at each level of quality."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

from facepin.core.look.camera import Viewport, frame_points
from facepin.core.look.heat import heat_scale
from facepin.core.look.shading import MODES
from facepin.core.mesh.normals import NormalField
from facepin.core.quality import LEVELS
from facepin.core.rig import Rig
from facepin.core.shapes.measures import moves

if TYPE_CHECKING:
    import moderngl
    from rich.table import Table

FRAMES = 7
"""Pictures of each kind; the first is not counted."""


@dataclass(frozen=True)
class FrameTime:
    """Median time of one kind of picture."""

    rig: str
    mode: str
    quality: str
    samples: int
    """Per pixel, as the machine does it."""
    seconds: float


def frame_times(rig: Rig, ctx: "moderngl.Context", size: tuple[int, int]) -> list[FrameTime]:
    """Draw a face as a window of that size would, wall and smooth edges and all, and take the time.

    Every picture is drawn as a whole; a drag draws anew only what moves.
    """
    from facepin.gpu.canvas import Canvases
    from facepin.gpu.framing import frame
    from facepin.gpu.pane import Overlays, draw_pane
    from facepin.gpu.scene import PaneMesh, Scene

    viewport = Viewport(0, 0, *size)
    camera = frame_points(rig.neutral, viewport.aspect)
    weights = rig.rest_weights.copy()
    weights[:1] = 1.0
    positions = rig.evaluate(weights)
    heat = (moves(positions, rig.neutral) / heat_scale(rig.height).top).astype(np.float32)
    scene, canvases = Scene(ctx, rig), Canvases(ctx)
    mesh = PaneMesh(scene)
    mesh.upload(positions, NormalField(rig).normals(positions))
    found = []
    for name, mode in MODES.items():
        over = Overlays(heat if mode.shading == "heat" else None, mode.wireframe, None, mode.shading)
        for word, level in LEVELS.items():
            canvas = canvases.of(level.samples, size)
            seconds = []
            for _ in range(FRAMES):
                began = perf_counter()
                scene.background.draw(canvas, [(viewport, camera)])
                draw_pane(canvas, frame(camera, viewport), mesh, over, fine=level.fine)
                canvas.flat()
                ctx.finish()
                seconds.append(perf_counter() - began)
            median = float(np.median(seconds[1:]))
            found.append(FrameTime(rig.name, name, word, canvas.samples, median))
    for item in (mesh, scene, canvases):
        item.release()
    return found


def frames_as_json(times: Sequence[FrameTime]) -> list[dict[str, Any]]:
    """Return one object for each kind of picture, time in seconds."""
    return [asdict(time) for time in times]


def frames_as_table(times: Sequence[FrameTime], size: tuple[int, int]) -> "Table":
    """Return what the terminal shows: a line for each face and mode, a column for each level."""
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    samples = {time.quality: time.samples for time in times}
    table = Table(
        title="A whole picture, in milliseconds (medians)",
        caption=f"{size[0]}x{size[1]} pixels; "
        + ", ".join(f"{word}: {max(count, 1)} samples" for word, count in samples.items()),
        box=SIMPLE_HEAD,
        padding=0,
    )
    table.add_column("rig", overflow="ellipsis", max_width=20, no_wrap=True)
    table.add_column("shading", no_wrap=True)
    for word in samples:
        table.add_column(word, justify="right", no_wrap=True)
    for rig in dict.fromkeys(time.rig for time in times):
        for mode in MODES:
            row = [time for time in times if (time.rig, time.mode) == (rig, mode)]
            table.add_row(rig, mode, *(f"{1e3 * time.seconds:.1f}" for time in row))
    return table
