"""A glTF document: the JSON, and its buffers as bytes, from a .glb or a .gltf with its companions."""

import base64
import binascii
import struct
from dataclasses import dataclass
from pathlib import Path, PurePosixPath, PureWindowsPath
from urllib.parse import unquote, urlsplit

from facepin.core.errors import FacepinError
from facepin.files.safely.checked_json import JsonObject, parse_json

COMPRESSIONS = {
    "KHR_draco_mesh_compression": "Draco",
    "EXT_meshopt_compression": "meshopt",
    "KHR_meshopt_compression": "meshopt",
}
HARMLESS = (
    "KHR_mesh_quantization",
    "KHR_materials_",
    "KHR_texture_",
    "KHR_lights_",
    "KHR_xmp",
    "EXT_texture_",
)
HARMLESS_AVATAR = ("VRM", "MSFT_texture_dds", "KHR_animation_pointer", "MSFT_lod")

JSON_CHUNK, BINARY_CHUNK = 0x4E4F534A, 0x004E4942


@dataclass(frozen=True, eq=False)
class GltfDocument:
    """Parsed JSON and loaded buffers."""

    path: Path
    root: JsonObject
    buffers: tuple[bytes | memoryview, ...]
    size: int
    """Bytes read in all: what the memory of the result is measured against."""


def read_document(path: Path) -> GltfDocument:
    """Read a .glb, .vrm or .gltf and the buffers that it names inside its own folder.

    Raises
    ------
    FacepinError
        For a broken container, an address outside the folder, a buffer shorter than it says, compression, or
        an extension that is required and unknown.
    """
    content = path.read_bytes()
    binary: memoryview | None = None
    if content[:4] == b"glTF" or path.suffix.lower() != ".gltf":
        text, binary = _split_glb(content, path.name)
    else:
        text = content
    root = parse_json(text, path.name)
    _check_extensions(root)
    buffers = [_buffer(entry, at, binary, path) for at, entry in enumerate(root.children("buffers"))]
    return GltfDocument(path, root, tuple(buffers), len(content) + sum(len(buffer) for buffer in buffers))


def _split_glb(content: bytes, name: str) -> tuple[bytes, memoryview | None]:
    """Return the JSON and the binary chunk of a GLB container."""
    if len(content) < 12:
        raise FacepinError(f"{name}: {len(content)} bytes, a GLB header alone has 12")
    magic, version, length = struct.unpack_from("<4sII", content)
    if magic != b"glTF":
        raise FacepinError(
            f"{name}: begins with {magic.decode('latin-1')!a}, allowed: 'glTF' (a binary glTF)"
        )
    if version != 2:
        raise FacepinError(f"{name}: glTF version {version}, allowed: 2")
    if length > len(content):
        raise FacepinError(f"{name}: header declares {length} bytes, the file has {len(content)}")
    chunks: dict[int, memoryview] = {}
    at = 12
    while at + 8 <= length:
        size, kind = struct.unpack_from("<II", content, at)
        if at + 8 + size > length:
            raise FacepinError(
                f"{name}: chunk at byte {at} declares {size} bytes, {length - at - 8} are left"
            )
        chunks.setdefault(kind, memoryview(content)[at + 8 : at + 8 + size])
        at += 8 + size
    if JSON_CHUNK not in chunks:
        raise FacepinError(f"{name}: no JSON chunk")
    return bytes(chunks[JSON_CHUNK]), chunks.get(BINARY_CHUNK)


def _check_extensions(root: JsonObject) -> None:
    required = root.strings("extensionsRequired")
    for extension in required:
        if extension in COMPRESSIONS:
            refuse_compression(extension, root.where)
        if not extension.startswith(HARMLESS + HARMLESS_AVATAR):
            raise FacepinError(
                f"{root.where} requires the extension {extension[:60]!a}, which is not known here"
            )


def refuse_compression(extension: str, where: str) -> None:
    """Raise the line that names the compression and the way out."""
    raise FacepinError(
        f"{where.rstrip(':')}: compressed with {COMPRESSIONS[extension]} ({extension}), which is not "
        "supported; export it again without mesh compression"
    )


def _buffer(entry: JsonObject, at: int, binary: memoryview | None, path: Path) -> bytes | memoryview:
    length = entry.integer("byteLength", low=1)
    if "uri" not in entry:
        for extension in COMPRESSIONS:
            if extension in entry.child("extensions"):
                refuse_compression(extension, entry.where)
        if at or binary is None:
            raise FacepinError(f"{entry.where} has no uri; only the first buffer of a GLB may lack one")
        content: bytes | memoryview = binary
    else:
        content = read_uri(entry, path, length)
    if len(content) < length:
        raise FacepinError(f"{entry.where}.byteLength is {length}, its data has {len(content)} bytes")
    return memoryview(content)[:length]


def read_uri(entry: JsonObject, path: Path, most: int) -> bytes:
    """Return what the `uri` of a buffer or an image holds, of a file at most the first `most` bytes.

    Raises
    ------
    FacepinError
        For an address that is not inside the folder of the model at `path`, or nothing there.
    """
    uri = entry.text("uri")
    return _decode_data_uri(uri, entry) if uri[:5].lower() == "data:" else _companion(uri, most, entry, path)


def _decode_data_uri(uri: str, entry: JsonObject) -> bytes:
    head, comma, body = uri.partition(",")
    if not comma or not head.lower().endswith(";base64"):
        entry.refuse("uri", "data:…;base64,… or a file name")
    try:
        return base64.b64decode(unquote(body) if "%" in body else body, validate=True)
    except (binascii.Error, ValueError) as error:
        raise FacepinError(f"{entry.place('uri')} is not base64: {error}") from error


def _companion(uri: str, length: int, entry: JsonObject, path: Path) -> bytes:
    """Read a file in the model's folder or below; everything else is refused before it is touched."""
    allowed = "a relative address inside the model's folder"
    name = unquote(uri)
    try:
        scheme = urlsplit(uri).scheme
    except ValueError:
        entry.refuse("uri", allowed)
    windows = PureWindowsPath(name)
    if (
        scheme
        or "\0" in name
        or windows.drive
        or windows.root
        or ".." in windows.parts
        or ".." in PurePosixPath(name).parts
    ):
        entry.refuse("uri", allowed)
    folder = path.resolve().parent
    try:
        target = (folder / name).resolve()
        found = target.is_file()
    except (OSError, RuntimeError):  # a name too long, a loop of links
        entry.refuse("uri", allowed)
    if not target.is_relative_to(folder):
        entry.refuse("uri", f"{allowed}, but it is a link that leads out")
    if not found:
        raise FacepinError(f"{entry.place('uri')}: no file {name[:200]!a} beside {path.name}")
    with target.open("rb") as file:
        return file.read(min(length, target.stat().st_size))
