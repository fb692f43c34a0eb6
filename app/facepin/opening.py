"""What is to be put on the desk, decided before its rig is read: a rig alone, a scene, or unsaved work."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from facepin.core.camera import Camera
from facepin.core.errors import FacepinError
from facepin.core.pose import Pose
from facepin.core.rig import Rig
from facepin.files.drafts import Leftover
from facepin.files.scene_file import Scene, places
from facepin.panels.view import PaneView
from facepin.resources import resource
from facepin.scenes import RigSource, resume
from facepin.session.edit import Edit
from facepin.session.session import Session
from facepin.session.solving import SolverChoice

OWN_FACES = "faces"
"""Folder of the program's own faces among its assets."""


@dataclass(frozen=True, eq=False)
class Begun:
    """The session on a rig that was read, and how to look at it."""

    session: Session
    cameras: tuple[Camera | None, ...]
    """One per pane; None where the face is to be framed."""
    views: tuple[PaneView, ...]
    linked: bool | None = None
    """None leaves it as it is."""
    complaint: str = ""
    """What could not be as asked, in one line."""


@dataclass(frozen=True, eq=False)
class RigOpening:
    """A rig alone."""

    source: RigSource
    first_pose: Callable[[Rig], Pose] | None = None
    """Makes the pose to begin with."""
    solve: bool = False
    """Whether the weights then follow the pins of that pose."""

    def begin(self, rig: Rig, choices: Sequence[SolverChoice]) -> Begun:
        """Return a session with one pane for each of `choices`."""
        pose, complaint = None, ""
        try:
            pose = self.first_pose(rig) if self.first_pose else None
        except FacepinError as error:
            complaint = str(error)  # the rig is there all the same
        session = Session(rig, choices, pose)
        if pose is not None and self.solve:
            session.apply(Edit("Solve the pins", True, pose.pins, solve=True))
        # What was shown over another face is over.
        views = tuple(PaneView() for _ in session.panes)
        return Begun(session, (None,) * len(views), views, complaint=complaint or session.message)


@dataclass(frozen=True, eq=False)
class SceneOpening:
    """A scene, or unsaved work that was left over."""

    scene: Scene
    file: Path | None
    """The scene's file, if it has one."""
    source: RigSource
    leftover: Leftover | None = None
    moved: bool = False
    """The rig was not where the scene says, the user showed where it is."""

    def begin(self, rig: Rig, choices: Sequence[SolverChoice]) -> Begun:
        """Return the session that the scene holds.

        Raises
        ------
        FacepinError
            When the scene makes no sense on any rig.
        """
        found = resume(self.scene, rig)
        session = Session.resumed(rig, found.work, found.active)
        return Begun(session, found.cameras, found.views, found.linked, found.report)


Opening = RigOpening | SceneOpening


@dataclass(frozen=True, eq=False)
class Lost:
    """A scene whose rig is nowhere to be found."""

    scene: Scene
    file: Path | None
    leftover: Leftover | None
    looked: tuple[Path, ...]
    """Where it was looked for."""

    @property
    def line(self) -> str:
        """What is the matter, in one line."""
        what = self.file.name if self.file else "the unsaved work"
        looked = " and ".join(str(path) for path in self.looked)
        return f"{what}: its rig {self.scene.rig.name} was not found, looked for {looked}"


def find_rig(scene: Scene, file: Path | None, leftover: Leftover | None) -> SceneOpening | Lost:
    """Find the rig of a scene: beside its file, where it was, or among the program's own."""
    rig = scene.rig
    if rig.asset:
        try:
            return SceneOpening(scene, file, RigSource(asset(rig.asset), asset=rig.asset), leftover)
        except (FileNotFoundError, ValueError):
            return Lost(scene, file, leftover, (Path(rig.asset),))
    looked = tuple(dict.fromkeys(places(rig, file)))
    for path in looked:
        if _is_there(path):
            return SceneOpening(scene, file, RigSource(path, rig.neutral), leftover)
    return Lost(scene, file, leftover, looked)


def asset(name: str) -> Path:
    """Return the path of one of the program's own faces.

    Raises
    ------
    FileNotFoundError, ValueError
        When there is none of that name, or it leads out of the assets.
    """
    if ".." in Path(name).parts or Path(name).is_absolute():
        raise ValueError(f"{name}: not the name of an asset")
    return resource("assets", name)


def source_of(path: Path, neutral: str | None) -> RigSource:
    """Return where a rig comes from, known as one of the program's own if it is."""
    own = f"{OWN_FACES}/{path.name}"
    try:
        if asset(own).samefile(path):
            return RigSource(path, asset=own)
    except (OSError, ValueError):  # no such face of ours, or no such file: whoever opens it says so
        pass
    return RigSource(path, neutral)


def _is_there(path: Path) -> bool:
    try:
        return path.exists()
    except (OSError, ValueError):  # a name that no file can have
        return False
