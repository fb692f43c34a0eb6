"""Nothing is lost: knows what of the open work is saved, and keeps a draft of what is not."""

from collections.abc import Callable
from pathlib import Path

from facepin.core.errors import FacepinError
from facepin.desk.scenes import Snapshot, scene_of
from facepin.files.work.drafts import Draft, Leftover, leftovers
from facepin.files.work.scene_file import digest_of, scene_bytes, write_scene
from facepin.session.autosave import Autosave
from facepin.session.session import Session
from facepin.session.work import Work


class ChangedElsewhere(FacepinError):
    """The scene file is no longer what the work here began with, or what was saved here."""


class Keeper:
    """Keeps the work of one window.

    After each undo step that leaves something unsaved, a draft is written in the background; when everything
    is saved, or the face is at rest with nothing on it, the draft is taken away.  A draft that is there when
    the window ends, however it ends, is offered by the next one.
    """

    def __init__(self, folder: Path | None) -> None:
        """Look for what former windows left over.

        Parameters
        ----------
        folder : Path
            Where drafts are; None keeps nothing.
        """
        self.file: Path | None = None
        """The scene file of the open work, if it has one."""
        self.digest = ""
        """Of that file as it was opened or saved here; empty where that is unknown."""
        self.left: list[Leftover] = []
        """Unsaved work of windows that are gone, newest first."""
        self.remarks: list[str] = []
        """What of it could not be read."""
        self._folder = folder
        self._draft: Draft | None = None
        self._saver = Autosave(_keep)
        self._saved: Work | None = None
        self._seen: Work | None = None
        self._warned = False
        if folder is not None:
            self._draft = Draft(folder)
            self.left, self.remarks = leftovers(folder)

    @property
    def complaint(self) -> str:
        """Why unsaved work is in memory only at the moment; empty when it is not."""
        return self._saver.complaint

    def is_saved(self, session: Session) -> bool:
        """Say whether the work is in a file of the user's, as it is."""
        return session.committed is self._saved

    def take_for_saved(self, session: Session) -> None:
        """Take the work as it is for saved: what it holds since it was is in files of its own."""
        self._saved = session.committed

    def begin(
        self,
        session: Session,
        file: Path | None,
        leftover: Leftover | None = None,
        *,
        saved: bool = True,
        digest: str = "",
    ) -> None:
        """Keep the work of another session from now on; call `let_go` for the one before.

        Parameters
        ----------
        session : Session
            As it begins.
        file : Path
            Its scene file, if it has one.
        leftover : Leftover
            What it begins with, if that was unsaved work: its draft goes on.
        saved : bool
            Whether it begins with what is in its files.
        digest : str
            Of its scene file, as it was read.
        """
        self.file, self.digest = file, digest
        self._saved = self._seen = session.committed
        if leftover is not None:
            self._forget(leftover)
            self._draft = leftover.draft
            self._saved = None
        elif not saved:
            self._saved = self._seen = None

    def follow(self, session: Session, snapshot: Callable[[], Snapshot]) -> None:
        """Keep the work if it is another than at the last call: to be called in every frame."""
        if session.committed is self._seen or self._draft is None:
            return
        self._seen = session.committed
        self._saver.put((self._draft, None if self.is_saved(session) else snapshot()))

    def save(self, session: Session, path: Path, snapshot: Snapshot, *, replace: bool = True) -> None:
        """Write the work to a scene file, which is its file from now on.

        Parameters
        ----------
        session : Session
            The work.
        path : Path
            The scene file.
        snapshot : Snapshot
            Of the session.
        replace : bool
            Whether what somebody else saved there meanwhile is knowingly replaced.

        Raises
        ------
        ChangedElsewhere
            If it is not, and somebody has.
        FacepinError
            If it cannot be written.
        """
        if not replace and self.digest and digest_of(path) not in ("", self.digest):
            raise ChangedElsewhere(f"{path.name} was saved elsewhere since it was opened or saved here")
        self.digest = write_scene(path, scene_of(snapshot, draft=False))
        self.file = path
        self._saved, self._seen = session.committed, None

    def let_go(self, session: Session, snapshot: Callable[[], Snapshot]) -> Leftover | None:
        """Leave the work to be taken up later, if it is unsaved, and begin a new draft; return what is left.

        Raises
        ------
        FacepinError
            When it can be kept nowhere: it has to stay open.
        """
        if self._folder is None or self._draft is None:
            return None
        self.follow(session, snapshot)
        if not self._saver.flush() and not self.is_saved(session):
            raise FacepinError(
                f"the unsaved work on {session.rig.name} can't be kept, so it stays open: {self.complaint}"
            )
        draft, self._draft = self._draft, Draft(self._folder)
        if self.is_saved(session):
            draft.release()
            return None
        draft.release()
        leftover = Leftover.now(draft, scene_of(snapshot(), draft=True))
        if not leftover.scene.is_touched:
            return None
        self.left = [leftover, *self.left]
        return leftover

    def take_up(self, leftover: Leftover) -> Leftover:
        """Claim unsaved work for this window; return it as it is now.

        Raises
        ------
        FacepinError
            When another window has it, or it is gone.
        """
        try:
            mine = leftover.claimed()
        except FacepinError:
            if not leftover.draft.path.exists():
                self._forget(leftover)
            raise
        self.left = [mine if other is leftover else other for other in self.left]
        return mine

    def discard(self, leftover: Leftover) -> None:
        """Throw unsaved work away.

        Raises
        ------
        FacepinError
            When another window has taken it up, or it is gone.
        OSError
            When its file can't be removed.
        """
        mine = self.take_up(leftover)
        mine.draft.remove()
        mine.draft.release()
        self._forget(mine)

    def _forget(self, leftover: Leftover) -> None:
        self.left = [other for other in self.left if other is not leftover]

    def may_close(self, session: Session | None, snapshot: Callable[[], Snapshot]) -> str:
        """Return why closing now would lose something, once; empty when it may be closed."""
        if self._draft is None or session is None or self._warned or self.is_saved(session):
            return ""
        self.follow(session, snapshot)
        if self._saver.flush():
            return ""
        self._warned = True
        return (
            f"the unsaved work can't be kept: {self.complaint}; save it elsewhere, or close again to lose it"
        )

    def close(self) -> str:
        """Leave everything to the next window; return what could not be kept, in one line, or nothing."""
        kept = self._saver.close()
        if self._draft is not None:
            self._draft.release()
        for leftover in self.left:
            leftover.draft.release()
        return "" if kept else f"the unsaved work could not be kept: {self.complaint}"


def _keep(job: tuple[Draft, Snapshot | None]) -> None:
    """Write a draft, or take it away when there is nothing unsaved; runs beside the window."""
    draft, snapshot = job
    scene = None if snapshot is None else scene_of(snapshot, draft=True)
    if scene is None or not scene.is_touched:
        draft.remove()
    else:
        draft.write(scene_bytes(scene, None))
