"""Pictures decoded with care: files from strangers inside of files from strangers."""

import io
from typing import TYPE_CHECKING, Any

import numpy as np

from facepin.core.errors import FacepinError

if TYPE_CHECKING:
    from PIL.Image import Image

LARGEST = 8192
"""Width and height up to which pictures are read."""
KEPT = 2048
"""Width and height up to which they stay as they are; larger ones are made smaller by a whole number."""
FORMATS = ("PNG", "JPEG", "WEBP")
"""What glTF allows, itself or by EXT_texture_webp."""
KTX2 = b"\xabKTX 20\xbb\r\n\x1a\n"
"""How pictures begin that KHR_texture_basisu allows."""
STRIP = 1 << 20
"""Pixels of a large picture that are made smaller at a time."""

Pixels = np.ndarray[tuple[int, ...], np.dtype[np.uint8]]


def read_picture(content: bytes, where: str, most: int) -> tuple[Pixels, int]:
    """Return RGBA pixels (h, w, 4), sRGB, and how many the file has, at most `most`.

    Raises
    ------
    FacepinError
        For what is no picture, or too large a one; nothing is decoded then.
    """
    if content.startswith(KTX2):
        return _basis_picture(content, where, most)
    from PIL import Image

    try:
        with Image.open(io.BytesIO(content), formats=FORMATS) as picture:
            count = _checked_size(*picture.size, where, most)
            picture.draft("RGB", (KEPT, KEPT))  # JPEG alone: decodes no more than is kept
            return _small_enough(picture), count
    except FacepinError:
        raise
    except Exception as error:  # Pillow raises whatever its decoders stumble over
        raise FacepinError(f"{where}: no readable PNG, JPEG or WebP ({_reason(error)})") from error


def _checked_size(width: int, height: int, where: str, most: int) -> int:
    """Return the number of pixels; refuse, before anything is decoded, what would take too much memory."""
    if max(width, height) > LARGEST:
        raise FacepinError(f"{where}: {width}x{height} pixels, allowed are {LARGEST}x{LARGEST}")
    if width * height > most:
        raise FacepinError(f"{where}: the pictures of the file have too many pixels together")
    return width * height


def _small_enough(picture: "Image") -> Pixels:
    """Return RGBA pixels; a large picture becomes smaller strip by strip, whatever its mode takes."""
    width, height = picture.size
    factor = -(-max(width, height) // KEPT)
    if factor == 1:
        return np.asarray(_of_bytes(picture).convert("RGBA"))
    rows = factor * max(1, STRIP // (factor * width))
    strips = []
    for top in range(0, height, rows):
        strip = _of_bytes(picture.crop((0, top, width, min(top + rows, height))))
        strips.append(np.asarray(strip.convert("RGBA").reduce(factor)))
    return np.concatenate(strips)


def _of_bytes(picture: "Image") -> "Image":
    """Return a picture of one byte a channel; one of 16 bits would only be cut off at 255."""
    if not picture.mode.startswith("I"):
        return picture
    from PIL import Image

    return Image.fromarray((np.clip(np.asarray(picture), 0, 65535) >> 8).astype(np.uint8))


def _basis_picture(content: bytes, where: str, most: int) -> tuple[Pixels, int]:
    """Return the largest level of a KTX2 picture that is kept as it is, else the smallest, made smaller."""
    from PIL import Image

    try:
        import opengl_basisu
    except ImportError as error:
        raise FacepinError(
            f'{where}: a KTX2 picture: either install what reads it, pip install "facepin[compressed]", or '
            "change it, gltf-transform ktxdecompress IN.glb OUT.glb"
        ) from error
    try:
        picture: Any = opengl_basisu.open(content)
        count = _checked_size(picture.width, picture.height, where, most)
        level = 0
        while max(picture.width, picture.height) >> level > KEPT and level + 1 < picture.levels:
            level += 1
        pixels = np.asarray(picture.transcode("rgba8", level=level).data, np.uint8)
        return _small_enough(Image.fromarray(pixels)), count
    except FacepinError:
        raise
    except Exception as error:  # whatever the library stumbles over
        raise FacepinError(f"{where}: no readable KTX2 picture ({_reason(error)})") from error


def _reason(error: Exception) -> str:
    return f"{type(error).__name__}: {' '.join(str(error).split())[:120]}"
