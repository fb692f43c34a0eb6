import pytest

from facepin.core.camera import Camera, Viewport
from facepin.core.events import Modifiers, PointerMoved, PointerPressed, PointerReleased, Scrolled
from facepin.session.navigation import Navigator

VIEWPORT = Viewport(0, 0, 400, 300)
CAMERA = Camera((0, 0, 0), 10.0)


def dragged(button: str, modifiers: Modifiers, dx: float, dy: float) -> Camera:
    navigator = Navigator()
    navigator.handle(PointerPressed(200, 150, button, modifiers), CAMERA, VIEWPORT)
    assert navigator.holding
    camera = navigator.handle(PointerMoved(200 + dx, 150 + dy), CAMERA, VIEWPORT)
    navigator.handle(PointerReleased(200 + dx, 150 + dy, button), camera, VIEWPORT)
    assert not navigator.holding
    assert navigator.handle(PointerMoved(0, 0), camera, VIEWPORT) is camera
    return camera


@pytest.mark.parametrize(
    ("button", "modifiers"),
    [("left", Modifiers(alt=True)), ("middle", Modifiers()), ("left", Modifiers())],
)
def test_orbit(button: str, modifiers: Modifiers) -> None:
    camera = dragged(button, modifiers, 40, 20)
    assert camera.yaw < 0  # the face turns with the mouse, to the right
    assert camera.pitch > 0
    assert camera.distance == CAMERA.distance
    assert camera.target == CAMERA.target


@pytest.mark.parametrize(
    ("button", "modifiers"),
    [("middle", Modifiers(alt=True)), ("middle", Modifiers(shift=True)), ("right", Modifiers())],
)
def test_pan(button: str, modifiers: Modifiers) -> None:
    camera = dragged(button, modifiers, 40, -20)
    x, y, _ = camera.project([CAMERA.target], VIEWPORT)[0]
    assert (x, y) == pytest.approx((240, 130))


@pytest.mark.parametrize(
    ("button", "modifiers"), [("right", Modifiers(alt=True)), ("middle", Modifiers(control=True))]
)
def test_dolly(button: str, modifiers: Modifiers) -> None:
    assert dragged(button, modifiers, 30, 0).distance < CAMERA.distance
    assert dragged(button, modifiers, 0, 30).distance > CAMERA.distance


def test_the_wheel_keeps_what_is_under_the_mouse() -> None:
    point = CAMERA.plane_point((300, 100), CAMERA.target, VIEWPORT)
    camera = Navigator().handle(Scrolled(300, 100, 2), CAMERA, VIEWPORT)
    assert camera.distance < CAMERA.distance
    x, y, _ = camera.project([point], VIEWPORT)[0]
    assert (x, y) == pytest.approx((300, 100))


def test_a_second_button_does_not_end_the_motion_of_the_first() -> None:
    navigator = Navigator()
    navigator.handle(PointerPressed(10, 10, "middle"), CAMERA, VIEWPORT)
    navigator.handle(PointerReleased(10, 10, "left"), CAMERA, VIEWPORT)
    assert navigator.holding
