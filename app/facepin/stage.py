"""The open rig as it is shown: for each pane its positions, normals and mesh on the graphics card."""

from dataclasses import dataclass
from time import perf_counter

import moderngl
import numpy as np

from facepin.core.arrays import Floats, Points
from facepin.core.camera import Camera, Viewport
from facepin.core.deform import Deformer
from facepin.core.normals import NormalField
from facepin.core.pose import Pose
from facepin.gpu.canvas import Canvas
from facepin.gpu.canvas import Canvas
from facepin.gpu.markers import MarkerLayer, Markers, MarkerState
from facepin.gpu.scene import PaneMesh, Scene
from facepin.session.drag import DragTool
from facepin.session.session import Session


@dataclass(eq=False)
class _Shown:
    """What one pane shows."""

    deformer: Deformer
    normals: NormalField
    mesh: PaneMesh
    weights: Floats | None = None
    positions: Points | None = None


class Stage:
    """Follows the poses of a session; draws them."""

    def __init__(self, ctx: moderngl.Context, session: Session) -> None:
        self.session = session
        self.seconds = 0.0
        """Time of the last deformation with normals and upload, all panes."""
        self._scene = Scene(ctx, session.rig)
        self._markers = MarkerLayer(ctx)
        normals = NormalField(session.rig)
        self._shown = [
            _Shown(Deformer(session.rig), normals if pane == 0 else normals.twin(), PaneMesh(self._scene))
            for pane in range(len(session.poses))
        ]
        self.update()

    def update(self) -> bool:
        """Deform what has new weights and send it to the graphics card; return whether anything had."""
        began = perf_counter()
        changed = False
        for shown, pose in zip(self._shown, self.session.poses, strict=True):
            if pose.weights is not shown.weights:
                shown.weights = pose.weights
                shown.positions = shown.deformer.deform(pose.weights)
                shown.mesh.upload(shown.positions, shown.normals.normals(shown.positions))
                changed = True
        if changed:
            self.seconds = perf_counter() - began
        return changed

    def positions(self, pane: int) -> Points:
        """Vertices (n, 3) of a pane as last drawn."""
        positions = self._shown[pane].positions
        assert positions is not None, "update() fills this"
        return positions

    def mesh(self, pane: int) -> PaneMesh:
        """The mesh of a pane, for a picture of it."""
        return self._shown[pane].mesh

    def draw(
        self,
        canvas: Canvas,
        viewports: tuple[Viewport, ...],
        camera: Camera,
        tool: DragTool,
        scale: float,
        *,
        fine: bool,
    ) -> None:
        """Draw every pane with its pins into its viewport; `fine` is slower where a processor does the drawing."""
        for pane, (viewport, pose) in enumerate(zip(viewports, self.session.poses, strict=True)):
            self._shown[pane].mesh.draw(canvas, viewport, camera, fine=fine)
            markers = _markers(pose, self.positions(pane), tool)
            self._markers.draw(canvas, viewport, camera, markers, scale=scale)

    def release(self) -> None:
        """Give the graphics memory back."""
        for shown in self._shown:
            shown.mesh.release()
        self._markers.release()
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
