"""The pictures that colour a glTF, and where its vertices are in them.

What cannot be used is left out with a warning; the face opens all the same.
"""

from collections.abc import Hashable
from hashlib import sha256

import numpy as np

from facepin.core.arrays import Points, frozen
from facepin.core.errors import FacepinError
from facepin.core.rig import Texture
from facepin.files.gltf.accessors import read_floats, view_bytes
from facepin.files.gltf.document import GltfDocument
from facepin.files.gltf.images import LARGEST, Pixels, read_picture
from facepin.files.safely.checked_json import JsonObject

MOST_PIXELS = 2 * LARGEST**2
"""Of all pictures of a file together: a few bytes can unfold to very many."""
MOST_BYTES = 256 << 20
"""Size of a picture's file."""
REPEAT, CLAMP = 10497, 33071
"""glTF's words for a picture that goes on beyond its edges, and for one whose edge does."""
OTHER_SOURCES = ("EXT_texture_webp", "KHR_texture_basisu")
"""Extensions by which a texture names a picture of another kind, instead of or beside the plain one."""


class Textures:
    """The textures of one file; each picture is read and decoded once, however many entries name it."""

    def __init__(self, document: GltfDocument, warnings: list[str]) -> None:
        """Prepare; `warnings` grows by a line for each picture that is left out."""
        self._document = document
        self._warnings = warnings
        self._made: dict[int, Texture | None] = {}
        self._by_address: dict[Hashable, Pixels] = {}
        self._by_content: dict[bytes, Pixels] = {}
        self._equal: dict[tuple[int, tuple[bool, bool]], Texture] = {}
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
        sampler = entry.optional_integer("sampler")
        wrap = root.children("samplers")[sampler] if sampler is not None else JsonObject({}, entry.where)
        repeats = (wrap.integer("wrapS", REPEAT) != CLAMP, wrap.integer("wrapT", REPEAT) != CLAMP)
        pixels = self._first_readable(entry)
        return self._equal.setdefault((id(pixels), repeats), Texture(pixels, repeats))

    def _first_readable(self, texture: JsonObject) -> Pixels:
        """Return the pixels of the first picture of a texture that can be read."""
        extensions = texture.child("extensions")
        others = [extensions.child(name) for name in OTHER_SOURCES if name in extensions]
        holders = [holder for holder in (texture, *others) if "source" in holder] or [texture]
        images = self._document.root.children("images")
        for holder in holders[:-1]:
            try:
                return self._decoded(images[holder.integer("source")])
            except FacepinError:  # the next one is there for that
                continue
        return self._decoded(images[holders[-1].integer("source")])

    def _decoded(self, image: JsonObject) -> Pixels:
        address = self._address(image)
        if address not in self._by_address:
            content = self._content(image)
            digest = sha256(content).digest()
            if digest not in self._by_content:
                pixels, count = read_picture(content, image.where, MOST_PIXELS - self._pixels)
                self._pixels += count
                self._by_content[digest] = frozen(pixels, np.uint8)
            self._by_address[address] = self._by_content[digest]
        return self._by_address[address]

    def _address(self, image: JsonObject) -> Hashable:
        if "uri" in image:
            return self._document.addresses.same(image)
        return image.integer("bufferView")

    def _content(self, image: JsonObject) -> bytes:
        if "uri" in image:
            return self._document.addresses.read(image, MOST_BYTES)
        return bytes(view_bytes(self._document, image.integer("bufferView")))


def places_key(primitive: JsonObject, shine: JsonObject) -> tuple[object, ...]:
    """Return what is equal for primitives whose vertices are at the same places in their textures."""
    index, offset, turn, scale = _placing(primitive, shine)
    return index, offset, turn, scale


def texture_places(
    document: GltfDocument, primitive: JsonObject, shine: JsonObject, count: int
) -> Points | None:
    """Return where the vertices of a primitive are in its texture, (count, 2), or None if it does not say.

    0, 0 is the first corner of the first row, 1, 1 the last of the last.
    """
    index, offset, turn, scale = _placing(primitive, shine)
    if index is None:
        return None
    places = read_floats(document, index, ("VEC2",))
    if len(places) != count:
        raise FacepinError(
            f"{primitive.where}: texture coordinates have {len(places)} elements, POSITION has {count}"
        )
    if (offset, turn, scale) != ((0.0, 0.0), 0.0, (1.0, 1.0)):
        c, s = np.cos(turn), np.sin(turn)
        with np.errstate(all="ignore"):
            places = (places * np.array(scale) @ np.array([[c, -s], [s, c]]) + np.array(offset)).astype(
                np.float32
            )
    return np.where(np.isfinite(places), places, 0).astype(np.float32)


def _placing(
    primitive: JsonObject, shine: JsonObject
) -> tuple[int | None, tuple[float, ...], float, tuple[float, ...]]:
    """Return the accessor of the texture coordinates, and by what they are moved, turned and scaled."""
    entry = shine.child("baseColorTexture")
    moved = entry.child("extensions").child("KHR_texture_transform")
    number = moved.integer("texCoord", entry.integer("texCoord", 0))
    index = primitive.child("attributes").optional_integer(f"TEXCOORD_{number}")
    offset = tuple(moved.numbers("offset", 2)) if "offset" in moved else (0.0, 0.0)
    scale = tuple(moved.numbers("scale", 2)) if "scale" in moved else (1.0, 1.0)
    return index, offset, moved.number("rotation", 0.0), scale
