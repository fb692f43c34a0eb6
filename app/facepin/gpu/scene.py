"""A rig on the graphics card, and the panes that show it in different poses."""

from dataclasses import dataclass, replace
from typing import Literal

import moderngl
import numpy as np

from facepin.core.arrays import Points
from facepin.core.camera import Camera, Viewport
from facepin.core.rig import Rig
from facepin.core.topology import DrawRun, draw_order
from facepin.gpu.background import Background
from facepin.gpu.framing import Framing, column_major, frame
from facepin.gpu.programs import load_program

CLAY = (0.70, 0.66, 0.63)
"""Base colour, sRGB, of what has no colour of its own."""

GLOSSY = 0.3
"""Roughness below which a highlight is too small to be computed at vertices."""


@dataclass(frozen=True)
class Run:
    """Neighbouring triangles that look the same and are drawn in one call."""

    first: int
    """Index of the first corner in the index buffer."""
    count: int
    tint: tuple[float, float, float]
    """Linear colour that multiplies the vertex colours."""
    roughness: float
    hidden: Literal["back", "front"] | None
    """The side that is never seen, so that triangles showing it are left out."""


class Scene:
    """What all panes of one rig share: programs, triangles, colours and materials."""

    def __init__(self, ctx: moderngl.Context, rig: Rig) -> None:
        self.ctx = ctx
        self.rig = rig
        order = draw_order(rig)
        self.runs = material_runs(rig, order.runs)
        self.indices = ctx.buffer(order.triangles)
        self.albedo = ctx.buffer(vertex_albedo(rig))
        self.fine_program = load_program(ctx, "mesh")
        self.fast_program = load_program(ctx, "mesh_fast")
        self.background = Background(ctx)

    def release(self) -> None:
        """Give the graphics memory back."""
        for item in (self.indices, self.albedo, self.fine_program, self.fast_program, self.background):
            item.release()


class PaneMesh:
    """One pose of a scene's rig: positions and normals on the graphics card."""

    def __init__(self, scene: Scene) -> None:
        size = 12 * scene.rig.vertex_count
        self.scene = scene
        self._positions = scene.ctx.buffer(reserve=size, dynamic=True)
        self._normals = scene.ctx.buffer(reserve=size, dynamic=True)
        self._uploaded: tuple[Points, Points] | None = None
        content = [
            (self._positions, "3f", "position"),
            (self._normals, "3f", "normal"),
            (scene.albedo, "4f2", "albedo"),
        ]
        self._fine = scene.ctx.vertex_array(scene.fine_program, content, scene.indices)
        self._fast = scene.ctx.vertex_array(scene.fast_program, content, scene.indices)

    def upload(self, positions: Points, normals: Points) -> bool:
        """Take over a pose; do nothing when these very arrays are there already.

        Parameters
        ----------
        positions, normals : (n, 3) float32
            Not changed afterwards by the caller; normals have any length.

        Returns
        -------
        bool
            Whether anything was sent.
        """
        sent = self._uploaded
        if sent is not None and sent[0] is positions and sent[1] is normals:
            return False
        self._positions.write(np.ascontiguousarray(positions, np.float32))
        self._normals.write(np.ascontiguousarray(normals, np.float32))
        self._uploaded = positions, normals
        return True

    def draw(
        self,
        framebuffer: moderngl.Framebuffer,
        viewport: Viewport,
        camera: Camera,
        *,
        fine: bool = True,
        background: bool = True,
    ) -> None:
        """Draw background and face into a rectangle of `framebuffer`, erasing what was there.

        Parameters
        ----------
        framebuffer : moderngl.Framebuffer
            With colour and depth, multisampled or not.
        viewport : Viewport
            Where the picture goes.
        camera : Camera
            Sees the face.
        fine : bool
            Compute light at every pixel; otherwise at the vertices of matt, closed surfaces, which is what
            keeps a drag smooth on a machine without a graphics card.
        background : bool
            Draw the studio wall; otherwise what is not the face stays transparent black.
        """
        framing = frame(camera, viewport, framebuffer.height)
        self.draw_framed(framebuffer, framing, fine=fine, background=background)

    def draw_framed(
        self, framebuffer: moderngl.Framebuffer, framing: Framing, *, fine: bool, background: bool
    ) -> None:
        """Draw like `draw`, for a framing that may be a tile of a larger picture."""
        ctx, scene = self.scene.ctx, self.scene
        framing.use(framebuffer)
        framebuffer.clear(0.0, 0.0, 0.0, 0.0, depth=1.0, viewport=framing.rectangle)
        for program in (scene.fine_program, scene.fast_program):
            program["to_view"] = column_major(framing.to_view)
            program["to_clip"] = column_major(framing.to_clip)
            program["sky"] = tuple(framing.to_view[:3, 1])
        scene.fine_program["ray_of_pixel"] = framing.ray_of_pixel
        ctx.depth_func = "<"
        ctx.front_face = "ccw"
        for run in scene.runs:
            if run.hidden is None:
                ctx.enable_only(moderngl.DEPTH_TEST)
            else:
                ctx.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
                ctx.cull_face = run.hidden
            program, mesh = scene.fine_program, self._fine
            if run.hidden is not None and run.roughness >= GLOSSY and not fine:
                program, mesh = scene.fast_program, self._fast
                program["facing"] = 1.0 if run.hidden == "back" else -1.0
            program["tint"] = run.tint
            program["roughness"] = run.roughness
            mesh.render(moderngl.TRIANGLES, vertices=run.count, first=run.first)
        if background:
            scene.background.draw_framed(framing)

    def release(self) -> None:
        """Give the graphics memory back."""
        for item in (self._fine, self._fast, self._positions, self._normals):
            item.release()


def linear(srgb: Points) -> Points:
    """Return linear light (..., 3) float32 of sRGB colours 0..1 (IEC 61966-2-1)."""
    srgb = np.clip(np.asarray(srgb, np.float32), 0, 1)
    light: Points = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4).astype(
        np.float32
    )
    return light


def vertex_albedo(rig: Rig) -> "np.ndarray[tuple[int, int], np.dtype[np.float16]]":
    """Linear vertex colours, white where the rig has none, and openness 1: (n, 4) float16."""
    albedo = np.ones((rig.vertex_count, 4), np.float16)
    if rig.colours is not None:
        albedo[:, :3] = linear(rig.colours)
    return albedo


def material_runs(rig: Rig, order: tuple[DrawRun, ...]) -> tuple[Run, ...]:
    """Join the runs of a draw order that look the same, so that a face of many parts needs few calls."""
    runs: list[Run] = []
    for piece in order:
        part = rig.parts[piece.part]
        colour = (1.0, 1.0, 1.0) if rig.colours is not None else part.colour or CLAY
        r, g, b = (float(c) for c in linear(np.array(colour, np.float32)))
        first, count = 3 * piece.triangles.start, 3 * len(piece.triangles)
        run = Run(first, count, (r, g, b), part.roughness, piece.hidden)
        if runs and replace(runs[-1], first=first, count=count) == run:
            before = runs.pop()
            run = replace(run, first=before.first, count=before.count + count)
        runs.append(run)
    return tuple(runs)
