"""What is to be put on the desk, decided before its rig is read: a rig alone, a scene, or unsaved work."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from facepin.core.errors import FacepinError
from facepin.core.look.camera import Camera
from facepin.core.pose import Pose
from facepin.core.rig import Rig
from facepin.desk.scenes import RigSource, resume
from facepin.files.obj.neutral_file import NeutralUnknown
from facepin.files.upright import open_upright
from facepin.files.work.drafts import Leftover
from facepin.files.work.scene_file import SUFFIX, Scene, places, read_scene
from facepin.panels.view import PaneView
from facepin.resources import resource
from facepin.session.edit import Edit
from facepin.session.loading import Loading
from facepin.session.session import Session
from facepin.session.solving.solving import SolverChoice

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
    reference_shown: bool = False
    """Whether the reference has a pane of its own."""
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


@dataclass(frozen=True, eq=False)
class SceneOpening:
    """A scene, or unsaved work that was left over."""

    scene: Scene
    file: Path | None
    """The scene's file, if it has one."""
    source: RigSource
    leftover: Leftover | None = None
    lost: Lost | None = None
    """What waited for the rig, where the user showed it: it was not where the scene says."""
    turned: bool = False
    """The user turned the face of what is open."""

    def begin(self, rig: Rig, choices: Sequence[SolverChoice]) -> Begun:
        """Return the session that the scene holds.

        Raises
        ------
        FacepinError
            When the scene makes no sense on any rig.
        """
        found = resume(self.scene, rig)
        session = Session.resumed(rig, found.work, found.active)
        return Begun(session, found.cameras, found.views, found.linked, found.report, found.reference_shown)


Opening = RigOpening | SceneOpening


class Opener:
    """Reads rigs beside the window, each for what is to be done with it; the last one asked for wins."""

    def __init__(self, settings: Path | None = None) -> None:
        """Turn faces as the folder of settings remembers."""
        self._settings = settings
        self.loading: Loading | None = None
        self.lost: Lost | None = None
        """A scene that waits until its rig is shown."""
        self.unclear: NeutralUnknown | None = None
        """A folder that waits until its neutral is named."""
        self._coming: Opening | None = None
        """What the rig is for that is being read."""

    def open(
        self,
        path: Path,
        first_pose: Callable[[Rig], Pose] | None = None,
        *,
        solve: bool = False,
        neutral: str | None = None,
    ) -> None:
        """Start opening the rig or the scene at `path`.

        Parameters
        ----------
        path : Path
            File or folder.
        first_pose : callable
            Makes the pose to begin with once the rig is there; a scene has its own.
        solve : bool
            Whether the weights then follow the pins of that pose.
        neutral : str
            For a folder: the file with the neutral.

        Raises
        ------
        FacepinError
            When it is a scene that can't be read, or whose rig is not found.
        """
        if path.suffix.lower() == SUFFIX and path.is_file():
            self.open_scene(read_scene(path), path)
        else:
            self._load(RigOpening(source_of(path, neutral), first_pose, solve))

    def open_scene(self, scene: Scene, file: Path | None, leftover: Leftover | None = None) -> None:
        """Start opening a scene: one from a file, or unsaved work that was left over.

        Raises
        ------
        FacepinError
            When its rig is not found; it is then `lost` until `locate` is told where the rig is.
        """
        found = find_rig(scene, file, leftover)
        if isinstance(found, Lost):
            self.lost = found
            raise FacepinError(found.line)
        self._load(found)

    def locate(self, path: Path) -> None:
        """Open the scene that waits for its rig, now that the rig was shown."""
        if self.lost is not None:
            lost = self.lost
            source = source_of(path, lost.scene.rig.neutral)
            self._load(SceneOpening(lost.scene, lost.file, source, lost.leftover, lost))

    def cancel(self) -> None:
        """Give up what is being read, or waited for."""
        self.lost = self.unclear = None
        if self.loading is not None:
            self.loading.cancel()

    def use_neutral(self, name: str) -> None:
        """Open the folder that waits for its neutral with the file `name` as that."""
        if self.unclear is not None and self._coming is not None:
            self._load(replace(self._coming, source=replace(self._coming.source, neutral=name)))

    def take(self) -> tuple[Rig, Opening] | None:
        """Return a rig that has been read, once, and what it is for; None as long as there is none.

        Raises
        ------
        FacepinError, OSError
            When it can't be read.
        """
        if self.loading is None or not self.loading.finished:
            return None
        loading, self.loading = self.loading, None
        opening, rig = self._coming, None
        try:
            rig = loading.result()
        except NeutralUnknown as error:  # asked for, where there is someone to ask
            self.unclear = error
            return None
        finally:
            if rig is None and isinstance(opening, SceneOpening):
                self.lost = opening.lost  # another file may do
        return None if rig is None or opening is None else (rig, opening)

    def _load(self, opening: Opening) -> None:
        self.cancel()
        self._coming = opening
        neutral, settings = opening.source.neutral, self._settings
        turn = opening.scene.rig.turn if isinstance(opening, SceneOpening) else None
        self.loading = Loading(
            opening.source.path,
            lambda path, progress: open_upright(
                path, neutral=neutral, progress=progress, turn=turn, settings=settings
            ),
        )


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
