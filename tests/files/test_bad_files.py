"""Files with faults, and files that only look as if they had some."""

import io
import random
import re
import struct
import subprocess
import sys
import tracemalloc
import warnings
from collections import Counter

import numpy as np
import pytest
from PIL import Image

from facepin.core.errors import FacepinError
from facepin.files import open_rig
from support.sample_files import POSITIONS, face_arrays, face_folder, face_gltf


def listed(folder):
    """Return (path, what is wrong, expected) of each line of a folder's INDEX.tsv."""
    lines = (folder / "INDEX.tsv").read_text(encoding="utf-8").splitlines()[1:]
    rows = [line.split("\t") for line in lines if line]
    return [(folder / name.rstrip("/"), about, expected) for name, about, expected in rows]


def check(rig):
    """Assert what every rig promises."""
    assert np.isfinite(rig.neutral).all()
    assert np.isfinite(rig.evaluate(np.ones(rig.shape_count))).all()
    assert rig.triangles.min() >= 0
    assert rig.triangles.max() < rig.vertex_count
    assert rig.parts[-1].faces.stop == len(rig.face_sizes)
    assert len(set(rig.shape_names)) == rig.shape_count == rig.deltas.shape[1] > 0
    assert all(name.isprintable() and 0 < len(name) <= 256 for name in rig.shape_names)
    assert all(line.isprintable() for line in rig.warnings)


def test_faulty_files_get_what_the_index_says(shared):
    rows = listed(shared / "bad")
    assert len(rows) > 35
    for path, about, expected in rows:
        tracemalloc.start()
        try:
            rig = open_rig(path, cache=False)
        except FacepinError as error:
            assert expected == "reject", f"{path.name} ({about}): {error}"
            assert str(error).isprintable()
            assert path.name in str(error) or any(part.name in str(error) for part in path.iterdir()), str(
                error
            )
        else:
            assert expected == "accept-with-warning", f"{path.name}: {about}"
            assert rig.warnings
            check(rig)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        size = path.stat().st_size if path.is_file() else sum(file.stat().st_size for file in path.iterdir())
        assert peak < 1e6 + 30 * size, f"{path.name}: {peak} bytes of memory for {size}"


def test_faultless_files_open_without_a_warning(shared):
    rows = listed(shared / "good")
    assert rows
    shapes = {"smile", "blink", "open"}
    for path, about, _ in rows:
        rig = open_rig(path, cache=False)
        assert (rig.vertex_count, set(rig.shape_names), rig.warnings) == (25, shapes, ()), about
        assert rig.deltas.nnz == 29
        check(rig)


SPY = """
import os, sys
from pathlib import Path
from facepin.core.errors import FacepinError
from facepin.files import open_rig
import numpy, zipfile, urllib.parse, base64, encodings.idna
folder = Path(sys.argv[1])
allowed = tuple(str(Path(p).resolve()) for p in (folder, sys.prefix, sys.base_prefix, *sys.path))
def spy(event, arguments):
    if event == "open" and isinstance(arguments[0], (str, bytes)):
        path = os.path.realpath(os.fsdecode(arguments[0]))
        if not path.startswith(allowed):
            print("OPENED", path)
    elif event.startswith(("socket.", "subprocess.", "os.system", "os.exec", "pickle.")):
        print("EVENT", event)
sys.addaudithook(spy)
for path in sorted(folder.iterdir()):
    try:
        open_rig(path, cache=False)
    except FacepinError:
        pass
print("done")
"""


def test_nothing_outside_the_folder_is_opened_run_or_unpickled(shared):
    for name in ("bad", "good"):
        command = [sys.executable, "-c", SPY, str(shared / name)]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        assert (result.stdout, result.stderr) == ("done\n", "")


def test_huge_counts_without_data_take_no_memory(tmp_path):
    for count in (4_000_000_000, 10**15):
        for place in ("target", "position", "indices"):
            gltf = face_gltf()
            primitive = gltf.json["meshes"][0]["primitives"][0]
            accessor = {
                "target": primitive["targets"][0]["POSITION"],
                "position": primitive["attributes"]["POSITION"],
                "indices": primitive["indices"],
            }[place]
            gltf.json["accessors"][accessor]["count"] = count
            del gltf.json["accessors"][accessor]["bufferView"]
            tracemalloc.start()
            with pytest.raises(FacepinError):
                open_rig(gltf.save(tmp_path / "face.glb"))
            peak = tracemalloc.get_traced_memory()[1]
            tracemalloc.stop()
            assert peak < 1e6


def harmed(content, dice):
    """Return `content` cut, overwritten, shortened, lengthened, or with a number exchanged."""
    changed = bytearray(content)
    way = dice.random()
    if way < 0.2:
        return bytes(changed[: dice.randrange(len(changed))])
    if way < 0.6:
        for _ in range(dice.choice([1, 2, 5, 30])):
            changed[dice.randrange(len(changed))] = dice.randrange(256)
    elif way < 0.7:
        at = dice.randrange(len(changed))
        del changed[at : at + dice.randrange(1, 40)]
    elif way < 0.8:
        at = dice.randrange(len(changed))
        changed[at:at] = dice.randbytes(dice.randrange(1, 20))
    else:
        # Of the same length, so that containers stay sound and the fault gets deeper.
        number = dice.choice(list(re.finditer(rb"\d+", content)))
        length = number.end() - number.start()
        other = dice.choice(
            [b"0", b"-1", b"9" * length, b"1e9", b"1.5", b"null", b"[]", b'""', b"{}", b"true"]
        )
        changed[number.start() : number.end()] = other[:length].ljust(length)
    return bytes(changed)


@pytest.mark.parametrize("kind", ["glb", "gltf", "vrm", "npz", "obj"])
def test_harmed_files_give_a_rig_or_one_line(tmp_path, kind):
    dice = random.Random(kind)
    folder = face_folder(tmp_path / "face")
    np.savez(tmp_path / "sound.npz", **face_arrays())
    path = tmp_path / f"face.{kind}"
    content = {
        "glb": lambda: face_gltf().save(tmp_path / "sound.glb").read_bytes(),
        "gltf": lambda: sound_gltf(tmp_path),
        "vrm": lambda: avatar_gltf().save(tmp_path / "sound.vrm").read_bytes(),
        "npz": lambda: (tmp_path / "sound.npz").read_bytes(),
        "obj": lambda: (folder / "face_neutral.obj").read_bytes(),
    }[kind]()
    if kind == "obj":
        path = folder / "face_neutral.obj"
    outcomes = Counter[str]()
    for _ in range(250):
        path.write_bytes(harmed(content, dice))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            try:
                rig = open_rig(folder if kind == "obj" else path, cache=False)
            except FacepinError as error:
                assert str(error).isprintable()
                outcomes["line"] += 1
            else:
                check(rig)
                outcomes["rig"] += 1
    assert min(outcomes["rig"], outcomes["line"]) > 2


def avatar_gltf():
    """Return the sample face with bones, a picture, an odd look, and an expression."""
    gltf = face_gltf(skin=0)
    picture = io.BytesIO()
    Image.new("RGB", (4, 4), "red").save(picture, "PNG")
    (primitive,) = gltf.json["meshes"][0]["primitives"]
    primitive["material"] = 0
    primitive["attributes"] |= {
        "TEXCOORD_1": gltf.accessor(POSITIONS[:, :2].copy()),
        "JOINTS_0": gltf.accessor(np.array([[0, 1, 0, 0]] * 4, np.uint8)),
        "WEIGHTS_0": gltf.accessor(np.array([[0.25, 0.75, 0, 0]] * 4, np.float32)),
    }
    joints = [gltf.node(rotation=[0.0, 0.6, 0.0, 0.8]), gltf.node(scale=[1.0, 2.0, 1.0])]
    matrices = np.tile(np.eye(4, dtype=np.float32).reshape(1, 16), (2, 1))
    older = {
        "diffuseFactor": [1.0, 0.5, 0.5, 0.5],
        "diffuseTexture": {
            "index": 0,
            "texCoord": 1,
            "extensions": {"KHR_texture_transform": {"offset": [0.5, 0.5], "scale": [2, 2], "rotation": 1}},
        },
    }
    gltf.json |= {
        "skins": [{"joints": joints, "inverseBindMatrices": gltf.accessor(matrices)}],
        "images": [{"bufferView": gltf.view(picture.getvalue())}],
        "samplers": [{"wrapS": 33071}],
        "textures": [{"sampler": 0, "extensions": {"EXT_texture_webp": {"source": 0}}}],
        "materials": [
            {
                "alphaMode": "MASK",
                "alphaCutoff": 0.25,
                "extensions": {"KHR_materials_pbrSpecularGlossiness": older},
            }
        ],
        "extensions": {
            "VRM": {
                "blendShapeMaster": {
                    "blendShapeGroups": [{"name": "Joy", "binds": [{"mesh": 0, "index": 1, "weight": 80}]}]
                }
            }
        },
    }
    return gltf


def sound_gltf(folder):
    gltf = face_gltf()
    (folder / "face.bin").write_bytes(bytes(gltf.binary))
    path = gltf.save(folder / "sound.glb")
    length = struct.unpack_from("<I", path.read_bytes(), 12)[0]
    text = path.read_bytes()[20 : 20 + length]
    return text.replace(b'"buffers": [{', b'"buffers": [{"uri": "face.bin", ')
