from collections.abc import Callable

import numpy as np
import pytest

from facepin.core.events import Modifiers, PointerMoved, PointerPressed, PointerReleased, Scrolled
from facepin.core.look.camera import Camera, Viewport
from facepin.session.navigation import PRESETS, Navigator, Preset, dolly, orbit, pan

VIEWPORT = Viewport(0, 0, 400, 300)
CAMERA = Camera((0, 0, 0), 10.0)
ALT = Modifiers(alt=True)


def dragged(habit: str, button: str, modifiers: Modifiers, dx: float, dy: float) -> Camera:
    navigator, preset = Navigator(), PRESETS[habit]
    navigator.handle(PointerPressed(200, 150, button, modifiers), CAMERA, VIEWPORT, preset)
    if not navigator.holding:
        return CAMERA
    camera = navigator.handle(PointerMoved(200 + dx, 150 + dy), CAMERA, VIEWPORT, preset)
    navigator.handle(PointerReleased(200 + dx, 150 + dy, button), camera, VIEWPORT, preset)
    assert not navigator.holding
    assert navigator.handle(PointerMoved(0, 0), camera, VIEWPORT, preset) is camera
    return camera


@pytest.mark.parametrize(
    ("habit", "button", "modifiers"),
    [
        ("facepin", "left", Modifiers()),
        ("facepin", "middle", Modifiers()),
        ("facepin", "left", ALT),
        ("maya", "left", ALT),
        ("blender", "middle", Modifiers()),
        ("blender", "left", ALT),
    ],
)
def test_orbit(habit: str, button: str, modifiers: Modifiers) -> None:
    camera = dragged(habit, button, modifiers, 40, 20)
    assert camera.yaw < 0  # the face turns with the mouse, to the right
    assert camera.pitch > 0
    assert camera.distance == CAMERA.distance
    assert camera.target == CAMERA.target


@pytest.mark.parametrize(
    ("habit", "button", "modifiers"),
    [
        ("facepin", "right", Modifiers()),
        ("facepin", "middle", Modifiers(shift=True)),
        ("facepin", "middle", ALT),
        ("maya", "middle", ALT),
        ("blender", "middle", Modifiers(shift=True)),
        ("blender", "left", Modifiers(shift=True, alt=True)),
    ],
)
def test_pan(habit: str, button: str, modifiers: Modifiers) -> None:
    camera = dragged(habit, button, modifiers, 40, -20)
    x, y, _ = camera.project([CAMERA.target], VIEWPORT)[0]
    assert (x, y) == pytest.approx((240, 130))


@pytest.mark.parametrize(
    ("habit", "button", "modifiers"),
    [
        ("facepin", "right", ALT),
        ("facepin", "middle", Modifiers(control=True)),
        ("maya", "right", ALT),
        ("blender", "middle", Modifiers(control=True)),
        ("blender", "left", Modifiers(control=True, alt=True)),
    ],
)
def test_dolly(habit: str, button: str, modifiers: Modifiers) -> None:
    assert dragged(habit, button, modifiers, 30, 0).distance < CAMERA.distance
    assert dragged(habit, button, modifiers, 0, 30).distance > CAMERA.distance


@pytest.mark.parametrize(
    ("habit", "button", "modifiers"),
    [
        ("maya", "left", Modifiers()),
        ("maya", "middle", Modifiers()),
        ("maya", "right", Modifiers()),
        ("blender", "left", Modifiers()),
        ("blender", "right", Modifiers()),
        ("blender", "right", ALT),
    ],
)
def test_what_other_programs_leave_to_selection_leaves_the_camera_alone(
    habit: str, button: str, modifiers: Modifiers
) -> None:
    assert dragged(habit, button, modifiers, 40, 20) is CAMERA


@pytest.mark.parametrize("preset", PRESETS.values())
def test_every_habit_can_turn_shift_and_come_closer(preset: Preset) -> None:
    assert set(preset.motions.values()) == {orbit, pan, dolly}


def test_the_wheel_keeps_what_is_under_the_mouse() -> None:
    point = CAMERA.plane_point((300, 100), CAMERA.target, VIEWPORT)
    camera = Navigator().handle(Scrolled(300, 100, 2), CAMERA, VIEWPORT, PRESETS["facepin"])
    assert camera.distance < CAMERA.distance
    x, y, _ = camera.project([point], VIEWPORT)[0]
    assert (x, y) == pytest.approx((300, 100))


def test_a_second_button_does_not_end_the_motion_of_the_first() -> None:
    navigator = Navigator()
    navigator.handle(PointerPressed(10, 10, "middle"), CAMERA, VIEWPORT, PRESETS["facepin"])
    navigator.handle(PointerReleased(10, 10, "left"), CAMERA, VIEWPORT, PRESETS["facepin"])
    assert navigator.holding


def on_wall(camera: Camera, depth: float) -> Callable[[tuple[float, float]], np.ndarray]:
    """A surface that faces +z at some z."""

    def point(pixel: tuple[float, float]) -> np.ndarray:
        origin, direction = camera.ray(pixel, VIEWPORT)
        return origin + direction * (depth - origin[2]) / direction[2]

    return point


@pytest.mark.parametrize("orthographic", [False, True])
def test_the_wheel_comes_close_to_the_surface_and_never_through_it(orthographic: bool) -> None:
    camera, at, surface = CAMERA.through(orthographic=orthographic), (300.0, 100.0), 2.0
    under = on_wall(camera, surface)(at)
    for _ in range(60):
        camera = Navigator().handle(
            Scrolled(*at, 1), camera, VIEWPORT, PRESETS["facepin"], on_wall(camera, surface)
        )
        x, y, depth = camera.project([under], VIEWPORT)[0]
        assert (x, y) == pytest.approx(at, abs=0.5)
        assert depth > camera.near
        assert camera.eye[2] > surface
    # What was as far as the eye before is far away now: the picture shows little but skin.
    assert camera.pixel_size(VIEWPORT) < CAMERA.pixel_size(VIEWPORT) / 50


@pytest.mark.parametrize(
    ("button", "modifiers"), [("right", ALT), ("left", Modifiers(control=True, alt=True))]
)
def test_a_dolly_never_leads_through_the_surface(button: str, modifiers: Modifiers) -> None:
    habit = "blender" if modifiers.control else "maya"
    navigator, preset, camera = Navigator(), PRESETS[habit], CAMERA
    for _ in range(10):
        camera = navigator.handle(
            PointerPressed(200, 150, button, modifiers), camera, VIEWPORT, preset, on_wall(camera, 2.0)
        )
        camera = navigator.handle(PointerMoved(500, 150), camera, VIEWPORT, preset)
        navigator.handle(PointerReleased(500, 150, button), camera, VIEWPORT, preset)
        assert camera.eye[2] > 2.0 + camera.near


def test_panning_follows_the_surface_under_the_mouse() -> None:
    navigator, preset = Navigator(), PRESETS["facepin"]
    under = on_wall(CAMERA, 6.0)((200, 150))
    camera = navigator.handle(
        PointerPressed(200, 150, "middle", Modifiers(shift=True)),
        CAMERA,
        VIEWPORT,
        preset,
        on_wall(CAMERA, 6.0),
    )
    camera = navigator.handle(PointerMoved(260, 100), camera, VIEWPORT, preset)
    x, y, _ = camera.project([under], VIEWPORT)[0]
    assert (x, y) == pytest.approx((260, 100))
