"""A sheet seen aslant, for tests of what the hand does to it."""

from facepin.core.look.camera import Viewport, frame_points
from facepin.core.pose import Pin, Pose, rest_pose
from facepin.session.hand.sight import Sight
from support.small_rigs import sheet

RIG = sheet()
VIEWPORT = Viewport(100, 50, 400, 400)
CAMERA = frame_points(RIG.neutral, 1.0).orbited(0.3, 0.2)


def sight(pose: Pose | None = None, **more: object) -> Sight:
    pose = pose or rest_pose(RIG)
    return Sight(RIG, RIG.triangles, pose, RIG.evaluate(pose.weights), CAMERA, VIEWPORT, **more)


def pixel_of(vertex: int) -> tuple[float, float]:
    x, y, _ = CAMERA.project(RIG.neutral[vertex][None], VIEWPORT)[0]
    return float(x), float(y)


def pinned(*vertices: int, **more: object) -> Pose:
    """The rest pose with pins on some vertices, unmoved."""
    pins = (Pin(vertex, tuple(RIG.neutral[vertex].astype(float).tolist()), **more) for vertex in vertices)
    return rest_pose(RIG).with_pins(tuple(pins))
