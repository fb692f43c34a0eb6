"""Small pictures of poses, drawn when somebody wants to show them and the program has time."""

from functools import cached_property
from pathlib import Path

import moderngl

from facepin.core.arrays import Floats
from facepin.core.errors import FacepinError
from facepin.core.look.camera import Camera
from facepin.core.look.face_view import face_camera
from facepin.core.pose import Pose
from facepin.desk.stage import Stage
from facepin.files.work.thumbnails import is_writable, mark_of, read_thumbnail, write_thumbnail
from facepin.gpu.atlas import Atlas, Tile

SIDE = 192
"""Pixels along each side."""
MARGIN = 0.06
"""Share of a picture left free round the part of the face that moves."""
BATCH = 4
"""New pictures after which they are shown."""


class Portraits:
    """Pictures of poses of one rig, front view."""

    def __init__(self, ctx: moderngl.Context, stage: Stage) -> None:
        self.complaint = ""
        """Why the last picture could not be stored; empty when it could."""
        self._stage = stage
        self._rig = stage.session.rig
        self._atlas = Atlas(ctx, SIDE)
        self._marks: dict[int, tuple[Floats, str]] = {}
        self._wanted: dict[str, tuple[Floats, Path | None]] = {}
        self._unseen = 0

    @cached_property
    def camera(self) -> Camera:
        """What looks at the poses."""
        return face_camera(self._rig, (SIDE, SIDE), margin=MARGIN)

    @property
    def refined(self) -> bool:
        """Whether `refine` has nothing to do."""
        return not self._wanted

    def tile(self, weights: Floats, path: Path | None = None) -> Tile | None:
        """Return where the picture of a pose is; None until `refine` has made it.

        Parameters
        ----------
        weights : (k,) float64, read-only
            The pose.
        path : Path
            File that it may be in, and is stored in.
        """
        mark = self._mark(weights)
        tile = self._atlas.tile(mark)
        if tile is None:
            self._wanted[mark] = weights, path
        return tile

    def refine(self) -> bool:
        """Fetch or draw one picture that was asked for; return whether it is time to show what is new."""
        if not self._wanted:
            return False
        mark, (weights, path) = self._wanted.popitem()  # what was asked for last is what is in sight
        image = None if path is None else read_thumbnail(path, mark, SIDE)
        if image is None:
            image = self._stage.portrait(Pose(weights), self.camera, (SIDE, SIDE))
            if path is not None and is_writable(path.parent):
                try:
                    write_thumbnail(path, image, mark)
                    self.complaint = ""
                except FacepinError as error:  # it is shown all the same, and made again next time
                    self.complaint = str(error)
        self._atlas.put(mark, image)
        self._unseen += 1
        if self._unseen < BATCH and self._wanted:
            return False
        self._unseen = 0
        return True

    def release(self) -> None:
        """Give the graphics memory back."""
        self._atlas.release()

    def _mark(self, weights: Floats) -> str:
        """Return what stands for a pose; remembered, since panels ask in every frame."""
        found = self._marks.get(id(weights))
        if found is None or found[0] is not weights:
            if len(self._marks) > 4096:
                self._marks.clear()
            found = self._marks[id(weights)] = weights, mark_of(self._rig, weights)
        return found[1]
