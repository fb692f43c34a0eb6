import numpy as np
import pytest

from facepin.core.camera import Viewport, frame_points
from facepin.core.events import KeyPressed, Modifiers, PointerMoved, PointerPressed, PointerReleased
from facepin.core.pose import Pin, Pose, rest_pose
from facepin.session.drag import DragTool
from facepin.session.sight import Sight
from small_rigs import sheet

RIG = sheet()
VIEWPORT = Viewport(100, 50, 400, 400)
CAMERA = frame_points(RIG.neutral, 1.0).orbited(0.3, 0.2)


def sight(pose: Pose | None = None, **more: object) -> Sight:
    pose = pose or rest_pose(RIG)
    return Sight(RIG, RIG.triangles, pose, RIG.evaluate(pose.weights), CAMERA, VIEWPORT, **more)


def pixel_of(vertex: int) -> tuple[float, float]:
    x, y, _ = CAMERA.project(RIG.neutral[vertex][None], VIEWPORT)[0]
    return float(x), float(y)


def test_a_click_places_a_pin_on_the_nearest_vertex_of_the_triangle() -> None:
    tool = DragTool()
    x, y = pixel_of(40)
    placed = tool.handle(PointerPressed(x + 3, y + 2), sight())
    assert placed is not None
    assert not placed.final
    assert [pin.vertex for pin in placed.pins] == [40]
    np.testing.assert_allclose(placed.pins[0].goal, RIG.neutral[40], atol=1e-7)
    done = tool.handle(PointerReleased(x + 3, y + 2), sight())
    assert done is not None
    assert done.final
    assert not done.solve
    assert done.pins == placed.pins
    assert tool.selected == {40}


def test_the_goal_moves_with_the_mouse_in_the_plane_that_faces_the_camera() -> None:
    tool = DragTool()
    x, y = pixel_of(40)
    tool.handle(PointerPressed(x + 3, y + 2), sight())
    edit = tool.handle(PointerMoved(x + 43, y - 18), sight())
    assert edit is not None
    assert edit.solve
    (pin,) = edit.pins
    move = np.subtract(pin.goal, RIG.neutral[40])
    right, up, back = CAMERA.axes
    assert abs(move @ back) < 1e-6
    seen = CAMERA.project(np.array([pin.goal]), VIEWPORT)[0, :2]
    np.testing.assert_allclose(seen, [x + 40, y - 20], atol=0.2)
    np.testing.assert_allclose(pin.axes, [right, up])


def test_moving_less_than_the_dead_zone_is_a_click() -> None:
    tool = DragTool()
    x, y = pixel_of(40)
    tool.handle(PointerPressed(x, y), sight())
    assert tool.handle(PointerMoved(x + 2, y + 2), sight()) is None
    assert tool.handle(PointerMoved(x + 2, y + 4), sight()) is not None
    again = DragTool()
    again.handle(PointerPressed(x, y), sight(scale=2.0))
    assert again.handle(PointerMoved(x + 2, y + 4), sight(scale=2.0)) is None


def test_a_press_near_a_marker_takes_that_pin_and_the_others_keep_their_goals() -> None:
    pins = (Pin(40, (0.1, 0.2, 0.3)), Pin(20, (0.5, 0.5, 0.0)))
    pose = rest_pose(RIG).with_pins(pins)
    tool = DragTool()
    x, y = pixel_of(20)
    assert tool.handle(PointerPressed(x + 5, y), sight(pose)) is None
    assert tool.held == {20}
    edit = tool.handle(PointerMoved(x + 25, y), sight(pose))
    assert edit is not None
    assert edit.pins[0] is pins[0]
    # The goal starts from where it was, not from the mouse: nothing jumps.
    moved = CAMERA.project(np.array([edit.pins[1].goal, pins[1].goal]), VIEWPORT)
    np.testing.assert_allclose(moved[0, :2] - moved[1, :2], [20, 0], atol=0.3)


def test_a_click_on_a_pin_selects_it_and_shift_adds() -> None:
    pose = rest_pose(RIG).with_pins(tuple(Pin(v, tuple(RIG.neutral[v].tolist())) for v in (20, 40)))
    tool = DragTool()
    for vertex, held in ((20, Modifiers()), (40, Modifiers(shift=True))):
        x, y = pixel_of(vertex)
        tool.handle(PointerPressed(x, y, "left", held), sight(pose))
        assert tool.handle(PointerReleased(x, y), sight(pose)) is None
    assert tool.selected == {20, 40}


def test_a_press_beside_the_mesh_takes_nothing() -> None:
    tool = DragTool(selected=frozenset({40}))
    assert tool.handle(PointerPressed(VIEWPORT.x + 2, VIEWPORT.y + 2), sight()) is None
    assert not tool.holding
    assert tool.selected == {40}  # the camera may be turned with it


def test_escape_lets_go() -> None:
    tool = DragTool()
    x, y = pixel_of(40)
    tool.handle(PointerPressed(x, y), sight())
    tool.handle(PointerMoved(x + 30, y), sight())
    tool.handle(KeyPressed("escape"), sight())
    assert not tool.holding
    assert tool.handle(PointerReleased(x + 30, y), sight()) is None


def test_the_pin_under_the_mouse_is_hovered() -> None:
    pose = rest_pose(RIG).with_pins((Pin(40, tuple(RIG.neutral[40].tolist())),))
    tool = DragTool()
    x, y = pixel_of(40)
    tool.handle(PointerMoved(x + 4, y), sight(pose))
    assert tool.hovered == 40
    tool.handle(PointerMoved(x + 40, y), sight(pose))
    assert tool.hovered is None


@pytest.mark.parametrize("freedom", ["space", "screen"])
def test_new_pins_have_the_freedom_that_is_set(freedom: str) -> None:
    tool = DragTool()
    edit = tool.handle(PointerPressed(*pixel_of(40)), sight(freedom=freedom))
    assert edit is not None
    assert edit.pins[0].freedom == freedom


def test_a_pin_behind_the_skin_is_not_in_the_way() -> None:
    x, y, z = RIG.neutral[40].astype(float) - CAMERA.axes[2] * RIG.height
    pose = rest_pose(RIG).with_pins((Pin(0, (x, y, z)),))  # its goal lies far behind vertex 40
    edit = DragTool().handle(PointerPressed(*pixel_of(40)), sight(pose))
    assert edit is not None
    assert [pin.vertex for pin in edit.pins] == [0, 40]
