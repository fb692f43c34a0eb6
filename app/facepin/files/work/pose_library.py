"""A library of poses: a folder of ordinary pose files beside the rig, each with an optional picture.

A pose of a library is a pose file (`pose_file`) with three more fields, all optional: `title`, `tags` (texts)
and `order` (a number).  So a pose file that is copied into the folder is in the library, and one of the
library opens like any other.
"""

import hashlib
import json
import os
from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from facepin.core.errors import FacepinError
from facepin.core.names import clean_name
from facepin.core.pose import Pose
from facepin.core.rig import Rig
from facepin.core.saved_pose import SavedPose, clean_tags
from facepin.core.sorting import natural_key
from facepin.files.safely.atomic import atomic_write
from facepin.files.safely.checked_json import parse_json
from facepin.files.safely.reading import read_bytes
from facepin.files.work.pose_file import pose_document, pose_of_document

SUFFIX = ".poses"
LONGEST_KEY = 60
RESERVED = {"con", "prn", "aux", "nul", *(f"{port}{n}" for port in ("com", "lpt") for n in range(1, 10))}
"""Names that Windows gives to no file."""


def folder_beside(source: Path) -> Path:
    """Return the folder for poses beside a rig's file or folder, whether it exists or not."""
    source = source.absolute()
    return source.with_name((source.name if source.is_dir() else source.stem) + SUFFIX)


def library_folder(name: str, source: Path | None, settings: Path | None) -> Path | None:
    """Return where the poses of a rig are kept, whether it exists or not.

    Parameters
    ----------
    name : str
        Of the rig.
    source : Path
        Where it came from; None for one that is not the user's own file.
    settings : Path
        The user's folder of the program, for rigs whose own place can't be written to.

    Returns
    -------
    Path
        Beside the rig if that can be written, else among the settings; None where neither is.
    """
    if source is None:
        return None if settings is None else settings / "poses" / f"{key_of(name)}{SUFFIX}"
    beside = folder_beside(source)
    if os.access(beside if beside.is_dir() else beside.parent, os.W_OK):
        return beside
    if settings is None:
        return None
    # Rigs of one name from two places must not share their poses.
    mark = hashlib.sha256(str(beside).encode()).hexdigest()[:8]
    return settings / "poses" / f"{beside.stem}-{mark}{SUFFIX}"


def pose_files(folder: Path) -> list[Path]:
    """Return the files of a library that may be poses, by name; none where there is no such folder.

    Raises
    ------
    FacepinError
        If the folder cannot be read.
    """
    try:
        if not folder.is_dir():
            return []
        paths = [path for path in folder.iterdir() if path.suffix == ".json" and path.name[0] != "."]
        return sorted(paths, key=lambda path: natural_key(path.stem))
    except OSError as error:
        raise FacepinError(f"{folder}: cannot be read: {error.strerror or error}") from error


def saved_poses(folder: Path, rig: Rig, known: Collection[str] = ()) -> Iterator[SavedPose | FacepinError]:
    """Read the poses of a library one after another; for a file that is none, give what is wrong with it.

    Files whose keys are `known` are passed over.
    """
    try:
        for path in pose_files(folder):
            if path.stem in known:
                continue
            try:
                yield read_saved(path, rig)
            except FacepinError as error:
                yield error
    except FacepinError as error:
        yield error


def given_poses(rig: Rig) -> Iterator[SavedPose]:
    """Return the poses that the file of a rig brings as a library holds them; none has a file of its own."""
    taken: list[str] = []
    for title, weights in rig.poses:
        taken.append(free_key(title, taken))
        yield new_saved(rig, Pose(weights), taken[-1], title, (), None)


def read_saved(path: Path, rig: Rig) -> SavedPose:
    """Read one pose of a library onto a rig.

    Raises
    ------
    FacepinError
        If it is not a pose file.
    """
    document = parse_json(read_bytes(path), path.name)
    pose, report = pose_of_document(document, rig)
    title = clean_name(document.text("title", path.stem)) or path.stem
    order = document.number("order", low=-1e12, high=1e12) if "order" in document else None
    tags = clean_tags(",".join(document.strings("tags")))
    return SavedPose(path.stem, title, tags, order, pose.weights, report, document.values)


def new_saved(
    rig: Rig, pose: Pose, key: str, title: str, tags: tuple[str, ...], order: float | None
) -> SavedPose:
    """Return a pose as it will stand in a library, pins and all."""
    return SavedPose(key, title, tags, order, pose.weights, "", pose_document(rig, pose))


def replaced(saved: SavedPose, rig: Rig, pose: Pose) -> SavedPose:
    """Return a saved pose with another pose in it, under its name."""
    document = {**saved.document, **pose_document(rig, pose)}
    return replace(saved, weights=pose.weights, report="", document=document)


def write_saved(folder: Path, saved: SavedPose) -> None:
    """Write a pose into a library, which is made if it is not there.

    Raises
    ------
    FacepinError
        If it cannot be written; what was there before stays as it was.
    """
    document: dict[str, Any] = dict(saved.document)
    labels = {"title": (saved.title, saved.key), "tags": (list(saved.tags), []), "order": (saved.order, None)}
    for field, (value, default) in labels.items():
        document.pop(field, None)
        if value != default:  # so that undo leads back to a file without a title, byte for byte
            document[field] = value
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FacepinError(f"{folder}: cannot be made: {error.strerror or error}") from error
    try:
        text = json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False) + "\n"
        content = text.encode()
    except ValueError as error:  # what others have put into the file, and Facepin does not know
        raise FacepinError(f"{saved.key}.json: a field can't be written again: {error}") from error
    atomic_write(folder / f"{saved.key}.json", content)


def remove_saved(folder: Path, key: str) -> None:
    """Take a pose and its picture out of a library; one that is not there is no fault.

    Raises
    ------
    FacepinError
        If it cannot be removed.
    """
    try:
        for suffix in (".json", ".png"):
            (folder / f"{key}{suffix}").unlink(missing_ok=True)
    except OSError as error:
        raise FacepinError(f"{folder / key}: cannot be removed: {error.strerror or error}") from error


def free_key(title: str, taken: Iterable[str]) -> str:
    """Return a file name without suffix for a pose of that title, none of `taken` in any case of letters."""
    key = key_of(title)
    there = {other.lower() for other in taken}
    number, free = 2, key
    while free.lower() in there:
        free, number = f"{key} {number}", number + 1
    return free


def key_of(title: str) -> str:
    """Return what of a title every file system takes for a name."""
    letters = "".join(c if c.isalnum() or c in " -_+" else "-" for c in title)
    key = " ".join(letters.split()).strip("- ")[:LONGEST_KEY].rstrip() or "pose"
    return f"{key}-pose" if key.lower() in RESERVED else key
