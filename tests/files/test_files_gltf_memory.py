"""A glTF takes memory in proportion to what it holds: each thing is read, counted and kept once."""

import io
import json
import struct
import tracemalloc

import numpy as np
import pytest
from PIL import Image

from facepin.core.errors import FacepinError
from facepin.files import open_rig
from support.sample_files import POSITIONS, Gltf, face_gltf


def opened(path):
    """Return a rig, or the line by which its file is refused, and the most memory that took."""
    tracemalloc.start()
    try:
        found = open_rig(path)
    except FacepinError as error:
        found = str(error)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return found, peak


def test_a_small_file_that_repeats_itself_is_refused(tmp_path):
    gltf = face_gltf()
    for _ in range(3000):
        gltf.node(mesh=0)
    with pytest.raises(FacepinError, match="far more than the file holds"):
        open_rig(gltf.save(tmp_path / "nodes.glb"))
    gltf = Gltf()
    target = gltf.accessor(np.ones((1000, 3), np.float32))
    primitive = gltf.primitive([target] * 9000)
    primitive["attributes"]["POSITION"] = gltf.accessor(np.ones((1000, 3), np.float32))
    gltf.node(mesh=gltf.mesh([primitive]))
    with pytest.raises(FacepinError, match="far more than the file holds"):
        open_rig(gltf.save(tmp_path / "targets.glb"))


def test_a_file_that_many_buffers_name_is_read_and_counted_once(tmp_path):
    gltf = face_gltf()
    content = bytes(gltf.binary).ljust(400_000, b"\0")
    (tmp_path / "big.bin").write_bytes(content)
    (tmp_path / "link.bin").symlink_to(tmp_path / "big.bin")
    addresses = ["big.bin", "./big.bin", "%62ig.bin", "link.bin"]
    gltf.json["buffers"] = [
        {"uri": addresses[at % 4], "byteLength": len(content) - 4 * (at % 50)} for at in range(200)
    ]
    for at, view in enumerate(gltf.json["bufferViews"]):
        view["buffer"] = 40 * at
    path = tmp_path / "face.gltf"
    path.write_text(json.dumps(gltf.json))
    rig, peak = opened(path)
    assert np.array_equal(rig.neutral, POSITIONS)
    assert peak < 3e6


def test_neither_text_nor_repetition_is_data_that_vertices_could_come_from(tmp_path):
    gltf = face_gltf()
    (tmp_path / "face.bin").write_bytes(bytes(gltf.binary))
    gltf.json["buffers"] = [{"uri": "face.bin", "byteLength": len(gltf.binary)}] * 500
    for _ in range(4_000):
        gltf.node(mesh=0)
    gltf.json["asset"]["copyright"] = "x" * 1_000_000
    (tmp_path / "face.gltf").write_text(json.dumps(gltf.json))
    line, _ = opened(tmp_path / "face.gltf")
    assert "far more than the file holds" in line


@pytest.mark.parametrize("name", ["face.glb", "face.gltf", "face.vrm"])
@pytest.mark.parametrize("head", [b"", b"{" + b"\0" * 30, b"MZ" * 50])
def test_the_head_of_a_huge_file_decides(tmp_path, name, head):
    with (tmp_path / name).open("wb") as file:
        file.write(head)
        file.truncate(2**31)
    line, peak = opened(tmp_path / name)
    assert name in line
    assert peak < 1e6


@pytest.mark.parametrize("size", [0, 2**31 - 20, 2**20])
def test_a_huge_chunk_is_not_read_before_it_looks_like_json(tmp_path, size):
    with (tmp_path / "face.glb").open("wb") as file:
        file.write(struct.pack("<4sIIII", b"glTF", 2, 2**31, size, 0x4E4F534A))
        file.truncate(2**31)
    assert opened(tmp_path / "face.glb")[1] < 1e6


def test_of_a_huge_binary_chunk_only_what_the_buffer_has_is_read(tmp_path):
    path = face_gltf().save(tmp_path / "face.glb")
    content = bytearray(path.read_bytes())
    text = struct.unpack_from("<I", content, 12)[0]
    struct.pack_into("<I", content, 8, 2**30)
    struct.pack_into("<I", content, 20 + text, 2**30 - 28 - text)
    with path.open("wb") as file:
        file.write(content)
        file.truncate(2**30)
    rig, peak = opened(path)
    assert rig.shape_count == 2
    assert peak < 1e6


def test_half_a_character_becomes_a_sign_of_replacement(tmp_path):
    gltf = face_gltf()
    gltf.json["meshes"][0]["extras"]["targetNames"] = ["sm\ud800ile", "\ud83d\ude00"]
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    assert rig.shape_names == ("sm\ufffdile", "\U0001f600")
    gltf.json["buffers"] = [{"byteLength": len(gltf.binary), "uri": "\udc80.bin"}]
    (tmp_path / "face.gltf").write_text(json.dumps(gltf.json))
    assert "buffers[0].uri" in opened(tmp_path / "face.gltf")[0]


def test_primitives_share_vertices_whatever_pictures_are_on_them(tmp_path):
    gltf = Gltf()
    places = gltf.accessor(POSITIONS[:, :2].copy())
    first = gltf.primitive([gltf.accessor(POSITIONS)])
    first["attributes"]["TEXCOORD_0"] = places
    first["attributes"]["TEXCOORD_1"] = gltf.accessor(POSITIONS[:, 1:].copy())
    pixel = io.BytesIO()
    Image.new("RGB", (1, 1)).save(pixel, "PNG")
    gltf.json["images"] = [{"bufferView": gltf.view(pixel.getvalue())}]
    gltf.json["textures"] = [{"source": 0}, {"source": 0}]
    looks = [{"baseColorTexture": {"index": 0}}, {"baseColorTexture": {"index": 1}}, {}]
    looks.append({"baseColorTexture": {"index": 0, "texCoord": 1}})
    gltf.json["materials"] = [{"pbrMetallicRoughness": look} for look in looks]
    order = [2, 0, 1, 3]  # what has no picture goes with the others wherever it stands
    gltf.node(mesh=gltf.mesh([first | {"material": at} for at in order], ["s"]))
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    assert rig.vertex_count == 8
    assert np.array_equal(rig.texture_places, np.concatenate([POSITIONS[:, :2], POSITIONS[:, 1:]]))
    assert [part.texture is None for part in rig.parts] == [True, False, False, False]
    assert len({part.texture for part in rig.parts[1:]}) == 1
