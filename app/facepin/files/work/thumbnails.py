"""Small square pictures of poses as PNG files that say what they show, so that stale ones are known."""

import hashlib
import io
import os
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats
from facepin.core.rig import Rig
from facepin.files.safely.atomic import atomic_write

MARK = "facepin-pose"
LARGEST = 1 << 22
"""Bytes; a picture of this size is none of ours."""


def mark_of(rig: Rig, weights: Floats) -> str:
    """Return a short text that stands for a pose of a rig."""
    digest = hashlib.sha256(f"{rig.name}\n{rig.vertex_count}\n{rig.shape_names}".encode())
    digest.update(np.asarray(weights, np.float32).tobytes())
    return digest.hexdigest()[:24]


def read_thumbnail(path: Path, mark: str, side: int) -> NDArray[np.uint8] | None:
    """Return the picture in a file, (side, side, 4) uint8, or None where it is not the one of that mark."""
    from PIL import Image

    try:
        if path.stat().st_size > LARGEST:
            return None
        with Image.open(path, formats=["PNG"]) as picture:
            if picture.size != (side, side) or picture.info.get(MARK) != mark:
                return None
            return np.asarray(picture.convert("RGBA"))
    except Exception:  # Pillow raises whatever its decoders stumble over, bombs and broken profiles too
        return None


def write_thumbnail(path: Path, image: NDArray[np.uint8], mark: str) -> None:
    """Write a picture, (side, side, 4) uint8 and opaque.

    Raises
    ------
    FacepinError
        If it cannot be written.
    """
    from PIL import Image, PngImagePlugin

    words = PngImagePlugin.PngInfo()
    words.add_text(MARK, mark)
    file = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(image[..., :3])).save(file, "PNG", pnginfo=words)
    atomic_write(path, file.getvalue())


def is_writable(folder: Path) -> bool:
    """Say whether pictures can be stored in a folder: where they can't, they are made anew each time."""
    return folder.is_dir() and os.access(folder, os.W_OK)
