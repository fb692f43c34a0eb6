"""A rig on the graphics card, and the panes that show it in different poses."""

from itertools import cycle
from typing import Literal

import moderngl
import numpy as np

from facepin.core.arrays import Points
from facepin.core.look.camera import Camera, Viewport
from facepin.core.look.shading import Shading
from facepin.core.mesh.topology import draw_order
from facepin.core.rig import Rig
from facepin.gpu.background import Background
from facepin.gpu.canvas import Canvas
from facepin.gpu.eyeballs import eyes_apart
from facepin.gpu.framing import Framing, frame
from facepin.gpu.kept import Kept
from facepin.gpu.materials import Run, cull_hidden, in_two_passes, material_runs, vertex_albedo
from facepin.gpu.motion import Motion
from facepin.gpu.openness import Openness
from facepin.gpu.shaders import ProgramName, Shaders

Part = Literal["all", "moving", "still"]

BLENDING = moderngl.SRC_ALPHA, moderngl.ONE_MINUS_SRC_ALPHA, moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
"""Of colours that are not premultiplied, into a picture that is."""

BATCH = 3 * 12_000
"""Corners of what moves that a processor takes in before it begins to fill their triangles."""


class Scene:
    """What all panes of one rig share: programs, triangles, colours and materials."""

    def __init__(self, ctx: moderngl.Context, rig: Rig) -> None:
        self.ctx = ctx
        self.rig = rig
        look = eyes_apart(rig)
        self._look = look
        self.parts = look.parts
        """Those of the rig, and eyes that it does not name."""
        order = draw_order(look)
        self.triangles = order.triangles
        """(t, 3) int32, those of the rig in the order of `indices`."""
        self._order = order.runs
        self.hide(frozenset())
        self.indices = ctx.buffer(order.triangles)
        self._albedo_values = vertex_albedo(look)
        self.albedo = ctx.buffer(self._albedo_values)
        self.towards = ctx.buffer(np.zeros((rig.vertex_count, 4), np.float16))
        places = rig.texture_places
        self.places = None if places is None else ctx.buffer(np.ascontiguousarray(places))
        self.shaders = Shaders(ctx)
        self.background = Background(ctx)
        self.kept = Kept()
        """What overlays share."""
        self._openness: Openness | None = Openness(ctx, look, order, self.solid, self.indices)

    def hide(self, names: frozenset[str]) -> None:
        """Draw all parts but those of some names from now on."""
        hard, blended = in_two_passes(material_runs(self._look, self._order, names))
        self.runs: tuple[Run, ...] = hard
        """What hides what is behind it."""
        self.blended: tuple[Run, ...] = blended
        """What is drawn over that, and lets it be seen."""
        self.solid: tuple[Run, ...] = tuple(run for run in hard if run.cutout is None)
        """Those of `runs` that are not cut out of cards by a texture."""

    @property
    def refined(self) -> bool:
        """Whether `refine` has nothing left to do."""
        return self._openness is None

    def refine(self, steps: int = 4) -> bool:
        """Do some of the work that the first picture does not wait for: shade what light hardly reaches.

        To be called when nothing else is to be done, until `refined`.  A step takes a few milliseconds
        without a graphics card.

        Returns
        -------
        bool
            Whether pictures look different now.
        """
        if self._openness is None or self._openness.step(steps):
            return False
        self._albedo_values[:, 3] = self._openness.values
        self.albedo.write(self._albedo_values)
        self.towards.write(np.pad(self._openness.towards, ((0, 0), (0, 1))).astype(np.float16))
        self._openness = None
        return True

    def release(self) -> None:
        """Give the graphics memory back."""
        if self._openness is not None:
            self._openness.release()
        buffers = (self.indices, self.albedo, self.towards, self.places)
        for item in (*buffers, self.shaders, self.background, self.kept):
            if item is not None:
                item.release()


class PaneMesh:
    """One pose of a scene's rig: positions and normals on the graphics card."""

    def __init__(self, scene: Scene) -> None:
        size = 12 * scene.rig.vertex_count
        self.scene = scene
        self.positions = scene.ctx.buffer(reserve=size, dynamic=True)
        self.normals = scene.ctx.buffer(reserve=size, dynamic=True)
        self.kept = Kept()
        """What overlays need of this pane."""
        self._uploaded: tuple[Points, Points] | None = None
        self._there: Points | None = None
        """Positions on the card: those that were taken over, or these but for what `motion` has settled."""
        self._motion: tuple[tuple[Run, ...], Motion] | None = None
        """With what it sorts: other parts may be hidden since."""
        self._arrays = _Arrays(self, scene.indices)
        self._sorted: tuple[moderngl.Buffer, _Arrays] | None = None
        """The triangles as `motion` sorts them."""

    @property
    def motion(self) -> Motion:
        """What moves from picture to picture; see `StillLayer`."""
        if self._motion is None or self._motion[0] is not self.scene.runs:
            runs = self.scene.runs
            self._motion = runs, Motion(self.scene.rig, self.scene.triangles, runs)
        return self._motion[1]

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
        self._send(positions)
        self.normals.write(np.ascontiguousarray(normals, np.float32))
        self._uploaded = positions, normals
        return True

    def look(self, framing: Framing) -> None:
        """Begin anew to tell what moves from what is still, as seen here."""
        assert self._uploaded is not None, "a pose comes first"
        positions, _ = self._uploaded
        depths = positions @ -framing.to_view[2, :3] - framing.to_view[2, 3]
        self.motion.forget(framing.pixel_angle * max(float(depths.min()), 0.0))

    def follow(self) -> bool:
        """Sort the triangles of the pose that was taken over into moving and still ones; `look` comes first.

        Returns
        -------
        bool
            Whether other triangles than before are still: they have to be drawn anew.
        """
        assert self._uploaded is not None, "a pose comes first"
        positions, _ = self._uploaded
        anew = self.motion.follow(positions)
        if anew and self.motion.still:
            if self._sorted is None:
                indices = self.scene.ctx.buffer(reserve=self.scene.indices.size, dynamic=True)
                self._sorted = indices, _Arrays(self, indices)
            self._sorted[0].write(np.ascontiguousarray(self.motion.triangles))
        self._send(self.motion.settled(positions))
        return anew

    def restore(self) -> None:
        """Send the pose exactly as it was taken over, if `follow` has settled what is still."""
        if self._uploaded is not None:
            self._send(self._uploaded[0])

    def _send(self, positions: Points) -> None:
        if positions is not self._there:
            self.positions.write(np.ascontiguousarray(positions, np.float32))
            self._there = positions

    def draw(
        self,
        canvas: Canvas,
        viewport: Viewport,
        camera: Camera,
        *,
        fine: bool = True,
        shading: Shading = "studio",
    ) -> None:
        """Draw the face into a rectangle of a canvas.

        A picture begins with `Background.draw` (or `Canvas.clear`), for all panes at once.

        Parameters
        ----------
        canvas : Canvas
            Has a size.
        viewport : Viewport
            Where the picture goes.
        camera : Camera
            Sees the face.
        fine : bool
            Compute light at every pixel; otherwise at the vertices of what is not glossy, which keeps a drag
            smooth on a machine without a graphics card.
        shading : Shading
            Anything but "heat", which `HeatLayer` draws.
        """
        framing = frame(camera, viewport)
        self.draw_framed(canvas, framing, fine=fine, shading=shading)

    def draw_framed(
        self,
        canvas: Canvas,
        framing: Framing,
        *,
        fine: bool,
        shading: Shading = "studio",
        part: Part = "all",
    ) -> None:
        """Draw like `draw`, for a framing that may be a tile of a larger picture.

        Parameters
        ----------
        part : Part
            "moving" for the rest of what `StillLayer.draw` has drawn.
        """
        if part == "still" and not self.motion.still:
            return
        ctx, scene = self.scene.ctx, self.scene
        if part == "all":
            self.restore()
        framing.use(canvas.framebuffer)
        shaders = scene.shaders
        shaders.see(framing)
        ctx.depth_func = "<"
        runs, arrays = scene.runs, self._arrays
        if part != "all" and self.motion.still and self._sorted is not None:
            runs = self.motion.moving if part == "moving" else self.motion.still
            _, arrays = self._sorted
        targets = cycle((canvas.alternate, canvas.framebuffer))
        for run in runs:
            if shading == "normals" and run.cutout is not None:
                continue
            name = shaders.use(run, shading, fine=fine)
            array = arrays.of(name)
            # At a vertex it is not known which side is seen, so of sheets each side is drawn by itself.
            for piece in run.sides if name == "fast" else (run,):
                if name == "fast":
                    shaders.program(name)["facing"] = 1.0 if piece.hidden == "back" else -1.0
                cull_hidden(ctx, piece)
                for batch in run.batches(BATCH if part == "moving" else run.count):
                    if batch.start > run.first:
                        framing.use(next(targets))
                    array.render(moderngl.TRIANGLES, vertices=len(batch), first=batch.start)
        if part != "still" and shading != "normals" and scene.blended:
            self._blend(canvas, framing, shading)

    def _blend(self, canvas: Canvas, framing: Framing, shading: Shading) -> None:
        """Draw what lets be seen what is behind it, farthest part first; depth stays that of the rest."""
        ctx, scene = self.scene.ctx, self.scene
        canvas.framebuffer.depth_mask = False
        framing.use(canvas.framebuffer)
        ctx.blend_func = BLENDING  # type: ignore[assignment]  # it may have four, which its stub does not know
        for run in sorted(
            scene.blended, key=lambda run: float(framing.to_view[2, :3] @ np.array(run.middle))
        ):
            array = self._arrays.of(scene.shaders.use(run, shading, fine=True))
            for side in reversed(run.sides):  # its own far side first
                cull_hidden(ctx, side)
                ctx.enable(moderngl.BLEND)
                array.render(moderngl.TRIANGLES, vertices=side.count, first=side.first)
        canvas.framebuffer.depth_mask = True
        framing.use(canvas.framebuffer)

    def release(self) -> None:
        """Give the graphics memory back."""
        if self._sorted is not None:
            indices, arrays = self._sorted
            arrays.release()
            indices.release()
        for item in (self.kept, self._arrays, self.positions, self.normals):
            item.release()


class _Arrays:
    """Vertices with an order to draw them in, for the programs that need them."""

    def __init__(self, mesh: PaneMesh, indices: moderngl.Buffer) -> None:
        scene = mesh.scene
        self._shaders, self._indices = scene.shaders, indices
        self._content = [
            (mesh.positions, "3f", "position"),
            (mesh.normals, "3f", "normal"),
            (scene.albedo, "4f2", "albedo"),
            (scene.towards, "3f2 1x2", "towards"),
        ]
        if scene.places is not None:
            self._content.append((scene.places, "2f", "place"))
        self._made: dict[ProgramName, moderngl.VertexArray] = {}

    def of(self, name: ProgramName) -> moderngl.VertexArray:
        """Return the one for a program."""
        if name not in self._made:
            program = self._shaders.program(name)
            content = [entry for entry in self._content if entry[2] in program]
            self._made[name] = program.ctx.vertex_array(program, content, self._indices)
        return self._made[name]

    def release(self) -> None:
        """Give the graphics memory back."""
        for array in self._made.values():
            array.release()
