"""Pictures of poses: what is none of ours, or no picture at all, is no picture."""

import struct
import zlib
from pathlib import Path

import numpy as np
import pytest

from facepin.files.work.thumbnails import read_thumbnail, write_thumbnail

IMAGE = np.random.default_rng(0).integers(0, 255, (8, 8, 4), np.uint8)


def piece(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def with_piece(content: bytes, name: bytes, data: bytes) -> bytes:
    """The same picture with one more piece behind its head."""
    return content[:33] + piece(name, data) + content[33:]


def with_size(content: bytes, width: int, height: int) -> bytes:
    head = struct.pack(">II", width, height) + content[24:29]
    return content[:8] + piece(b"IHDR", head) + content[33:]


@pytest.mark.parametrize(
    "change",
    [
        lambda content: with_size(content, 50_000, 50_000),
        lambda content: with_size(content, 2**31 - 1, 2**31 - 1),
        lambda content: with_size(content, 0, 0),
        lambda content: with_piece(content, b"zTXt", b"a\0\0" + zlib.compress(bytes(50_000_000))),
        lambda content: with_piece(content, b"iCCP", b"a\0\0" + zlib.compress(b"no profile"))[:-30],
        lambda content: content[:40],
        lambda content: b"",
    ],
)
def test_whatever_a_decoder_stumbles_over_there_is_no_picture(tmp_path: Path, change: object) -> None:
    path = tmp_path / "a.png"
    write_thumbnail(path, IMAGE, "mark")
    found = read_thumbnail(path, "mark", 8)
    np.testing.assert_array_equal(found[..., :3], IMAGE[..., :3])
    path.write_bytes(change(path.read_bytes()))
    assert read_thumbnail(path, "mark", 8) is None
