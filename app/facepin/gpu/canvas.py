"""A framebuffer of our own, with as many samples per pixel as wanted."""

from collections.abc import Callable
from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

TextureMaker = Callable[[tuple[int, int]], moderngl.Texture]


class Canvas:
    """Colour and depth in memory, stored with the first row first.

    As large as the window, panes draw into it at their own places and one copy brings all of them to the
    screen.
    """

    def __init__(
        self, ctx: moderngl.Context, samples: int = 4, make_texture: TextureMaker | None = None
    ) -> None:
        """Make an empty canvas.

        Parameters
        ----------
        ctx : moderngl.Context
            Where it is.
        samples : int
            Per pixel: 0 or 1 for none, otherwise what the machine can do of it.
        make_texture : callable
            Makes what holds four channels of colour for a size, such as `Window.texture`, which the screen
            takes over as it is.
        """
        self.ctx = ctx
        self._make_texture = make_texture or (lambda size: ctx.texture(size, 4))
        self.samples = _samples(ctx, samples)
        self._buffers: _Buffers | None = None
        self._means: moderngl.Framebuffer | None = None
        self._second: tuple[moderngl.Framebuffer, moderngl.Framebuffer] | None = None

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        return self._made.framebuffer.size

    @property
    def framebuffer(self) -> moderngl.Framebuffer:
        """To draw the face into, with depth."""
        return self._made.framebuffer

    @property
    def alternate(self) -> moderngl.Framebuffer:
        """As `framebuffer`, the same picture and depth: drawing into one ends what goes into the other.

        A processor then begins to fill triangles while it still takes in the next ones.
        """
        return self._made.alternate

    @property
    def overlay(self) -> moderngl.Framebuffer:
        """The same picture without its depth: to draw over the face while looking at `depth`."""
        return self._made.overlay

    @property
    def depth(self) -> moderngl.Texture:
        """Depth of what is in `framebuffer`; multisampled if there are `samples`."""
        return self._made.depth

    @property
    def second_depth(self) -> moderngl.Framebuffer:
        """Depth alone, another one than that of the picture; made when first asked for."""
        return self._second_made[0]

    @property
    def with_second_depth(self) -> moderngl.Framebuffer:
        """The same picture with the second depth: to draw what does not hide behind the face."""
        return self._second_made[1]

    @property
    def _second_made(self) -> tuple[moderngl.Framebuffer, moderngl.Framebuffer]:
        if self._second is None:
            depth = self.ctx.depth_renderbuffer(self.size, samples=self.samples)
            colours = self._made.framebuffer.color_attachments
            self._second = (
                self.ctx.framebuffer(depth_attachment=depth),
                self.ctx.framebuffer(colours, depth),
            )
        return self._second

    @property
    def _made(self) -> "_Buffers":
        if self._buffers is None:
            raise RuntimeError("a canvas has nothing to draw into before it is given a size")
        return self._buffers

    def resize(self, width: int, height: int) -> None:
        """Make the canvas this large, in pixels; its content is lost when that is a change."""
        size = (max(width, 1), max(height, 1))
        if self._buffers is not None and self.size == size:
            return
        self.release()
        colour = (
            self.ctx.renderbuffer(size, 4, samples=self.samples) if self.samples else self._make_texture(size)
        )
        depth = self.ctx.depth_texture(size, samples=self.samples)
        if not self.samples:
            depth.compare_func = ""  # read as a number, not compared
        framebuffer, alternate = (self.ctx.framebuffer([colour], depth) for _ in range(2))
        self._buffers = _Buffers(framebuffer, alternate, self.ctx.framebuffer([colour]), depth)

    def twin(self) -> "Canvas":
        """Return a canvas without a size that can be copied to this one as fast as can be."""
        return Canvas(self.ctx, self.samples, self._make_texture)

    def clear(self, colour: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)) -> None:
        """Make all of the picture one colour (RGBA, transparent black), and far away."""
        self._use_all_of(self.framebuffer)
        self.framebuffer.clear(*colour, depth=1.0)

    def copy_to(self, other: "Canvas") -> None:
        """Copy picture and depth to a canvas of the same size and samples."""
        self._copy(self.framebuffer, other.framebuffer)

    def flat(self) -> moderngl.Framebuffer:
        """Return the picture with one sample per pixel, each the mean of several if there are."""
        if not self.samples:
            return self.overlay
        if self._means is None:
            self._means = self.ctx.framebuffer([self._make_texture(self.size)])
        # Not from the one with depth: depth would be copied too, or refused where its format differs.
        self._copy(self.overlay, self._means)
        return self._means

    def _copy(self, source: moderngl.Framebuffer, target: moderngl.Framebuffer) -> None:
        self._use_all_of(source)
        self._use_all_of(target)
        self.ctx.copy_framebuffer(target, source)

    def read(self) -> NDArray[np.uint8]:
        """Return the picture, (h, w, 4) uint8, first row on top."""
        source = self.flat()
        data = np.frombuffer(source.read(components=4, alignment=1), np.uint8)
        return data.reshape(source.height, source.width, 4)

    @staticmethod
    def _use_all_of(framebuffer: moderngl.Framebuffer) -> None:
        """Clearing and copying obey the scissor."""
        framebuffer.scissor = (0, 0, *framebuffer.size)
        framebuffer.use()

    def release(self) -> None:
        """Give the graphics memory back."""
        if self._second is not None:
            alone, together = self._second
            together.release()
            release_framebuffer(alone)
        if self._buffers is not None:
            leave_framebuffers(self.ctx)
            self._buffers.overlay.release()
            self._buffers.alternate.release()
            release_framebuffer(self._buffers.framebuffer)
        if self._means is not None:
            release_framebuffer(self._means)
        self._buffers = self._means = self._second = None


class Canvases:
    """One canvas for each number of samples, all of one size, made when it is first asked for."""

    def __init__(self, ctx: moderngl.Context, make_texture: TextureMaker | None = None) -> None:
        self._ctx, self._make_texture = ctx, make_texture
        self._made: dict[int, Canvas] = {}
        self._size = (0, 0)

    def of(self, samples: int, size: tuple[int, int]) -> Canvas:
        """Return the one with that many samples per pixel, as far as the machine goes, as large as `size`.

        Raises
        ------
        moderngl.Error
            When the machine has no room for it.
        """
        if size != self._size:
            self.release()  # those of other samples may not be asked for again
            self._size = size
        samples = _samples(self._ctx, samples)
        if samples not in self._made:
            canvas = Canvas(self._ctx, samples, self._make_texture)
            canvas.resize(*size)
            self._made[samples] = canvas
        return self._made[samples]

    def release(self) -> None:
        """Give the graphics memory back."""
        for canvas in self._made.values():
            canvas.release()
        self._made.clear()


def _samples(ctx: moderngl.Context, wanted: int) -> int:
    """Return how many samples per pixel there can be; 0 for one."""
    most = min(int(ctx.max_samples), int(ctx.info["GL_MAX_DEPTH_TEXTURE_SAMPLES"]))
    return min(wanted, most) if wanted > 1 and most > 1 else 0


@dataclass(frozen=True)
class _Buffers:
    """What a canvas is made of at one size."""

    framebuffer: moderngl.Framebuffer
    alternate: moderngl.Framebuffer
    overlay: moderngl.Framebuffer
    depth: moderngl.Texture


def leave_framebuffers(ctx: moderngl.Context) -> None:
    """Go back to the framebuffer of the system.

    moderngl returns to the one in use after it made a new one; that must not be one that was released.
    """
    ctx.detect_framebuffer(0).use()


def release_framebuffer(framebuffer: moderngl.Framebuffer) -> None:
    """Give back a framebuffer with all that is attached to it."""
    leave_framebuffers(framebuffer.ctx)
    attachments = [*framebuffer.color_attachments, framebuffer.depth_attachment]
    framebuffer.release()
    for attachment in attachments:
        if attachment is not None:
            attachment.release()
