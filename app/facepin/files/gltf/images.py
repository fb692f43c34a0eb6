"""The pictures that colour a glTF, decoded with care: files from strangers inside of files from strangers.

What cannot be used is left out with a warning; the face opens all the same.
"""

import io
from typing import TYPE_CHECKING

import numpy as np

from facepin.core.arrays import Points, frozen
from facepin.core.errors import FacepinError
from facepin.core.rig import Texture
from facepin.files.gltf.accessors import read_floats, view_bytes
from facepin.files.gltf.document import GltfDocument, read_uri
from facepin.files.safely.checked_json import JsonObject

if TYPE_CHECKING:
    from PIL.Image import Image

LARGEST = 8192
"""Width and height up to which pictures are read."""
KEPT = 2048
"""Width and height up to which they stay as they are; larger ones are halved until they fit."""
MOST_PIXELS = 2 * LARGEST**2
"""Of all pictures of a file together: a few bytes can unfold to very many."""
MOST_BYTES = 256 << 20
"""Size of a picture's file."""
FORMATS = ("PNG", "JPEG")
"""What glTF allows."""
REPEAT, CLAMP = 10497, 33071
"""glTF's words for a picture that goes on beyond its edges, and for one whose edge does."""


class Textures:
    """The textures of one file; each picture is decoded once."""

    def __init__(self, document: GltfDocument, warnings: list[str]) -> None:
        """Prepare; `warnings` grows by a line for each picture that is left out."""
        self._document = document
        self._warnings = warnings
        self._made: dict[int, Texture | None] = {}
        self._pixels = 0

    def base_colour(self, shine: JsonObject) -> Texture | None:
        """Return the base colour texture of a `pbrMetallicRoughness`, or None where there is none to use."""
        if "baseColorTexture" not in shine:
            return None
        index = shine.child("baseColorTexture").integer("index")
        if index not in self._made:
            self._made[index] = None
            try:
                self._made[index] = self._texture(index)
            except FacepinError as error:
                self._warnings.append(f"a texture is left out: {error}")
        return self._made[index]

    def _texture(self, index: int) -> Texture:
        root = self._document.root
        entry = root.children("textures")[index]
        image = root.children("images")[entry.integer("source")]
        sampler = entry.optional_integer("sampler")
        wrap = root.children("samplers")[sampler] if sampler is not None else JsonObject({}, entry.where)
        repeats = (wrap.integer("wrapS", REPEAT) != CLAMP, wrap.integer("wrapT", REPEAT) != CLAMP)
        pixels = self._decoded(self._content(image), image.where)
        return Texture(frozen(pixels, np.uint8), repeats)

    def _content(self, image: JsonObject) -> bytes:
        if "uri" in image:
            return bytes(read_uri(image, self._document.path, MOST_BYTES))
        return bytes(view_bytes(self._document, image.integer("bufferView")))

    def _decoded(self, content: bytes, where: str) -> np.ndarray[tuple[int, ...], np.dtype[np.uint8]]:
        """Return RGBA pixels (h, w, 4), sRGB."""
        from PIL import Image

        try:
            with Image.open(io.BytesIO(content), formats=FORMATS) as picture:
                self._check_size(picture, where)
                picture.draft("RGB", (KEPT, KEPT))  # JPEG alone: decodes no more than is kept
                small = picture.reduce(-(-max(picture.size) // KEPT)) if _is_plain(picture) else picture
                pixels = small.convert("RGBA")
        except FacepinError:
            raise
        except Exception as error:  # Pillow raises whatever its decoders stumble over
            reason = f"{type(error).__name__}: {' '.join(str(error).split())[:120]}"
            raise FacepinError(f"{where}: no readable PNG or JPEG ({reason})") from error
        if (most := max(pixels.size)) > KEPT:
            pixels = pixels.reduce(-(-most // KEPT))
        return np.asarray(pixels)

    def _check_size(self, picture: "Image", where: str) -> None:
        """Refuse, before anything is decoded, what would take too much memory."""
        width, height = picture.size
        if max(width, height) > LARGEST:
            raise FacepinError(f"{where}: {width}x{height} pixels, allowed are {LARGEST}x{LARGEST}")
        self._pixels += width * height
        if self._pixels > MOST_PIXELS:
            raise FacepinError(
                f"{where}: the pictures have more than {MOST_PIXELS >> 20} million pixels together"
            )


def _is_plain(picture: "Image") -> bool:
    """Say whether a large picture can be made smaller as it is, before it takes four bytes a pixel."""
    return max(picture.size) > KEPT and picture.mode in ("L", "LA", "RGB", "RGBA")


def texture_places(
    document: GltfDocument, primitive: JsonObject, shine: JsonObject, count: int
) -> Points | None:
    """Return where the vertices of a primitive are in its texture, (count, 2), or None if it does not say.

    0, 0 is the first corner of the first row, 1, 1 the last of the last.
    """
    entry = shine.child("baseColorTexture")
    moved = entry.child("extensions").child("KHR_texture_transform")
    number = moved.integer("texCoord", entry.integer("texCoord", 0))
    index = primitive.child("attributes").optional_integer(f"TEXCOORD_{number}")
    if index is None:
        return None
    places = read_floats(document, index, ("VEC2",))
    if len(places) != count:
        raise FacepinError(
            f"{primitive.where}: TEXCOORD_{number} has {len(places)} elements, POSITION has {count}"
        )
    if moved.values:
        scale = np.array(moved.numbers("scale", 2) if "scale" in moved else (1, 1))
        offset = np.array(moved.numbers("offset", 2) if "offset" in moved else (0, 0))
        turn = moved.number("rotation", 0.0)
        c, s = np.cos(turn), np.sin(turn)
        with np.errstate(all="ignore"):
            places = (places * scale @ np.array([[c, -s], [s, c]]) + offset).astype(np.float32)
    return np.where(np.isfinite(places), places, 0).astype(np.float32)
