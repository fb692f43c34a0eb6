"""Arrays of a .npz archive.  Headers are checked before anything is inflated; nothing is ever unpickled."""

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

HEADER = re.compile(
    rb"\s*\{\s*'descr':\s*'(?P<dtype>[^']{1,20})',\s*'fortran_order':\s*(?P<fortran>True|False),"
    rb"\s*'shape':\s*\((?P<shape>[\d,\s]{0,100})\),?\s*\}\s*"
)
PLAIN = re.compile(r"[<>|=]?(f2|f4|f8|f16|[iu][1248]|b1|[US][1-9]\d{0,8})")
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


@contextmanager
def open_archive(path: Path) -> Iterator["Archive"]:
    """Open the archive at `path`, and close it.

    Raises
    ------
    FacepinError
        If it is no sound zip archive.
    """
    with ExitStack() as stack:
        with sound(path.name):
            archive = stack.enter_context(zipfile.ZipFile(path))
        yield Archive(archive, path)


@contextmanager
def sound(name: str) -> Iterator[None]:
    """Turn everything that a broken zip archive makes `zipfile` raise into one line."""
    try:
        yield
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError, ValueError) as error:
        raise FacepinError(f"{name}: not a sound .npz archive: {str(error)[:120]}") from error


class Archive:
    """The arrays of a .npz, read on request."""

    def __init__(self, archive: zipfile.ZipFile, path: Path) -> None:
        self._zip = archive
        self._size = path.stat().st_size
        self.name = path.name
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
        stored = min(member.info.compress_size, self._size)
        if member.info.file_size > LARGEST_RATIO * stored + 2**20:
            raise FacepinError(
                f"{self.name}: {member.name} inflates from {stored} bytes to {member.info.file_size}, "
                "out of proportion"
            )
        with sound(f"{self.name}: {member.name}"), self._zip.open(member.info) as file:
            content = file.read()
        flat = np.frombuffer(content, member.dtype, offset=member.header_size)
        return _portable(flat.reshape(member.shape, order="F" if member.fortran else "C"))

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
                yield _portable(np.frombuffer(content, member.dtype).reshape(member.shape[1:]))


def _portable(array: NDArray[Any]) -> NDArray[Any]:
    """Return long doubles as doubles: JSON, OpenGL and most of numpy's neighbours know no others."""
    return array.astype(np.float64) if array.dtype.kind == "f" and array.dtype.itemsize > 8 else array


def texts(array: NDArray[Any]) -> list[str]:
    """Return an array of texts (k,) as strings; codes that are no characters become a replacement mark."""
    if array.dtype.kind == "S":
        return [bytes(text).decode("utf-8", "replace") for text in array]
    codec = "utf-32-be" if array.dtype.byteorder == ">" else "utf-32-le"
    return [text.tobytes().decode(codec, "replace").rstrip("\0") for text in array[:, None]]


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
    described = match["dtype"].decode("latin-1")
    if not PLAIN.fullmatch(described):
        raise FacepinError(
            f"{where}: holds {described!a}, allowed are plain numbers and texts; nothing is unpickled"
        )
    try:
        dtype = np.dtype(described)
    except TypeError as error:  # long doubles are not the same everywhere
        raise FacepinError(f"{where}: this machine has no numbers of type {described}") from error
    shape = tuple(int(size) for size in match["shape"].decode("ascii").split(",") if size.strip())
    return dtype, shape, match["fortran"] == b"True", 8 + width + length
