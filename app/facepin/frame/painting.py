"""The picture under the panels: drawn where it is another than the last one."""

import moderngl

from facepin.core.camera import Viewport
from facepin.core.quality import LEVELS, Level, level
from facepin.desk.desk import Desk
from facepin.desk.stage import Stage
from facepin.gpu.background import Colour
from facepin.gpu.canvas import Canvas, Canvases, TextureMaker

SOFTWARE = ("llvmpipe", "softpipe", "swiftshader", "software", "basic render")
"""Words in the names of what draws without a graphics card."""


class Painting:
    """Keeps the last picture."""

    def __init__(self, ctx: moderngl.Context, make_texture: TextureMaker) -> None:
        self._software = _is_software(ctx)
        # A card shows any texture as fast; a processor, one that is stored as screens are.
        self._canvases = Canvases(ctx, make_texture if self._software else None)
        self._drawn: object = None
        self._flat: moderngl.Framebuffer | None = None
        self._most = max(each.samples for each in LEVELS.values())
        """Samples per pixel that there was room for."""

    def draw(
        self,
        desk: Desk,
        stage: Stage,
        viewports: tuple[Viewport, ...],
        size: tuple[int, int],
        beside: Colour,
        *,
        moving: bool,
    ) -> None:
        """Draw all panes as they are now, if they are not drawn already.

        Parameters
        ----------
        desk, stage
            What is seen, and how.
        viewports : tuple of Viewport
            One per pane.
        size : (int, int)
            Of the window, in pixels.
        beside : (r, g, b, a)
            Colour of what is outside of the panes.
        moving : bool
            Whether more pictures will follow at once, so that this one should be fast.
        """
        quality = level(desk.view.quality, software=self._software, moving=moving)
        wanted = _key(desk, stage, viewports, quality, size)
        if wanted == self._drawn:
            return
        canvas = self._canvas(desk, quality.samples, size)
        sights = list(zip(viewports, desk.cameras, strict=True))
        panes, scale = desk.view.panes, desk.pixel_scale
        stage.draw(canvas, sights, panes, desk.tool, scale, fine=quality.fine, beside=beside)
        self._drawn, self._flat = wanted, canvas.flat()

    def flat(self) -> moderngl.Framebuffer:
        """Return the last picture with one sample per pixel."""
        assert self._flat is not None, "a picture comes first"
        return self._flat

    def _canvas(self, desk: Desk, samples: int, size: tuple[int, int]) -> Canvas:
        """Return a canvas; one with less samples when the machine has no room for as many."""
        try:
            return self._canvases.of(min(samples, self._most), size)
        except moderngl.Error as error:
            if min(samples, self._most) == 0:
                raise
            self._most = 0
            desk.say(f"Edges are not smoothed: {error}", error=True)
            return self._canvases.of(0, size)

    def release(self) -> None:
        """Give the graphics memory back."""
        self._canvases.release()


def _is_software(ctx: moderngl.Context) -> bool:
    """Say whether OpenGL runs on the processor: many samples then wait until the picture rests."""
    return any(word in ctx.info["GL_RENDERER"].lower() for word in SOFTWARE)


def _key(
    desk: Desk, stage: Stage, viewports: tuple[Viewport, ...], quality: Level, size: tuple[int, int]
) -> tuple[object, ...]:
    """Return everything the picture depends on; the same key means the same picture."""
    tool = desk.tool
    overlays = tuple(pane.key for pane in desk.view.panes)
    work = stage.session.work
    hands = (tool.selected, tool.hovered, tool.held)
    seen = (quality, size, viewports, tuple(desk.cameras), desk.view.theme)
    return (stage, stage.refined, work, desk.pixel_scale, *seen, overlays, hands)
