"""Small models made for the tests of the readers, each number known."""

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np

POSITIONS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.5]], np.float32)
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]], np.uint16)
SMILE = np.array([[0, 0.25, 0], [0, 0, 0], [0, -1, 2], [0, 0, 0]], np.float32)
BLINK = np.array([[0, 0, 0], [0.5, 0, 0], [0, 0, 0], [0, 0, -4]], np.float32)
COMPONENTS = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class Gltf:
    """A glTF that grows; `save` writes it as .glb."""

    def __init__(self) -> None:
        self.binary = bytearray()
        self.json: dict[str, Any] = {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": []}],
            "nodes": [],
            "meshes": [],
            "accessors": [],
            "bufferViews": [],
        }

    def view(self, content: bytes, **more: Any) -> int:
        self.binary += bytes(-len(self.binary) % 4)
        self.json["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(content), **more}
        )
        self.binary += content
        return len(self.json["bufferViews"]) - 1

    def accessor(self, array: np.ndarray, **more: Any) -> int:
        return self.raw_accessor(array, bufferView=self.view(array.tobytes()), **more)

    def raw_accessor(self, like: np.ndarray, **more: Any) -> int:
        entry = {
            "componentType": COMPONENTS[like.dtype.str[1:]],
            "count": len(like),
            "type": TYPES[1 if like.ndim == 1 else like.shape[1]],
            **more,
        }
        self.json["accessors"].append(entry)
        return len(self.json["accessors"]) - 1

    def primitive(self, targets: list[int], **more: Any) -> dict[str, Any]:
        return {
            "attributes": {"POSITION": self.accessor(POSITIONS)},
            "indices": self.accessor(TRIANGLES.ravel()),
            "targets": [{"POSITION": target} for target in targets],
            **more,
        }

    def mesh(self, primitives: list[dict[str, Any]], names: list[Any] | None = None, **more: Any) -> int:
        entry = {"primitives": primitives, **more}
        if names is not None:
            entry["extras"] = {"targetNames": names}
        self.json["meshes"].append(entry)
        return len(self.json["meshes"]) - 1

    def node(self, *, root: bool = True, **entry: Any) -> int:
        self.json["nodes"].append(entry)
        if root:
            self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)
        return len(self.json["nodes"]) - 1

    def save(self, path: Path) -> Path:
        if self.binary:
            self.json["buffers"] = [{"byteLength": len(self.binary)}, *self.json.get("buffers", [])[1:]]
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text
        chunks += struct.pack("<I4s", len(self.binary), b"BIN\0") + self.binary
        path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
        return path


def face_gltf(**node: Any) -> Gltf:
    """Return one mesh with the shapes smile and blink at one node."""
    gltf = Gltf()
    primitive = gltf.primitive([gltf.accessor(SMILE), gltf.accessor(BLINK)])
    gltf.node(mesh=gltf.mesh([primitive], ["smile", "blink"]), **node)
    return gltf


def obj_lines(positions: np.ndarray, faces: str = "") -> str:
    return "".join(f"v {x} {y} {z}\n" for x, y, z in positions.tolist()) + faces


def face_folder(folder: Path) -> Path:
    """Write the same face as a folder of .obj files, its two triangles as one quad."""
    folder.mkdir()
    (folder / "face_neutral.obj").write_text(obj_lines(POSITIONS, "f 1 2 3 4\n"))
    (folder / "smile.obj").write_text(obj_lines(POSITIONS + SMILE))
    (folder / "blink.obj").write_text(obj_lines(POSITIONS + BLINK))
    return folder


def face_arrays() -> dict[str, np.ndarray]:
    """Return the same face as the arrays of a .npz."""
    return {
        "neutral": POSITIONS,
        "faces": TRIANGLES.astype(np.int32),
        "deltas": np.stack([SMILE, BLINK]),
        "names": np.array(["smile", "blink"]),
    }


def dense(rig: Any) -> np.ndarray:
    """Return the deltas of a rig as (k, n, 3)."""
    return rig.deltas.toarray().T.reshape(rig.shape_count, rig.vertex_count, 3)
