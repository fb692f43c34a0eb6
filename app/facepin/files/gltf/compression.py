"""Compressed glTF made plain, with libraries that may be there or not: meshopt and Draco.

Both are undone before anything is read, so that the readers of accessors know nothing of them.
"""

from importlib.util import find_spec
from typing import Any, NoReturn

import numpy as np

from facepin.core.errors import FacepinError
from facepin.files.safely.checked_json import JsonObject

Buffer = bytes | memoryview

COMPRESSIONS = {
    "KHR_draco_mesh_compression": "Draco",
    "EXT_meshopt_compression": "meshopt",
    "KHR_meshopt_compression": "meshopt",
}
LIBRARIES = {"Draco": "DracoPy", "meshopt": "meshopt"}
MESHOPT = ("KHR_meshopt_compression", "EXT_meshopt_compression")
DRACO = "KHR_draco_mesh_compression"
UNFOLDS = 256
"""How many times larger than it is stored data may become: zeros of deltas shrink to little."""
COMPONENTS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}


def can_undo(extension: str) -> bool:
    """Say whether the library that undoes a compression is installed."""
    return find_spec(LIBRARIES[COMPRESSIONS[extension]]) is not None


def refuse_compression(extension: str, where: str) -> NoReturn:
    """Raise the line that names the compression and the ways out."""
    raise FacepinError(
        f"{where.rstrip(':')}: compressed with {COMPRESSIONS[extension]} ({extension}): either install what "
        'reads it, pip install "facepin[compressed]", or undo it, gltf-transform copy IN.glb OUT.glb'
    )


def is_stand_in(buffer: JsonObject) -> bool:
    """Say whether a buffer only tells how large the compressed data would be that others hold."""
    return any(
        buffer.child("extensions").child(extension).flag("fallback", False)
        and ("uri" not in buffer or can_undo(extension))
        for extension in MESHOPT
        if extension in buffer.child("extensions")
    )


def without_compression(root: JsonObject, buffers: list[Buffer]) -> tuple[JsonObject, list[Buffer]]:
    """Return the JSON as if nothing were compressed, and the buffers that come after `buffers` for that.

    Raises
    ------
    FacepinError
        For compressed data that are broken, or without the library that undoes it.
    """
    unpacked: list[Buffer] = []
    views = _plain_views(root, buffers, unpacked)
    root = JsonObject({**root.values, **({"bufferViews": views} if views else {})}, root.where)
    if any(DRACO in primitive.child("extensions") for primitive in _primitives(root)):
        root = _plain_primitives(root, buffers, unpacked)
    return root, unpacked


def _primitives(root: JsonObject) -> list[JsonObject]:
    return [primitive for mesh in root.children("meshes") for primitive in mesh.children("primitives")]


def _plain_views(root: JsonObject, buffers: list[Buffer], unpacked: list[Buffer]) -> list[Any]:
    """Return the entries of all bufferViews, those that meshopt has compressed with data of their own."""
    views = list(root.children("bufferViews").values)
    for at, view in enumerate(root.children("bufferViews").values):
        extensions = view.get("extensions") if isinstance(view, dict) else None
        if not isinstance(extensions, dict):
            continue
        for extension in MESHOPT:
            if extension not in extensions:
                continue
            entry = root.children("bufferViews")[at]
            if not can_undo(extension):
                if _has_data(entry, buffers):
                    continue
                refuse_compression(extension, entry.where)
            content = _meshopt(entry.child("extensions").child(extension), buffers, extension)
            kept = {key: value for key, value in view.items() if key not in ("extensions", "byteOffset")}
            views[at] = kept | {"buffer": len(buffers) + len(unpacked), "byteLength": len(content)}
            unpacked.append(content)
            break
    return views


def _has_data(view: JsonObject, buffers: list[Buffer]) -> bool:
    at = view.integer("buffer")
    return at < len(buffers) and len(buffers[at]) > 0


def _meshopt(entry: JsonObject, buffers: list[Buffer], extension: str) -> bytes:
    """Return what one bufferView holds."""
    content = _stored(entry, buffers)
    count, stride = entry.integer("count", low=1), entry.integer("byteStride", low=1, high=256)
    _check_growth(count * stride, len(content), entry.where)
    mode, sieve = entry.text("mode"), entry.text("filter", "NONE")
    try:
        import meshopt

        return bytes(meshopt.decode_gltf_buffer(content, count, stride, mode, sieve).tobytes())
    except Exception as error:  # whatever the library stumbles over
        _refuse_broken(extension, entry.where, error)


def _plain_primitives(root: JsonObject, buffers: list[Buffer], unpacked: list[Buffer]) -> JsonObject:
    """Return the JSON whose accessors of primitives that Draco has compressed have data of their own."""
    views, accessors = (list(root.children(key).values) for key in ("bufferViews", "accessors"))
    meshes: dict[int, Any] = {}
    for primitive in _primitives(root):
        if DRACO not in primitive.child("extensions"):
            continue
        packed = primitive.child("extensions").child(DRACO)
        attributes = primitive.child("attributes")
        wanted = {name: attributes.integer(name) for name in packed.child("attributes").values}
        if not can_undo(DRACO):
            if all("bufferView" in root.children("accessors")[index] for index in wanted.values()):
                continue  # it is there a second time, as everybody can read it
            refuse_compression(DRACO, primitive.where)
        at = packed.integer("bufferView")
        if at not in meshes:
            meshes[at] = _draco(root.children("bufferViews")[at], buffers + unpacked)
        arrays = {
            index: _attribute(meshes[at], packed.child("attributes").integer(name), packed)
            for name, index in wanted.items()
        }
        if "indices" in primitive:
            arrays[primitive.integer("indices")] = np.asarray(meshes[at].faces, np.uint32).reshape(-1, 1)
        for index, array in arrays.items():
            entry = root.children("accessors")[index]
            kept = {key: value for key, value in entry.values.items() if key != "byteOffset"}
            if array.shape[1] == 1 and entry.text("type") == "SCALAR" and array.dtype == np.uint32:
                kept["componentType"], kept["count"] = 5125, len(array)
            kind = kept.get("componentType")
            if not isinstance(kind, int) or kind not in COMPONENTS or len(array) != kept.get("count"):
                entry.refuse("count", f"{len(array)} elements, as its compressed data have")
            content = np.ascontiguousarray(array, COMPONENTS[kind]).tobytes()
            accessors[index] = kept | {"bufferView": len(views)}
            views.append({"buffer": len(buffers) + len(unpacked), "byteLength": len(content)})
            unpacked.append(content)
    return JsonObject({**root.values, "bufferViews": views, "accessors": accessors}, root.where)


def _draco(view: JsonObject, buffers: list[Buffer]) -> Any:
    content = _stored(view, buffers)
    try:
        import DracoPy

        mesh = DracoPy.decode(content)
        size = sum(attribute["data"].nbytes for attribute in mesh.attributes) + mesh.faces.nbytes
    except Exception as error:  # whatever the library stumbles over
        _refuse_broken(DRACO, view.where, error)
    _check_growth(size, len(content), view.where)
    return mesh


def _attribute(mesh: Any, number: int, entry: JsonObject) -> np.ndarray[Any, np.dtype[Any]]:
    for attribute in mesh.attributes:
        if attribute["unique_id"] == number:
            data = np.asarray(attribute["data"])
            return data.reshape(len(data), -1)
    raise FacepinError(f"{entry.where}: attribute {number} is not in the compressed data")


def _stored(entry: JsonObject, buffers: list[Buffer]) -> bytes:
    """Return the bytes that an entry names with buffer, byteOffset and byteLength."""
    at = entry.integer("buffer")
    if at >= len(buffers):
        entry.refuse("buffer", f"0 to {len(buffers) - 1}")
    start, length = entry.integer("byteOffset", 0), entry.integer("byteLength", low=1)
    if start + length > len(buffers[at]):
        raise FacepinError(f"{entry.where} ends at byte {start + length}, its buffer has {len(buffers[at])}")
    return bytes(buffers[at][start : start + length])


def _check_growth(size: int, stored: int, where: str) -> None:
    if size > UNFOLDS * stored + 4096:
        raise FacepinError(f"{where}: {stored} compressed bytes unfold to {size}, far more than data does")


def _refuse_broken(extension: str, where: str, error: Exception) -> NoReturn:
    reason = f"{type(error).__name__}: {' '.join(str(error).split())[:120]}"
    raise FacepinError(f"{where}: no readable {COMPRESSIONS[extension]} data ({reason})") from error
