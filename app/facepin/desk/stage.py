"""The open rig as it is shown: for each pane its positions, normals and mesh on the graphics card."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from threading import Thread
from time import perf_counter

import moderngl
import numpy as np

from facepin.core.arrays import Floats, Indices, Points, frozen
from facepin.core.control import ShapeControl
from facepin.core.look.alpha import Presence
from facepin.core.look.camera import Camera, Viewport
from facepin.core.mesh.normals import NormalField
from facepin.core.mesh.picking import Hit, pick
from facepin.core.pose import Pose
from facepin.core.rig import Rig
from facepin.core.shapes.answering import answering
from facepin.core.shapes.deform import Deformer
from facepin.core.shapes.places import Places, find_places
from facepin.gpu.background import Colour
from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import Framing, frame
from facepin.gpu.markers import MarkerLayer, Markers, pin_markers
from facepin.gpu.materials import material
from facepin.gpu.pane import BARE, Overlays, draw_pane
from facepin.gpu.picture import Image, draw_picture
from facepin.gpu.scene import PaneMesh, Part, Scene
from facepin.gpu.still import StillLayer
from facepin.panels.view import Ghost, PaneView
from facepin.session.appraisal import Appraisal, Appraiser
from facepin.session.hand.drag import DragTool
from facepin.session.heat import HeatGauge
from facepin.session.session import Session
from facepin.session.work import Pane, Work


@dataclass(eq=False)
class _Shown:
    """What one pane shows; `control` is None for the reference, of which nothing is muted."""

    deformer: Deformer
    normals: NormalField
    mesh: PaneMesh
    gauge: HeatGauge
    weights: Floats | None = None
    control: ShapeControl | None = None
    positions: Points | None = None
    appraised: tuple[Work, Appraisal] | None = None
    """The last appraisal, and what it was of."""


@dataclass(frozen=True, eq=False)
class _Shell:
    """A pose that shines through."""

    weights: Floats | None
    """None for the neutral."""
    mesh: PaneMesh


class Stage:
    """Follows the poses of a session; draws them."""

    def __init__(self, ctx: moderngl.Context, session: Session) -> None:
        self.session = session
        self.scale = 1.0
        """Pixels per pixel of a 1x screen, as last drawn."""
        self.with_reference = False
        """Whether the reference, if there is one, has a pane of its own after the others."""
        self.seconds = 0.0
        """Time of the last deformation with normals and upload, all panes."""
        self._scene = Scene(ctx, session.rig)
        self._still = StillLayer(self._scene)
        self._markers = MarkerLayer(ctx)
        self.hide(frozenset())
        self._appraiser = Appraiser(session.rig)
        self._shells: dict[Ghost, _Shell] = {}
        self._sitter: PaneMesh | None = None
        """For portraits."""
        rig = session.rig
        self._shown = [_Shown(Deformer(rig), NormalField(rig), PaneMesh(self._scene), HeatGauge(rig))]
        # So that the first press need not wait for what a hand asks of a face.
        Thread(target=_get_ready, args=(rig,), name="get ready for a hand", daemon=True).start()
        self.update()

    def hide(self, names: frozenset[str]) -> None:
        """Show all parts but those of some names from now on: what is not drawn can't be pressed."""
        rig = self.session.rig
        self._scene.hide(names)
        self._still.forget()
        shown = [
            part
            for part in self._scene.parts
            if part.name not in names and material(part, rig.colours is not None) is not None
        ]
        self.present = Presence(rig, shown)
        """Tells where what is drawn can be pressed: not where it is cut out, nor where it is clear."""
        self.triangles: Indices = frozen(self.present.triangles, np.int32)
        """(t, 3) what is drawn, hence what can be pressed."""

    @cached_property
    def places(self) -> Places:
        """What the places of the face are called."""
        return find_places(self.session.rig)

    @property
    def panes(self) -> tuple[Pane, ...]:
        """What is shown side by side: the panes of the session, and maybe the reference.

        The reference has no pins, and moves from where the last drag of the active pane began.
        """
        session = self.session
        if not self.shows_reference:
            return session.panes
        reference = session.work.reference
        assert reference is not None, "it is shown"
        return (*session.panes, replace(session.pane, pose=Pose(reference), solved=None))

    @property
    def shows_reference(self) -> bool:
        """Whether the last of `panes` is the reference."""
        return self.with_reference and self.session.work.reference is not None

    @property
    def refined(self) -> bool:
        """Whether `refine` has nothing left to do."""
        return self._scene.refined

    def refine(self) -> bool:
        """Do some of the work that makes pictures better, some milliseconds; return whether they look new."""
        return self._scene.refine()

    def update(self) -> bool:
        """Deform what has new weights and send it to the graphics card; return whether anything had."""
        began = perf_counter()
        panes, control, own = self.panes, self.session.control, len(self.session.panes)
        for _ in range(len(self._shown), len(panes)):
            first = self._shown[0]
            mesh, gauge = PaneMesh(self._scene), HeatGauge(self.session.rig)
            self._shown.append(_Shown(first.deformer.twin(), first.normals.twin(), mesh, gauge))
        changed = False
        for at, (shown, pane) in enumerate(zip(self._shown, panes, strict=False)):
            weights, heard = pane.pose.weights, control if at < own else None
            if weights is shown.weights and heard is shown.control:
                continue
            shown.weights, shown.control = weights, heard
            positions = shown.deformer.deform(weights if heard is None else heard.heard(weights))
            if positions is not shown.positions:
                shown.positions = positions
                shown.mesh.upload(positions, shown.normals.normals(positions))
                changed = True
        if changed:
            self.seconds = perf_counter() - began
        return changed

    def positions(self, pane: int) -> Points:
        """Vertices (n, 3) of a pane as last drawn."""
        positions = self._shown[pane].positions
        assert positions is not None, "update() fills this"
        return positions

    def hit(self, pane: int, camera: Camera, viewport: Viewport, pixel: tuple[float, float]) -> Hit | None:
        """Return where the ray through a pixel of a pane meets the face, or None."""
        return pick(self.positions(pane), self.triangles, camera, viewport, pixel, present=self.present)

    def vertex_under(
        self, pane: int, camera: Camera, viewport: Viewport, pixel: tuple[float, float]
    ) -> int | None:
        """Return the vertex of a pane that a press at a pixel would pin, or None."""
        hit = self.hit(pane, camera, viewport, pixel)
        return None if hit is None else hit.vertex

    def appraise(self, pane: int) -> Appraisal:
        """Measure a pane's pose as it is shown."""
        work, shown = self.session.work, self._shown[pane]
        if shown.appraised is None or shown.appraised[0] is not work:
            found = self._appraiser.appraise(
                self.panes[pane], work.control, self.positions(pane), work.reference
            )
            shown.appraised = work, found
        return shown.appraised[1]

    def mesh(self, pane: int) -> PaneMesh:
        """The mesh of a pane."""
        return self._shown[pane].mesh

    def picture(
        self,
        pane: int,
        view: PaneView,
        camera: Camera,
        size: tuple[int, int],
        *,
        tool: DragTool | None = None,
        samples: int = 4,
    ) -> Image:
        """Return what a pane shows when it rests, (h, w, 4) uint8, with fine light and its shading refined.

        Parameters
        ----------
        pane, view, camera
            As for `draw`.
        size : (int, int)
            Width and height in pixels, any.
        tool : DragTool
            Whose pins are drawn too; no pins without one.
        samples : int
            Per pixel.
        """
        while not self.refined:
            self.refine()

        def pins(canvas: Canvas, framing: Framing, scale: float) -> None:
            if tool is not None:
                markers = _markers(self.session.panes[pane].pose, self.positions(pane), tool)
                self._markers.draw_framed(canvas, framing, markers, scale=scale)

        return draw_picture(
            self.mesh(pane),
            camera,
            size,
            samples=samples,
            overlays=self.overlays(pane, view),
            scale=self.scale,
            overlay=pins,
        )

    def overlays(self, pane: int, view: PaneView) -> Overlays:
        """Return what `view` shows over the face of a pane; measures and uploads only what it asks for."""
        work, shown = self.session.work, self._shown[pane]
        heat = None
        if view.reach:
            heat = shown.gauge.reach(work.panes[pane])
        elif view.shading == "heat":
            heat = shown.gauge.heat(self.panes[pane], work.control, self.positions(pane))
        tint = None if view.shape is None else shown.gauge.shape(view.shape)
        return Overlays(heat, view.wireframe, self._ghost_of(view), view.shading, tint)

    def portrait(
        self,
        pose: Pose,
        camera: Camera,
        size: tuple[int, int],
        over: PaneView | None = None,
        *,
        pins: bool = False,
        scale: float = 1.0,
        transparent: bool = False,
    ) -> Image:
        """Return a picture of a pose that no pane need show, (h, w, 4) uint8, first row on top.

        Parameters
        ----------
        pose : Pose
            On the rig of the session.
        camera : Camera
            Sees it.
        size : (int, int)
            Width and height in pixels.
        over : PaneView
            Shading, wireframe and ghost as in a pane; studio for a heat map, since no drag led here.
        pins : bool
            Draw the pins too.
        scale : float
            Pixels per pixel of a 1x screen.
        transparent : bool
            Leave out the background.
        """
        if self._sitter is None:
            self._sitter = PaneMesh(self._scene)
        positions = self.session.rig.evaluate(pose.weights)
        self._sitter.upload(positions, self._shown[0].normals.twin().normals(positions))
        overlays = BARE
        if over is not None:
            shading = "studio" if over.shading == "heat" else over.shading
            overlays = Overlays(None, over.wireframe, self._ghost_of(over), shading)
        markers = _markers(pose, positions, DragTool())

        def draw_pins(canvas: Canvas, framing: Framing, scale: float) -> None:
            self._markers.draw_framed(canvas, framing, markers, scale=scale)

        return draw_picture(
            self._sitter,
            camera,
            size,
            transparent=transparent,
            overlays=overlays,
            scale=scale,
            overlay=draw_pins if pins and pose.pins else None,
        )

    def _ghost_of(self, view: PaneView) -> PaneMesh | None:
        """Return the ghost that a pane shows, if any."""
        reference = self.session.work.reference
        if view.ghost == "neutral" or (view.ghost == "reference" and reference is not None):
            return self._ghost(view.ghost, None if view.ghost == "neutral" else reference)
        return None

    def _ghost(self, kind: Ghost, weights: Floats | None) -> PaneMesh:
        """Return the mesh of a ghost, with the pose of `weights`; None is the neutral."""
        shell = self._shells.get(kind)
        if shell is None or shell.weights is not weights:
            mesh = shell.mesh if shell else PaneMesh(self._scene)
            rig = self.session.rig
            positions = rig.neutral if weights is None else rig.evaluate(weights)
            mesh.upload(positions, self._shown[0].normals.twin().normals(positions))
            shell = self._shells[kind] = _Shell(weights, mesh)
        return shell.mesh

    def draw(
        self,
        canvas: Canvas,
        sights: Sequence[tuple[Viewport, Camera]],
        overlays: Sequence[PaneView],
        scale: float,
        *,
        fine: bool,
        beside: Colour,
    ) -> None:
        """Draw the face of every pane.

        Parameters
        ----------
        canvas : Canvas
            What to draw into.
        sights : sequence of (viewport, camera)
            Where each pane is and how it is seen.
        overlays : sequence of PaneView
            What each pane shows over its face.
        scale : float
            Pixels per pixel of a 1x screen.
        fine : bool
            Slower where a processor does the drawing.
        beside : (r, g, b, a)
            Colour of what is outside of the panes.
        """
        self.scale = scale
        if fine or canvas.samples:
            self._still.forget()
            self._scene.background.draw(canvas, sights, beside)
            part: Part = "all"
        else:
            faces = [
                None if view.measured else (self.mesh(at), view.shading)
                for at, view in enumerate(overlays[: len(sights)])
            ]
            self._still.draw(canvas, sights, faces, beside)
            part = "moving"
        for at, (viewport, camera) in enumerate(sights):
            over = self.overlays(at, overlays[at])
            mesh = self._shown[at].mesh
            draw_pane(canvas, frame(camera, viewport), mesh, over, fine=fine, part=part, scale=scale)

    def rest(self) -> None:
        """Do not draw the faces again as they rest: with the next drag other triangles may move."""
        self._still.forget()

    def draw_pins(
        self, canvas: Canvas, sights: Sequence[tuple[Viewport, Camera]], tool: DragTool, scale: float
    ) -> None:
        """Draw the pins of every pane over their faces; `tool` holds, hovers and selects some."""
        for at, (pane, (viewport, camera)) in enumerate(zip(self.session.panes, sights, strict=False)):
            markers = _markers(pane.pose, self.positions(at), tool)
            self._markers.draw(canvas, viewport, camera, markers, scale=scale)

    def release(self) -> None:
        """Give the graphics memory back."""
        for shown in self._shown:
            shown.mesh.release()
        for shell in self._shells.values():
            shell.mesh.release()
        if self._sitter is not None:
            self._sitter.release()
        self._markers.release()
        self._still.release()
        self._scene.release()


def _markers(pose: Pose, positions: Points, tool: DragTool) -> Markers:
    return pin_markers(pose, positions, held=tool.held, hovered=tool.hovered, selected=tool.selected)


def _get_ready(rig: Rig) -> None:
    """Find what is found once per rig when a hand takes it for the first time."""
    if rig.vertex_count and rig.shape_count:
        answering(rig, [0])
        _ = rig.sentinels
