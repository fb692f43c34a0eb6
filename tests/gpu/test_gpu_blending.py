"""What is behind shows through what is clear, from wherever it is seen."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import moderngl
import numpy as np
import pytest

from facepin.core.arrays import Points
from facepin.core.look.shading import Shading
from facepin.core.mesh.normals import NormalField
from facepin.core.rig import Rig, Texture
from facepin.core.rig_builder import PartLook, build_rig
from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import frame
from facepin.gpu.scene import PaneMesh, Scene
from facepin.gpu.still import StillLayer
from support.gpu_help import SIZE, WHOLE, camera

MIDDLE = SIZE // 2
RED, BLUE, GREEN = (0.9, 0.1, 0.1), (0.1, 0.1, 0.9), (0.1, 0.9, 0.1)


def cards(*looks: dict) -> Rig:
    """Squares one before the other, the last one nearest; the whole moves with its one shape."""
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    points = np.concatenate([square + np.array([0, 0, 0.2 * at]) for at in range(len(looks))])
    rig = build_rig(
        "cards",
        points,
        np.arange(len(points)),
        np.full(len(looks), 4),
        [("move", np.ones_like(points))],
        parts=[PartLook(f"card {at}") for at in range(len(looks))],
        face_parts=np.arange(len(looks)),
        texture_places=np.tile([[0, 1], [1, 1], [1, 0], [0, 0]], (len(looks), 1)),
    )
    return replace(rig, parts=tuple(replace(p, **look) for p, look in zip(rig.parts, looks, strict=True)))


@contextmanager
def shown(gl: moderngl.Context, rig: Rig) -> Iterator[tuple[PaneMesh, Canvas]]:
    scene, canvas = Scene(gl, rig), Canvas(gl, 0)
    mesh = PaneMesh(scene)
    canvas.resize(SIZE, SIZE)
    mesh.upload(rig.neutral, normals(rig))
    try:
        yield mesh, canvas
    finally:
        canvas.release()
        mesh.release()
        scene.release()


def normals(rig: Rig) -> Points:
    return NormalField(rig).normals(rig.neutral)


def seen(
    gl: moderngl.Context,
    rig: Rig,
    shading: Shading = "studio",
    *,
    back: bool = False,
    hidden: tuple[str, ...] = (),
) -> np.ndarray:
    """The picture before black, (h, w, 4)."""
    view = camera(rig).looking("back") if back else camera(rig)
    with shown(gl, rig) as (mesh, canvas):
        mesh.scene.hide(frozenset(hidden))
        canvas.clear()
        mesh.draw_framed(canvas, frame(view, WHOLE), fine=True, shading=shading)
        return canvas.read().astype(int)


CLEAR = {"colour": GREEN, "blends": True, "opacity": 0.0}
VEIL = {"colour": GREEN, "blends": True, "opacity": 0.4}


@pytest.mark.parametrize(
    "look", [CLEAR, {"colour": GREEN, "opacity": 0.0}, {"colour": GREEN, "transmission": 1.0}]
)
def test_what_is_clear_is_not_there(gl: moderngl.Context, look: dict) -> None:
    with_shell, without = seen(gl, cards({"colour": RED}, look)), seen(gl, cards({"colour": RED}))
    middle = with_shell[MIDDLE, MIDDLE]
    assert middle[0] > middle[1] + 60
    assert np.abs(middle - without[MIDDLE, MIDDLE]).max() < 20
    alone = seen(gl, cards(look, CLEAR))
    assert alone[..., 3].max() == 0


@pytest.mark.parametrize("shading", ["studio", "clay"])
def test_a_veil_lets_be_seen_what_is_behind_it(gl: moderngl.Context, shading: Shading) -> None:
    bare, veiled = (seen(gl, cards({"colour": RED}, look), shading) for look in (CLEAR, VEIL))
    if shading == "studio":
        assert veiled[MIDDLE, MIDDLE, 0] > 40
        assert veiled[MIDDLE, MIDDLE, 1] > bare[MIDDLE, MIDDLE, 1] + 20
    assert veiled[MIDDLE, MIDDLE, 3] == 255
    alone = seen(gl, cards(VEIL, CLEAR), shading)
    assert 0.3 * 255 < alone[MIDDLE, MIDDLE, 3] < 0.5 * 255


def test_veils_are_drawn_farthest_first_from_both_sides(gl: moderngl.Context) -> None:
    half = {"blends": True, "opacity": 0.8}
    rig = cards({"colour": BLUE, **half}, {"colour": RED, **half})
    front, back = seen(gl, rig), seen(gl, rig, back=True)
    assert front[MIDDLE, MIDDLE, 0] > front[MIDDLE, MIDDLE, 2], "red is before blue"
    assert back[MIDDLE, MIDDLE, 2] > back[MIDDLE, MIDDLE, 0], "blue is before red"


def test_a_texture_fades_and_its_solid_part_hides(gl: moderngl.Context) -> None:
    fade = np.full((1, 64, 4), 255, np.uint8)
    fade[0, :, 3] = np.linspace(0, 255, 64)
    card = {"texture": Texture(fade, (False, False)), "colour": GREEN, "blends": True}
    row = seen(gl, cards({"colour": RED}, card))[MIDDLE]
    inner = row[SIZE // 5 : -SIZE // 5]
    assert inner[0, 0] > inner[0, 1] + 40, "red shows through where it is clear"
    assert row[-SIZE // 8, 1] > row[-SIZE // 8, 0] + 40, "green hides where it is solid"
    assert np.abs(np.diff(inner[:, 0])).max() < 12, "and there is no edge between"


def test_veils_stay_over_what_moves_and_what_is_still(gl: moderngl.Context) -> None:
    rig = cards({"colour": RED}, VEIL)
    view = camera(rig)
    with shown(gl, rig) as (mesh, canvas):
        still = StillLayer(mesh.scene)
        for step in range(3):
            positions = rig.neutral.copy()
            positions[:2, 0] += 0.02 * step  # a corner of the red card
            mesh.upload(positions, normals(rig))
            still.draw(canvas, [(WHOLE, view)], [(mesh, "studio")])
            mesh.draw_framed(canvas, frame(view, WHOLE), fine=False, part="moving")
            middle = canvas.read()[MIDDLE, MIDDLE].astype(int)
            assert middle[0] > 40
            assert middle[1] > 40
        still.release()


def test_hidden_parts_are_not_drawn(gl: moderngl.Context) -> None:
    rig = cards({"colour": RED}, {"colour": GREEN})
    assert seen(gl, rig)[MIDDLE, MIDDLE, 1] > 60
    without = seen(gl, rig, hidden=("card 1",))[MIDDLE, MIDDLE]
    assert without[0] > without[1] + 60
    assert seen(gl, rig, hidden=("card 0", "card 1")).max() == 0
