"""A face with all that may be shown over it."""

from dataclasses import dataclass

from facepin.core.arrays import Points
from facepin.core.look.shading import Shading
from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import Framing
from facepin.gpu.ghost import GhostLayer
from facepin.gpu.heat import HeatLayer
from facepin.gpu.scene import PaneMesh, Part
from facepin.gpu.tint import TintLayer
from facepin.gpu.wires import WireLayer


@dataclass(frozen=True, eq=False)
class Overlays:
    """What a pane shows over its face, or instead of its colours."""

    heat: Points | None = None
    """(n,) float32, how far each vertex moved, in shares of the top of the heat scale: seen as colours."""
    wireframe: bool = False
    ghost: PaneMesh | None = None
    """Another pose of the same scene."""
    shading: Shading = "studio"
    """What colours the face where `heat` does not."""
    tint: Points | None = None
    """(n,) float32, 0..1: how strongly each vertex is tinted, whatever colours the face."""


BARE = Overlays()


def draw_pane(
    canvas: Canvas,
    framing: Framing,
    mesh: PaneMesh,
    overlays: Overlays = BARE,
    *,
    fine: bool,
    part: Part = "all",
    scale: float = 1.0,
) -> None:
    """Draw a face and what is shown over it into a canvas with a background.

    Parameters
    ----------
    canvas : Canvas
        Holds the depth of the face (and of the lines on it) afterwards.
    framing : Framing
        Where, and how it is seen.
    mesh : PaneMesh
        The face.
    overlays : Overlays
        What is not wanted costs nothing.
    fine : bool
        See `PaneMesh.draw`.
    part : Part
        See `PaneMesh.draw_framed`; a heat map is always drawn as a whole.
    scale : float
        Pixels per point: 2 on a HiDPI screen.
    """
    if overlays.heat is None:
        mesh.draw_framed(canvas, framing, fine=fine, shading=overlays.shading, part=part)
    else:
        heat = mesh.kept.get(lambda: HeatLayer(mesh), HeatLayer)
        mesh.restore()
        heat.upload(overlays.heat)
        heat.draw(canvas, framing)
    if overlays.tint is not None:
        tint = mesh.kept.get(lambda: TintLayer(mesh), TintLayer)
        tint.upload(overlays.tint)
        tint.draw(canvas, framing)
    if (ghost := overlays.ghost) is not None:
        ghost.kept.get(lambda: GhostLayer(ghost), GhostLayer).draw(canvas, framing)
    if overlays.wireframe:
        wires = mesh.kept.get(lambda: WireLayer(mesh), WireLayer)
        wires.draw(canvas, framing, scale, coloured=overlays.heat is None and overlays.shading == "studio")
