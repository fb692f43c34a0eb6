"""The edges of a face as thin lines over it."""

import moderngl
import numpy as np

from facepin.core.arrays import Indices, Points
from facepin.core.mesh.outlines import outlines
from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import Framing, column_major
from facepin.gpu.materials import material
from facepin.gpu.programs import load_program
from facepin.gpu.scene import PaneMesh, Scene


class WireLook:
    """What the wireframes of all panes share."""

    def __init__(self, scene: Scene) -> None:
        rig = scene.rig
        seen = [part for part in scene.parts if material(part, rig.colours is not None) is not None]
        edges = outlines(rig, seen)
        self.program = load_program(scene.ctx, "wires")
        self.indices = scene.ctx.buffer(edges.tobytes()) if len(edges) else None
        self.spacing = scene.ctx.buffer(spacing(rig.neutral, edges))

    def release(self) -> None:
        """Give the graphics memory back."""
        for item in (self.program, self.indices, self.spacing):
            if item is not None:
                item.release()


class WireLayer:
    """The wireframe of one pane, drawn over its face."""

    def __init__(self, mesh: PaneMesh) -> None:
        scene = mesh.scene
        self._ctx = scene.ctx
        self._look = scene.kept.get(lambda: WireLook(scene), WireLook)
        content = [
            (mesh.positions, "3f", "position"),
            (mesh.normals, "3f", "normal"),
            (scene.albedo, "4f2", "albedo"),
            (self._look.spacing, "1f", "spacing"),
        ]
        self._array = scene.ctx.vertex_array(self._look.program, content, self._look.indices)

    def draw(self, canvas: Canvas, framing: Framing, scale: float, *, coloured: bool) -> None:
        """Draw the edges that the face does not hide.

        Parameters
        ----------
        canvas, framing
            Those the face was drawn with.
        scale : float
            Pixels per point.  A line is one pixel wide: thinner than a point where there are more of them,
            and then stronger.
        coloured : bool
            The face shows its own colours: lines are light where these are dark.
        """
        if self._look.indices is None:
            return
        program = self._look.program
        program["to_view"] = column_major(framing.to_view)
        program["to_clip"] = column_major(framing.to_clip)
        program["pixel_angle"] = framing.pixel_angle
        program["scale"] = scale
        program["plain"] = not coloured
        framing.use(canvas.framebuffer)
        self._ctx.enable_only(moderngl.DEPTH_TEST | moderngl.BLEND)
        self._ctx.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA  # the shader premultiplies
        # Where lines meet, one of them is enough.
        self._ctx.depth_func = "<"
        self._array.render(moderngl.LINES)

    def release(self) -> None:
        """Give the graphics memory back."""
        self._array.release()


def spacing(points: Points, edges: Indices) -> Points:
    """Mean length of the edges (e, 2) at each point (n, 3), (n,) float32; 0 where there are none."""
    start, end = edges.T
    lengths = np.linalg.norm(points[start] - points[end], axis=1)
    count, total = (np.bincount(edges.ravel(), of, len(points)) for of in (None, np.repeat(lengths, 2)))
    mean: Points = (total / np.maximum(count, 1)).astype(np.float32)
    return mean
