"""Pictures inside and beside a glTF: used where they can be, left out with a warning where not."""

import base64
import io
import json
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facepin.core.rig import Rig, Texture
from facepin.files import open_rig, write_model
from facepin.files.gltf import images as gltf_images
from facepin.files.gltf import textures as gltf_textures
from support.sample_files import Gltf, face_gltf

PLACES = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
PIXELS = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 0]]], np.uint8)


def png(pixels: np.ndarray = PIXELS, kind: str = "PNG") -> bytes:
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, kind)
    return file.getvalue()


def textured(image: dict | bytes, *, places: np.ndarray | None = PLACES, **material: object) -> Gltf:
    """The sample face with a picture on it: bytes go into the file, a dict is the entry of the image."""
    gltf = face_gltf()
    primitive = gltf.json["meshes"][0]["primitives"][0]
    primitive["material"] = 0
    if places is not None:
        primitive["attributes"]["TEXCOORD_0"] = gltf.accessor(places)
    if isinstance(image, bytes):
        image = {"bufferView": gltf.view(image), "mimeType": "image/png"}
    gltf.json["images"] = [image]
    gltf.json["textures"] = [{"source": 0}]
    shine = {"baseColorTexture": {"index": 0}, "baseColorFactor": [0.5, 0.5, 0.5, 1.0]}
    gltf.json["materials"] = [{"pbrMetallicRoughness": shine, **material}]
    return gltf


def texture(rig: Rig) -> Texture:
    (part,) = rig.parts
    assert part.texture is not None
    return part.texture


def left_out(rig: Rig, *words: str) -> None:
    """The face opened, without its texture but with its colour, and one line says why."""
    (part,) = rig.parts
    assert rig.shape_count == 2
    assert part.texture is None
    assert rig.texture_places is None
    assert part.colour is not None
    lines = [line for line in rig.warnings if "texture is left out" in line]
    assert len(lines) == 1
    assert all(word in lines[0] for word in words), lines[0]
    assert "\n" not in lines[0]


def test_a_picture_inside_the_file(tmp_path: Path) -> None:
    rig = open_rig(textured(png()).save(tmp_path / "face.glb"))
    np.testing.assert_array_equal(texture(rig).pixels[..., :3], PIXELS)
    assert (texture(rig).pixels[..., 3] == 255).all()
    assert texture(rig).repeats == (True, True)
    np.testing.assert_array_equal(rig.texture_places, PLACES)
    assert rig.parts[0].cutout is None
    assert rig.parts[0].colour == pytest.approx((0.7354,) * 3, abs=1e-3)
    assert rig.warnings == ()


def test_pictures_beside_the_model_and_as_text(tmp_path: Path) -> None:
    (tmp_path / "maps").mkdir()
    (tmp_path / "maps" / "my skin.jpg").write_bytes(png(np.full((8, 8, 3), 200, np.uint8), "JPEG"))
    rig = open_rig(textured({"uri": "maps/my%20skin.jpg"}).save(tmp_path / "face.glb"))
    assert texture(rig).pixels.shape == (8, 8, 4)
    uri = "data:image/png;base64," + base64.b64encode(png()).decode()
    np.testing.assert_array_equal(
        texture(open_rig(textured({"uri": uri}).save(tmp_path / "b.glb"))).pixels[..., :3], PIXELS
    )


@pytest.mark.parametrize(
    "uri",
    ["../secret.png", "/etc/hostname", "https://x.org/a.png", "C:\\a.png", "link.png"],
)
def test_nothing_outside_the_folder_is_read(tmp_path: Path, uri: str) -> None:
    (tmp_path / "secret.png").write_bytes(png())
    inside = tmp_path / "model"
    inside.mkdir()
    (inside / "link.png").symlink_to(tmp_path / "secret.png")
    left_out(open_rig(textured({"uri": uri}).save(inside / "face.glb")), "images[0].uri", "inside")


def test_what_is_no_picture_is_left_out(tmp_path: Path) -> None:
    whole = png(np.random.default_rng(1).integers(0, 255, (64, 64, 3)).astype(np.uint8))
    for broken in (b"", b"GIF89a" + bytes(30), whole[: len(whole) // 2], whole[:40], b"<svg/>"):
        left_out(
            open_rig(textured(broken or b"x").save(tmp_path / "face.glb")), "images[0]", "PNG, JPEG or WebP"
        )
    left_out(open_rig(textured({"uri": "gone.png"}).save(tmp_path / "face.glb")), "gone.png")
    left_out(open_rig(textured({"bufferView": 99}).save(tmp_path / "face.glb")), "bufferViews[99]")


def test_a_small_file_cannot_ask_for_much_memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def chunk(kind: bytes, content: bytes) -> bytes:
        check = struct.pack(">I", zlib.crc32(kind + content))
        return struct.pack(">I", len(content)) + kind + content + check

    for width, height, word in ((10000, 8000, "10000x8000"), (30000, 30000, "900000000 pixels")):
        header = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
        data = chunk(b"IDAT", zlib.compress(bytes(1000))) + chunk(b"IEND", b"")
        left_out(open_rig(textured(b"\x89PNG\r\n\x1a\n" + header + data).save(tmp_path / "face.glb")), word)
    monkeypatch.setattr(gltf_textures, "MOST_PIXELS", 3)
    left_out(open_rig(textured(png()).save(tmp_path / "face.glb")), "together")


@pytest.mark.parametrize("kind", ["PNG", "JPEG"])
def test_large_pictures_are_made_smaller(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str) -> None:
    monkeypatch.setattr(gltf_images, "KEPT", 16)
    pixels = np.zeros((40, 64, 3), np.uint8)
    pixels[:, 32:] = 240
    found = texture(open_rig(textured(png(pixels, kind)).save(tmp_path / "face.glb"))).pixels
    assert max(found.shape[:2]) == 16
    assert found[5, 3, 0] < 20 < 220 < found[5, 12, 0]


def test_a_texture_needs_places(tmp_path: Path) -> None:
    left_out(open_rig(textured(png(), places=None).save(tmp_path / "face.glb")), "coordinates")


def test_places_are_moved_as_the_file_says(tmp_path: Path) -> None:
    gltf = textured(png())
    moved = {"offset": [0.5, 0.25], "scale": [2.0, 1.0], "rotation": np.pi / 2}
    look = gltf.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]
    look["extensions"] = {"KHR_texture_transform": moved}
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    x, y = (PLACES * [2, 1]).T
    np.testing.assert_allclose(rig.texture_places, np.stack([y + 0.5, -x + 0.25], axis=1), atol=1e-6)


@pytest.mark.parametrize(
    ("material", "cutout"),
    [
        ({"alphaMode": "MASK"}, 0.5),
        ({"alphaMode": "MASK", "alphaCutoff": 0.2}, 0.2),
        ({"alphaMode": "BLEND"}, 0.5),
    ],
)
def test_alpha_cuts_out(tmp_path: Path, material: dict, cutout: float) -> None:
    rig = open_rig(textured(png(), **material).save(tmp_path / "face.glb"))
    assert rig.parts[0].cutout == cutout


def test_edges_repeat_or_not(tmp_path: Path) -> None:
    gltf = textured(png())
    gltf.json["samplers"] = [{"wrapS": 33071, "wrapT": 10497}]
    gltf.json["textures"][0]["sampler"] = 0
    assert texture(open_rig(gltf.save(tmp_path / "face.glb"))).repeats == (False, True)


def test_white_is_the_colour_of_textured_vertices_beside_coloured_ones(tmp_path: Path) -> None:
    gltf = textured(png())
    other = json.loads(json.dumps(gltf.json["meshes"][0]["primitives"][0]))
    del other["material"]
    other["attributes"]["COLOR_0"] = gltf.accessor(np.full((4, 3), 0.25, np.float32))
    gltf.json["meshes"][0]["primitives"].append(other)
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    assert [part.texture is None for part in rig.parts] == [False, True]
    assert rig.colours is not None
    assert rig.texture_places is not None
    np.testing.assert_allclose(rig.colours[:4], 1.0)
    np.testing.assert_allclose(rig.colours[4:], 0.5371, atol=1e-3)
    np.testing.assert_array_equal(rig.texture_places[4:], 0)


@pytest.mark.parametrize("mode", ["OPAQUE", "MASK"])
def test_a_texture_is_written_and_comes_back(tmp_path: Path, mode: str) -> None:
    pixels = np.dstack([PIXELS, np.array([[255, 0], [128, 255]], np.uint8)])
    gltf = textured(png(pixels if mode == "MASK" else PIXELS), alphaMode=mode)
    gltf.json["samplers"] = [{"wrapS": 33071}]
    gltf.json["textures"][0]["sampler"] = 0
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    write_model(rig, np.zeros(rig.shape_count), tmp_path / "again.glb")
    again = open_rig(tmp_path / "again.glb")
    np.testing.assert_array_equal(texture(again).pixels, texture(rig).pixels)
    assert texture(again).repeats == texture(rig).repeats == (False, True)
    np.testing.assert_array_equal(again.texture_places, rig.texture_places)
    assert again.parts[0].cutout == rig.parts[0].cutout
    assert again.parts[0].colour == pytest.approx(rig.parts[0].colour, abs=1e-6)
    assert again.warnings == ()


def test_real_textures_are_written_once_each(shared: Path, tmp_path: Path) -> None:
    (source,) = (shared / "models/khronos_morph_samples/MorphStressTest").rglob("*.gltf")
    rig = open_rig(source)
    write_model(rig, np.zeros(rig.shape_count), tmp_path / "again.glb")
    again = open_rig(tmp_path / "again.glb")
    for part, copy in zip(rig.parts, again.parts, strict=True):
        assert part.texture is not None and copy.texture is not None
        np.testing.assert_array_equal(copy.texture.pixels, part.texture.pixels)
    count = len({part.texture for part in rig.parts})
    assert (tmp_path / "again.glb").read_bytes().count(b"image/png") == count


GLASS = {"KHR_materials_transmission": {"transmissionFactor": 0.75}}


@pytest.mark.parametrize(
    ("material", "alpha", "found"),
    [
        ({}, 0.0, (1.0, False, None)),
        ({"alphaMode": "BLEND"}, 0.0, (0.0, True, 0.5)),
        ({"alphaMode": "BLEND"}, 0.4, (0.4, True, 0.5)),
        ({"alphaMode": "MASK", "alphaCutoff": 0.3}, 0.4, (0.4, False, 0.3)),
    ],
)
@pytest.mark.parametrize("with_picture", [True, False])
def test_what_a_material_says_of_alpha_is_kept_and_comes_back(
    tmp_path: Path, material: dict, alpha: float, found: tuple, with_picture: bool
) -> None:
    opacity, blends, cutout = found
    gltf = textured(png(), doubleSided=True, extensions=GLASS, **material)
    shine = gltf.json["materials"][0]["pbrMetallicRoughness"]
    shine["baseColorFactor"] = [1, 0.5, 0.5, alpha]
    if not with_picture:
        del shine["baseColorTexture"]
        opacity, cutout = (1.0 if cutout == 0.3 else opacity), None
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    write_model(rig, np.zeros(2), tmp_path / "again.glb")
    for part in rig.parts + open_rig(tmp_path / "again.glb").parts:
        assert (part.opacity, part.blends, part.cutout) == (pytest.approx(opacity), blends, cutout)
        assert (part.double_sided, part.transmission) == (True, 0.75)


def test_a_surface_without_picture_that_is_cut_away_is_not_there(tmp_path: Path) -> None:
    gltf = face_gltf()
    gltf.json["meshes"][0]["primitives"][0]["material"] = 0
    shine = {"baseColorFactor": [1, 1, 1, 0.2]}
    gltf.json["materials"] = [{"alphaMode": "MASK", "pbrMetallicRoughness": shine}]
    (part,) = open_rig(gltf.save(tmp_path / "face.glb")).parts
    assert (part.opacity, part.cutout, part.double_sided) == (0.0, None, False)


def webp(gltf: Gltf, content: bytes) -> None:
    """Name a picture by EXT_texture_webp beside what the texture has."""
    gltf.json["images"].append({"bufferView": gltf.view(content), "mimeType": "image/webp"})
    gltf.json["textures"][0]["extensions"] = {"EXT_texture_webp": {"source": 1}}


@pytest.mark.parametrize("plain", ["none", "broken", "whole"])
def test_webp_instead_of_a_plain_picture_or_beside_it(tmp_path: Path, plain: str) -> None:
    large = np.repeat(np.repeat(PIXELS, 8, axis=0), 8, axis=1)
    gltf = textured(png() if plain == "whole" else b"no picture")
    webp(gltf, png(large, "WEBP"))
    if plain == "none":
        del gltf.json["textures"][0]["source"]
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    assert texture(rig).pixels.shape == ((2, 2, 4) if plain == "whole" else (16, 16, 4))
    np.testing.assert_allclose(texture(rig).pixels[0, 0], [255, 0, 0, 255], atol=6)
    assert rig.warnings == ()


def test_where_no_picture_of_a_texture_can_be_read_one_line_says_so(tmp_path: Path) -> None:
    gltf = textured(b"no picture")
    webp(gltf, b"nor this")
    left_out(open_rig(gltf.save(tmp_path / "face.glb")), "images[1]")
    del gltf.json["textures"][0]["source"], gltf.json["textures"][0]["extensions"]
    left_out(open_rig(gltf.save(tmp_path / "face.glb")), "textures[0].source")


def test_the_diffuse_colour_of_specular_glossiness_is_the_base_colour(tmp_path: Path) -> None:
    gltf = textured(png())
    older = {"diffuseTexture": {"index": 0}, "diffuseFactor": [1.0, 0.0, 1.0, 0.5], "glossinessFactor": 0.25}
    gltf.json["materials"] = [
        {"alphaMode": "BLEND", "extensions": {"KHR_materials_pbrSpecularGlossiness": older}}
    ]
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    np.testing.assert_array_equal(texture(rig).pixels[..., :3], PIXELS)
    (part,) = rig.parts
    assert (part.colour, part.roughness, part.opacity) == ((1.0, 0.0, 1.0), 0.75, 0.5)


def test_a_second_set_of_coordinates(tmp_path: Path) -> None:
    gltf = textured(png())
    (primitive,) = gltf.json["meshes"][0]["primitives"]
    primitive["attributes"]["TEXCOORD_1"] = gltf.accessor(1 - PLACES)
    gltf.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    np.testing.assert_array_equal(rig.texture_places, 1 - PLACES)


def test_a_picture_that_many_name_is_decoded_and_kept_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(gltf_textures, "MOST_PIXELS", 4)  # as many as it has
    gltf = textured(png())
    address = gltf.json["images"][0]
    (tmp_path / "skin.png").write_bytes(png())
    copy = {"bufferView": gltf.view(png())}
    gltf.json["images"] = [address, address, copy, {"uri": "skin.png"}, {"uri": "./skin.png"}]
    gltf.json["textures"] = [{"source": at % 5} for at in range(20)]
    gltf.json["materials"] = [
        {"pbrMetallicRoughness": {"baseColorTexture": {"index": at}}} for at in range(20)
    ]
    (primitive,) = gltf.json["meshes"][0]["primitives"]
    gltf.json["meshes"][0]["primitives"] = [primitive | {"material": at} for at in range(20)]
    rig = open_rig(gltf.save(tmp_path / "face.glb"))
    assert rig.warnings == ()
    assert len({part.texture for part in rig.parts}) == 1
    assert rig.vertex_count == 4


@pytest.mark.parametrize("size", [8, 40])
@pytest.mark.parametrize("mode", ["I;16", "L", "LA", "P", "1", "RGBA"])
def test_pictures_of_every_kind_keep_their_brightness(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, mode: str, size: int
) -> None:
    monkeypatch.setattr(gltf_images, "KEPT", 16)
    monkeypatch.setattr(gltf_images, "STRIP", 100)
    if mode == "I;16":
        picture = Image.fromarray(np.full((size, size), 0x4080, np.uint16))
    else:
        picture = Image.new("L", (size, size), 255 if mode == "1" else 0x40).convert(mode)
    file = io.BytesIO()
    picture.save(file, "PNG")
    pixels = texture(open_rig(textured(file.getvalue()).save(tmp_path / "face.glb"))).pixels
    assert pixels.shape == (min(size, 14), min(size, 14), 4)
    assert (pixels == (*[255 if mode == "1" else 0x40] * 3, 255)).all()
