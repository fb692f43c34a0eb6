"""The picture under the panels: drawn where it is another than the last one."""

import moderngl

from facepin.core.look.camera import Camera, Viewport
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
        self._rest: Canvas | None = None
        """Without a graphics card: the last faces that rested, without pins."""
        self._resting: object = None
        """What these faces depend on."""
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
        faces, tool = _key(desk, stage, viewports, quality, size), desk.tool
        hands = (tool.selected, tool.hovered, tool.held)
        if self._drawn == (faces, hands):
            return
        canvas = self._canvas(desk, quality.samples, size)
        sights = list(zip(viewports, cameras_of(desk, stage), strict=True))
        if self._rest is not None and self._resting == faces:
            self._rest.copy_to(canvas)
            stage.rest()
        else:
            panes, scale = [*desk.view.panes, desk.view.reference], desk.pixel_scale
            stage.draw(canvas, sights, panes, scale, fine=quality.fine, beside=beside)
            if self._software and quality.fine and not moving:
                self._keep(canvas, faces)
        stage.draw_pins(canvas, sights, tool, desk.pixel_scale)
        self._drawn, self._flat = (faces, hands), canvas.flat()

    def _keep(self, canvas: Canvas, faces: object) -> None:
        """Keep faces that rest: a processor takes long for them, and the mouse passes over pins often."""
        if self._rest is None or self._rest.samples != canvas.samples:
            self._let_go()
            self._rest = canvas.twin()
        try:
            self._rest.resize(*canvas.size)
        except moderngl.Error:  # no room: then they are drawn anew each time
            self._let_go()
            return
        canvas.copy_to(self._rest)
        self._resting = faces

    def _let_go(self) -> None:
        if self._rest is not None:
            self._rest.release()
        self._rest = self._resting = None

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
        self._let_go()
        self._canvases.release()


def cameras_of(desk: Desk, stage: Stage) -> list[Camera]:
    """Return a camera for each pane of the stage: the reference is seen as the active pane is."""
    return [*desk.cameras, *[desk.camera] * stage.shows_reference]


def _is_software(ctx: moderngl.Context) -> bool:
    """Say whether OpenGL runs on the processor: many samples then wait until the picture rests."""
    return any(word in ctx.info["GL_RENDERER"].lower() for word in SOFTWARE)


def _key(
    desk: Desk, stage: Stage, viewports: tuple[Viewport, ...], quality: Level, size: tuple[int, int]
) -> tuple[object, ...]:
    """Return everything that faces depend on; the same key means the same picture but for the pins."""
    overlays = tuple(pane.key for pane in (*desk.view.panes, desk.view.reference))
    work = stage.session.work
    seen = (quality, size, viewports, tuple(cameras_of(desk, stage)), desk.view.theme)
    return (stage, stage.refined, work, desk.pixel_scale, *seen, overlays)
