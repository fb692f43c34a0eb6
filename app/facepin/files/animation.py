"""Animated pictures as PNG (APNG).

Not GIF: its 256 colours show as bands on skin, and it knows no half transparency.  APNG holds the very pixels
of the frames, is played by every browser, and is read as its first frame by what does not know it.

Frames are kept packed as they come: Pillow wants all of them unpacked before it writes the first, 200 frames
of a full screen would take 1.2 GB.
"""

import io
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from facepin.files.safely.atomic import atomic_write

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_LONGEST = 65535
"""Thousandths of a second that a frame can be shown."""


@dataclass(frozen=True, eq=False)
class _Packed:
    """A frame as a PNG file has it."""

    head: bytes
    """The content of IHDR: size and kind of all frames."""
    pixels: bytes
    """The content of IDAT."""
    alike: int
    """Frames in a row that are this one."""


@dataclass(eq=False)
class Animation:
    """Takes frames one by one, and writes them all at the end: a picture that repeats for ever.

    It is transparent if its first frame is.
    """

    _packed: list[_Packed] = field(default_factory=list)
    _last: NDArray[np.uint8] | None = None
    _opaque: bool = True

    def add(self, frame: NDArray[np.uint8]) -> None:
        """Add a frame, (h, w, 3) or (h, w, 4) uint8, of the size of those before."""
        if self._last is None:
            self._opaque = frame.shape[2] == 3 or bool((frame[..., 3] == 255).all())
        elif np.array_equal(frame, self._last):
            last = self._packed.pop()
            self._packed.append(_Packed(last.head, last.pixels, last.alike + 1))
            return
        self._packed.append(_pack(frame[..., :3] if self._opaque else frame))
        self._last = frame

    def write(self, path: Path, seconds: float) -> None:
        """Write the frames, one or more, into a .png; each is shown for so many seconds.

        Raises
        ------
        FacepinError
            If the file cannot be written.
        """
        atomic_write(path, b"".join([_SIGNATURE, *self._chunks(seconds)]))

    def _chunks(self, seconds: float) -> Iterator[bytes]:
        """Yield the chunks of the file (PNG, third edition, 11.3.6)."""
        first = self._packed[0]
        yield _chunk(b"IHDR", first.head)
        yield _chunk(b"acTL", struct.pack(">II", len(self._packed), 0))
        number = 0
        for frame in self._packed:
            shown = min(round(1000 * seconds * frame.alike), _LONGEST)
            # At (0, 0), in place of what was there.
            yield _chunk(b"fcTL", struct.pack(">I8s2I2H2B", number, frame.head[:8], 0, 0, shown, 1000, 0, 0))
            number += 1
            if frame is first:
                yield _chunk(b"IDAT", frame.pixels)
            else:
                yield _chunk(b"fdAT", struct.pack(">I", number) + frame.pixels)
                number += 1
        yield _chunk(b"IEND", b"")


def _pack(frame: NDArray[np.uint8]) -> _Packed:
    """Let Pillow make a PNG of one frame, and take it apart."""
    from PIL import Image

    file = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(frame)).save(file, "PNG")
    content, at = file.getvalue(), len(_SIGNATURE)
    head, pixels = b"", []
    while at < len(content):
        length, kind = struct.unpack_from(">I4s", content, at)
        body = content[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            head = body
        elif kind == b"IDAT":
            pixels.append(body)
        at += length + 12
    return _Packed(head, b"".join(pixels), 1)


def _chunk(kind: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
