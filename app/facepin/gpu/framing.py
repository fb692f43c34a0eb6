"""What shaders need to know about a camera and the pixels it fills."""

from dataclasses import dataclass, replace

import moderngl
import numpy as np

from facepin.core.arrays import Floats
from facepin.core.look.camera import Camera, Viewport

Y_DOWN = np.diag([1.0, -1.0, 1.0, 1.0])
"""OpenGL counts rows from below.  Turned over, a picture begins with its first row, as windows and files want
it: without a graphics card, showing it is then a plain copy.  Front sides turn clockwise in it."""


@dataclass(frozen=True, eq=False)
class Framing:
    """A camera, and the rectangle of a framebuffer that its picture (or a tile of it) fills."""

    rectangle: tuple[int, int, int, int]
    """x, y, width, height in pixels, origin top left: canvases are stored with their first row first."""
    to_view: Floats
    """World to camera space, (4, 4)."""
    to_clip: Floats
    """Camera to clip space, (4, 4), where y points down."""
    half_picture: tuple[float, float]
    """Half the width and height of the whole picture at depth 1."""
    corner: tuple[int, int] = (0, 0)
    """Where the rectangle begins in the whole picture: not at its corner where it is a tile."""

    @property
    def to_whole(self) -> tuple[int, int]:
        """What leads from a pixel of the framebuffer to that of the whole picture."""
        return self.corner[0] - self.rectangle[0], self.corner[1] - self.rectangle[1]

    @property
    def ray_of_pixel(self) -> tuple[float, float, float, float]:
        """Scale and offset that turn gl_FragCoord.xy into x and y of the view ray at depth 1."""
        x, y, width, height = self.rectangle
        sx, sy = 2 / (width * self.to_clip[0, 0]), 2 / (height * self.to_clip[1, 1])
        ox = (self.to_clip[0, 2] - 1) / self.to_clip[0, 0] - x * sx
        oy = (self.to_clip[1, 2] - 1) / self.to_clip[1, 1] - y * sy
        return float(sx), float(sy), float(ox), float(oy)

    @property
    def pixel_angle(self) -> float:
        """Height of a pixel at depth 1."""
        return abs(self.ray_of_pixel[1])

    def use(self, framebuffer: moderngl.Framebuffer) -> None:
        """Draw into this rectangle of `framebuffer` from now on, and nowhere else."""
        framebuffer.viewport = self.rectangle
        framebuffer.scissor = self.rectangle
        framebuffer.use()


def frame(camera: Camera, viewport: Viewport) -> Framing:
    """Return the framing of a viewport (whole pixels, at least one)."""
    left, top = round(viewport.x), round(viewport.y)
    width = max(round(viewport.x + viewport.width) - left, 1)
    height = max(round(viewport.y + viewport.height) - top, 1)
    projection = camera.projection(width / height)
    return Framing(
        (left, top, width, height),
        camera.view_matrix(),
        Y_DOWN @ projection,
        (1 / projection[0, 0], 1 / projection[1, 1]),
    )


def tile(whole: Framing, x: int, y: int, width: int, height: int) -> Framing:
    """Return the framing of a piece of `whole`, for a canvas of that size."""
    _, _, full_width, full_height = whole.rectangle
    crop = np.eye(4)
    crop[0, 0], crop[1, 1] = full_width / width, full_height / height
    crop[0, 3] = (full_width - 2 * x) / width - 1
    crop[1, 3] = (full_height - 2 * y) / height - 1
    return replace(whole, rectangle=(0, 0, width, height), to_clip=crop @ whole.to_clip, corner=(x, y))


def column_major(matrix: Floats) -> tuple[float, ...]:
    """Return a matrix that acts on columns as the numbers of a uniform: column after column."""
    return tuple(matrix.T.ravel().tolist())
