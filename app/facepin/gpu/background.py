"""The studio wall behind the face."""

from collections.abc import Sequence

import moderngl

from facepin.core.look.camera import Camera, Viewport
from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import Framing, frame
from facepin.gpu.programs import load_program

Colour = tuple[float, float, float, float]

POOL = (1.47, 1.67)
"""Half axes of the pool of light, in half widths and half heights of the picture."""
POOL_HEIGHT = 0.13
"""Height of its middle above the middle of the picture, in half heights."""


class Background:
    """What every picture begins with; one for all panes."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self.ctx = ctx
        self._program = load_program(ctx, "background")
        self._triangle = ctx.vertex_array(self._program, [])
        self._kept: Canvas | None = None
        self._keeps: object = None

    def draw(
        self,
        canvas: Canvas,
        sights: Sequence[tuple[Viewport, Camera]],
        beside: Colour = (0.0, 0.0, 0.0, 0.0),
    ) -> None:
        """Erase a canvas and draw the wall of every pane.

        Parameters
        ----------
        canvas : Canvas
            Has a size.
        sights : sequence of (viewport, camera)
            The panes.  Of a camera its lens matters here, not where it stands.
        beside : (r, g, b, a)
            Colour of what is outside of them.
        """
        framings = [frame(camera, viewport) for viewport, camera in sights]
        if canvas.samples:
            self.draw_framed(canvas, framings, beside)
            return
        # Copying a whole picture takes a processor a tenth of a millisecond, drawing it several.
        keeps = (canvas.size, [(framing.rectangle, framing.half_picture) for framing in framings], beside)
        if self._kept is None:
            self._kept = canvas.twin()
        if keeps != self._keeps:
            self._kept.resize(*canvas.size)
            self.draw_framed(self._kept, framings, beside)
            self._keeps = keeps
        self._kept.copy_to(canvas)

    def draw_framed(
        self, canvas: Canvas, framings: Sequence[Framing], beside: Colour = (0.0, 0.0, 0.0, 0.0)
    ) -> None:
        """Draw like `draw`, for framings that may be tiles of larger pictures."""
        canvas.clear(beside)
        for framing in framings:
            sx, sy, ox, oy = framing.ray_of_pixel
            kx, ky = 1 / (POOL[0] * framing.half_picture[0]), 1 / (POOL[1] * framing.half_picture[1])
            self._program["pool_of_pixel"] = (sx * kx, sy * ky, ox * kx, oy * ky - POOL_HEIGHT / POOL[1])
            self._program["to_whole"] = framing.to_whole
            framing.use(canvas.framebuffer)
            self.ctx.enable_only(moderngl.NOTHING)
            self._triangle.render(moderngl.TRIANGLES, vertices=3)

    def release(self) -> None:
        """Give the graphics memory back."""
        if self._kept is not None:
            self._kept.release()
        self._triangle.release()
        self._program.release()
