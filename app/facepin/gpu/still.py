"""What does not move is drawn once, as if it were part of the wall: a frame costs what moves.

Without a graphics card the face is most of a frame.  As long as it is seen from where it was, a frame begins
with a copy of wall and still triangles, with their depth, and only what moves is drawn over that.
"""

from collections.abc import Sequence

from facepin.core.look.camera import Camera, Viewport
from facepin.core.look.shading import Shading
from facepin.gpu.background import Colour
from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import frame
from facepin.gpu.scene import PaneMesh, Scene


class StillLayer:
    """Wall and still triangles of all panes."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._kept: Canvas | None = None
        self._sight: object = None

    def draw(
        self,
        canvas: Canvas,
        sights: Sequence[tuple[Viewport, Camera]],
        shown: Sequence[tuple[PaneMesh, Shading] | None],
        beside: Colour = (0.0, 0.0, 0.0, 0.0),
    ) -> None:
        """Erase a canvas and draw the wall and what is still of every face, as `fine=False` draws it.

        The rest is to be drawn with `PaneMesh.draw_framed` and `part="moving"`.

        Parameters
        ----------
        canvas : Canvas
            Has a size, and no samples.
        sights : sequence of (viewport, camera)
            The panes.
        shown : sequence of (PaneMesh, Shading) or None
            Their faces; None where something else is drawn instead.
        beside : (r, g, b, a)
            Colour of what is outside of the panes.
        """
        framings = [frame(camera, viewport) for viewport, camera in sights]
        faces = [(*face, framing) for face, framing in zip(shown, framings, strict=True) if face is not None]
        sight = (canvas.size, tuple(sights), tuple(shown), beside, self._scene.refined, self._scene.runs)
        if sight != self._sight:
            self.forget()
            for mesh, _, framing in faces:
                mesh.look(framing)
            self._sight = sight
        sorted_anew = [mesh.follow() for mesh, _, _ in faces]
        if not any(mesh.motion.still for mesh, _, _ in faces):
            self._scene.background.draw(canvas, sights, beside)
            return
        if self._kept is None:
            self._kept = canvas.twin()
        if any(sorted_anew):
            self._kept.resize(*canvas.size)
            self._scene.background.draw(self._kept, sights, beside)
            for mesh, shading, framing in faces:
                mesh.draw_framed(self._kept, framing, fine=False, shading=shading, part="still")
        self._kept.copy_to(canvas)

    def forget(self) -> None:
        """Begin anew with the next picture: then less may move."""
        self._sight = None

    def release(self) -> None:
        """Give the graphics memory back."""
        if self._kept is not None:
            self._kept.release()
