"""Drafts: unsaved work, one file per running window, which no other window touches while that one lives."""

from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from secrets import token_hex

from facepin.core.errors import FacepinError
from facepin.files.safely.atomic import atomic_write, make_folder, set_aside
from facepin.files.safely.file_lock import FileLock, take_lock
from facepin.files.safely.reading import read_bytes
from facepin.files.work.scene_file import SUFFIX, NewerVersion, Scene, parse_scene


class Draft:
    """The file that holds the unsaved work of one window."""

    def __init__(self, folder: Path, name: str | None = None) -> None:
        """Take a name that no other draft has, or the draft of a given name; nothing is written yet."""
        self.path = folder / f"{name or token_hex(8)}{SUFFIX}"
        self._lock: FileLock | None = None

    def claim(self) -> bool:
        """Take the draft for this window; False when another one has it.

        Raises
        ------
        OSError
            When its folder can't be written.
        """
        if self._lock is None:
            self._lock = take_lock(self.path.with_suffix(".lock"))
        return self._lock is not None

    def write(self, content: bytes) -> None:
        """Replace what the file holds, in one step.

        Raises
        ------
        FacepinError
            When it can't be written; what it held before is still there.
        """
        make_folder(self.path.parent)
        try:
            mine = self.claim()
        except OSError as error:
            raise FacepinError(f"{self.path}: cannot be written: {error.strerror or error}") from error
        if not mine:
            raise FacepinError(f"{self.path}: another window writes this")
        atomic_write(self.path, content)

    def remove(self) -> None:
        """Take the file away: there is nothing unsaved.

        Raises
        ------
        OSError
            When that is impossible.
        """
        self.path.unlink(missing_ok=True)

    def release(self) -> None:
        """Leave the file, if there is one, to whichever window comes next."""
        if self._lock is not None:
            self._lock.release()
            self._lock = None


@dataclass(frozen=True, eq=False)
class Leftover:
    """Unsaved work of a window that is gone; whoever claims its draft first may take it up."""

    draft: Draft
    scene: Scene
    time: datetime
    """When it was last written."""

    @classmethod
    def now(cls, draft: Draft, scene: Scene) -> "Leftover":
        """Return a draft that was written just now."""
        return cls(draft, scene, datetime.now())

    def claimed(self) -> "Leftover":
        """Return it as it is now, for this window alone: another one may have taken it up meanwhile.

        Raises
        ------
        FacepinError
            When another window has it, or it is gone.
        """
        path = self.draft.path
        try:
            mine = self.draft.claim()
        except OSError as error:
            raise FacepinError(f"{path}: cannot be taken up: {error.strerror or error}") from error
        if not mine:
            raise FacepinError(f"another window is at work on {self.scene.rig.name} as it was left here")
        try:
            if not path.exists():
                raise FacepinError(f"{path.name}: this work was taken up or discarded already")
            return Leftover(self.draft, parse_scene(read_bytes(path), path.name), self.time)
        except FacepinError:
            self.draft.release()
            raise


def leftovers(folder: Path) -> tuple[list[Leftover], list[str]]:
    """Find what windows that are gone left behind in a folder; none of it is held, however much it is.

    Returns
    -------
    list of Leftover
        Newest first.  Drafts of windows that live, of newer versions of the program, and of faces at rest are
        left alone.
    list of str
        One line for each draft that can't be read; it is set aside.
    """
    found: list[Leftover] = []
    remarks: list[str] = []
    with suppress(OSError):  # a folder that can't be written holds nothing, and is spoken of when it should
        names = {path.stem for path in folder.iterdir() if path.suffix in (SUFFIX, ".lock")}
        for name in sorted(name for name in names if not name.startswith(".")):
            draft = Draft(folder, name)
            if not draft.claim():
                continue
            for torn in folder.glob(f".{name}-*{SUFFIX}"):  # its window ended while it was being written
                torn.unlink(missing_ok=True)
            try:
                scene = parse_scene(read_bytes(draft.path), draft.path.name)
                if scene.is_touched:
                    found.append(Leftover(draft, scene, datetime.fromtimestamp(draft.path.stat().st_mtime)))
            except NewerVersion:
                pass
            except FacepinError as error:
                if draft.path.exists():
                    remarks.append(f"unsaved work can't be read: {error}; {set_aside(draft.path)}")
            finally:
                draft.release()
    found.sort(key=lambda leftover: leftover.time, reverse=True)
    return found, remarks
