"""glTF accessors as numpy arrays: strided, normalised, sparse; bounds are checked before allocating."""

import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Points
from facepin.core.delta_columns import Delta
from facepin.core.errors import FacepinError
from facepin.files.gltf.compression import COMPONENTS
from facepin.files.gltf.document import GltfDocument
from facepin.files.safely.checked_json import JsonObject

WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
UNSIGNED = (5121, 5123, 5125)

Numbers = NDArray[Any]


def accessor_count(document: GltfDocument, index: int) -> int:
    """Return the number of elements that accessor `index` declares."""
    return document.root.children("accessors")[index].integer("count", low=1)


def read_floats(document: GltfDocument, index: int, types: tuple[str, ...]) -> NDArray[np.float32]:
    """Return accessor `index` as (count, width) float32, integers normalised where the file says so.

    Raises
    ------
    FacepinError
        If its type is not one of `types`, or it does not fit the data it refers to.
    """
    entry = _entry(document, index, types)
    return _normalised(_dense(document, entry), entry)


def view_bytes(document: GltfDocument, index: int) -> memoryview:
    """Return all bytes of bufferView `index`.

    Raises
    ------
    FacepinError
        If it does not lie within its buffer.
    """
    view = document.root.children("bufferViews")[index]
    length = view.integer("byteLength", low=1)
    everything = JsonObject({"bufferView": index}, view.where)
    return memoryview(_view(document, everything, length, 1, np.dtype(np.uint8)).tobytes())


def read_indices(document: GltfDocument, index: int, below: int) -> NDArray[np.uint32]:
    """Return a SCALAR accessor of unsigned integers, (count,) uint32, each less than `below`."""
    entry = _entry(document, index, ("SCALAR",))
    if entry.integer("componentType") not in UNSIGNED:
        entry.refuse("componentType", "5121, 5123 or 5125 for indices")
    indices = _dense(document, entry)[:, 0].astype(np.uint32)
    if indices.max() >= below:
        at = int(np.argmax(indices >= below))
        raise FacepinError(f"{entry.where}: index {indices[at]} at {at}, allowed are 0 to {below - 1}")
    return indices


def read_quadruples(document: GltfDocument, index: int) -> NDArray[np.uint32]:
    """Return a VEC4 accessor of unsigned integers, (count, 4) uint32: which joints move a vertex."""
    entry = _entry(document, index, ("VEC4",))
    if entry.integer("componentType") not in UNSIGNED:
        entry.refuse("componentType", "5121, 5123 or 5125 for joints")
    return _dense(document, entry).astype(np.uint32)


def read_delta(document: GltfDocument, index: int, vertices: int) -> Delta:
    """Return a VEC3 accessor of `vertices` elements as a delta, a pair where only what moves is stored."""
    entry = _entry(document, index, ("VEC3",))
    if entry.integer("count") != vertices:
        entry.refuse("count", f"{vertices}, as the mesh has vertices")
    if "sparse" in entry and "bufferView" not in entry:
        places, values = _sparse(document, entry)
        order = np.argsort(places, kind="stable")
        last = np.append(np.diff(places[order]) != 0, True)
        return places[order][last], _normalised(values[order][last], entry)
    if "bufferView" not in entry:
        return np.zeros(0, np.int32), np.zeros((0, 3), np.float32)
    return _normalised(_dense(document, entry), entry)


def _entry(document: GltfDocument, index: int, types: tuple[str, ...]) -> JsonObject:
    entry = document.root.children("accessors")[index]
    if entry.text("type") not in types:
        entry.refuse("type", " or ".join(types))
    if entry.integer("componentType") not in COMPONENTS:
        entry.refuse("componentType", "one of " + ", ".join(map(str, COMPONENTS)))
    entry.integer("count", low=1)
    return entry


def _dense(document: GltfDocument, entry: JsonObject) -> Numbers:
    """Return (count, width) raw components; a view of the buffer wherever possible."""
    count, width = entry.integer("count"), WIDTHS[entry.text("type")]
    component = np.dtype(COMPONENTS[entry.integer("componentType")])
    if "bufferView" in entry:
        values = _view(document, entry, count, width, component)
    else:
        if count > document.size:
            entry.refuse("count", f"{document.size} at most without a bufferView, as the file has bytes")
        values = np.zeros((count, width), component)
    if "sparse" in entry:
        places, replacements = _sparse(document, entry)
        values = values.copy()
        values[places] = replacements
    return values


def _sparse(document: GltfDocument, entry: JsonObject) -> tuple[NDArray[np.int64], Numbers]:
    """Return the places (s,) and raw values (s, width) of a sparse accessor."""
    count, width = entry.integer("count"), WIDTHS[entry.text("type")]
    sparse = entry.child("sparse")
    stored = sparse.integer("count", low=1, high=count)
    where = sparse.child("indices")
    if where.integer("componentType") not in UNSIGNED:
        where.refuse("componentType", "5121, 5123 or 5125 for indices")
    places = _view(document, where, stored, 1, np.dtype(COMPONENTS[where.integer("componentType")]))[:, 0]
    if places.max() >= count:
        raise FacepinError(f"{where.where}: index {places.max()}, allowed are 0 to {count - 1}")
    component = np.dtype(COMPONENTS[entry.integer("componentType")])
    return places.astype(np.int64), _view(document, sparse.child("values"), stored, width, component)


def _view(
    document: GltfDocument, entry: JsonObject, count: int, width: int, component: np.dtype[Any]
) -> Numbers:
    """Return (count, width) components at `entry`'s bufferView and byteOffset, without a copy."""
    view = document.root.children("bufferViews")[entry.integer("bufferView")]
    buffer_index = view.integer("buffer")
    if buffer_index >= len(document.buffers):
        view.refuse("buffer", f"0 to {len(document.buffers) - 1}")
    buffer = document.buffers[buffer_index]
    start, length = view.integer("byteOffset", 0), view.integer("byteLength", low=1)
    if start + length > len(buffer):
        raise FacepinError(f"{view.where} ends at byte {start + length}, its buffer has {len(buffer)}")
    element = width * component.itemsize
    stride = view.integer("byteStride", element, low=element, high=max(element, 252))
    offset = entry.integer("byteOffset", 0)
    needed = offset + stride * (count - 1) + element
    if needed > length:
        raise FacepinError(
            f"{entry.where}: {count} elements need {needed} bytes, {view.where.split(': ')[-1]} has {length}"
        )
    values: Numbers = np.ndarray(
        (count, width), component, buffer, start + offset, strides=(stride, component.itemsize)
    )
    return values if sys.byteorder == "little" else values.astype(component.newbyteorder("="))


def _normalised(values: Numbers, entry: JsonObject) -> Points:
    """Return float32; integers marked as normalised become 0..1 or -1..1 (KHR_mesh_quantization, colours)."""
    floats = np.ascontiguousarray(values, np.float32)
    if values.dtype.kind == "f" or not entry.flag("normalized", False):
        return floats
    floats = floats / np.float32(np.iinfo(values.dtype).max)
    return np.maximum(floats, np.float32(-1.0))
