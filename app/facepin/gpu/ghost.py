"""Another pose that shines through: a shell of light where the face has moved away from it."""

import moderngl

from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import Framing, column_major
from facepin.gpu.lamps import LAMPS
from facepin.gpu.materials import cull_hidden
from facepin.gpu.programs import load_program
from facepin.gpu.scene import PaneMesh, Scene

CLOSE = 0.0012
"""Where the face is this near, in face heights, the shell begins to be seen."""
DEEP = 0.12
"""This far behind the face it is not seen: a chin that came forward does not show the neck."""


class GhostLook:
    """What all ghosts share."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self.depth = load_program(scene.ctx, "ghost", "DEPTH_ONLY")
        self._shells: dict[int, moderngl.Program] = {}

    def shell(self, samples: int) -> moderngl.Program:
        """Return the program for canvases with that many samples per pixel: their depth differs in type."""
        if samples not in self._shells:
            defined = (f"SAMPLES {samples}",) if samples else ()
            program = self._shells[samples] = load_program(self._scene.ctx, "ghost", *defined)
            program["depth_map"] = 0
            program["close"] = CLOSE * self._scene.rig.height
            program["deep"] = DEEP * self._scene.rig.height
            program["key"] = tuple(LAMPS[0].tolist())
        return self._shells[samples]

    def release(self) -> None:
        """Give the graphics memory back."""
        for program in (self.depth, *self._shells.values()):
            program.release()


class GhostLayer:
    """One pose as a ghost."""

    def __init__(self, mesh: PaneMesh) -> None:
        scene = mesh.scene
        self._scene = scene
        self._look = scene.kept.get(lambda: GhostLook(scene), GhostLook)
        self._position = (mesh.positions, "3f", "position")
        self._more = [(mesh.normals, "3f", "normal"), (scene.albedo, "4f2", "albedo")]
        self._depth = scene.ctx.vertex_array(self._look.depth, [self._position], scene.indices)
        self._shells: dict[int, moderngl.VertexArray] = {}

    def draw(self, canvas: Canvas, framing: Framing) -> None:
        """Draw the shell over a face that is drawn already; the depth of the canvas stays."""
        depth, shell = self._look.depth, self._look.shell(canvas.samples)
        if canvas.samples not in self._shells:
            content = [self._position, *self._more]
            array = self._scene.ctx.vertex_array(shell, content, self._scene.indices)
            self._shells[canvas.samples] = array
        for program in (depth, shell):
            program["to_view"] = column_major(framing.to_view)
            program["to_clip"] = column_major(framing.to_clip)
        shell["pixel_angle"] = framing.pixel_angle
        # Only what is nearest of the shell shines, or the head would be full of its own inside.
        framing.use(canvas.second_depth)
        canvas.second_depth.clear(depth=1.0)
        self._render(self._depth, "<")
        canvas.depth.use(0)
        framing.use(canvas.with_second_depth)
        self._scene.ctx.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        self._render(self._shells[canvas.samples], "<=", moderngl.BLEND)
        # Pins ask for the same depth next, in their vertex shader: llvmpipe does not wait for it by itself.
        self._scene.ctx.finish()

    def _render(self, array: moderngl.VertexArray, depth_func: str, *flags: int) -> None:
        ctx = self._scene.ctx
        ctx.depth_func = depth_func
        for run in self._scene.solid:
            cull_hidden(ctx, run)
            for flag in flags:
                ctx.enable(flag)
            array.render(moderngl.TRIANGLES, vertices=run.count, first=run.first)

    def release(self) -> None:
        """Give the graphics memory back."""
        for array in (self._depth, *self._shells.values()):
            array.release()
