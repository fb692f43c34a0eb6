"""Colour over a face where something is the case: the skin below stays to be seen."""

import moderngl
import numpy as np

from facepin.core.arrays import Points
from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import Framing, column_major
from facepin.gpu.lamps import sight
from facepin.gpu.materials import cull_hidden
from facepin.gpu.programs import load_program
from facepin.gpu.scene import PaneMesh, Scene


class TintLook:
    """What the tints of all panes share."""

    def __init__(self, scene: Scene) -> None:
        self.program = load_program(scene.ctx, "tint")

    def release(self) -> None:
        """Give the graphics memory back."""
        self.program.release()


class TintLayer:
    """The tint of one pane, drawn over its face."""

    def __init__(self, mesh: PaneMesh) -> None:
        scene = mesh.scene
        self._scene = scene
        self._look = scene.kept.get(lambda: TintLook(scene), TintLook)
        self._shares = scene.ctx.buffer(reserve=4 * scene.rig.vertex_count, dynamic=True)
        self._uploaded: Points | None = None
        content = [
            (mesh.positions, "3f", "position"),
            (mesh.normals, "3f", "normal"),
            (self._shares, "1f", "share"),
        ]
        self._array = scene.ctx.vertex_array(self._look.program, content, scene.indices)

    def upload(self, shares: Points) -> None:
        """Take over how strong the tint is at every vertex, (n,) float32 from 0 to 1."""
        if shares is not self._uploaded:
            self._shares.write(np.ascontiguousarray(shares, np.float32))
            self._uploaded = shares

    def draw(self, canvas: Canvas, framing: Framing) -> None:
        """Lay the colour over a face that is drawn already."""
        program, ctx = self._look.program, self._scene.ctx
        sight(framing).tell(program)
        program["to_view"] = column_major(framing.to_view)
        program["to_clip"] = column_major(framing.to_clip)
        program["pixel_angle"] = framing.pixel_angle
        framing.use(canvas.framebuffer)
        ctx.depth_func = "<"
        ctx.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA  # the shader premultiplies
        for run in self._scene.solid:
            cull_hidden(ctx, run)
            ctx.enable(moderngl.BLEND)
            self._array.render(moderngl.TRIANGLES, vertices=run.count, first=run.first)

    def release(self) -> None:
        """Give the graphics memory back."""
        self._array.release()
        self._shares.release()
