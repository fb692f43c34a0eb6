"""A round rig, a place to draw it, and a camera that sees all of it."""

from collections.abc import Iterator
from contextlib import contextmanager

import moderngl
import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Points
from facepin.core.look.camera import Camera, Viewport, frame_points
from facepin.core.rig import Rig
from facepin.core.rig_builder import PartLook, build_rig
from facepin.gpu.canvas import Canvas
from facepin.gpu.scene import PaneMesh, Scene

SIZE = 128
WHOLE = Viewport(0, 0, SIZE, SIZE)


def ball(
    rings: int = 24,
    *,
    name: str = "ball",
    colour: tuple[float, float, float] | None = None,
    inside_out: bool = False,
) -> Rig:
    """A closed ball of radius 1 round the origin, with one shape that stretches it upwards."""
    columns = 2 * rings
    down = np.linspace(0, np.pi, rings + 1)[1:-1, None]
    round_ = np.arange(columns) * (2 * np.pi / columns)
    grid = np.stack(
        [np.sin(down) * np.sin(round_), np.cos(down) + 0 * round_, np.sin(down) * np.cos(round_)], axis=-1
    ).reshape(-1, 3)
    points = np.concatenate([grid, [[0, 1, 0], [0, -1, 0]]])
    at = np.arange(len(grid)).reshape(rings - 1, columns)
    right = np.roll(at, -1, axis=1)
    upper, lower = [at[:-1], at[1:], right[1:]], [at[:-1], right[1:], right[:-1]]
    bands = [np.stack(corners, axis=-1).reshape(-1, 3) for corners in (upper, lower)]
    top = np.stack([np.full(columns, len(grid)), at[0], right[0]], axis=1)
    bottom = np.stack([np.full(columns, len(grid) + 1), right[-1], at[-1]], axis=1)
    triangles = np.concatenate([*bands, top, bottom])
    if inside_out:
        triangles = triangles[:, ::-1]
    stretch = np.stack([0 * points[:, 1], np.maximum(points[:, 1], 0), 0 * points[:, 1]], axis=1)
    return build_rig(
        "ball",
        points,
        triangles.ravel(),
        np.full(len(triangles), 3),
        [("stretch", stretch)],
        parts=[PartLook(name, colour)],
    )


def bowl(rings: int = 24) -> Rig:
    """The front half of the ball, open at the back: both its sides can be seen."""
    whole = ball(rings)
    corners = whole.triangles[(whole.neutral[whole.triangles, 2] > -1e-6).all(axis=1)].ravel()
    sizes = np.full(len(corners) // 3, 3)
    return build_rig("bowl", whole.neutral, corners, sizes, [("move", np.ones_like(whole.neutral))])


def camera(rig: Rig) -> Camera:
    """Sees the whole rig from the front."""
    return frame_points(rig.neutral, 1.0)


def ball_normals(rig: Rig, *, inside_out: bool = False) -> Points:
    """Normals of the ball as its winding gives them."""
    return -rig.neutral if inside_out else rig.neutral


def draw(
    mesh: PaneMesh,
    canvas: Canvas,
    view: Camera,
    viewport: Viewport = WHOLE,
    *,
    fine: bool = True,
    background: bool = True,
) -> NDArray[np.uint8]:
    """Draw one pane and return the picture."""
    if background:
        mesh.scene.background.draw(canvas, [(viewport, view)])
    else:
        canvas.clear()
    mesh.draw(canvas, viewport, view, fine=fine)
    return canvas.read().copy()


@contextmanager
def drawn(
    gl: moderngl.Context, rig: Rig, normals: Points, samples: int = 0, size: int = SIZE
) -> Iterator[tuple[PaneMesh, Canvas]]:
    """A mesh in its rest pose, and an empty canvas."""
    scene, canvas = Scene(gl, rig), Canvas(gl, samples)
    mesh = PaneMesh(scene)
    canvas.resize(size, size)
    mesh.upload(rig.neutral, normals)
    try:
        yield mesh, canvas
    finally:
        canvas.release()
        mesh.release()
        scene.release()
