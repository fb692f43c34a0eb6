"""What is drawn over faces can be told apart by people who see fewer colours, on light and on dark skin."""

from itertools import combinations

import moderngl
import numpy as np
import pytest

from facepin.core.look.camera import Viewport, frame_points
from facepin.core.look.heat import BEYOND, STOPS, heat_colours, hex_colours, oklab
from facepin.core.mesh.normals import NormalField
from facepin.core.mesh.picking import pick
from facepin.files import open_rig
from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import frame
from facepin.gpu.markers import STYLES, MarkerLayer, Markers, MarkerState
from facepin.gpu.materials import linear
from facepin.gpu.pane import Overlays, draw_pane
from facepin.gpu.scene import PaneMesh, Scene
from facepin.resources import resource

# Machado, Oliveira and Fernandes 2009, severity 1, on linear light.
VISIONS = {
    "all colours": np.eye(3),
    "no long waves (protanopia)": np.array(
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ]
    ),
    "no middle waves (deuteranopia)": np.array(
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ]
    ),
    "no short waves (tritanopia)": np.array(
        [
            [1.255528, -0.076749, -0.178779],
            [-0.078411, 0.930809, 0.147602],
            [0.004733, 0.691367, 0.303900],
        ]
    ),
    "none": np.tile([0.2126, 0.7152, 0.0722], (3, 1)),
}
SEEN_APART = 0.10
"""Distance in OKLab at which patches are told apart at a glance; neighbours in a scale need less."""


def seen(vision: str, srgb: np.ndarray) -> np.ndarray:
    """OKLab (m, 3) of colours as somebody sees them."""
    light = np.clip(linear(np.atleast_2d(srgb)).astype(float) @ VISIONS[vision].T, 0, 1)
    encoded = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    return oklab(encoded)


def apart(vision: str, one: np.ndarray, other: np.ndarray) -> np.ndarray:
    return np.linalg.norm(seen(vision, one) - seen(vision, other), axis=-1)


@pytest.mark.parametrize("vision", VISIONS)
def test_the_heat_map_can_be_read(vision: str) -> None:
    lab = seen(vision, heat_colours(9))
    steps = np.linalg.norm(np.diff(lab, axis=0), axis=1)
    assert steps.min() > 0.02, "every eighth of the scale is another colour than the one before"
    lightness = lab[:, 0]
    # Ever lighter, whoever looks: the map can be read without any colour.
    assert (np.diff(lightness) > 0.005).all()
    assert lightness[-1] - lightness[0] > 0.35
    assert apart(vision, heat_colours(2)[1], hex_colours((BEYOND,)))[0] > 0.05, "the top, and beyond it"
    for low, high in combinations(hex_colours(STOPS)[::3], 2):
        assert apart(vision, low, high)[0] > SEEN_APART


@pytest.mark.parametrize("vision", VISIONS)
def test_pins_are_told_apart_by_their_state(vision: str) -> None:
    normal, selected = (
        np.array(STYLES[state].colour) for state in (MarkerState.NORMAL, MarkerState.SELECTED)
    )
    assert apart(vision, normal, selected)[0] > SEEN_APART
    # Held and selected have one colour, hovered and normal another: a halo and a size make the difference.
    for one, other in combinations(STYLES.values(), 2):
        looks = {(style.colour == one.colour, style.halo > 0, style.radius) for style in (one, other)}
        assert len(looks) == 2


@pytest.mark.parametrize("face", ["ada", "mira"])
@pytest.mark.parametrize("heat", [False, True])
def test_pins_and_goal_lines_are_seen_on_light_and_dark_skin(
    gl: moderngl.Context, face: str, heat: bool
) -> None:
    rig = open_rig(resource("assets", f"faces/{face}.npz"))
    camera, view = frame_points(rig.neutral, 1.0).zoomed(1.7), Viewport(0, 0, 240, 240)
    skin = next(part for part in rig.parts if part.name == "skin").triangles
    on_skin = set(rig.triangles[skin.start : skin.stop].ravel().tolist())
    hits = [
        pick(rig.neutral, rig.triangles, camera, view, (x, y))
        for x in range(60, 200, 40)
        for y in range(60, 200, 40)
    ]
    pins = rig.neutral[[hit.vertex for hit in hits if hit and hit.vertex in on_skin]]
    goals = pins + rig.height * np.float32([0.06, 0.05, 0.1])  # in front of the face
    scene, canvas, layer = Scene(gl, rig), Canvas(gl, 4), MarkerLayer(gl)
    mesh = PaneMesh(scene)
    mesh.upload(rig.neutral, NormalField(rig).normals(rig.neutral))
    canvas.resize(240, 240)
    move = np.linspace(0, 1.2, rig.vertex_count).astype(np.float32)

    def picture(state: MarkerState | None) -> np.ndarray:
        scene.background.draw(canvas, [(view, camera)])
        draw_pane(canvas, frame(camera, view), mesh, Overlays(move if heat else None), fine=True)
        if state is not None:
            layer.draw(canvas, view, camera, Markers(pins, goals, np.full(len(pins), state, np.uint8)))
        return canvas.read()[..., :3] / 255

    bare, marked = picture(None), [picture(state) for state in (MarkerState.NORMAL, MarkerState.SELECTED)]
    for item in (layer, canvas, mesh, scene):
        item.release()
    ends = camera.project(pins, view)[:, :2], camera.project(goals, view)[:, :2]
    places = np.concatenate([ends[0], (ends[0] + ends[1]) / 2, ends[1]])
    patches = [(slice(int(y) - 7, int(y) + 8), slice(int(x) - 7, int(x) + 8)) for x, y in places.tolist()]
    assert len(patches) >= 30
    for vision in VISIONS:
        before, *after = (
            seen(vision, np.concatenate([image[patch].reshape(-1, 3) for patch in patches]))
            for image in (bare, *marked)
        )
        for lab in after:
            change = np.linalg.norm(lab - before, axis=1).reshape(len(patches), -1)
            assert np.sort(change, axis=1)[:, -12].min() > 1.5 * SEEN_APART, "twelve pixels of each"
