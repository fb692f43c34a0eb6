"""The file itself, .glb or .gltf: its head is looked at before anything else is read."""

import struct
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from facepin.core.errors import FacepinError

JSON_CHUNK, BINARY_CHUNK = 0x4E4F534A, 0x004E4942

LARGEST_JSON = 1 << 29
"""Bytes of JSON: far more than any scene has, unless its data stand in it as text."""
HEAD = 64
"""Bytes within which JSON has begun."""


@dataclass(frozen=True)
class Container:
    """The JSON of a glTF, and where in the same file its binary chunk is."""

    path: Path
    text: bytes
    start: int = 0
    length: int | None = None
    """Bytes of the binary chunk, None where there is none."""

    def binary(self, most: int) -> bytes:
        """Return at most the first `most` bytes of the binary chunk."""
        with self.path.open("rb") as file:
            file.seek(self.start)
            return file.read(min(most, self.length or 0))


def read_container(path: Path) -> Container:
    """Return the JSON of a .glb, .vrm or .gltf.

    Raises
    ------
    FacepinError
        For what is no glTF, or says that it is larger than it is.
    """
    with path.open("rb") as file:
        size = path.stat().st_size
        head = file.read(12)
        if head[:4] == b"glTF" or path.suffix.lower() != ".gltf":
            return _glb(file, head, size, path)
        return Container(path, _json(file, 0, size, path.name))


def _glb(file: BinaryIO, head: bytes, size: int, path: Path) -> Container:
    """Return the content of a GLB, whose first chunk is JSON and whose second, if any, is binary."""
    name = path.name
    if len(head) < 12:
        raise FacepinError(f"{name}: {len(head)} bytes, a GLB header alone has 12")
    magic, version, length = struct.unpack("<4sII", head)
    if magic != b"glTF":
        raise FacepinError(
            f"{name}: begins with {magic.decode('latin-1')!a}, allowed: 'glTF' (a binary glTF)"
        )
    if version != 2:
        raise FacepinError(f"{name}: glTF version {version}, allowed: 2")
    if length > size:
        raise FacepinError(f"{name}: header declares {length} bytes, the file has {size}")
    first = _chunk(file, 12, length, name)
    if first is None or first[0] != JSON_CHUNK:
        raise FacepinError(f"{name}: no JSON chunk")
    second = _chunk(file, 20 + first[1], length, name)
    text = _json(file, 20, first[1], name)
    if second is None or second[0] != BINARY_CHUNK:
        return Container(path, text)
    return Container(path, text, 28 + first[1], second[1])


def _chunk(file: BinaryIO, at: int, length: int, name: str) -> tuple[int, int] | None:
    """Return kind and size of the chunk at a byte, None at the end of the file."""
    if at + 8 > length:
        return None
    file.seek(at)
    head = file.read(8)
    if len(head) < 8:
        raise FacepinError(f"{name}: ends at byte {at + len(head)}, its header declares {length} bytes")
    size, kind = struct.unpack("<II", head)
    if at + 8 + size > length:
        raise FacepinError(f"{name}: chunk at byte {at} declares {size} bytes, {length - at - 8} are left")
    return kind, size


def _json(file: BinaryIO, at: int, size: int, name: str) -> bytes:
    """Return `size` bytes that look like a JSON object."""
    if size > LARGEST_JSON:
        raise FacepinError(f"{name}: {size} bytes of JSON, allowed are {LARGEST_JSON}")
    file.seek(at)
    head = file.read(min(HEAD, size))
    start = head.removeprefix(b"\xef\xbb\xbf").lstrip()
    if start and not start.startswith(b"{"):
        raise FacepinError(f"{name}: not JSON: begins with {start[:8].decode('latin-1')!a}, allowed: '{{'")
    return head + file.read(size - len(head))
