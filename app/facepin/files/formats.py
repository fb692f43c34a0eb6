"""The formats, by suffix, and the two doors: `open_rig` and `write_model`."""

import os
from collections.abc import Callable, Mapping
from pathlib import Path

from facepin.core.arrays import Floats
from facepin.core.errors import FacepinError
from facepin.core.rig import Rig
from facepin.core.turn import AS_IN_FILE, back
from facepin.files.gltf.reader import read_gltf
from facepin.files.gltf.writer import write_glb
from facepin.files.mesh_writers import write_obj, write_ply, write_stl
from facepin.files.npz.reader import read_npz
from facepin.files.obj.folder import read_obj_file, read_obj_folder
from facepin.files.options import Progress, ReadOptions, no_progress

FOLDER = "folder"

READERS: dict[str, Callable[[Path, ReadOptions], Rig]] = {
    FOLDER: read_obj_folder,
    ".obj": read_obj_file,
    ".glb": read_gltf,
    ".gltf": read_gltf,
    ".vrm": read_gltf,
    ".npz": read_npz,
}

WRITERS: dict[str, Callable[[Rig, Floats, Path], None]] = {
    ".glb": write_glb,
    ".obj": write_obj,
    ".ply": write_ply,
    ".stl": write_stl,
}


def open_rig(
    path: str | os.PathLike[str],
    *,
    neutral: str | None = None,
    progress: Progress | None = None,
    cache: bool = True,
    cache_folder: Path | None = None,
) -> Rig:
    """Open a rig from a file or from a folder of OBJ files.

    Parameters
    ----------
    path : file or folder
        Its suffix chooses the reader, see `READERS`.
    neutral : str
        For a folder: name of the file with the neutral, with or without its suffix.
    progress : callable
        Told fraction and a short line; an exception that it raises abandons the reading and comes out.
    cache, cache_folder
        Whether a parsed folder is remembered, and where (in the user's cache folder when left out).

    Raises
    ------
    FacepinError
        In one line, whatever is wrong with the file.
    """
    path = Path(path)
    if cache and cache_folder is None:
        from platformdirs import user_cache_path

        cache_folder = user_cache_path("facepin", appauthor=False) / "rigs"
    options = ReadOptions(neutral, progress or no_progress, cache_folder if cache else None)
    try:
        reader = _reader_for(path, neutral)
        rig = reader(path, options)
    except OSError as error:
        raise FacepinError(f"{path}: cannot be read: {error.strerror or error}") from error
    except MemoryError as error:
        raise FacepinError(f"{path}: does not fit into memory") from error
    options.progress(1.0, f"{rig.name} is open")
    return rig


def write_model(rig: Rig, weights: Floats, path: str | os.PathLike[str]) -> None:
    """Write a face posed with `weights` (k,); the suffix of `path` chooses the format, see `WRITERS`.

    A .glb keeps the rig: neutral, shapes, and `weights` as its own weights.  The others hold the posed mesh.
    What was turned lies as in its own file again: it fits what it was made for.

    Raises
    ------
    FacepinError
        For another suffix, or if the file cannot be written.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix not in WRITERS:
        found = suffix or "files without a suffix"
        raise FacepinError(f"{path.name}: no writer for {found!r}, there are: {known(WRITERS)}")
    WRITERS[suffix](rig if rig.turn == AS_IN_FILE else rig.turned(back(rig.turn)), weights, path)


def _reader_for(path: Path, neutral: str | None) -> Callable[[Path, ReadOptions], Rig]:
    if "\0" in str(path) or not path.exists():
        raise FacepinError(f"{ascii(str(path))[1:-1]}: no such file or folder")
    if path.is_dir():
        return READERS[FOLDER]
    if not path.is_file():
        raise FacepinError(f"{path}: neither a file nor a folder")
    suffix = path.suffix.lower()
    if suffix not in READERS:
        found = suffix or "files without a suffix"
        raise FacepinError(f"{path.name}: no reader for {found!r}, there are: {known(READERS)}")
    if neutral is not None and suffix != ".obj":
        raise FacepinError(
            f"{path.name}: a neutral can be named for a folder of .obj files only, found {suffix}"
        )
    return READERS[suffix]


def known(registry: Mapping[str, object]) -> str:
    """Return the keys of a registry as one line."""
    return ", ".join("a folder of .obj files" if key == FOLDER else key for key in registry)
