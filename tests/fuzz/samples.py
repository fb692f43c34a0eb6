"""Whole models of every kind, with something of everything in them."""

import io
import json
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from support.sample_files import POSITIONS, SMILE, Gltf, face_arrays, face_folder, face_gltf

PLACES = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)


def _gltf() -> Gltf:
    gltf = face_gltf(rotation=[0.0, 0.0, 0.0, 1.0], translation=[0.0, 1.0, 0.0])
    sparse: dict[str, Any] = {
        "count": 1,
        "indices": {"bufferView": gltf.view(np.array([2], np.uint16).tobytes()), "componentType": 5123},
    }
    sparse["values"] = {"bufferView": gltf.view(SMILE[2].tobytes())}
    gltf.json["meshes"][0]["primitives"][0]["targets"].append(
        {"POSITION": gltf.raw_accessor(SMILE, sparse=sparse)}
    )
    gltf.json["meshes"][0]["extras"]["targetNames"].append("frown")
    gltf.json["meshes"][0]["weights"] = [0.0, 0.25, 0.0]
    primitive = gltf.json["meshes"][0]["primitives"][0]
    primitive["attributes"]["TEXCOORD_0"] = gltf.accessor(PLACES)
    primitive["material"] = 0
    gltf.json["textures"] = [{"source": 0}]
    gltf.json["materials"] = [
        {"name": "skin", "alphaMode": "MASK", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}
    ]
    skin = gltf.accessor(np.tile(np.eye(4, dtype=np.float32).reshape(1, 16), (1, 1)))
    gltf.json["skins"] = [{"joints": [0], "inverseBindMatrices": skin}]
    gltf.node(name="eye", mesh=gltf.mesh([gltf.primitive([])]), matrix=np.eye(4).ravel().tolist())
    return gltf


def _png(side: int = 4) -> bytes:
    file = io.BytesIO()
    pixels = np.random.default_rng(1).integers(0, 255, (side, side, 4), np.uint8)
    Image.fromarray(pixels).save(file, "PNG")
    return file.getvalue()


def glb(folder: Path, name: str = "face.glb", **more: Any) -> None:
    gltf = _gltf()
    gltf.json["images"] = [{"bufferView": gltf.view(_png()), "mimeType": "image/png"}]
    gltf.json |= more
    gltf.save(folder / name)


def gltf_folder(folder: Path) -> None:
    gltf = _gltf()
    gltf.json["images"] = [{"uri": "skin.png"}]
    gltf.json["buffers"] = [{"uri": "face.bin", "byteLength": len(gltf.binary)}]
    (folder / "face.gltf").write_text(json.dumps(gltf.json))
    (folder / "face.bin").write_bytes(gltf.binary)
    (folder / "skin.png").write_bytes(_png())


def vrm(folder: Path) -> None:
    binds = [{"mesh": 0, "index": 0, "weight": 100}, {"mesh": 0, "index": 1, "weight": 40}]
    groups = [{"name": "Joy", "presetName": "joy", "binds": binds, "isBinary": False}]
    morphs = [{"node": 0, "index": 1, "weight": 0.5}]
    expressions = {
        "preset": {"happy": {"morphTargetBinds": morphs}},
        "custom": {"odd": {"morphTargetBinds": morphs}},
    }
    vrm: dict[str, Any] = {"VRM": {"blendShapeMaster": {"blendShapeGroups": groups}}}
    vrm["VRMC_vrm"] = {"specVersion": "1.0", "expressions": expressions}
    glb(folder, "face.vrm", extensionsUsed=["VRM", "VRMC_vrm"], extensions=vrm)


def npz(folder: Path) -> None:
    combined = {"combo_pairs": np.array([[0, 1]]), "combo_deltas": SMILE[None] / 4}
    with zipfile.ZipFile(folder / "face.npz", "w") as archive:
        for name, array in {**face_arrays(), **combined}.items():
            file = io.BytesIO()
            np.save(file, array)
            archive.writestr(f"{name}.npy", file.getvalue())


def obj(folder: Path) -> None:
    face_folder(folder / "face")
    lines = [f"v {x} {y} {z}" for x, y, z in POSITIONS.tolist()]
    lines += ["vt 0 0", "vn 0 0 1", "mtllib face.mtl", "usemtl skin", "g head", "f 1/1/1 2/1/1 3//1 4"]
    (folder / "face/face_neutral.obj").write_text("\n".join(lines) + "\n")
    (folder / "face/face.mtl").write_text("newmtl skin\nKd 0.8 0.5 0.4\nmap_Kd skin.png\n")
    (folder / "face/skin.png").write_bytes(_png())
