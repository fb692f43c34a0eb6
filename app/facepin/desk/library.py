"""The pose library of the open rig: what is on the disk, kept in step with the session."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain
from pathlib import Path
from time import perf_counter

from facepin.core.errors import FacepinError
from facepin.core.pose import Pose
from facepin.core.saved_pose import SavedPose
from facepin.files.work import pose_library as files
from facepin.session.session import Session
from facepin.session.shelf import Shelf, next_order, standing

BUDGET = 0.008
"""Seconds that a step of `refine` may take."""


class Library:
    """Poses beside one rig.  Reads them when they are first looked at, a little at a time."""

    def __init__(
        self, session: Session, folder: Path | None, remark: str, shared: Path | None = None
    ) -> None:
        """Know the poses of a rig.

        Parameters
        ----------
        session : Session
            Poses are on its rig; its work says what was done to them.
        folder : Path
            Where they are kept, need not exist; None where there is no place for any.
        remark : str
            Says in one line where that is, and why there.
        shared : Path
            A folder that can't be written, whose poses are there too.
        """
        self.remark = remark
        self._shared = shared
        self.folder = folder
        self.complaints: list[str] = []
        """Files that are no poses, a line each."""
        self.looked_at = False
        """Set by whoever shows it: before that nothing is read or drawn."""
        self._session = session
        self._rig = session.rig
        self._stored: dict[str, SavedPose] = {}
        """Every pose as first seen, also those removed since: undo may bring them back."""
        self._written: dict[str, SavedPose] = {}
        """What the files hold."""
        self._followed: Shelf = {}
        self._standing: tuple[Shelf, tuple[SavedPose, ...]] | None = None
        self._reading: Iterator[SavedPose | FacepinError] | None = None
        self.read_again()

    @property
    def is_reading(self) -> bool:
        """Whether there may be more poses than are known yet."""
        return self._reading is not None

    @property
    def refined(self) -> bool:
        """Whether `refine` has nothing to do."""
        return not self.looked_at or self._reading is None

    @property
    def poses(self) -> tuple[SavedPose, ...]:
        """The poses as they stand now; the same tuple as long as nothing changes."""
        shelf = self._session.committed.shelf
        if self._standing is None or self._standing[0] is not shelf:
            self._standing = shelf, standing(self._stored, shelf)
        return self._standing[1]

    def pose(self, key: str) -> SavedPose:
        """Return the pose of a key.

        Raises
        ------
        FacepinError
            When there is none.
        """
        for pose in self.poses:
            if pose.key == key:
                return pose
        raise FacepinError(f"there is no pose '{key}' in the library")

    def picture_file(self, pose: SavedPose) -> Path | None:
        """Return where the picture of a pose is kept."""
        return None if self.folder is None else self.folder / f"{pose.key}.png"

    def read_again(self) -> None:
        """Begin to read what is in the folder and not known yet: files may come from elsewhere.

        Poses that the rig's own file brings stand among them until they are changed: then they have files.
        """
        self.complaints.clear()
        if self.folder is not None:
            places = [self.folder] if self._shared is None else [self.folder, self._shared]
            saved = (files.saved_poses(each, self._rig, self._stored) for each in places)
            self._reading = chain(*saved, files.given_poses(self._rig))

    def read_all(self) -> None:
        """Read what is not read yet."""
        while self._reading is not None:
            self._advance()

    def save(self, pose: Pose, title: str, tags: tuple[str, ...]) -> SavedPose:
        """Store a pose under a title, after all others.

        Raises
        ------
        FacepinError
            If there is no place for it or it cannot be written; then it is not in the library.
        """
        folder = self._place()
        self.read_all()
        key = files.free_key(title, self._taken(folder))
        saved = files.new_saved(self._rig, pose, key, title, tags, next_order(self.poses))
        self._store(folder, saved)
        return saved

    def take_from(self, folder: Path) -> tuple[list[SavedPose], list[str]]:
        """Copy the poses of another library into this one, after all others.

        Returns
        -------
        poses : list of SavedPose
            As they are here; each says what of it does not match this rig.
        complaints : list of str
            Files that are no poses, a line each.

        Raises
        ------
        FacepinError
            If there is no place for them, or one can't be written.
        """
        place = self._place()
        if folder.resolve() == place.resolve():
            raise FacepinError(f"{folder}: these poses are in the library already")
        self.read_all()
        found = list(files.saved_poses(folder, self._rig))
        poses = {pose.key: pose for pose in found if isinstance(pose, SavedPose)}
        keys, order, added = self._taken(place), next_order(self.poses), []
        for number, pose in enumerate(standing(poses, {})):
            key = files.free_key(pose.title, keys)
            keys.add(key)
            added.append(replace(pose, key=key, order=order + number))
            self._store(place, added[-1])
        return added, [str(fault) for fault in found if isinstance(fault, FacepinError)]

    def follow(self) -> None:
        """Bring the files in step with what the session has done, or undone, to poses of the library.

        Raises
        ------
        FacepinError
            If one of them can't be written.  The others are; it is tried again with the next change.
        """
        shelf = self._session.committed.shelf
        if shelf is self._followed or self.folder is None:
            return
        self._followed = shelf
        failure: FacepinError | None = None
        for key in {**self._stored, **shelf}:
            wanted = shelf.get(key, self._stored.get(key))
            if wanted is self._written.get(key):
                continue
            try:
                if wanted is None:
                    files.remove_saved(self.folder, key)
                    del self._written[key]
                    self._refuse_lasting(key)
                else:
                    files.write_saved(self.folder, wanted)
                    self._written[key] = wanted
            except FacepinError as error:
                failure = failure or error
        if failure is not None:
            raise failure

    def refine(self) -> bool:
        """Read some files, some milliseconds; return whether the panel looks new."""
        if self.refined:
            return False
        began = perf_counter()
        while self._reading is not None and perf_counter() - began < BUDGET:
            self._advance()
        return self._reading is None

    def _place(self) -> Path:
        if self.folder is None:
            raise FacepinError(self.remark)
        return self.folder

    def _refuse_lasting(self, key: str) -> None:
        """Say of a pose that was removed that its file is where nothing can be removed."""
        if any(pose.key == key for pose in files.given_poses(self._rig)):
            raise FacepinError(f"'{key}' is in the rig's own file, so it will be there again next time")
        if self._shared is not None and (self._shared / f"{key}.json").exists():
            raise FacepinError(f"{self._shared}: read-only, so '{key}' will be there again next time")

    def _taken(self, folder: Path) -> set[str]:
        """Return the names that a new file can't have: also of poses that undo may bring back."""
        return {*self._stored, *(path.stem for path in files.pose_files(folder))}

    def _store(self, folder: Path, saved: SavedPose) -> None:
        files.write_saved(folder, saved)
        self._stored[saved.key] = self._written[saved.key] = saved
        self._standing = None

    def _advance(self) -> None:
        assert self._reading is not None, "there is something to read"
        found = next(self._reading, None)
        if found is None:
            self._reading = None
        else:
            self._read(found)

    def _read(self, found: SavedPose | FacepinError) -> None:
        if isinstance(found, FacepinError):
            self.complaints.append(str(found))
        elif found.key not in self._stored:  # else it was saved meanwhile
            self._stored[found.key] = self._written[found.key] = found
            self._standing = None


def library_of(session: Session, settings: Path | None, *, own: bool) -> Library:
    """Return the library of an open rig.

    Parameters
    ----------
    session : Session
        Its rig.
    settings : Path
        The user's folder of the program, for rigs that poses can't be kept beside; None where there is none.
    own : bool
        Whether the rig is the user's own file.
    """
    source = session.rig.source if own else None
    folder = files.library_folder(session.rig.name, source, settings)
    if folder is None:
        remark = "There is no folder to keep poses in: neither beside this rig nor among the settings."
    elif source is None:
        remark = "Poses of the built-in face are kept among the settings."
    elif folder.parent == source.absolute().parent:
        remark = "Poses are kept beside the rig."
    else:
        remark = "The rig's own folder is read-only: its poses are kept among the settings."
        return Library(session, folder, remark, files.folder_beside(source))
    return Library(session, folder, remark)
