"""How much light reaches a vertex."""

import moderngl
import numpy as np

from facepin.core.rig import Rig
from facepin.core.rig_builder import build_rig
from facepin.gpu.openness import directions, opened, smoothed, vertex_normals
from facepin.gpu.scene import Scene
from support.gpu_help import ball


def openness(gl: moderngl.Context, rig: Rig) -> np.ndarray:
    scene = Scene(gl, rig)
    changed = 0
    while not scene.refined:
        changed += scene.refine(16)
    assert changed == 1
    assert not scene.refine()
    albedo = np.frombuffer(scene.albedo.read(), np.float16).reshape(-1, 4)
    scene.release()
    return albedo[:, 3].astype(float)


def pot() -> Rig:
    """A ball with a deep pit in its front."""
    rig = ball(48)
    points = rig.neutral.copy()
    pit = np.hypot(points[:, 0], points[:, 1]) < 0.35
    points[pit & (points[:, 2] > 0), 2] -= 1.2
    corners = rig.triangles.ravel()
    return build_rig("pot", points, corners, np.full(len(corners) // 3, 3), [("move", np.ones_like(points))])


def test_a_ball_is_open_all_round(gl: moderngl.Context) -> None:
    values = openness(gl, ball(32))
    assert values.min() > 0.9
    assert values.max() <= 1.0


def test_the_bottom_of_a_pit_is_dark(gl: moderngl.Context) -> None:
    rig = pot()
    values = openness(gl, rig)
    x, y, z = rig.neutral.T
    bottom = (np.hypot(x, y) < 0.2) & (np.abs(z) < 0.4)
    assert bottom.sum() > 5
    assert values[bottom].max() < 0.5
    assert values[z < -0.5].min() > 0.9


def test_lids_are_lit_when_they_close(gl: moderngl.Context) -> None:
    rig = pot()
    x, y, z = rig.neutral.T
    bottom = (np.hypot(x, y) < 0.2) & (np.abs(z) < 0.4)
    out = np.where((np.hypot(x, y) < 0.35) & (z < 0.6) & (z > -0.6), 1.2, 0.0)
    moves = {"jawOpen": np.ones_like(rig.neutral), "eyeBlink_L": np.outer(out, (0, 0, 1))}
    corners, sizes = rig.triangles.ravel(), np.full(len(rig.triangles), 3)
    lids = openness(gl, build_rig("lids", rig.neutral, corners, sizes, list(moves.items())))
    moves["brow"] = moves.pop("eyeBlink_L")
    other = openness(gl, build_rig("other", rig.neutral, corners, sizes, list(moves.items())))
    assert lids[bottom].min() > other[bottom].max() + 0.1
    np.testing.assert_allclose(
        lids[out == 0][z[out == 0] < -0.5], other[out == 0][z[out == 0] < -0.5], atol=0.01
    )


def test_light_is_spread_by_distance_not_by_neighbours() -> None:
    x, y = np.meshgrid(0.01 * np.arange(21), 0.1 * np.arange(21))
    points = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    at = np.arange(x.size).reshape(x.shape)
    quads = np.stack([at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]], axis=-1).reshape(-1, 4)
    rig = build_rig("strips", points, quads.ravel(), np.full(len(quads), 4), [("move", points)])
    spike = np.zeros(x.size, np.float32)
    spike[at[10, 10]] = 1.0
    spread = smoothed(spike, rig, 4).reshape(x.shape)
    steps = np.arange(21) - 10.0
    along, across = ((spread.sum(axis=axis) / spread.sum()) @ steps**2 for axis in (1, 0))
    assert across > 1.5 * along > 0, "equal neighbours would spread it alike, in steps"
    assert 0 < spread.max() < 0.5
    np.testing.assert_allclose(smoothed(np.ones_like(spike), rig, 4), 1.0, rtol=1e-5)


def test_what_stands_by_a_wall_opens_away_from_it(gl: moderngl.Context) -> None:
    rig = pot()
    scene = Scene(gl, rig)
    while not scene.refined:
        scene.refine(16)
    towards = np.frombuffer(scene.towards.read(), np.float16).reshape(-1, 4)[:, :3].astype(float)
    scene.release()
    x, y, z = rig.neutral.T
    away = np.hypot(x, y)
    foot = (away > 0.2) & (away < 0.33) & (np.abs(z) < 0.4)
    assert foot.sum() > 5
    outwards = (towards[foot, 0] * x[foot] + towards[foot, 1] * y[foot]) / away[foot]
    assert outwards.mean() < -0.1
    assert np.abs(towards[z < -0.5]).max() < 0.15, "what is open all round leans nowhere"


def test_an_inside_out_file_is_lit_outside(gl: moderngl.Context) -> None:
    assert openness(gl, ball(32, inside_out=True)).min() > 0.9


def test_directions_are_spread_evenly() -> None:
    spread = directions(48)
    np.testing.assert_allclose(np.linalg.norm(spread, axis=1), 1)
    np.testing.assert_allclose(spread.mean(axis=0), 0, atol=0.02)
    np.testing.assert_allclose(spread.T @ spread / 48, np.eye(3) / 3, atol=0.02)


def test_normals_of_a_ball_are_its_points() -> None:
    rig = ball(32)
    np.testing.assert_allclose(vertex_normals(rig.neutral, rig.triangles), rig.neutral, atol=0.02)


def test_the_mouth_is_opened_by_name_else_by_the_largest_move() -> None:
    one = ball(6)
    corners, count = one.triangles.ravel(), one.vertex_count
    moves = [("brow", np.full((count, 3), 5.0)), ("Jaw_Open", np.full((count, 3), 1.0))]
    for shapes, move in ((moves, 1.0), (moves[:1], 5.0)):
        rig = build_rig("x", one.neutral, corners, np.full(len(corners) // 3, 3), shapes)
        np.testing.assert_allclose(opened(rig) - rig.neutral, move, rtol=1e-5)
