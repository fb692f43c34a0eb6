"""Rigs from numpy archives.  Headers are checked before anything is inflated; nothing is ever unpickled."""

import re
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from math import prod
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from facepin.core.errors import FacepinError
from facepin.core.rig import Rig
from facepin.core.rig_builder import Delta, PartLook, build_rig
from facepin.files.options import ReadOptions

HEADER = re.compile(
    rb"\s*\{\s*'descr':\s*'(?P<dtype>[^']{1,20})',\s*'fortran_order':\s*(?P<fortran>True|False),"
    rb"\s*'shape':\s*\((?P<shape>[\d,\s]{0,100})\),?\s*\}\s*"
)
LONGEST_HEADER = 4096
LARGEST_RATIO = 200
"""Inflated bytes for one stored byte that geometry may reach; shapes, read one by one, may be all zeros."""


@dataclass(frozen=True)
class Member:
    """One array of the archive, by its header."""

    name: str
    dtype: np.dtype[Any]
    shape: tuple[int, ...]
    fortran: bool
    header_size: int
    info: zipfile.ZipInfo


def read_npz(path: Path, options: ReadOptions) -> Rig:
    """Read a rig from `neutral` (n, 3), `faces` (m, 3 or 4; -1 fills up) and `deltas` (k, n, 3).

    Optional: `names` (k); `part` (n) with `part_names`, or `region` with `region_names`: the part of every
    vertex, a face belongs to that of its first corner; `part_colours`, a row per part; `colors` or `colours`
    (n, 3); `weights` (k).  Colours are sRGB, 0..1 or bytes.  What does not fit is left out with a warning.

    Raises
    ------
    FacepinError
        For a broken archive, headers that lie or do not fit together, or numbers that are not finite.
    """
    options.progress(0.0, f"reading {path.name}")
    with ExitStack() as stack:
        with sound(path.name):
            archive = stack.enter_context(zipfile.ZipFile(path))
        return _read(Archive(archive, path.name), path, options)


@contextmanager
def sound(name: str) -> Iterator[None]:
    """Turn everything that a broken zip archive makes `zipfile` raise into one line."""
    try:
        yield
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError, ValueError) as error:
        raise FacepinError(f"{name}: not a sound .npz archive: {error}") from error


class Archive:
    """The arrays of a .npz, read on request."""

    def __init__(self, archive: zipfile.ZipFile, name: str) -> None:
        self._zip = archive
        self.name = name
        self.infos = {info.filename.removesuffix(".npy"): info for info in archive.infolist()}

    def __contains__(self, key: str) -> bool:
        return key in self.infos

    def member(self, key: str) -> Member:
        """Read the header of array `key` and check it against the archive's directory."""
        if key not in self.infos:
            raise FacepinError(
                f"{self.name}: no array {key!r}, there are: {', '.join(self.infos)[:200] or 'none'}"
            )
        info = self.infos[key]
        where = f"{self.name}: {key}"
        if info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            raise FacepinError(
                f"{where}: packed with zip method {info.compress_type}, allowed are 0 and 8 (deflate)"
            )
        with sound(where), self._zip.open(info) as file:
            dtype, shape, fortran, header_size = _header(file, where)
        declared = prod(shape) * dtype.itemsize + header_size
        if declared != info.file_size:
            raise FacepinError(
                f"{where}: its header declares {declared} bytes, the archive holds {info.file_size}"
            )
        return Member(key, dtype, shape, fortran, header_size, info)

    def array(self, member: Member) -> NDArray[Any]:
        """Inflate a whole array, unless it is out of proportion to its place in the file."""
        if member.info.file_size > LARGEST_RATIO * member.info.compress_size + 2**20:
            raise FacepinError(
                f"{self.name}: {member.name} inflates from {member.info.compress_size} bytes to "
                f"{member.info.file_size}, out of proportion"
            )
        with sound(f"{self.name}: {member.name}"), self._zip.open(member.info) as file:
            content = file.read()
        flat = np.frombuffer(content, member.dtype, offset=member.header_size)
        return flat.reshape(member.shape, order="F" if member.fortran else "C")

    def slices(self, member: Member) -> Iterator[NDArray[Any]]:
        """Inflate an array one leading index at a time, so that memory does not grow with its first axis."""
        if member.fortran:
            yield from self.array(member)
            return
        size = prod(member.shape[1:]) * member.dtype.itemsize
        where = f"{self.name}: {member.name}"
        with ExitStack() as stack:
            with sound(where):
                file = stack.enter_context(self._zip.open(member.info))
                file.read(member.header_size)
            for _ in range(member.shape[0]):
                with sound(where):  # the last read also checks the CRC
                    content = file.read(size)
                if len(content) < size:
                    raise FacepinError(f"{where} ends early")
                yield np.frombuffer(content, member.dtype).reshape(member.shape[1:])


def _header(file: IO[bytes], where: str) -> tuple[np.dtype[Any], tuple[int, ...], bool, int]:
    """Return dtype, shape, order and header size of a .npy stream; plain number and text types only."""
    start = file.read(8)
    if len(start) < 8 or start[:6] != b"\x93NUMPY" or start[6] not in (1, 2, 3):
        raise FacepinError(f"{where}: not a .npy array of version 1 to 3")
    width = 2 if start[6] == 1 else 4
    length = int.from_bytes(file.read(width), "little")
    if length > LONGEST_HEADER:
        raise FacepinError(f"{where}: array header of {length} bytes, allowed are {LONGEST_HEADER}")
    match = HEADER.fullmatch(file.read(length))
    if match is None:
        raise FacepinError(f"{where}: its array header is not one of plain numbers or texts")
    try:
        dtype = np.dtype(match["dtype"].decode("latin-1"))
    except (TypeError, ValueError) as error:
        raise FacepinError(f"{where}: unknown number type {match['dtype'].decode('latin-1')!a}") from error
    if dtype.kind not in "fiubUS" or not dtype.itemsize:
        raise FacepinError(
            f"{where}: holds {dtype}, allowed are plain numbers and texts; nothing is unpickled"
        )
    shape = tuple(int(size) for size in match["shape"].decode("ascii").split(",") if size.strip())
    return dtype, shape, match["fortran"] == b"True", 8 + width + length


def _read(archive: Archive, path: Path, options: ReadOptions) -> Rig:
    where = path.name
    members = {key: archive.member(key) for key in ("neutral", "faces", "deltas")}
    neutral, faces, deltas = members.values()
    if neutral.dtype.kind != "f" or len(neutral.shape) != 2 or neutral.shape[1] != 3:
        raise FacepinError(f"{where}: neutral is {neutral.dtype} {neutral.shape}, allowed: floats (n, 3)")
    if faces.dtype.kind not in "iu" or len(faces.shape) != 2 or faces.shape[1] < 3:
        raise FacepinError(
            f"{where}: faces are {faces.dtype} {faces.shape}, allowed: whole numbers (m, 3) or (m, 4)"
        )
    count, vertices = (deltas.shape or (0,))[0], neutral.shape[0]
    if deltas.dtype.kind != "f" or deltas.shape[1:] != (vertices, 3) or not count:
        raise FacepinError(
            f"{where}: deltas are {deltas.dtype} {deltas.shape}, allowed: floats (k, {vertices}, 3), k > 0"
        )
    table = archive.array(faces).astype(np.int64)
    used = table != -1
    if (used[:, 1:] & ~used[:, :-1]).any():
        raise FacepinError(f"{where}: faces may have -1 after their last corner only")
    corners, sizes = table[used], used.sum(axis=1)
    extras = Extras(archive, count, vertices)
    names = extras.names()
    looks, part_of_vertex = extras.parts()
    face_parts = None
    if (
        part_of_vertex is not None
        and len(sizes)
        and sizes.min()
        and 0 <= corners.min() <= corners.max() < vertices
    ):
        face_parts = part_of_vertex[corners[np.cumsum(sizes) - sizes]]

    def shapes() -> Iterator[tuple[str, Delta]]:
        for j, delta in enumerate(archive.slices(deltas)):
            options.progress(0.1 + 0.9 * j / count, f"shape {j + 1} of {count}")
            yield names[j], delta

    return build_rig(
        path.stem,
        archive.array(neutral),
        corners,
        sizes,
        shapes(),
        parts=looks if face_parts is not None else (),
        face_parts=face_parts,
        colours=extras.colours(),
        rest_weights=extras.weights(),
        warnings=extras.warnings,
        source=path,
    )


class Extras:
    """The optional arrays, each taken only if it fits; otherwise a warning says why not."""

    def __init__(self, archive: Archive, shapes: int, vertices: int) -> None:
        self._archive = archive
        self._shapes = shapes
        self._vertices = vertices
        self.warnings: list[str] = []

    def names(self) -> list[str]:
        """Return a name for every shape, empty ones where there are none."""
        return self._texts("names", self._shapes) or [""] * self._shapes

    def parts(self) -> tuple[list[PartLook], NDArray[np.intp] | None]:
        """Return the looks of the parts and the part of every vertex, or nothing."""
        for key in ("part", "region"):
            numbers = self._fitting(key, "iu", (self._vertices,))
            if numbers is None or not len(numbers):
                continue
            names = self._texts(f"{key}_names", None)
            if names is None or numbers.min() < 0 or numbers.max() >= len(names):
                self.warnings.append(f"array {key!r} is ignored: its numbers need an array '{key}_names'")
                continue
            colours = self._fitting(f"{key}_colours", "fu", (len(names), 3))
            looks = [PartLook(name) for name in names]
            if colours is not None:
                looks = [
                    PartLook(name, (float(r), float(g), float(b)))
                    for name, (r, g, b) in zip(names, _unit(colours), strict=True)
                ]
            return looks, numbers.astype(np.intp)
        return [], None

    def colours(self) -> NDArray[Any] | None:
        """Return (n, 3) sRGB 0..1, or None."""
        for key in ("colors", "colours"):
            found = self._fitting(key, "fu", (self._vertices, 3))
            if found is not None:
                return _unit(found)
        return None

    def weights(self) -> NDArray[Any] | None:
        """Return (k,) rest weights, or None."""
        return self._fitting("weights", "f", (self._shapes,))

    def _texts(self, key: str, count: int | None) -> list[str] | None:
        found = self._fitting(key, "US", None if count is None else (count,))
        if found is None or found.ndim != 1:
            return None
        if found.dtype.kind == "S":
            return [bytes(text).decode("utf-8", "replace") for text in found]
        return [str(text) for text in found]

    def _fitting(self, key: str, kinds: str, shape: tuple[int, ...] | None) -> NDArray[Any] | None:
        """Return array `key` if it is there, of one of `kinds`, of `shape` and finite."""
        if key not in self._archive:
            return None
        try:
            member = self._archive.member(key)
            if member.dtype.kind not in kinds or (shape is not None and member.shape != shape):
                raise FacepinError(f"it is {member.dtype} {member.shape}, expected {shape or 'texts'}")
            array = self._archive.array(member)
            if member.dtype.kind == "f" and not np.isfinite(array).all():
                raise FacepinError("it has numbers that are not finite")
        except (FacepinError, UnicodeDecodeError, ValueError) as error:
            self.warnings.append(f"array {key!r} is ignored: {error}")
            return None
        return array


def _unit(colours: NDArray[Any]) -> NDArray[np.float32]:
    """Return colours 0..1; bytes are divided by 255."""
    return (colours / 255.0 if colours.dtype.kind == "u" else np.clip(colours, 0.0, 1.0)).astype(np.float32)
