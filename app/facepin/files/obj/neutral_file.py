"""The .obj files of a folder, and which of them is the neutral."""

import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from unicodedata import normalize

from facepin.core.errors import FacepinError
from facepin.core.names import listed
from facepin.core.sorting import natural_key

NEUTRAL_WORDS = ("base", "basis", "rest", "reference", "default", "template")
MODELS = (".glb", ".gltf", ".vrm", ".npz")
MOST_SUBFOLDERS = 1000
"""Subfolders in which is looked for .obj files, to say where they are."""


class NeutralUnknown(FacepinError):
    """A folder whose neutral has to be named."""

    def __init__(self, line: str, folder: Path, names: Sequence[str], likely: str) -> None:
        """Say so in one line; `likely` is that of the file `names` which it may be first of all."""
        super().__init__(line)
        self.folder = folder
        self.names = tuple(names)
        self.likely = likely


def obj_files(folder: Path) -> list[Path]:
    """Return the .obj files of a folder, as people sort them.

    Raises
    ------
    FacepinError
        If there is none, or for a link that leads out of the folder.
    """
    inside = folder.resolve()
    files = []
    others = []
    for file in sorted(folder.iterdir(), key=lambda path: natural_key(path.name)):
        if file.name.startswith(".") or not file.is_file():
            continue
        if file.suffix.lower() != ".obj":
            others.append(file.name)
        elif not file.resolve().is_relative_to(inside):
            raise FacepinError(
                f"{file.name}: a link that leads out of the folder, allowed are files inside it"
            )
        else:
            files.append(file)
    if not files:
        raise FacepinError(f"{inside.name}: no .obj files in this folder{_hint(folder, others)}")
    return files


def find_neutral(files: Sequence[Path], wanted: str | None, folder: Path) -> Path:
    """Return the neutral of a folder: the `wanted` one, else the only one whose name says so.

    Raises
    ------
    NeutralUnknown
        When no name says so, or several do.
    FacepinError
        When there is no file of the wanted name.
    """
    where = folder.resolve().name
    names = [file.name for file in files]
    if wanted is not None:
        for file in files:
            if _plain(wanted) in (_plain(file.name), _plain(file.stem)):
                return file
        raise FacepinError(f"{where}: no file {wanted!a} to be the neutral, there are: {listed(names)}")
    candidates = neutral_candidates(files)
    if len(candidates) == 1:
        return candidates[0]
    few = [file.name for file in candidates] or names
    what = "several files may be the neutral" if candidates else "no file can be told to be the neutral"
    line = f"{where}: {what}, open that file itself or name it with --neutral: {listed(few)}"
    raise NeutralUnknown(line, folder, [*few, *(name for name in names if name not in few)], few[0])


def neutral_candidates(files: Sequence[Path]) -> list[Path]:
    """Return the files that may be the neutral: the best kind of match that any file has."""
    stems = {file: file.stem.lower() for file in files}
    exact = [file for file, stem in stems.items() if stem == "neutral"]
    containing = [file for file, stem in stems.items() if "neutral" in stem]
    words = [
        file for file, stem in stems.items() if set(re.split(r"[^a-z]+", stem)).intersection(NEUTRAL_WORDS)
    ]
    return exact or containing or words


def _plain(name: str) -> str:
    return normalize("NFC", name).casefold()


def _hint(folder: Path, others: Sequence[str]) -> str:
    """Return what to do instead in a folder without .obj files."""
    models = [name for name in others if name.lower().endswith(MODELS)]
    if models:
        return f"; to open {models[0]}, name the file itself"
    subfolders = sorted(path for path in folder.iterdir() if path.is_dir() and path.name[0] != ".")
    counts = Counter(
        path.name
        for path in subfolders[:MOST_SUBFOLDERS]
        for file in path.iterdir()
        if file.suffix.lower() == ".obj"
    )
    if len(counts) == 1:
        (name,) = counts
        return f", they are in its subfolder {name}: open that"
    if counts:
        where = listed([f"{name} ({count})" for name, count in counts.items()])
        return f", they are in {where}: put neutral and shapes into one folder"
    return f" (it has: {listed(others) or 'nothing'})"
