"""A framebuffer of our own, with as many samples per pixel as wanted."""

import moderngl
import numpy as np
from numpy.typing import NDArray


class Canvas:
    """Colour and depth in memory.  As large as the window, panes draw into it at their own places and one
    `resolve` brings all of them to the screen with smooth edges.
    """

    def __init__(self, ctx: moderngl.Context, samples: int = 4) -> None:
        """Samples per pixel: 0 or 1 for none, otherwise what the machine can do of it."""
        self.ctx = ctx
        self.samples = min(samples, int(ctx.max_samples)) if samples > 1 else 0
        self._drawn: moderngl.Framebuffer | None = None
        self._resolved: moderngl.Framebuffer | None = None

    @property
    def framebuffer(self) -> moderngl.Framebuffer:
        """What to draw into, after `resize`."""
        if self._drawn is None:
            raise RuntimeError("a canvas has no framebuffer before it is given a size")
        return self._drawn

    def resize(self, width: int, height: int) -> None:
        """Make the canvas this large, in pixels; its content is lost when that is a change."""
        size = (max(width, 1), max(height, 1))
        if self._drawn is not None and self._drawn.size == size:
            return
        self.release()
        self._drawn = self.ctx.framebuffer(
            [self.ctx.renderbuffer(size, 4, samples=self.samples)],
            self.ctx.depth_renderbuffer(size, samples=self.samples),
        )

    def resolve(self, target: moderngl.Framebuffer) -> None:
        """Copy the picture to a framebuffer of the same size, each pixel the mean of its samples."""
        for framebuffer in (self.framebuffer, target):  # copying obeys the scissor
            framebuffer.scissor = (0, 0, *framebuffer.size)
            framebuffer.use()
        self.ctx.copy_framebuffer(target, self.framebuffer)

    def read(self) -> NDArray[np.uint8]:
        """Return the picture, (h, w, 4) uint8, first row on top."""
        source = self.framebuffer
        if self.samples:
            if self._resolved is None:
                self._resolved = self.ctx.framebuffer([self.ctx.renderbuffer(source.size, 4)])
            self.resolve(self._resolved)
            source = self._resolved
        data = np.frombuffer(source.read(components=4, alignment=1), np.uint8)
        return data.reshape(source.height, source.width, 4)[::-1]

    def release(self) -> None:
        """Give the graphics memory back."""
        for framebuffer in (self._drawn, self._resolved):
            if framebuffer is not None:
                release_framebuffer(framebuffer)
        self._drawn = self._resolved = None


def release_framebuffer(framebuffer: moderngl.Framebuffer) -> None:
    """Give back a framebuffer with all that is attached to it."""
    # moderngl returns to the framebuffer in use after it made a new one; it must not be a deleted one.
    framebuffer.ctx.detect_framebuffer(0).use()
    attachments = [*framebuffer.color_attachments, framebuffer.depth_attachment]
    framebuffer.release()
    for attachment in attachments:
        if attachment is not None:
            attachment.release()
