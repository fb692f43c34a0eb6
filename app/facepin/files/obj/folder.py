"""Rigs from a folder of .obj files: one neutral, one file per shape, the same vertices in the same order."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats, Points
from facepin.core.delta_columns import Delta
from facepin.core.errors import FacepinError
from facepin.core.rig import Rig
from facepin.core.rig_builder import PartLook, build_rig
from facepin.files.obj.cache import recall, remember
from facepin.files.obj.colours import read_colours
from facepin.files.obj.materials import look_like
from facepin.files.obj.neutral_file import find_neutral, neutral_candidates, obj_files
from facepin.files.obj.same_mesh import covers, likeness
from facepin.files.obj.text import ObjFaces, ObjText, check_text, cut_lines, read_faces, read_vertices
from facepin.files.options import ReadOptions

HEAD = 4096
"""Bytes by which a file is told to be text."""


def read_obj_folder(folder: Path, options: ReadOptions) -> Rig:
    """Read a rig from the .obj files of `folder`, ordered by name; every file but the neutral is a shape.

    The neutral is the file whose name contains "neutral", else one that has the word base, basis, rest,
    reference, default or template, unless `options.neutral` names it.  Faces and parts (`usemtl`) come from
    the neutral.  Other meshes beside it (eyes, hair) are parts that no shape moves; a shape whose vertices
    are in another order than the neutral's is left out with a warning.

    Raises
    ------
    NeutralUnknown
        Where it has to be asked for.
    FacepinError
        For a folder without .obj files or without shapes, for a shape with more or fewer vertices than the
        neutral, and with file and line for a broken file.
    """
    files = obj_files(folder)
    neutral = find_neutral(files, options.neutral, folder)
    if len(files) == 1:
        raise FacepinError(
            f"{folder.name}: only {neutral.name}; a rig needs one .obj file more for each shape"
        )
    if options.cache_folder is not None:
        remembered = recall(options.cache_folder, folder, files, neutral, options.progress)
        if remembered is not None:
            return remembered
    rig = _read(folder, files, neutral, options)
    if options.cache_folder is not None:
        remember(options.cache_folder, folder, files, neutral, rig)
    return rig


def read_obj_file(path: Path, options: ReadOptions) -> Rig:
    """Read the folder of an .obj file, which is the neutral unless there is just one that seems to be."""
    if options.neutral is None and len(neutral_candidates(obj_files(path.parent))) != 1:
        options = ReadOptions(path.name, options.progress, options.cache_folder)
    return read_obj_folder(path.parent, options)


@dataclass(frozen=True, eq=False)
class _Mesh:
    """A file, read."""

    file: Path
    text: ObjText
    vertices: Floats
    """(n, 3)."""


@dataclass(frozen=True, eq=False)
class _Beside:
    """What stands beside the neutral."""

    shapes: list[tuple[str, Delta]] = field(default_factory=list)
    meshes: list[tuple[_Mesh, ObjFaces]] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)
    """Why files are left out, a line each."""
    told: list[str] = field(default_factory=list)
    """What else was odd."""


def _read(folder: Path, files: Sequence[Path], neutral: Path, options: ReadOptions) -> Rig:
    total = sum(file.stat().st_size for file in files) or 1
    options.progress(0.0, f"reading {neutral.name}")
    rest = _mesh(neutral)
    faces = read_faces(rest.text, len(rest.vertices))
    done = neutral.stat().st_size
    beside = _Beside()
    for file in files:
        if file != neutral:
            options.progress(done / total, f"reading {file.name}")
            _sort_out(_mesh(file), rest, faces, beside)
            done += file.stat().st_size
    if not beside.shapes and len(beside.left_out) + len(beside.meshes):
        found = [f"{mesh.file.name}: {_counts(mesh, rest)}" for mesh, _ in beside.meshes]
        raise FacepinError([*beside.left_out, *found][0])

    name = folder.resolve().name
    looks = _looks(rest, faces, name, beside)
    colours = [read_colours(rest.text)]
    vertices, corners, sizes, parts = [rest.vertices], [faces.corners], [faces.sizes], [faces.part_of_face]
    for mesh, more in beside.meshes:
        parts.append(more.part_of_face + len(looks))
        looks += _looks(mesh, more, mesh.file.stem, beside)
        corners.append(more.corners + sum(map(len, vertices)))
        sizes.append(more.sizes)
        vertices.append(mesh.vertices)
        colours.append(read_colours(mesh.text))
    return build_rig(
        name,
        np.concatenate(vertices),
        np.concatenate(corners),
        np.concatenate(sizes),
        iter(beside.shapes),
        parts=looks,
        face_parts=np.concatenate(parts),
        colours=_all_colours(colours, [len(points) for points in vertices]),
        warnings=[*(f"left out: {line}" for line in beside.left_out), *beside.told],
        source=folder,
    )


def _looks(mesh: _Mesh, faces: ObjFaces, name: str, beside: _Beside) -> list[PartLook]:
    """Return the looks of the parts of a mesh; `name` is that of one which is a single part."""
    looks = [PartLook(part) for part in faces.part_names] or [PartLook(name)]
    return look_like(looks, faces.part_names or [""], mesh.text, mesh.file.parent, beside.told)


def _mesh(file: Path) -> _Mesh:
    with file.open("rb") as stream:  # the head decides before the rest is read
        head = stream.read(HEAD)
        check_text(head, file.name)
        text = cut_lines(head + stream.read(), file.name)
    return _Mesh(file, text, read_vertices(text))


def _sort_out(mesh: _Mesh, rest: _Mesh, faces: ObjFaces, beside: _Beside) -> None:
    """Take a file for a shape of the neutral, for a mesh beside it or for neither."""
    name, count = mesh.file.name, len(rest.vertices)
    if len(mesh.vertices) != count:
        own = read_faces(mesh.text, len(mesh.vertices))
        if not len(own.sizes) or covers(rest.vertices, mesh.vertices):
            raise FacepinError(f"{name}: {_counts(mesh, rest)}")
        beside.meshes.append((mesh, own))
        return
    vertices = mesh.vertices
    if not _same_lines(mesh.text, rest.text):
        try:
            like = likeness(faces, read_faces(mesh.text, count), count)
        except FacepinError as error:
            beside.told.append(f"faces that can't be compared with those of {rest.file.name}: {error}")
        else:
            if like.strange_face is not None:
                at = f"{name}:{mesh.text.lines_of(b'f')[like.strange_face] + 1}"
                beside.left_out.append(
                    f"{at}: face {like.strange_face} joins other vertices than those of {rest.file.name}, "
                    "so they are in another order; allowed: the same order (as a shape it would be a knot)"
                )
                return
            if like.order is not None:
                vertices = vertices[like.order]
                beside.told.append(
                    f"{name}: its vertices are in another order than those of {rest.file.name} "
                    "(its faces differ); which is which was told by the order of the faces"
                )
    delta = (vertices - rest.vertices).astype(np.float32)
    moved = np.flatnonzero(delta.any(axis=1))
    beside.shapes.append((mesh.file.stem, (moved.astype(np.int32), delta[moved])))


def _same_lines(one: ObjText, other: ObjText) -> bool:
    """Say whether two files have the very same lines of faces, none counted back from where it stands."""
    here, there = (text.joined(text.lines_of(b"f")) for text in (one, other))
    return here == there and b"-" not in here


def _counts(mesh: _Mesh, rest: _Mesh) -> str:
    return f"{len(mesh.vertices)} vertices, {rest.file.name} has {len(rest.vertices)}"


def _all_colours(found: Sequence[Points | None], counts: Sequence[int]) -> NDArray[np.float32] | None:
    """Return the colours of all meshes, white for one that has none; None if no mesh has any."""
    if all(colours is None for colours in found):
        return None
    pairs: Iterator[tuple[Points | None, int]] = zip(found, counts, strict=True)
    return np.concatenate(
        [np.ones((n, 3), np.float32) if colours is None else colours for colours, n in pairs]
    )
