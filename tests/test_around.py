"""Before, during and after a drag: what the whole program does around the hand."""

from collections.abc import Iterator

import numpy as np
import pytest

from driver import App, running
from facepin.core.camera import Viewport
from facepin.core.events import PointerMoved, PointerPressed, PointerReleased

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
