"""Pins as crisp markers over the face."""

from collections.abc import Collection
from dataclasses import dataclass
from enum import IntEnum
from math import log10

import moderngl
import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats, Points
from facepin.core.look.camera import Camera, Viewport
from facepin.core.pose import Pin, Pose
from facepin.gpu.canvas import Canvas
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

_VERTICES = 18
_LAYOUT = np.dtype(
    [("position", "3f4"), ("goal", "3f4"), ("colour", "4f4"), ("radius", "f4"), ("square", "f4")]
)


def marker_size(stiffness: float) -> float:
    """Return how many times the usual size shows how hard a pin pulls: ten times as hard, a fifth larger."""
    return min(max(1 + 0.2 * log10(stiffness), 0.6), 1.6)


@dataclass(frozen=True, eq=False)
class Markers:
    """Pins to draw."""

    positions: Points
    """(p, 3) float32, where the pins' vertices are."""
    goals: Points
    """(p, 3) float32, where they should be."""
    states: NDArray[np.uint8]
    """(p,) values of `MarkerState`."""
    sizes: Floats | None = None
    """(p,) times the usual radius; None for all as usual."""
    locked: NDArray[np.bool_] | None = None
    """(p,) which are drawn as squares; None for none."""


def pin_markers(
    pose: Pose,
    positions: Points,
    *,
    held: Collection[int] = (),
    hovered: int | None = None,
    selected: Collection[int] = (),
) -> Markers:
    """Return markers for the pins of a pose on the vertices (n, 3) as posed, without those that are hidden.

    The goal of a pin on the screen has no depth of its own: it is as deep as its vertex for the camera that
    set it, so that a pin which is met looks met from everywhere.
    Pins that are held, hovered or selected are named by their vertices.
    """

    def state(vertex: int) -> MarkerState:
        if vertex in held:
            return MarkerState.HELD
        if vertex in selected:
            return MarkerState.SELECTED
        return MarkerState.HOVERED if vertex == hovered else MarkerState.NORMAL

    pins = [pin for pin in pose.pins if not pin.hidden]
    return Markers(
        positions[[pin.vertex for pin in pins]],
        np.array([_seen_goal(pin, positions[pin.vertex]) for pin in pins], np.float32).reshape(-1, 3),
        np.array([state(pin.vertex) for pin in pins], np.uint8),
        np.array([marker_size(pin.stiffness) for pin in pins]),
        np.array([pin.locked for pin in pins], bool),
    )


def _seen_goal(pin: Pin, vertex: Floats) -> Floats:
    """Return where a goal is shown, (3,)."""
    goal = np.array(pin.goal)
    if pin.freedom == "space":
        return goal
    right, up = np.array(pin.axes)
    deep = np.cross(right, up)
    seen: Floats = goal + ((vertex - goal) @ deep) * deep
    return seen


class MarkerLayer:
    """Draws markers over a face that is drawn already; one for all panes."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self.ctx = ctx
        # Depth with several samples per pixel is another type of texture, hence another program.
        self._programs = [load_program(ctx, "marker"), load_program(ctx, "marker", "MULTISAMPLED")]
        self._reserve(16)

    def _reserve(self, count: int) -> None:
        """Make room for `count` markers."""
        self._capacity = count
        self._instances = self.ctx.buffer(reserve=count * _LAYOUT.itemsize, dynamic=True)
        names = ("position", "goal", "colour", "radius", "square")
        layout = (self._instances, "3f 3f 4f 1f 1f /i", *names)
        self._quads = [self.ctx.vertex_array(program, [layout]) for program in self._programs]

    def draw(
        self, canvas: Canvas, viewport: Viewport, camera: Camera, markers: Markers, *, scale: float = 1.0
    ) -> None:
        """Draw markers where `PaneMesh.draw` has drawn the face: dimmed where the face hides them.

        Parameters
        ----------
        canvas : Canvas
            Still holds the depth of the face.
        viewport, camera
            Those the face was drawn with.
        markers : Markers
            May be empty.
        scale : float
            Pixels per point: 2 on a HiDPI screen.
        """
        self.draw_framed(canvas, frame(camera, viewport), markers, scale=scale)

    def draw_framed(self, canvas: Canvas, framing: Framing, markers: Markers, *, scale: float) -> None:
        """Draw like `draw`, for a framing that may be a tile of a larger picture."""
        count = len(markers.states)
        if count == 0:
            return
        if count > self._capacity:
            self._give_back_room()
            self._reserve(2 * count)
        self._instances.write(_instances(markers))
        which = 1 if canvas.samples else 0
        program = self._programs[which]
        program["to_view"] = column_major(framing.to_view)
        program["to_clip"] = column_major(framing.to_clip)
        program["rectangle"] = framing.rectangle
        program["pixel_angle"] = framing.pixel_angle
        program["scale"] = scale
        program["depth_map"] = 0
        canvas.depth.use(0)
        framing.use(canvas.overlay)
        self.ctx.enable_only(moderngl.BLEND)
        self.ctx.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA  # the shader premultiplies
        self._quads[which].render(moderngl.TRIANGLES, vertices=_VERTICES, instances=count)

    def release(self) -> None:
        """Give the graphics memory back."""
        self._give_back_room()
        for program in self._programs:
            program.release()

    def _give_back_room(self) -> None:
        for quads in self._quads:
            quads.release()
        self._instances.release()


def _instances(markers: Markers) -> NDArray[np.void]:
    """Pack markers for the card, (p,), those with the highest state last, hence on top."""
    order = np.argsort(markers.states, kind="stable")
    styles = [STYLES[MarkerState(int(state))] for state in markers.states[order]]
    packed = np.zeros(len(styles), _LAYOUT)
    packed["position"] = markers.positions[order]
    packed["goal"] = markers.goals[order]
    packed["colour"] = [(*style.colour, style.halo) for style in styles]
    packed["radius"] = [style.radius for style in styles]
    if markers.sizes is not None:
        packed["radius"] *= markers.sizes[order]
    if markers.locked is not None:
        packed["square"] = markers.locked[order]
    return packed
