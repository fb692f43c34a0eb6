"""A picture made of what is kept and what moves is that of the whole face, from every side, in every pose."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import moderngl
import numpy as np
import pytest

from facepin.core.look.camera import Camera, Viewport, frame_points
from facepin.core.mesh.normals import NormalField
from facepin.core.rig import Rig
from facepin.files import open_rig
from facepin.gpu import scene
from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import frame
from facepin.gpu.scene import PaneMesh, Scene
from facepin.gpu.still import StillLayer
from facepin.resources import resource

SIZE = (240, 180)
VIEW = Viewport(0, 0, *SIZE)
VIEWS: dict[str, Callable[[Camera], Camera]] = {
    "front": lambda camera: camera,
    "side": lambda camera: camera.orbited(1.3, 0.1),
    "mouth": lambda camera: camera.orbited(-0.4, 0.2).zoomed(3.0),
}


class Drag:
    """Draws the poses of a rig, once in parts and once as a whole."""

    def __init__(self, ctx: moderngl.Context, rig: Rig, panes: int = 1) -> None:
        self.rig = rig
        self.scene = Scene(ctx, rig)
        self.meshes = [PaneMesh(self.scene) for _ in range(panes)]
        self.still = StillLayer(self.scene)
        self.canvas = Canvas(ctx, 0)
        self.canvas.resize(*SIZE)
        self._normals = NormalField(rig)

    def pose(self, mesh: PaneMesh, **weights: float) -> None:
        positions = self.rig.evaluate(np.array([weights.get(name, 0.0) for name in self.rig.shape_names]))
        mesh.upload(positions, self._normals.normals(positions))

    def draw(self, *sights: tuple[Viewport, Camera]) -> np.ndarray:
        self.still.draw(self.canvas, sights, [(mesh, "studio") for mesh in self.meshes])
        for mesh, (viewport, camera) in zip(self.meshes, sights, strict=True):
            framing = frame(camera, viewport)
            mesh.draw_framed(self.canvas, framing, fine=False, part="moving")
        return self.canvas.read().astype(int)

    def whole(self, *sights: tuple[Viewport, Camera], fine: bool = False) -> np.ndarray:
        self.scene.background.draw(self.canvas, sights)
        for mesh, (viewport, camera) in zip(self.meshes, sights, strict=True):
            mesh.draw(self.canvas, viewport, camera, fine=fine)
        return self.canvas.read().astype(int)

    def release(self) -> None:
        for item in (self.still, *self.meshes, self.scene, self.canvas):
            item.release()


@contextmanager
def dragging(ctx: moderngl.Context, rig: Rig, panes: int = 1) -> Iterator[Drag]:
    drag = Drag(ctx, rig, panes)
    try:
        yield drag
    finally:
        drag.release()


def same(parts: np.ndarray, whole: np.ndarray) -> None:
    """Edges may be elsewhere by a share of a pixel; nothing is missing."""
    differing = np.abs(parts - whole).max(axis=2) > 12
    assert np.count_nonzero(differing) <= 12


@pytest.fixture(scope="module")
def ada() -> Rig:
    return open_rig(resource("assets", "faces/ada.npz"))


@pytest.mark.parametrize("view", VIEWS)
def test_parts_make_the_whole(gl: moderngl.Context, ada: Rig, view: str) -> None:
    sight = VIEW, VIEWS[view](frame_points(ada.neutral, SIZE[0] / SIZE[1]))
    poses = [{}, {"mouthSmileLeft": 0.1}, {"mouthSmileLeft": 1.0}, {"mouthSmileLeft": 0.4}, {}]
    poses += [{"eyeBlinkLeft": 0.3}, {"eyeBlinkLeft": 1.0, "mouthSmileLeft": 0.2}]
    with dragging(gl, ada) as drag:
        for pose in poses:
            drag.pose(drag.meshes[0], **pose)
            parts = drag.draw(sight)
            same(parts, drag.whole(sight))
        assert drag.meshes[0].motion.still, "less than the whole was drawn"


def test_a_wide_open_mouth_after_one_frame_has_no_holes(gl: moderngl.Context, ada: Rig) -> None:
    for turn in VIEWS.values():
        sight = VIEW, turn(frame_points(ada.neutral, SIZE[0] / SIZE[1]))
        with dragging(gl, ada) as drag:
            for weight in (0.0, 1.0, 0.0, 0.5):
                drag.pose(drag.meshes[0], jawOpen=weight)
                parts = drag.draw(sight)
                same(parts, drag.whole(sight))


def test_another_view_begins_anew(gl: moderngl.Context, ada: Rig) -> None:
    camera = frame_points(ada.neutral, SIZE[0] / SIZE[1])
    with dragging(gl, ada) as drag:
        mesh = drag.meshes[0]
        for step in range(3):
            drag.pose(mesh, browInnerUp=0.2 * step)
            drag.draw((VIEW, camera))
        assert mesh.motion.still
        sight = VIEW, camera.orbited(0.3, 0.0)
        np.testing.assert_array_equal(drag.draw(sight), drag.whole(sight))
        assert not mesh.motion.still


def test_the_resting_picture_is_not_changed_by_a_drag_before(gl: moderngl.Context, ada: Rig) -> None:
    sight = VIEW, frame_points(ada.neutral, SIZE[0] / SIZE[1])
    with dragging(gl, ada) as drag:
        drag.pose(drag.meshes[0], eyeBlinkLeft=0.5)
        expected = drag.whole(sight, fine=True)
    with dragging(gl, ada) as drag:
        for weight in (0.0, 0.1, 0.3, 0.5):
            drag.pose(drag.meshes[0], eyeBlinkLeft=weight)
            drag.draw(sight)
        assert drag.meshes[0].motion.still
        np.testing.assert_array_equal(drag.whole(sight, fine=True), expected)


def test_every_pane_has_its_own_still_parts(gl: moderngl.Context, ada: Rig) -> None:
    half = SIZE[0] / 2
    camera = frame_points(ada.neutral, half / SIZE[1])
    sights = [(Viewport(0, 0, half, SIZE[1]), camera), (Viewport(half, 0, half, SIZE[1]), camera)]
    with dragging(gl, ada, panes=2) as drag:
        left, right = drag.meshes
        for step in range(4):
            drag.pose(left, browInnerUp=0.3 * step)
            drag.pose(right, mouthSmileLeft=0.3 * step)
            same(drag.draw(*sights), drag.whole(*sights))
        assert left.motion.still
        assert right.motion.still
        assert left.motion.still != right.motion.still


def test_batches_make_the_same_picture(
    gl: moderngl.Context, ada: Rig, monkeypatch: pytest.MonkeyPatch
) -> None:
    sight = VIEW, frame_points(ada.neutral, SIZE[0] / SIZE[1])
    pictures = []
    for batch in (10**9, 300):
        monkeypatch.setattr(scene, "BATCH", batch)
        with dragging(gl, ada) as drag:
            for weight in (0.0, 0.3, 0.6):
                drag.pose(drag.meshes[0], jawOpen=weight)
                pictures.append(drag.draw(sight))
            assert drag.meshes[0].motion.still
            (run, *_) = drag.meshes[0].motion.moving
            assert [at for batch in run.batches(300) for at in batch] == [
                *range(run.first, run.first + run.count)
            ]
    for one, other in zip(pictures[:3], pictures[3:], strict=True):
        np.testing.assert_array_equal(one, other)


def test_a_pane_where_nearly_all_moves_leaves_nothing_behind(gl: moderngl.Context, ada: Rig) -> None:
    half = SIZE[0] / 2
    camera = frame_points(ada.neutral, half / SIZE[1])
    sights = [(Viewport(0, 0, half, SIZE[1]), camera), (Viewport(half, 0, half, SIZE[1]), camera)]
    with dragging(gl, ada, panes=2) as drag:
        left, right = drag.meshes
        normals = NormalField(ada)
        for step in range(5):
            drag.pose(left, browInnerUp=0.2 * step)
            moved = ada.neutral + np.float32((0.0, 0.06 * step * ada.height, 0.0))
            right.upload(moved, normals.normals(moved))
            same(drag.draw(*sights), drag.whole(*sights))
        assert left.motion.still
        assert not right.motion.still


def test_shading_that_was_refined_meanwhile_is_shown(gl: moderngl.Context, ada: Rig) -> None:
    sight = VIEW, frame_points(ada.neutral, SIZE[0] / SIZE[1])
    with dragging(gl, ada) as drag:
        for step in range(3):
            drag.pose(drag.meshes[0], browInnerUp=0.2 * step)
            drag.draw(sight)
        while not drag.scene.refined:
            drag.scene.refine()
        drag.pose(drag.meshes[0], browInnerUp=0.5)
        same(drag.draw(sight), drag.whole(sight))


@pytest.mark.parametrize("view", VIEWS)
def test_a_real_head_is_whole_too(gl: moderngl.Context, shared: Path, view: str) -> None:
    rig = open_rig(shared / "models" / "ict-facekit" / "ict_expressions.glb")
    sight = VIEW, VIEWS[view](frame_points(rig.neutral, SIZE[0] / SIZE[1]))
    with dragging(gl, rig) as drag:
        poses = [{}, {"eyeBlink_L": 0.2}, {"eyeBlink_L": 1.0}, {"jawOpen": 1.0}, {"jawOpen": 0.3}]
        for pose in poses:
            drag.pose(drag.meshes[0], **pose)
            same(drag.draw(sight), drag.whole(sight))
            if "eyeBlink_L" in pose:
                assert drag.meshes[0].motion.still
