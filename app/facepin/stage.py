"""The open rig as it is shown: for each pane its positions, normals and mesh on the graphics card."""

from collections.abc import Sequence
from dataclasses import dataclass
from time import perf_counter

import moderngl
import numpy as np

from facepin.core.arrays import Floats, Indices, Points, frozen
from facepin.core.camera import Camera, Viewport
from facepin.core.control import ShapeControl
from facepin.core.deform import Deformer
from facepin.core.normals import NormalField
from facepin.core.picking import pick
from facepin.core.pose import Pose
from facepin.gpu.background import Colour
from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import frame
from facepin.gpu.markers import MarkerLayer, Markers, MarkerState
from facepin.gpu.materials import material
from facepin.gpu.pane import Overlays, draw_pane
from facepin.gpu.scene import PaneMesh, Part, Scene
from facepin.gpu.still import StillLayer
from facepin.panels.view import Ghost, PaneView
from facepin.session.appraisal import Appraisal, Appraiser
from facepin.session.drag import DragTool
from facepin.session.heat import HeatGauge
from facepin.session.session import Pane, Session, Work


@dataclass(eq=False)
class _Shown:
    """What one pane shows."""

    deformer: Deformer
    normals: NormalField
    mesh: PaneMesh
    gauge: HeatGauge
    weights: Floats | None = None
    control: ShapeControl | None = None
    positions: Points | None = None
    appraised: tuple[Pane, Work, Appraisal] | None = None
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
        self.seconds = 0.0
        """Time of the last deformation with normals and upload, all panes."""
        self._scene = Scene(ctx, session.rig)
        self._still = StillLayer(self._scene)
        self._markers = MarkerLayer(ctx)
        shown = [
            session.rig.triangles[part.triangles.start : part.triangles.stop]
            for part in session.rig.parts
            if material(part, session.rig.colours is not None) is not None
        ]
        self.triangles: Indices = frozen(np.concatenate(shown) if shown else session.rig.triangles, np.int32)
        """(t, 3) what is drawn, hence what can be pressed."""
        self._appraiser = Appraiser(session.rig)
        self._shells: dict[Ghost, _Shell] = {}
        rig = session.rig
        self._shown = [_Shown(Deformer(rig), NormalField(rig), PaneMesh(self._scene), HeatGauge(rig))]
        self.update()

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
        panes, control = self.session.panes, self.session.control
        for _ in range(len(self._shown), len(panes)):
            first = self._shown[0]
            mesh, gauge = PaneMesh(self._scene), HeatGauge(self.session.rig)
            self._shown.append(_Shown(first.deformer.twin(), first.normals.twin(), mesh, gauge))
        changed = False
        for shown, pane in zip(self._shown, panes, strict=False):
            weights = pane.pose.weights
            if weights is shown.weights and control is shown.control:
                continue
            shown.weights, shown.control = weights, control
            positions = shown.deformer.deform(control.heard(weights))
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

    def vertex_under(
        self, pane: int, camera: Camera, viewport: Viewport, pixel: tuple[float, float]
    ) -> int | None:
        """Return the vertex of a pane that a press at a pixel would pin, or None."""
        hit = pick(self.positions(pane), self.triangles, camera, viewport, pixel)
        return None if hit is None else hit.vertex

    def appraise(self, pane: int) -> Appraisal:
        """Measure a pane's pose as it is shown."""
        work, shown = self.session.work, self._shown[pane]
        if shown.appraised is None or shown.appraised[:2] != (work.panes[pane], work):
            found = self._appraiser.appraise(
                work.panes[pane], work.control, self.positions(pane), work.reference
            )
            shown.appraised = work.panes[pane], work, found
        return shown.appraised[2]

    def mesh(self, pane: int) -> PaneMesh:
        """The mesh of a pane, for a picture of it."""
        return self._shown[pane].mesh

    def overlays(self, pane: int, view: PaneView) -> Overlays:
        """Return what `view` shows over the face of a pane; measures and uploads only what it asks for."""
        work, shown = self.session.work, self._shown[pane]
        heat = None
        if view.heat:
            heat = shown.gauge.heat(work.panes[pane], work.control, self.positions(pane))
        if view.reach:
            heat = shown.gauge.reach(work.panes[pane])
        if view.shape is not None:
            heat = shown.gauge.shape(view.shape)
        ghost = None
        if view.ghost == "neutral" or (view.ghost == "reference" and work.reference is not None):
            ghost = self._ghost(view.ghost, None if view.ghost == "neutral" else work.reference)
        return Overlays(heat, view.wireframe, ghost)

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
        tool: DragTool,
        scale: float,
        *,
        fine: bool,
        beside: Colour,
    ) -> None:
        """Draw every pane with its pins.

        Parameters
        ----------
        canvas : Canvas
            What to draw into.
        sights : sequence of (viewport, camera)
            Where each pane is and how it is seen.
        overlays : sequence of PaneView
            What each pane shows over its face.
        tool : DragTool
            Which pins are held, hovered or selected.
        scale : float
            Pixels per pixel of a 1x screen.
        fine : bool
            Slower where a processor does the drawing.
        beside : (r, g, b, a)
            Colour of what is outside of the panes.
        """
        if fine or canvas.samples:
            self._still.forget()
            self._scene.background.draw(canvas, sights, beside)
            part: Part = "all"
        else:
            faces = [
                None if view.coloured else self.mesh(at) for at, view in enumerate(overlays[: len(sights)])
            ]
            self._still.draw(canvas, sights, faces, beside)
            part = "moving"
        for at, (pane, (viewport, camera)) in enumerate(zip(self.session.panes, sights, strict=True)):
            framing = frame(camera, viewport)
            over = self.overlays(at, overlays[at])
            draw_pane(canvas, framing, self._shown[at].mesh, over, fine=fine, part=part, scale=scale)
            markers = _markers(pane.pose, self.positions(at), tool)
            self._markers.draw(canvas, viewport, camera, markers, scale=scale)

    def release(self) -> None:
        """Give the graphics memory back."""
        for shown in self._shown:
            shown.mesh.release()
        for shell in self._shells.values():
            shell.mesh.release()
        self._markers.release()
        self._still.release()
        self._scene.release()


def _markers(pose: Pose, positions: Points, tool: DragTool) -> Markers:
    states = []
    for pin in pose.pins:
        if pin.vertex == tool.held:
            states.append(MarkerState.HELD)
        elif pin.vertex in tool.selected:
            states.append(MarkerState.SELECTED)
        elif pin.vertex == tool.hovered:
            states.append(MarkerState.HOVERED)
        else:
            states.append(MarkerState.NORMAL)
    return Markers(
        positions[[pin.vertex for pin in pose.pins]],
        np.array([pin.goal for pin in pose.pins], np.float32).reshape(-1, 3),
        np.array(states, np.uint8),
    )
