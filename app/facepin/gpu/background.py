"""The studio wall behind the face."""

import moderngl

from facepin.gpu.framing import Framing
from facepin.gpu.programs import load_program

POOL = (1.47, 1.67)
"""Half axes of the pool of light, in half widths and half heights of the picture."""
POOL_HEIGHT = 0.13
"""Height of its middle above the middle of the picture, in half heights."""


class Background:
    """Fills what the face leaves empty; one for all panes."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self.ctx = ctx
        self._program = load_program(ctx, "background")
        self._triangle = ctx.vertex_array(self._program, [])

    def draw_framed(self, framing: Framing) -> None:
        """Draw behind what is in the depth buffer, into a rectangle that is in use (`Framing.use`)."""
        sx, sy, ox, oy = framing.ray_of_pixel
        kx, ky = 1 / (POOL[0] * framing.half_picture[0]), 1 / (POOL[1] * framing.half_picture[1])
        self._program["pool_of_pixel"] = (sx * kx, sy * ky, ox * kx, oy * ky - POOL_HEIGHT / POOL[1])
        self.ctx.enable_only(moderngl.DEPTH_TEST)
        self.ctx.depth_func = "<="
        self._triangle.render(moderngl.TRIANGLES, vertices=3)

    def release(self) -> None:
        """Give the graphics memory back."""
        self._triangle.release()
        self._program.release()
