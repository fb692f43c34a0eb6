"""Compressed glTF: read where the libraries are installed, else one line says what to do."""

import base64
import random
import sys

import numpy as np
import pytest

from facepin.core.errors import FacepinError
from facepin.files import open_rig
from support.sample_files import BLINK, POSITIONS, SMILE, TRIANGLES, dense, face_gltf

MESHOPT = ("EXT_meshopt_compression", "KHR_meshopt_compression")
DRACO = "KHR_draco_mesh_compression"
WAYS_OUT = r'pip install "facepin\[compressed\]".* gltf-transform copy'


def meshopt_gltf(extension, *, fallback=False):
    """Return the sample face compressed by meshopt; `fallback` keeps the plain data too, as gltfpack -cf."""
    meshopt = pytest.importorskip("meshopt")
    gltf = face_gltf()
    plain = bytes(gltf.binary)
    gltf.binary = bytearray(plain if fallback else b"")
    at = 1 - fallback
    for view, array in zip(
        gltf.json["bufferViews"], (SMILE, BLINK, POSITIONS, TRIANGLES.ravel()), strict=True
    ):
        mode = "ATTRIBUTES" if array.ndim == 2 else "TRIANGLES"
        rows, sieve = array, "NONE"
        if array is BLINK:
            rows, sieve = meshopt.encode_filter_exp(array, 24), "EXPONENTIAL"
        packed = meshopt.encode_gltf_buffer(rows, mode)
        start = len(gltf.binary)
        gltf.binary += packed
        view["buffer"] = at
        view["extensions"] = {
            extension: {
                "buffer": 0,
                "byteOffset": start,
                "byteLength": len(packed),
                "byteStride": array.itemsize * (3 if array.ndim == 2 else 1),
                "count": len(array),
                "mode": mode,
                "filter": sieve,
            }
        }
    if not fallback:
        flag = {"fallback": True}
        gltf.json["buffers"] = [{}, {"byteLength": len(plain), "extensions": {extension: flag}}]
        gltf.json["extensionsRequired"] = [extension]
    return gltf


def draco_gltf():
    """Return the sample face with Draco's positions, places, joints and indices, and plain targets."""
    draco = pytest.importorskip("DracoPy")
    gltf = face_gltf(skin=0)
    gltf.json["skins"] = [{"joints": [gltf.node(), gltf.node(translation=[7.0, 0.0, 0.0])]}]
    packed = draco.encode(
        POSITIONS,
        TRIANGLES.astype(np.uint32),
        preserve_order=True,
        quantization_bits=24,
        generic_attributes={
            3: np.array([[0, 0, 0, 0]] * 3 + [[1, 0, 0, 0]], np.uint8),
            4: np.array([[1, 0, 0, 0]] * 4, np.float32),
        },
    )
    numbers = {
        {3: "JOINTS_0", 4: "WEIGHTS_0"}.get(found["unique_id"], "POSITION"): found["unique_id"]
        for found in draco.decode(packed).attributes
    }
    (primitive,) = gltf.json["meshes"][0]["primitives"]
    primitive["attributes"] |= {
        "JOINTS_0": gltf.raw_accessor(np.zeros((4, 4), np.uint8)),
        "WEIGHTS_0": gltf.raw_accessor(np.zeros((4, 4), np.float32)),
    }
    for accessor in (primitive["attributes"]["POSITION"], primitive["indices"]):
        del gltf.json["accessors"][accessor]["bufferView"]
    primitive["extensions"] = {DRACO: {"bufferView": gltf.view(packed), "attributes": numbers}}
    gltf.json["extensionsRequired"] = [DRACO]
    return gltf


@pytest.mark.parametrize("extension", MESHOPT)
@pytest.mark.parametrize("fallback", [True, False])
def test_meshopt_is_undone(tmp_path, extension, fallback):
    rig = open_rig(meshopt_gltf(extension, fallback=fallback).save(tmp_path / "face.glb"))
    assert np.array_equal(rig.neutral, POSITIONS)
    assert np.array_equal(rig.triangles, TRIANGLES)
    assert np.array_equal(dense(rig), [SMILE, BLINK])


def test_draco_is_undone(tmp_path):
    rig = open_rig(draco_gltf().save(tmp_path / "face.glb"))
    assert np.allclose(rig.neutral, POSITIONS + np.array([[0, 0, 0]] * 3 + [[7, 0, 0]]), atol=1e-5)
    assert np.array_equal(rig.triangles, TRIANGLES)
    assert np.array_equal(dense(rig), [SMILE, BLINK])


@pytest.mark.parametrize("extension", [DRACO, *MESHOPT])
def test_without_the_library_one_line_says_how_to_get_it_or_what_to_run(tmp_path, monkeypatch, extension):
    library = "DracoPy" if extension == DRACO else "meshopt"
    monkeypatch.setitem(sys.modules, library, None)
    gltf = face_gltf()
    gltf.json["extensionsRequired"] = [extension]
    if extension == DRACO:
        (primitive,) = gltf.json["meshes"][0]["primitives"]
        position = primitive["attributes"]["POSITION"]
        primitive["extensions"] = {extension: {"bufferView": 0, "attributes": {"POSITION": 0}}}
        del gltf.json["accessors"][position]["bufferView"]
    else:
        gltf.json["bufferViews"][0] |= {"buffer": 1, "extensions": {extension: {"buffer": 0}}}
        flag = {"fallback": True}
        gltf.json["buffers"] = [{}, {"byteLength": 9, "extensions": {extension: flag}}]
    with pytest.raises(FacepinError, match=rf"face\.glb.*\({extension}\).*{WAYS_OUT}"):
        open_rig(gltf.save(tmp_path / "face.glb"))


@pytest.mark.parametrize("extension", [DRACO, *MESHOPT])
def test_without_the_library_what_is_there_in_plain_too_is_read(tmp_path, monkeypatch, extension):
    for library in ("DracoPy", "meshopt"):
        monkeypatch.setitem(sys.modules, library, None)
    gltf = face_gltf()
    (primitive,) = gltf.json["meshes"][0]["primitives"]
    primitive["extensions"] = {DRACO: {"bufferView": 0, "attributes": {"POSITION": 0}}}
    gltf.json["bufferViews"][0]["extensions"] = {extension: {"buffer": 0}}
    assert np.array_equal(dense(open_rig(gltf.save(tmp_path / "face.glb"))), [SMILE, BLINK])


def test_compressed_data_may_not_unfold_to_far_more(tmp_path):
    gltf = meshopt_gltf(MESHOPT[0])
    packed = gltf.json["bufferViews"][0]["extensions"][MESHOPT[0]]
    packed["count"] = 2**31
    with pytest.raises(FacepinError, match="far more"):
        open_rig(gltf.save(tmp_path / "face.glb"))


@pytest.mark.parametrize("make", [lambda: meshopt_gltf(MESHOPT[0]), draco_gltf], ids=["meshopt", "draco"])
def test_harmed_compressed_data_give_a_rig_or_one_line(tmp_path, make):
    dice = random.Random(1)
    gltf = make()
    content = bytes(gltf.binary)
    lines = 0
    for _ in range(60):
        gltf.binary = bytearray(content)
        for _ in range(dice.choice([1, 3, 20])):
            gltf.binary[dice.randrange(len(content))] = dice.randrange(256)
        try:
            open_rig(gltf.save(tmp_path / "face.glb"))
        except FacepinError as error:
            assert str(error).isprintable()
            lines += 1
    assert lines > 2


RED_OVER_GREEN = base64.b64decode(
    "q0tUWCAyMLsNChoKAAAAAAEAAAAIAAAACAAAAAAAAAAAAAAAAQAAAAEAAAAAAAAAaAAAACwAAACUAAAALAAAAAAAAAAAAAAA"
    "AAAAAAAAAADAAAAAAAAAAEAAAAAAAAAAQAAAAAAAAAAsAAAAAAAAAAIAKACmAQIAAwMAABAAAAAAAAAAAAB/AAAAAAAAAAAA"
    "/////x8AAABLVFh3cml0ZXIAQmFzaXMgVW5pdmVyc2FsIDIuMTAAAAQAAAB/fwAA9x8A4B96AAAAAAAAAAAAAPcfAOAfegAA"
    "AAAAAAAAAAAX4B/gHwIPAAAAAAAAAAAAF+Af4B8CDwAAAAAAAAAAAA=="
)
"""A KTX2 picture (UASTC) of 8 × 8 pixels."""


def ktx2_gltf():
    gltf = face_gltf()
    (primitive,) = gltf.json["meshes"][0]["primitives"]
    primitive |= {"material": 0}
    primitive["attributes"]["TEXCOORD_0"] = gltf.accessor(POSITIONS[:, :2].copy())
    gltf.json["images"] = [{"bufferView": gltf.view(RED_OVER_GREEN), "mimeType": "image/ktx2"}]
    gltf.json["textures"] = [{"extensions": {"KHR_texture_basisu": {"source": 0}}}]
    gltf.json["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
    gltf.json["extensionsRequired"] = ["KHR_texture_basisu"]
    return gltf


def test_a_ktx2_picture_is_read(tmp_path):
    pytest.importorskip("opengl_basisu")
    (part,) = open_rig(ktx2_gltf().save(tmp_path / "face.glb")).parts
    assert part.texture is not None
    assert part.texture.pixels.shape == (8, 8, 4)
    assert part.texture.pixels[[0, -1], 4].tolist() == [[255, 0, 0, 255], [0, 255, 0, 255]]


def test_without_the_library_a_face_opens_without_its_ktx2_picture(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "opengl_basisu", None)
    rig = open_rig(ktx2_gltf().save(tmp_path / "face.glb"))
    assert rig.parts[0].texture is None
    (line,) = rig.warnings
    assert "KTX2" in line
    assert 'pip install "facepin[compressed]"' in line
    assert "gltf-transform ktxdecompress" in line


def test_harmed_ktx2_pictures_are_left_out(tmp_path):
    pytest.importorskip("opengl_basisu")
    dice = random.Random(1)
    gltf = ktx2_gltf()
    content = bytes(gltf.binary)
    for _ in range(40):
        gltf.binary = bytearray(content)
        for _ in range(3):
            gltf.binary[dice.randrange(len(content) - len(RED_OVER_GREEN), len(content))] = dice.randrange(
                256
            )
        rig = open_rig(gltf.save(tmp_path / "face.glb"))
        assert (rig.parts[0].texture is None) == any("left out" in line for line in rig.warnings)
