"""A face coloured by how far each vertex moved."""

import moderngl
import numpy as np

from facepin.core.arrays import Points
from facepin.core.look.heat import BEYOND, heat_colours, hex_colours
from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import Framing
from facepin.gpu.lamps import sight
from facepin.gpu.materials import cull_hidden, linear
from facepin.gpu.programs import load_program
from facepin.gpu.scene import PaneMesh, Scene


class HeatLook:
    """What the heat maps of all panes share."""

    def __init__(self, scene: Scene) -> None:
        self.program = load_program(scene.ctx, "heat")
        colours = linear(np.concatenate([heat_colours(), hex_colours((BEYOND,))]).astype(np.float32))
        self.colours = scene.ctx.texture((len(colours), 1), 3, colours.tobytes(), dtype="f4")
        self.colours.filter = moderngl.NEAREST, moderngl.NEAREST
        self.program["colours"] = 0

    def release(self) -> None:
        """Give the graphics memory back."""
        self.colours.release()
        self.program.release()


class HeatLayer:
    """The heat map of one pane: drawn instead of the face in its own colours."""

    def __init__(self, mesh: PaneMesh) -> None:
        scene = mesh.scene
        self._scene = scene
        self._look = scene.kept.get(lambda: HeatLook(scene), HeatLook)
        self._heat = scene.ctx.buffer(reserve=4 * scene.rig.vertex_count, dynamic=True)
        self._uploaded: Points | None = None
        content = [
            (mesh.positions, "3f", "position"),
            (mesh.normals, "3f", "normal"),
            (scene.albedo, "4f2", "albedo"),
            (self._heat, "1f", "heat"),
        ]
        self._array = scene.ctx.vertex_array(self._look.program, content, scene.indices)

    def upload(self, heat: Points) -> None:
        """Take over how far vertices moved, (n,) float32 shares of the top of the scale."""
        if heat is not self._uploaded:
            self._heat.write(np.ascontiguousarray(heat, np.float32))
            self._uploaded = heat

    def draw(self, canvas: Canvas, framing: Framing) -> None:
        """Draw the face, with depth."""
        program = self._look.program
        sight(framing).tell(program)
        self._look.colours.use(0)
        framing.use(canvas.framebuffer)
        self._scene.ctx.depth_func = "<"
        for run in self._scene.solid:
            cull_hidden(self._scene.ctx, run)
            self._array.render(moderngl.TRIANGLES, vertices=run.count, first=run.first)

    def release(self) -> None:
        """Give the graphics memory back."""
        self._array.release()
        self._heat.release()
