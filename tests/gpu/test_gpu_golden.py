"""Pictures that people have looked at and liked; `pytest --regenerate` stores them anew."""

from pathlib import Path

import moderngl
import numpy as np
import pytest
from PIL import Image

from facepin.core.look.camera import Camera, Viewport, frame_points
from facepin.core.look.heat import heat_scale
from facepin.core.look.shading import MODES
from facepin.core.mesh.normals import NormalField
from facepin.core.mesh.picking import pick
from facepin.core.rig import Rig
from facepin.core.shapes.measures import moves
from facepin.files import open_rig
from facepin.gpu.canvas import Canvas
from facepin.gpu.markers import MarkerLayer, Markers
from facepin.gpu.pane import Overlays
from facepin.gpu.picture import draw_picture, png_bytes, render_picture
from facepin.gpu.scene import PaneMesh, Scene
from facepin.resources import resource

GOLDEN = Path(__file__).parent / "golden"
SIZE = 256


@pytest.fixture(scope="module")
def ada() -> Rig:
    return open_rig(resource("assets", "faces/ada.npz"))


def check(name: str, image: np.ndarray, gl: moderngl.Context, request: pytest.FixtureRequest) -> None:
    """Compare with the stored picture, on the software renderer only: others round differently."""
    path = GOLDEN / f"{name}.png"
    if request.config.getoption("--regenerate"):
        GOLDEN.mkdir(exist_ok=True)
        path.write_bytes(png_bytes(image))
    if not gl.info["GL_RENDERER"].startswith("llvmpipe"):
        pytest.skip(f"golden pictures are compared on llvmpipe, this is {gl.info['GL_RENDERER']}")
    golden = np.asarray(Image.open(path).convert("RGB")).astype(int)
    difference = np.abs(image[..., :3].astype(int) - golden)
    if difference.mean() > 0.5 or np.mean(difference.max(axis=2) > 16) > 0.01:
        folder = request.getfixturevalue("tmp_path")
        beside = np.concatenate([golden, image[..., :3], np.minimum(8 * difference, 255)], axis=1)
        (folder / f"{name}.png").write_bytes(png_bytes(beside.astype(np.uint8)))
        pytest.fail(f"{name} looks different (golden, now, difference x8): {folder / name}.png")


def test_front(gl: moderngl.Context, ada: Rig, request: pytest.FixtureRequest) -> None:
    camera = frame_points(ada.neutral, 1.0)
    normals = NormalField(ada).normals(ada.neutral)
    check("front", render_picture(gl, ada, ada.neutral, normals, camera, (SIZE, SIZE)), gl, request)


def test_smile_with_pins(gl: moderngl.Context, ada: Rig, request: pytest.FixtureRequest) -> None:
    smile = ("mouthSmileLeft", "mouthSmileRight", "jawOpen")
    positions = ada.evaluate(np.array([0.6 * (name in smile) for name in ada.shape_names]))
    camera = frame_points(ada.neutral, 1.0, Camera(radius=0.0).looking("three-quarter")).zoomed(1.6)
    scene, canvas, layer = Scene(gl, ada), Canvas(gl, 4), MarkerLayer(gl)
    mesh = PaneMesh(scene)
    mesh.upload(positions, NormalField(ada).normals(positions))
    canvas.resize(SIZE, SIZE)
    view = Viewport(0, 0, SIZE, SIZE)
    scene.background.draw(canvas, [(view, camera)])
    mesh.draw(canvas, view, camera)
    # Mouth corner, brow, chin on its goal, and an ear that the head hides.
    hits = [
        pick(positions, ada.triangles, camera, view, pixel) for pixel in ((90, 176), (110, 58), (80, 212))
    ]
    far_ear = int(ada.triangles[next(part for part in ada.parts if part.name == "earR").triangles.start, 0])
    vertices = [hit.vertex for hit in hits if hit] + [far_ear]
    goals = positions[vertices] + np.float32([(2, 1, 0), (0, 1.5, 0), (0, 0, 0), (1, 2, 0)])
    layer.draw(canvas, view, camera, Markers(positions[vertices], goals, np.uint8([3, 0, 2, 1])))
    image = canvas.read().copy()
    for item in (layer, canvas, mesh, scene):
        item.release()
    check("smile", image, gl, request)


def test_modes_and_ghost(gl: moderngl.Context, ada: Rig, request: pytest.FixtureRequest) -> None:
    shapes = {"jawOpen": 0.7, "mouthLeft": 0.8, "browInnerUp": 0.8}
    positions = ada.evaluate(np.array([shapes.get(name, 0.0) for name in ada.shape_names]))
    camera = frame_points(ada.neutral, 1.0, Camera(radius=0.0).looking("three-quarter")).zoomed(1.6)
    scene = Scene(gl, ada)
    while not scene.refined:
        scene.refine()
    face, neutral = PaneMesh(scene), PaneMesh(scene)
    for mesh, pose in ((face, positions), (neutral, ada.neutral)):
        mesh.upload(pose, NormalField(ada).normals(pose))
    heat = (moves(positions, ada.neutral) / heat_scale(ada.height).top).astype(np.float32)
    looks = {
        name: Overlays(heat if mode.shading == "heat" else None, mode.wireframe, shading=mode.shading)
        for name, mode in MODES.items()
    }
    looks |= {"ghost": Overlays(ghost=neutral), "edges": Overlays(wireframe=True)}
    pictures = {name: draw_picture(face, camera, (SIZE, SIZE), overlays=look) for name, look in looks.items()}
    for item in (neutral, face, scene):
        item.release()
    for name, image in pictures.items():
        check(name, image, gl, request)
