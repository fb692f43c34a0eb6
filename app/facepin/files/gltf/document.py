"""A glTF document: the JSON, and its buffers as bytes, from a .glb or a .gltf with its companions."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from facepin.core.errors import FacepinError
from facepin.files.gltf.addresses import Addresses
from facepin.files.gltf.compression import COMPRESSIONS, Buffer, is_stand_in, without_compression
from facepin.files.gltf.container import Container, read_container
from facepin.files.safely.checked_json import JsonObject, parse_json

HARMLESS = (
    "KHR_mesh_quantization",
    "KHR_materials_",
    "KHR_texture_",
    "KHR_lights_",
    "KHR_xmp",
    "EXT_texture_",
)
HARMLESS_AVATAR = ("VRM", "MSFT_texture_dds", "KHR_animation_pointer", "MSFT_lod")
HALF_A_PAIR = re.compile(rb"\\u[dD][89a-fA-F]")


@dataclass(frozen=True, eq=False)
class GltfDocument:
    """Parsed JSON and loaded buffers, nothing in them compressed."""

    path: Path
    root: JsonObject
    buffers: tuple[Buffer, ...]
    size: int
    """Bytes of data in all, each counted once: what the memory of the result is measured against."""
    addresses: Addresses
    """Where pictures beside the model are read."""

    def check_growth(self, elements: int, what: str) -> None:
        """Refuse, by `FacepinError`, to make more of something than the data are good for."""
        if elements > 4 * self.size + 65536:
            raise FacepinError(f"{self.root.where} its {what} unfold to far more than the file holds")


def read_document(path: Path) -> GltfDocument:
    """Read a .glb, .vrm or .gltf and the buffers that it names inside its own folder.

    Raises
    ------
    FacepinError
        For a broken container, an address outside the folder, a buffer shorter than it says, compression
        that cannot be undone here, or an extension that is required and unknown.
    """
    container = read_container(path)
    root = parse_json(container.text, path.name)
    if HALF_A_PAIR.search(container.text):
        root = JsonObject(_whole_characters(root.values), root.where)
    _check_extensions(root)
    addresses = Addresses(path)
    buffers = _buffers(root, container, addresses)
    plain, unpacked = without_compression(root, buffers)
    size = addresses.size + sum(len(buffer) for buffer in unpacked)
    if len(buffers) and "uri" not in root.children("buffers")[0]:
        size += len(buffers[0])
    return GltfDocument(path, plain, (*buffers, *unpacked), size, addresses)


def _whole_characters(value: Any) -> Any:
    """Return JSON with a sign of replacement for each half of a character, which no file can be named by."""
    if isinstance(value, str):
        return value.encode("utf-16", "surrogatepass").decode("utf-16", "replace")
    if isinstance(value, list):
        return [_whole_characters(item) for item in value]
    if isinstance(value, dict):
        return {_whole_characters(key): _whole_characters(item) for key, item in value.items()}
    return value


def _check_extensions(root: JsonObject) -> None:
    for extension in root.strings("extensionsRequired"):
        if extension not in COMPRESSIONS and not extension.startswith(HARMLESS + HARMLESS_AVATAR):
            raise FacepinError(
                f"{root.where} requires the extension {extension[:60]!a}, which is not known here"
            )


def _buffers(root: JsonObject, container: Container, addresses: Addresses) -> list[Buffer]:
    """Return the data of all buffers; those at one address share it, and stand-ins have none."""
    entries = list(root.children("buffers"))
    named = {at: entry for at, entry in enumerate(entries) if "uri" in entry and not is_stand_in(entry)}
    found = dict(
        zip(
            named,
            addresses.keep([(entry, entry.integer("byteLength", low=1)) for entry in named.values()]),
            strict=True,
        )
    )
    buffers: list[Buffer] = []
    for at, entry in enumerate(entries):
        if is_stand_in(entry):
            buffers.append(b"")
            continue
        length = entry.integer("byteLength", low=1)
        if at in found:
            content = found[at]
        elif at or container.length is None:
            raise FacepinError(f"{entry.where} has no uri; only the first buffer of a GLB may lack one")
        else:
            content = container.binary(length)
        if len(content) < length:
            raise FacepinError(f"{entry.where}.byteLength is {length}, its data has {len(content)} bytes")
        buffers.append(memoryview(content)[:length])
    return buffers
