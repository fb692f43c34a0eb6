"""Before, during and after a drag: what the whole program does around the hand."""

from collections.abc import Iterator

import numpy as np
import pytest

from facepin.core.events import (
    KeyPressed,
    KeyReleased,
    Modifiers,
    PointerMoved,
    PointerPressed,
    PointerReleased,
    Scrolled,
)
from facepin.core.look.camera import Viewport
from facepin.core.pose import Pin
from facepin.session.edit import Edit
from support.driver import App, running

BESIDE = (60.0, 120.0)


@pytest.fixture(scope="module")
def program() -> Iterator[App]:
    """One program for the tests that leave it as they found it."""
    with running(solver="tikhonov") as app:
        yield app


@pytest.fixture
def app(program: App) -> Iterator[App]:
    """The built-in face without pins; the mouse rests beside it."""
    before, camera = program.session.work, program.desk.camera
    program.step(PointerMoved(*BESIDE), frames=3)
    yield program
    program.key("escape")
    program.key("escape")
    program.desk.tool.selected = frozenset()
    while program.session.work is not before:
        assert program.session.undo()
    program.desk.look(camera)
    program.step(PointerMoved(*BESIDE), frames=3)


def seen(app: App, region: str, side: str = "") -> tuple[int, tuple[float, float]]:
    """A vertex of a region and where it can be pressed."""
    places, stage = app.desk.stage.places, app.desk.stage
    title = f"{region}, {side}" if side else region
    for vertex in np.flatnonzero(places.regions == places.names.index(region)).tolist():
        pixel = app.pixel_of(vertex)
        under = stage.vertex_under(0, app.desk.camera, app.frame.viewport, pixel)
        if under == vertex and places.title(vertex) == title:
            return vertex, pixel
    raise AssertionError(f"{title} is not seen")


def inside(viewport: Viewport, pixels: np.ndarray) -> bool:
    x, y = pixels[:, 0], pixels[:, 1]
    within = (x > viewport.x) & (x < viewport.x + viewport.width)
    return bool((within & (y > viewport.y) & (y < viewport.y + viewport.height)).all())


def test_a_press_on_hair_turns_the_camera_and_says_why_there_is_no_pin(app: App) -> None:
    _, (x, y) = seen(app, "hair", "left")
    before = app.desk.camera
    app.step(PointerPressed(x, y))  # without a frame in which the mouse was there
    assert app.desk.message == "No shape moves the hair"
    app.step(PointerMoved(x + 40, y), PointerReleased(x + 40, y), frames=2)
    assert app.desk.camera.yaw != before.yaw
    assert not app.session.pose.pins


def test_f_frames_the_face_and_the_selected_pins(app: App) -> None:
    app.key("f")
    rig, viewport = app.session.rig, app.frame.viewport
    face, far = app.desk.camera, app.desk.camera.distance
    moved = app.desk.stage.places.moved
    lips = [app.desk.stage.places.names.index(name) for name in ("upper lip", "chin", "brow")]
    expressive = moved & np.isin(app.desk.stage.places.regions, lips)
    assert inside(viewport, face.project(rig.neutral[expressive], viewport))
    assert not inside(viewport, face.project(rig.neutral, viewport))  # neither the bust nor the hair
    vertex, pixel = seen(app, "mouth corner", "left")
    app.press(*pixel)
    app.release(*pixel)
    assert app.desk.tool.selected == {vertex}
    app.key("f")
    assert app.desk.camera.distance < 0.7 * far
    x, y = app.pixel_of(vertex)
    assert abs(x - (viewport.x + viewport.width / 2)) < 2
    assert abs(y - (viewport.y + viewport.height / 2)) < 2
    app.key("escape")
    app.key("f")
    assert app.desk.camera.distance == pytest.approx(far)


def between_the_lips(app: App) -> tuple[float, float]:
    """A pixel at which both lips are within reach."""
    x = app.frame.viewport.x + app.frame.viewport.width / 2 + 12
    _, (_, y) = seen(app, "upper lip", "left")
    for step in range(-40, 80):
        app.move(x, y + step)
        aim = app.desk.tool.aim
        if aim is not None and len(aim.vertices) > 1:
            return x, y + step
    raise AssertionError("the lips do not meet")


def test_the_ring_shows_what_the_press_takes_and_the_face_is_not_drawn_for_it(app: App) -> None:
    vertex, (x, y) = seen(app, "cheek", "left")
    app.step(PointerMoved(*BESIDE), frames=3)
    away = app.screenshot()
    drawn: list[object] = []
    stage = app.desk.stage
    draw = stage.draw
    stage.draw = lambda *given, **more: drawn.append(draw(*given, **more))  # type: ignore[method-assign]
    try:
        app.step(PointerMoved(x, y), frames=2)
    finally:
        del stage.draw
    assert not drawn
    assert app.desk.tool.aim is not None
    assert app.desk.tool.aim.vertices[0] == vertex
    ring = np.abs(app.screenshot().astype(int) - away).sum(axis=2)
    assert ring[round(y) - 10 : round(y) + 11, round(x) - 10 : round(x) + 11].max() > 100
    app.step(PointerPressed(x, y), PointerReleased(x, y), frames=2)
    assert [pin.vertex for pin in app.session.pose.pins] == [vertex]
    app.step(PointerMoved(1200, 300), frames=2)  # over a panel
    assert app.desk.tool.aim is None


def test_tab_takes_the_other_lip_and_goes_on_along_it(app: App) -> None:
    app.key("f")
    x, y = between_the_lips(app)
    places = app.desk.stage.places
    first, second = (places.region(v) for v in app.desk.tool.aim.vertices[:2])
    assert {first, second} == {"upper lip", "lower lip"}
    app.key("tab")
    assert places.region(app.desk.tool.aim.vertices[0]) == second
    app.move(x + 1, y)
    assert places.region(app.desk.tool.aim.vertices[0]) == second
    app.step(PointerPressed(x + 1, y), PointerReleased(x + 1, y), frames=2)
    (pin,) = app.session.pose.pins
    assert places.region(pin.vertex) == second
    # The pin is under the mouse now, and the first lip can still be taken.
    app.move(x + 1, y)
    assert app.desk.tool.hovered == pin.vertex
    app.key("tab")
    app.step(PointerPressed(x + 1, y), PointerReleased(x + 1, y), frames=2)
    assert [places.region(pin.vertex) for pin in app.session.pose.pins] == [second, first]


def test_symmetry_has_a_button_that_does_what_its_key_does(app: App) -> None:
    viewport = app.frame.viewport
    x, y = viewport.x + viewport.width - 60, viewport.y + viewport.height - 22
    camera = app.desk.camera
    off = app.screenshot()
    app.press(x, y)
    app.release(x, y)
    assert app.desk.view.symmetric
    assert app.desk.camera == camera
    app.step(PointerMoved(*BESIDE), frames=3)
    on = app.screenshot()
    corner = slice(round(y) - 12, round(y) + 12), slice(round(x) - 60, round(x) + 48)
    assert (on[corner] != off[corner]).any()
    app.key("m")
    assert not app.desk.view.symmetric


def goal_of(app: App) -> np.ndarray:
    return np.array(app.session.pose.pins[-1].goal)


def test_shift_makes_a_drag_finer_without_a_jump(app: App) -> None:
    app.desk.view.steady = False
    _, (x, y) = seen(app, "cheek", "left")
    app.press(x, y)
    app.step(PointerMoved(x + 20, y))
    coarse = goal_of(app)
    app.step(PointerMoved(x + 20, y, Modifiers(shift=True)))
    np.testing.assert_array_equal(goal_of(app), coarse)
    app.step(PointerMoved(x + 70, y, Modifiers(shift=True)))
    fine = goal_of(app)
    app.step(PointerMoved(x + 70, y))
    np.testing.assert_array_equal(goal_of(app), fine)
    app.step(PointerMoved(x + 80, y))
    again = goal_of(app)
    app.release(x + 80, y)
    app.desk.view.steady = True
    np.testing.assert_array_equal(goal_of(app), again)
    pixel = (coarse - again)[0] / -20  # 50 / 5 + 10 pixels
    assert (fine - coarse)[0] == pytest.approx(10 * pixel, rel=1e-3)


def test_x_and_y_keep_a_drag_on_a_line_through_the_press(app: App) -> None:
    app.desk.view.steady = False
    vertex, (x, y) = seen(app, "cheek", "left")
    start = app.session.rig.neutral[vertex]
    app.press(x, y)
    app.move(x + 20, y + 30)
    free = goal_of(app)
    app.step(KeyPressed("x"))
    along = goal_of(app)
    assert along[0] == pytest.approx(free[0], abs=1e-3)
    assert along[1] == pytest.approx(start[1], abs=1e-3)
    assert app.desk.tool.line == ("x", (x, y))
    app.step(frames=1)
    app.step(KeyPressed("y"))
    assert goal_of(app)[0] == pytest.approx(start[0], abs=1e-3)
    app.step(KeyReleased("x"))
    assert app.desk.tool.line == ("y", (x, y))
    app.step(KeyReleased("y"))
    np.testing.assert_allclose(goal_of(app), free)
    app.release(x + 20, y + 30)
    app.desk.view.steady = True
    assert app.desk.tool.line is None
    assert app.session.undo_label == "Drag pin"


def test_nothing_of_a_line_is_left_after_a_drag_is_given_up(app: App) -> None:
    _, (x, y) = seen(app, "cheek", "left")
    app.press(x, y)
    app.move(x + 20, y + 30)
    app.step(KeyPressed("x"))
    app.key("escape")
    assert app.desk.tool.line is None
    app.release(x + 20, y + 30)
    assert not app.session.pose.pins


def test_with_symmetry_a_soft_drag_moves_both_sides_alike(app: App) -> None:
    app.desk.view.steady = False
    places, rig = app.desk.stage.places, app.session.rig
    left, at = seen(app, "upper lip", "left")
    right = int(app.session.mirror.vertices[left])
    pins = tuple(Pin(v, tuple(rig.neutral[v].astype(float).tolist())) for v in (right, left))
    app.desk.apply(Edit("Place pins", True, pins))
    before = {pin.vertex: np.array(pin.goal) for pin in pins}
    app.key("m")
    app.press(*at)
    app.move(at[0], at[1] + 20)
    app.step(Scrolled(*at, 20.0))
    moved = {pin.vertex: np.array(pin.goal) - before[pin.vertex] for pin in app.session.pose.pins}
    alone = app.desk.tool.held
    app.step(Scrolled(*at, -30.0))
    app.release(at[0], at[1] + 20)
    app.key("m")
    app.desk.view.steady = True
    assert places.sides[left] == -places.sides[right] == 1
    assert alone == {left}
    np.testing.assert_allclose(moved[right], moved[left] * (-1, 1, 1), atol=1e-9)
    assert moved[left][1] < -0.01 * rig.height


def test_the_wheel_in_a_drag_carries_near_pins_along(app: App) -> None:
    app.desk.view.steady = False
    places = app.desk.stage.places
    first, at = seen(app, "upper lip", "left")
    skin = np.flatnonzero((places.regions == places.regions[first]) & (places.sides == 1))
    away = np.linalg.norm(app.session.rig.neutral[skin] - app.session.rig.neutral[first], axis=1)
    near = int(skin[np.argmin(np.abs(away - 0.03 * app.session.rig.height))])
    far, _ = seen(app, "brow", "right")
    pins = tuple(Pin(v, tuple(app.session.rig.neutral[v].astype(float).tolist())) for v in (first, near, far))
    app.desk.apply(Edit("Place pins", True, pins))
    before = {pin.vertex: np.array(pin.goal) for pin in app.session.pose.pins}
    camera = app.desk.camera

    def ways() -> list[float]:
        goals = {pin.vertex: np.array(pin.goal) for pin in app.session.pose.pins}
        return [float(np.linalg.norm(goals[v] - before[v])) for v in (first, near, far)]

    app.press(*at)
    app.move(at[0], at[1] + 20)
    whole = ways()[0]
    assert ways() == [whole, 0.0, 0.0]
    app.step(Scrolled(*at, 4.0))
    assert app.desk.camera == camera
    moved = ways()
    assert moved[0] == pytest.approx(whole)
    assert 0.1 * whole < moved[1] < whole
    assert moved[2] == 0.0
    assert app.desk.tool.held == {first, near}
    app.step(Scrolled(*at, 1.0))
    assert moved[1] < ways()[1] < whole
    app.step(Scrolled(*at, -9.0))
    assert ways() == pytest.approx([whole, 0.0, 0.0])
    app.release(at[0], at[1] + 20)
    app.desk.view.steady = True
    assert app.desk.tool.radius == 0
    assert app.session.undo_label == "Drag pin"
