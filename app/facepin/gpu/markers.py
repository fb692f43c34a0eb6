"""Pins as crisp markers over the face."""

from dataclasses import dataclass
from enum import IntEnum

import moderngl
import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Points
from facepin.core.camera import Camera, Viewport
from facepin.gpu.framing import Framing, column_major, frame
from facepin.gpu.programs import load_program


class MarkerState(IntEnum):
    """How a pin looks; a higher one is drawn over a lower one."""

    NORMAL = 0
    HOVERED = 1
    SELECTED = 2
    HELD = 3


@dataclass(frozen=True)
class MarkerStyle:
    """Colour (sRGB 0..1), radius (points: pixels of a plain screen) and strength of the halo (0..1)."""

    colour: tuple[float, float, float]
    radius: float
    halo: float


STYLES: dict[MarkerState, MarkerStyle] = {
    MarkerState.NORMAL: MarkerStyle((0.96, 0.97, 0.98), 5.0, 0.0),
    MarkerState.HOVERED: MarkerStyle((1.00, 1.00, 1.00), 6.0, 0.55),
    MarkerState.SELECTED: MarkerStyle((0.98, 0.62, 0.24), 6.0, 0.0),
    MarkerState.HELD: MarkerStyle((0.98, 0.62, 0.24), 6.5, 0.6),
}
"""White and the accent differ in lightness as well as in hue: told apart without colour vision."""

HIDDEN_STRENGTH = 0.3
"""Opacity of what lies behind the face."""

_VERTICES = 18
_LAYOUT = np.dtype([("position", "3f4"), ("goal", "3f4"), ("colour", "4f4"), ("radius", "f4")])


@dataclass(frozen=True, eq=False)
class Markers:
    """Pins to draw."""

    positions: Points
    """(p, 3) float32, where the pins' vertices are."""
    goals: Points
    """(p, 3) float32, where they should be."""
    states: NDArray[np.uint8]
    """(p,) values of `MarkerState`."""


class MarkerLayer:
    """Draws markers over a face that is drawn already; one for all panes."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self.ctx = ctx
        self._program = load_program(ctx, "marker")
        self._reserve(16)

    def _reserve(self, count: int) -> None:
        """Make room for `count` markers."""
        self._capacity = count
        self._instances = self.ctx.buffer(reserve=count * _LAYOUT.itemsize, dynamic=True)
        layout = (self._instances, "3f 3f 4f 1f /i", "position", "goal", "colour", "radius")
        self._quads = self.ctx.vertex_array(self._program, [layout])

    def draw(
        self,
        framebuffer: moderngl.Framebuffer,
        viewport: Viewport,
        camera: Camera,
        markers: Markers,
        *,
        scale: float = 1.0,
    ) -> None:
        """Draw markers where `PaneMesh.draw` has drawn the face: dimmed where the face hides them.

        Parameters
        ----------
        framebuffer : moderngl.Framebuffer
            Still holds the depth of the face.
        viewport, camera
            Those the face was drawn with.
        markers : Markers
            May be empty.
        scale : float
            Pixels per point: 2 on a HiDPI screen.
        """
        self.draw_framed(framebuffer, frame(camera, viewport, framebuffer.height), markers, scale=scale)

    def draw_framed(
        self, framebuffer: moderngl.Framebuffer, framing: Framing, markers: Markers, *, scale: float
    ) -> None:
        """Draw like `draw`, for a framing that may be a tile of a larger picture."""
        count = len(markers.states)
        if count == 0:
            return
        if count > self._capacity:
            self._quads.release()
            self._instances.release()
            self._reserve(2 * count)
        self._instances.write(_instances(markers))
        program = self._program
        program["to_view"] = column_major(framing.to_view)
        program["to_clip"] = column_major(framing.to_clip)
        program["rectangle"] = framing.rectangle
        program["pixel_angle"] = framing.ray_of_pixel[1]
        program["scale"] = scale
        framebuffer.depth_mask = False
        framing.use(framebuffer)
        self.ctx.enable_only(moderngl.DEPTH_TEST | moderngl.BLEND)
        self.ctx.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA  # the shader premultiplies
        for depth_func, strength in ((">", HIDDEN_STRENGTH), ("<=", 1.0)):
            self.ctx.depth_func = depth_func
            program["strength"] = strength
            self._quads.render(moderngl.TRIANGLES, vertices=_VERTICES, instances=count)
        framebuffer.depth_mask = True
        framebuffer.use()

    def release(self) -> None:
        """Give the graphics memory back."""
        for item in (self._quads, self._instances, self._program):
            item.release()


def _instances(markers: Markers) -> NDArray[np.void]:
    """Pack markers for the card, (p,), those with the highest state last, hence on top."""
    order = np.argsort(markers.states, kind="stable")
    styles = [STYLES[MarkerState(int(state))] for state in markers.states[order]]
    packed = np.zeros(len(styles), _LAYOUT)
    packed["position"] = markers.positions[order]
    packed["goal"] = markers.goals[order]
    packed["colour"] = [(*style.colour, style.halo) for style in styles]
    packed["radius"] = [style.radius for style in styles]
    return packed
