"""The rig as .glb: every vertex in its place, shapes as morph targets, parts as primitives sharing both."""

import io
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats, Points, frozen
from facepin.core.mesh.normals import NormalField
from facepin.core.rig import Part, Rig, Texture
from facepin.files.gltf.container import BINARY_CHUNK, JSON_CHUNK
from facepin.files.gltf.materials import TRANSMISSION, srgb_to_linear
from facepin.files.gltf.targets import COMBINATIONS
from facepin.files.gltf.textures import CLAMP, REPEAT
from facepin.files.safely.atomic import atomic_write

FLOAT, SHORT, LONG = 5126, 5123, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


def write_glb(rig: Rig, weights: Floats, path: Path) -> None:
    """Write the neutral, all shapes with their names, and `weights` (k,) as the weights of the mesh.

    glTF knows no combinations.  Each is written as one more target whose weight is the product of the two
    weights, so that the pose looks right everywhere, and `extras` of the mesh say which targets these are.
    Faces become triangles.  Textures are stored as PNG, as large as they were read.  Normals are those of
    the neutral, and nothing is said about how shapes change them.  Shapes are stored sparse where that is
    smaller.

    Raises
    ------
    FacepinError
        If the file cannot be written.
    """
    packed = _Packed()
    attributes = {"POSITION": packed.points(rig.neutral, bounds=True), "NORMAL": packed.points(_normals(rig))}
    if rig.colours is not None:
        attributes["COLOR_0"] = packed.points(srgb_to_linear(rig.colours))
    if rig.texture_places is not None:
        attributes["TEXCOORD_0"] = packed.points(rig.texture_places)
    targets = [
        {"POSITION": packed.delta(*_moves(rig, j), rig.vertex_count)} for j in range(rig.deltas.shape[1])
    ]
    primitives = [
        {
            "attributes": attributes,
            "indices": packed.indices(
                rig.triangles[part.triangles.start : part.triangles.stop], rig.vertex_count
            ),
            "material": at,
            "targets": targets,
        }
        for at, part in enumerate(rig.parts)
    ]
    mesh = {
        "name": rig.parts[0].name if len(rig.parts) == 1 else rig.name,
        "primitives": primitives,
        "weights": rig.amounts(np.asarray(weights, np.float64)).tolist(),
        "extras": _extras(rig),
    }
    document = {
        "asset": {"version": "2.0", "generator": "Facepin"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": rig.name, "mesh": 0}],
        "meshes": [mesh],
        **_looks(rig, packed),
        "accessors": packed.accessors,
        "bufferViews": packed.views,
        "buffers": [{"byteLength": len(packed.content)}],
    }
    atomic_write(path, _container(document, bytes(packed.content)))


def _extras(rig: Rig) -> dict[str, Any]:
    """Return the names of all targets, and of which shapes the combinations among them are."""
    names = [*rig.names_outside, *rig.combination_names]
    combined = [
        {"target": rig.shape_count + i, "shapes": [a, b]}
        for i, (a, b) in enumerate(rig.combinations.tolist())
    ]
    return {"targetNames": names, **({COMBINATIONS: combined} if combined else {})}


class _Packed:
    """The binary chunk while it grows, with its views and accessors."""

    def __init__(self) -> None:
        self.content = bytearray()
        self.views: list[dict[str, int]] = []
        self.accessors: list[dict[str, Any]] = []

    def points(self, points: Points, *, bounds: bool = False) -> int:
        """Store (n, 2 or 3) floats and return their accessor."""
        entry: dict[str, Any] = {
            "bufferView": self._view(points, ARRAY_BUFFER),
            "componentType": FLOAT,
            "count": len(points),
            "type": f"VEC{points.shape[1]}",
        }
        return self._accessor(entry | (_bounds(points) if bounds else {}))

    def delta(self, vertices: NDArray[np.int32], moves: Points, count: int) -> int:
        """Store what one shape moves, dense or sparse, and return its accessor."""
        wide = np.uint16 if count <= 2**16 else np.uint32
        if len(vertices) * (moves.itemsize * 3 + np.dtype(wide).itemsize) >= 12 * count:
            dense = np.zeros((count, 3), np.float32)
            dense[vertices] = moves
            return self.points(dense, bounds=True)
        entry: dict[str, Any] = {"componentType": FLOAT, "count": count, "type": "VEC3"}
        if len(vertices):
            component = SHORT if wide is np.uint16 else LONG
            entry["sparse"] = {
                "count": len(vertices),
                "indices": {"bufferView": self._view(vertices.astype(wide)), "componentType": component},
                "values": {"bufferView": self._view(moves)},
            }
        still = np.zeros((int(len(vertices) < count), 3), np.float32)
        return self._accessor(entry | _bounds(np.concatenate([moves, still])))

    def indices(self, triangles: NDArray[np.int32], vertices: int) -> int:
        """Store (t, 3) vertex numbers and return their accessor."""
        short = vertices < 2**16  # 65535 itself would restart a primitive
        flat = triangles.astype(np.uint16 if short else np.uint32).ravel()
        view = self._view(flat, ELEMENT_ARRAY_BUFFER)
        component = SHORT if short else LONG
        return self._accessor(
            {"bufferView": view, "componentType": component, "count": len(flat), "type": "SCALAR"}
        )

    def picture(self, texture: Texture) -> int:
        """Store a picture as PNG and return its view."""
        from PIL import Image

        pixels = texture.pixels if (texture.pixels[..., 3] < 255).any() else texture.pixels[..., :3]
        file = io.BytesIO()
        Image.fromarray(np.ascontiguousarray(pixels)).save(file, "PNG")
        return self._view(np.frombuffer(file.getbuffer(), np.uint8))

    def _view(self, array: NDArray[Any], target: int | None = None) -> int:
        self.content += bytes(-len(self.content) % 4)
        view = {"buffer": 0, "byteOffset": len(self.content), "byteLength": array.nbytes}
        self.content += np.ascontiguousarray(array, array.dtype.newbyteorder("<")).tobytes()
        self.views.append(view if target is None else view | {"target": target})
        return len(self.views) - 1

    def _accessor(self, entry: dict[str, Any]) -> int:
        self.accessors.append(entry)
        return len(self.accessors) - 1


def _bounds(points: Points) -> dict[str, list[float]]:
    return {"min": points.min(axis=0).tolist(), "max": points.max(axis=0).tolist()}


def _moves(rig: Rig, column: int) -> tuple[NDArray[np.int32], Points]:
    """Return the vertices that a column of the deltas moves, ascending, and (s, 3) how far."""
    run = slice(rig.deltas.indptr[column], rig.deltas.indptr[column + 1])
    rows = rig.deltas.indices[run]
    vertices, place = np.unique(rows // 3, return_inverse=True)
    moves = np.zeros((len(vertices), 3), np.float32)
    moves[place, rows % 3] = rig.deltas.data[run]
    return vertices.astype(np.int32), moves


def _normals(rig: Rig) -> Points:
    normals = NormalField(rig).normals(rig.neutral).astype(np.float64)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return frozen(normals, np.float32)


def _looks(rig: Rig, packed: _Packed) -> dict[str, Any]:
    """Return what the document says of materials and of pictures on them, each of which is stored once."""
    used = [part.texture for part in rig.parts if part.texture is not None and rig.texture_places is not None]
    numbers = {texture: number for number, texture in enumerate(dict.fromkeys(used))}
    looks: dict[str, Any] = {
        "materials": [
            _material(part, rig.colours is not None, numbers.get(part.texture) if part.texture else None)
            for part in rig.parts
        ]
    }
    if any(part.transmission for part in rig.parts):
        looks["extensionsUsed"] = [TRANSMISSION]
    if numbers:
        looks["images"] = [
            {"bufferView": packed.picture(texture), "mimeType": "image/png"} for texture in numbers
        ]
        looks["samplers"] = [
            dict(zip(("wrapS", "wrapT"), [REPEAT if on else CLAMP for on in texture.repeats], strict=True))
            for texture in numbers
        ]
        looks["textures"] = [{"source": number, "sampler": number} for number in numbers.values()]
    return looks


def _material(part: Part, coloured: bool, texture: int | None) -> dict[str, Any]:
    """Return the material of a part; white where the vertices carry the colour."""
    base = (1.0, 1.0, 1.0) if part.colour is None or coloured else srgb_to_linear(part.colour)
    shine: dict[str, Any] = {"metallicFactor": 0.0, "roughnessFactor": part.roughness}
    if (part.colour is not None and not coloured) or part.opacity < 1.0:
        shine["baseColorFactor"] = [*map(float, base), part.opacity]
    if texture is not None:
        shine["baseColorTexture"] = {"index": texture}
    look: dict[str, Any] = {
        "name": part.name,
        "pbrMetallicRoughness": shine,
        "doubleSided": part.double_sided,
    }
    if part.transmission:
        look["extensions"] = {TRANSMISSION: {"transmissionFactor": part.transmission}}
    if part.blends:
        look["alphaMode"] = "BLEND"
    elif part.cutout is not None or part.opacity < 1.0:
        look |= {"alphaMode": "MASK", "alphaCutoff": 0.5 if part.cutout is None else part.cutout}
    return look


def _container(document: dict[str, Any], binary: bytes) -> bytes:
    text = json.dumps(document, ensure_ascii=False, separators=(",", ":"), allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    binary += bytes(-len(binary) % 4)
    chunks = struct.pack("<II", len(text), JSON_CHUNK) + text
    chunks += struct.pack("<II", len(binary), BINARY_CHUNK) + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
