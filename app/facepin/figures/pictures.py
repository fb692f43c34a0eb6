"""Faces with their pins, drawn without a window."""

from typing import TYPE_CHECKING

import numpy as np

from facepin.core.arrays import Floats, Points
from facepin.core.look.camera import View
from facepin.core.look.face_view import face_camera
from facepin.core.look.heat import heat_colours, heat_scale
from facepin.core.mesh.normals import NormalField
from facepin.core.pose import Pin
from facepin.core.rig import Rig
from facepin.core.shapes.measures import percent
from facepin.sheets import Image, Legend

if TYPE_CHECKING:
    import moderngl

SUPERSAMPLING = 2


class Painter:
    """Draws poses of one rig, all seen by one camera.  Give it back with `release`."""

    def __init__(
        self, ctx: "moderngl.Context", rig: Rig, size: tuple[int, int], view: View = "front"
    ) -> None:
        """Look at a rig in pictures of `size` (width, height)."""
        from facepin.gpu.markers import MarkerLayer
        from facepin.gpu.scene import PaneMesh, Scene

        self.size = size
        self.camera = face_camera(rig, size, view)
        self._rig = rig
        self._scene = Scene(ctx, rig)
        self._mesh = PaneMesh(self._scene)
        self._markers = MarkerLayer(ctx)
        self._normals = NormalField(rig)
        while not self._scene.refined:
            self._scene.refine()

    def paint(
        self,
        positions: Points,
        pins: tuple[Pin, ...] = (),
        moved: Floats | None = None,
        *,
        heat: Floats | None = None,
        transparent: bool = False,
    ) -> Image:
        """Return a picture of a posed face, (h, w, 4) uint8, with a marker per pin and a line to its goal.

        With `moved` (n,), lengths in the rig's unit, colours show how far each vertex moved (`heat_legend`);
        with `heat` (n,) anything else, in shares of the top of the scale.
        Pictures may be `transparent` where the face is not.
        """
        from facepin.gpu.markers import Markers, MarkerState
        from facepin.gpu.pane import Overlays
        from facepin.gpu.picture import draw_picture

        self._mesh.upload(positions, self._normals.normals(positions))
        markers = Markers(
            positions[[pin.vertex for pin in pins]],
            np.array([pin.goal for pin in pins], np.float32).reshape(-1, 3),
            np.full(len(pins), MarkerState.SELECTED, np.uint8),
        )
        if moved is not None:
            heat = moved / heat_scale(self._rig.height).top
        scale = SUPERSAMPLING * max(self.size[1] / 600, 0.5)
        return draw_picture(
            self._mesh,
            self.camera,
            self.size,
            transparent=transparent,
            samples=0,
            supersampling=SUPERSAMPLING,
            overlays=Overlays(heat=None if heat is None else heat.astype(np.float32)),
            overlay=lambda canvas, framing, _: self._markers.draw_framed(
                canvas, framing, markers, scale=scale
            ),
        )

    def release(self) -> None:
        """Give the graphics memory back."""
        self._markers.release()
        self._mesh.release()
        self._scene.release()


def heat_legend(rig: Rig) -> Legend:
    """Return the legend of `Painter.paint` with `moved`, in per cent of the face height."""
    ticks = heat_scale(rig.height).ticks
    return Legend(heat_colours(), tuple(f"{percent(tick, rig.height):.2g} %" for tick in ticks))
