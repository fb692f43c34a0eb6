"""Pins are where the camera says, seen through the face, and as large as asked for."""

from dataclasses import replace

import moderngl
import numpy as np
import pytest
from numpy.typing import ArrayLike

from facepin.core.look.camera import Camera, Viewport, frame_points
from facepin.core.mesh.normals import NormalField
from facepin.core.pose import Pin, Pose
from facepin.files import open_rig
from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import frame
from facepin.gpu.markers import STYLES, MarkerLayer, Markers, MarkerState, marker_size, pin_markers
from facepin.gpu.pane import Overlays, draw_pane
from facepin.gpu.scene import PaneMesh, Scene
from facepin.resources import resource
from support.gpu_help import WHOLE, ball, camera, draw, drawn

FRONT, BACK = (0.3, 0.2, 0.92), (0.3, 0.2, -0.92)


def markers(positions: ArrayLike, goals: ArrayLike | None = None, states: ArrayLike | None = None) -> Markers:
    positions = np.asarray(positions, np.float32).reshape(-1, 3)
    goals = positions if goals is None else np.asarray(goals, np.float32).reshape(-1, 3)
    return Markers(positions, goals, np.asarray([0] * len(positions) if states is None else states, np.uint8))


def change(gl: moderngl.Context, pins: Markers, scale: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """Picture with pins, and how far each pixel is from the picture without."""
    rig = ball()
    layer = MarkerLayer(gl)
    with drawn(gl, rig, rig.neutral) as (mesh, canvas):
        before = draw(mesh, canvas, camera(rig)).astype(int)
        layer.draw(canvas, WHOLE, camera(rig), pins, scale=scale)
        after = canvas.read().astype(int)
    layer.release()
    assert (after[..., 3] == 255).all()
    return after, np.abs(after - before).max(axis=2)


def pixel_of(point: ArrayLike) -> tuple[float, float]:
    x, y, _ = camera(ball()).project(point, WHOLE)[0]
    return x, y


def middle(changed: np.ndarray) -> np.ndarray:
    y, x = np.nonzero(changed > 8)
    return np.array([x.mean() + 0.5, y.mean() + 0.5])


@pytest.mark.parametrize("point", [FRONT, (0, 0, 1), (-0.5, -0.6, 0.62)])
def test_a_marker_is_where_its_vertex_is_seen(
    gl: moderngl.Context, point: tuple[float, float, float]
) -> None:
    picture, changed = change(gl, markers(point))
    np.testing.assert_allclose(middle(changed), pixel_of(point), atol=0.6)
    x, y = pixel_of(point)
    ring = picture[int(y), int(x + 0.7 * STYLES[MarkerState.NORMAL].radius)]
    np.testing.assert_allclose(ring[:3] / 255, STYLES[MarkerState.NORMAL].colour, atol=0.02)


def test_size_is_in_points(gl: moderngl.Context) -> None:
    small = (change(gl, markers(FRONT))[1] > 60).sum()
    large = (change(gl, markers(FRONT), scale=2.0)[1] > 60).sum()
    assert 3.3 < large / small < 4.7


def test_states_look_different(gl: moderngl.Context) -> None:
    x, y = pixel_of(FRONT)
    seen = {tuple(change(gl, markers(FRONT, states=[s]))[0][int(y), int(x) + 4]) for s in MarkerState}
    assert len(seen) >= 3
    areas = [(change(gl, markers(FRONT, states=[s]))[1] > 8).sum() for s in MarkerState]
    assert areas[MarkerState.HELD] > areas[MarkerState.SELECTED] > areas[MarkerState.NORMAL]


def test_a_locked_pin_is_a_square_in_every_state(gl: moderngl.Context) -> None:
    x, y = (round(c) for c in pixel_of(FRONT))
    for state in MarkerState:
        disc = change(gl, markers(FRONT, states=[state]), scale=4.0)[0]
        square = change(gl, replace(markers(FRONT, states=[state]), locked=np.array([True])), scale=4.0)[0]
        reach = int(4 * 0.85 * STYLES[state].radius / 2**0.5)
        colour = np.array(STYLES[state].colour) * 255
        # The same along the axes, but out to the corners.
        for picture in (disc, square):
            np.testing.assert_allclose(picture[y, x + reach, :3], colour, atol=6)
        corner = int(4 * 0.76 * STYLES[state].radius)
        np.testing.assert_allclose(square[y + corner, x + corner, :3], colour, atol=6)
        assert np.abs(disc[y + corner, x + corner, :3] - colour).max() > 60


def test_a_stiffer_pin_is_larger(gl: moderngl.Context) -> None:
    def area(stiffness: float) -> int:
        sizes = np.array([marker_size(stiffness)])
        return int((change(gl, replace(markers(FRONT), sizes=sizes), scale=4.0)[1] > 60).sum())

    assert marker_size(1.0) == 1.0
    assert area(0.1) < 0.85 * area(1.0)
    assert area(10.0) > 1.2 * area(1.0)
    assert 0.5 < marker_size(1e-6) < marker_size(1e6) < 2


def test_a_hidden_marker_is_dimmed(gl: moderngl.Context) -> None:
    shown, hidden = change(gl, markers(FRONT))[1], change(gl, markers(BACK))[1]
    assert hidden.max() > 15
    assert hidden.max() < 0.6 * shown.max()
    np.testing.assert_allclose(middle(hidden), pixel_of(BACK), atol=0.6)


def test_a_line_leads_to_the_goal(gl: moderngl.Context) -> None:
    goal = (-0.5, 0.5, 0.9)
    _, changed = change(gl, markers(FRONT, goal))
    start, end = np.array(pixel_of(FRONT)), np.array(pixel_of(goal))
    for share in np.linspace(0, 1, 12):
        x, y = (start + share * (end - start)).astype(int)
        assert changed[y - 1 : y + 2, x - 1 : x + 2].max() > 60
    along = (end - start) / np.linalg.norm(end - start)
    y, x = np.nonzero(changed > 60)
    across = (np.stack([x, y], axis=1) + 0.5 - start) @ (-along[1], along[0])
    assert np.abs(across).max() < STYLES[MarkerState.NORMAL].radius + 3


def test_on_its_goal_a_pin_is_a_disc_only(gl: moderngl.Context) -> None:
    alone = change(gl, markers(FRONT))[0]
    np.testing.assert_array_equal(change(gl, markers(FRONT, np.add(FRONT, 1e-5)))[0], alone)


def test_the_held_pin_is_on_top(gl: moderngl.Context) -> None:
    held = change(gl, markers(FRONT, states=[3]))[0]
    for states in ([3, 0], [0, 3]):
        both = change(gl, markers([FRONT, FRONT], states=states))[0]
        x, y = pixel_of(FRONT)
        np.testing.assert_array_equal(both[int(y), int(x) + 4], held[int(y), int(x) + 4])


def test_strange_places_draw_nothing_wrong(gl: moderngl.Context) -> None:
    rig = ball()
    behind = camera(rig).eye * 2
    assert change(gl, markers(behind))[1].max() == 0
    _, changed = change(gl, markers(FRONT, behind))
    x, y = pixel_of(FRONT)
    assert changed[int(y), int(x)] > 60
    assert change(gl, markers(np.zeros((0, 3))))[1].max() == 0


def test_many_markers_need_no_preparation(gl: moderngl.Context) -> None:
    points = np.random.default_rng(1).normal(size=(100, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    _, changed = change(gl, markers(points))
    for x, y, _ in camera(ball()).project(points[points[:, 2] > 0.5], WHOLE):
        assert changed[int(max(y, 2)) - 2 : int(y) + 3, int(max(x, 2)) - 2 : int(x) + 3].max() > 60


def test_depth_can_be_written_again_afterwards(gl: moderngl.Context) -> None:
    rig = ball()
    layer = MarkerLayer(gl)
    with drawn(gl, rig, rig.neutral) as (mesh, canvas):
        expected = draw(mesh, canvas, camera(rig))
        layer.draw(canvas, WHOLE, camera(rig), markers(FRONT))
        np.testing.assert_array_equal(draw(mesh, canvas, camera(rig)), expected)
    layer.release()


def test_pins_behind_a_ghost_look_the_same_in_every_picture(gl: moderngl.Context) -> None:
    rig = open_rig(resource("assets", "faces/ada.npz"))
    scene, layer, canvas = Scene(gl, rig), MarkerLayer(gl), Canvas(gl, 0)
    mesh, shell = PaneMesh(scene), PaneMesh(scene)
    normals = NormalField(rig).normals(rig.neutral)
    moved = rig.evaluate(np.full(rig.shape_count, 0.1))
    mesh.upload(moved, NormalField(rig).normals(moved))
    shell.upload(rig.neutral, normals)
    canvas.resize(600, 320)
    sights = [(Viewport(200 * at, 0, 200, 320), frame_points(rig.neutral, 200 / 320)) for at in range(3)]
    vertices = np.random.default_rng(1).choice(rig.vertex_count, 60, replace=False)
    pins = markers(moved[vertices])
    pictures = []
    for _ in range(4):
        scene.background.draw(canvas, sights)
        for viewport, seen in sights:
            draw_pane(canvas, frame(seen, viewport), mesh, Overlays(ghost=shell), fine=True)
            layer.draw(canvas, viewport, seen, pins)
        pictures.append(canvas.read())
    for item in (layer, mesh, shell, scene, canvas):
        item.release()
    for picture in pictures[1:]:
        np.testing.assert_array_equal(picture, pictures[0])


def test_a_screen_pin_that_is_met_looks_met_from_every_side() -> None:
    turned = Camera(radius=1.0).orbited(0.4, 0.2)
    right, up, back = turned.axes
    axes = tuple(right.tolist()), tuple(up.tolist())
    vertex = np.array([[0.1, 0.2, 0.3]], np.float32)
    goal = tuple((vertex[0] + 0.7 * back).tolist())
    met = Pose(np.zeros(1), (Pin(0, goal, "screen", axes),))
    np.testing.assert_allclose(pin_markers(met, vertex).goals, vertex, atol=1e-6)
    off = Pose(np.zeros(1), (Pin(0, tuple(np.add(goal, 0.2 * right).tolist()), "screen", axes),))
    np.testing.assert_allclose(pin_markers(off, vertex).goals, vertex + 0.2 * right, atol=1e-6)
    held = Pose(np.zeros(1), (Pin(0, goal),))
    np.testing.assert_allclose(pin_markers(held, vertex).goals[0], goal, atol=1e-6)
