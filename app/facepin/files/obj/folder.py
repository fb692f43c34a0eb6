"""Rigs from a folder of .obj files: one neutral, one file per shape, the same vertices in the same order."""

import re
from collections.abc import Iterator
from pathlib import Path

from facepin.core.arrays import Floats
from facepin.core.delta_columns import Delta
from facepin.core.errors import FacepinError
from facepin.core.names import listed
from facepin.core.rig import Rig
from facepin.core.rig_builder import PartLook, build_rig
from facepin.files.obj.cache import recall, remember
from facepin.files.obj.text import cut_lines, read_faces, read_vertices
from facepin.files.options import ReadOptions

NAME_IT = "open that file itself or name it with --neutral"
NEUTRAL_WORDS = ("base", "basis", "rest")


def read_obj_folder(folder: Path, options: ReadOptions) -> Rig:
    """Read a rig from the .obj files of `folder`, ordered by name; every file but the neutral is a shape.

    The neutral is the file whose name contains "neutral", else one that has the word base, basis or rest,
    unless `options.neutral` names it.  Faces and parts (`usemtl`) come from the neutral.

    Raises
    ------
    FacepinError
        For a folder without .obj files or without a neutral, and with file and line for a broken file.
    """
    files = _obj_files(folder)
    neutral = _find_neutral(files, options.neutral, folder)
    if len(files) == 1:
        raise FacepinError(
            f"{folder.name}: only {neutral.name}; a rig needs one .obj file more for each shape"
        )
    if options.cache_folder is not None:
        remembered = recall(options.cache_folder, folder, files, neutral, options.progress)
        if remembered is not None:
            return remembered

    sizes = [file.stat().st_size for file in files]
    total = sum(sizes) or 1
    options.progress(0.0, f"reading {neutral.name}")
    text = cut_lines(neutral.read_bytes(), neutral.name)
    rest = read_vertices(text)
    faces = read_faces(text, len(rest))

    def shapes() -> Iterator[tuple[str, Delta]]:
        done = neutral.stat().st_size
        for file, size in zip(files, sizes, strict=True):
            if file == neutral:
                continue
            options.progress(done / total, f"reading {file.name}")
            yield file.stem, _moves(file, rest, neutral.name)
            done += size

    rig = build_rig(
        folder.resolve().name,
        rest,
        faces.corners,
        faces.sizes,
        shapes(),
        parts=[PartLook(name) for name in faces.part_names],
        face_parts=faces.part_of_face,
        source=folder,
    )
    if options.cache_folder is not None:
        remember(options.cache_folder, folder, files, neutral, rig)
    return rig


def read_obj_file(path: Path, options: ReadOptions) -> Rig:
    """Read the folder of an .obj file, which is the neutral unless there is just one that seems to be."""
    files = _obj_files(path.parent)
    if options.neutral is None and len(_candidates(files)) != 1:
        options = ReadOptions(path.name, options.progress, options.cache_folder)
    return read_obj_folder(path.parent, options)


def _moves(file: Path, rest: Floats, neutral: str) -> Floats:
    vertices = read_vertices(cut_lines(file.read_bytes(), file.name))
    if len(vertices) != len(rest):
        raise FacepinError(f"{file.name}: {len(vertices)} vertices, {neutral} has {len(rest)}")
    return vertices - rest


def _obj_files(folder: Path) -> list[Path]:
    """Return the .obj files of a folder by name; links that lead out of it are refused."""
    inside = folder.resolve()
    files = []
    others = []
    for file in sorted(folder.iterdir()):
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
        models = [name for name in others if name.lower().endswith((".glb", ".gltf", ".vrm", ".npz"))]
        hint = (
            f"; to open {models[0]}, name the file itself"
            if models
            else f" (it has: {listed(others) or 'nothing'})"
        )
        raise FacepinError(f"{folder.resolve().name}: no .obj files in this folder{hint}")
    return files


def _candidates(files: list[Path]) -> list[Path]:
    """Return the files that may be the neutral: the best kind of match that any file has."""
    stems = {file: file.stem.lower() for file in files}
    exact = [file for file, stem in stems.items() if stem == "neutral"]
    containing = [file for file, stem in stems.items() if "neutral" in stem]
    words = [
        file for file, stem in stems.items() if set(re.split(r"[^a-z]+", stem)).intersection(NEUTRAL_WORDS)
    ]
    return exact or containing or words


def _find_neutral(files: list[Path], wanted: str | None, folder: Path) -> Path:
    names = listed([file.name for file in files])
    if wanted is not None:
        for file in files:
            if wanted.lower() in (file.name.lower(), file.stem.lower()):
                return file
        raise FacepinError(
            f"{folder.resolve().name}: no file {wanted!a} to be the neutral, there are: {names}"
        )
    candidates = _candidates(files)
    if len(candidates) == 1:
        return candidates[0]
    if candidates:
        several = listed([file.name for file in candidates])
        raise FacepinError(f"{folder.resolve().name}: several files may be the neutral, {NAME_IT}: {several}")
    raise FacepinError(f"{folder.resolve().name}: no file can be told to be the neutral, {NAME_IT}: {names}")
