"""Another pose that shines through: a shell of light where the face has moved away from it."""

import moderngl

from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import Framing, column_major
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
        ctx = scene.ctx
        self.depth = load_program(ctx, "ghost", "DEPTH_ONLY")
        # Depth with several samples per pixel is another type of texture, hence another program.
        self.plain = load_program(ctx, "ghost")
        self.multisampled = load_program(ctx, "ghost", "MULTISAMPLED")
        for program in (self.plain, self.multisampled):
            program["depth_map"] = 0
            program["close"] = CLOSE * scene.rig.height
            program["deep"] = DEEP * scene.rig.height

    def release(self) -> None:
        """Give the graphics memory back."""
        for program in (self.depth, self.plain, self.multisampled):
            program.release()


class GhostLayer:
    """One pose as a ghost."""

    def __init__(self, mesh: PaneMesh) -> None:
        scene = mesh.scene
        self._scene = scene
        self._look = scene.kept.get(lambda: GhostLook(scene), GhostLook)
        position = (mesh.positions, "3f", "position")
        more = [(mesh.normals, "3f", "normal"), (scene.albedo, "4f2", "albedo")]
        self._depth = scene.ctx.vertex_array(self._look.depth, [position], scene.indices)
        self._shells = {
            program: scene.ctx.vertex_array(program, [position, *more], scene.indices)
            for program in (self._look.plain, self._look.multisampled)
        }

    def draw(self, canvas: Canvas, framing: Framing) -> None:
        """Draw the shell over a face that is drawn already; the depth of the canvas stays."""
        look = self._look
        shell = look.multisampled if canvas.samples else look.plain
        for program in (look.depth, shell):
            program["to_view"] = column_major(framing.to_view)
            program["to_clip"] = column_major(framing.to_clip)
        shell["pixel_angle"] = framing.ray_of_pixel[1]
        if canvas.samples:
            shell["samples"] = canvas.samples
        # Only what is nearest of the shell shines, or the head would be full of its own inside.
        framing.use(canvas.second_depth)
        canvas.second_depth.clear(depth=1.0)
        self._render(self._depth, "<")
        canvas.depth.use(0)
        framing.use(canvas.with_second_depth)
        self._scene.ctx.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        self._render(self._shells[shell], "<=", moderngl.BLEND)

    def _render(self, array: moderngl.VertexArray, depth_func: str, *flags: int) -> None:
        ctx = self._scene.ctx
        ctx.depth_func = depth_func
        for run in self._scene.runs:
            cull_hidden(ctx, run)
            for flag in flags:
                ctx.enable(flag)
            array.render(moderngl.TRIANGLES, vertices=run.count, first=run.first)

    def release(self) -> None:
        """Give the graphics memory back."""
        for array in (self._depth, *self._shells.values()):
            array.release()
