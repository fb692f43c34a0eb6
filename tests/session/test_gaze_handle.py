"""The handle of the eyes in the whole program."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facepin.core.events import PointerMoved, PointerPressed, PointerReleased
from facepin.core.shapes.gaze import Gaze, find_gaze
from facepin.panels.commands import Command
from facepin.panels.requests import OpenPath
from facepin.resources import resource
from facepin.session.hand.gaze import handle_pixel
from support.driver import App, running

ADA = resource("assets", "faces/ada.npz")
ICT = "models/ict-facekit/ict_expressions.glb"


def gaze_of(app: App) -> Gaze:
    gaze = find_gaze(app.session.rig)
    assert gaze is not None
    return gaze


def handle(app: App, pane: int = 0) -> tuple[float, float]:
    weights = app.session.panes[pane].pose.weights
    place = app.frame.viewports[pane]
    at = handle_pixel(gaze_of(app), weights, app.desk.cameras[pane], place)
    assert at is not None
    return at


def wanted_angles(app: App, pixel: tuple[float, float]) -> tuple[float, float]:
    """Yaw and pitch of the point under a pixel on the handle's ball, from the camera's matrices alone."""
    gaze, camera, place = gaze_of(app), app.desk.camera, app.frame.viewports[0]
    to_clip = camera.projection(place.aspect) @ camera.view_matrix()
    x = 2 * (pixel[0] - place.x) / place.width - 1
    y = 1 - 2 * (pixel[1] - place.y) / place.height
    near, far = (np.linalg.solve(to_clip, (x, y, z, 1.0)) for z in (-1.0, 1.0))
    start, end = near[:3] / near[3] - gaze.middle, far[:3] / far[3] - gaze.middle
    a, b, c = (end - start) @ (end - start), 2 * start @ (end - start), start @ start - gaze.reach**2
    t = (-b - (b * b - 4 * a * c) ** 0.5) / (2 * a)
    x, y, z = start + t * (end - start)
    return np.arctan(x / z), np.arcsin(y / gaze.reach)


def face_of(name: str, request: pytest.FixtureRequest) -> Path:
    return ADA if name == "ada" else request.getfixturevalue("shared") / ICT


@pytest.mark.parametrize("name", ["ada", "ict"])
@pytest.mark.parametrize("view", [Command.FRONT, Command.THREE_QUARTER])
def test_a_drag_of_the_handle_turns_both_eyes(
    name: str, view: Command, request: pytest.FixtureRequest
) -> None:
    with running(face_of(name, request)) as app:
        app.ask(view)
        app.step(frames=2)
        x, y = handle(app)
        steps = len(app.session.steps)
        app.drag((x, y), (x + 40, y + 25))
        yaw, pitch = wanted_angles(app, (x + 40, y + 25))
        assert yaw > 0.05 and pitch < -0.05
        weights = dict(zip(app.session.rig.shape_names, app.session.pose.weights, strict=True))
        left, right = ("Left", "Right") if name == "ada" else ("_L", "_R")
        aside, down = (29.2, 24.1) if name == "ada" else (30, 30)  # degrees at weight 1
        expected = {
            f"eyeLookOut{left}": np.degrees(yaw) / aside,
            f"eyeLookIn{right}": np.degrees(yaw) / aside,
            f"eyeLookDown{left}": -np.degrees(pitch) / down,
            f"eyeLookDown{right}": -np.degrees(pitch) / down,
        }
        assert {shape for shape, weight in weights.items() if weight} == set(expected)
        for shape, weight in expected.items():
            assert weights[shape] == pytest.approx(weight, abs=0.01)
        assert handle(app) == pytest.approx((x + 40, y + 25), abs=0.5)  # it stays under the mouse
        assert len(app.session.steps) == steps + 1
        assert not app.session.pose.pins
        app.key("z", control=True)
        assert not app.session.pose.weights.any()
        assert handle(app) == pytest.approx((x, y), abs=1e-3)


def test_esc_restores_exactly_and_a_click_changes_nothing() -> None:
    with running(ADA) as app:
        x, y = handle(app)
        app.drag((x, y), (x - 30, y - 20))
        before, steps = app.session.pose.weights, len(app.session.steps)
        x, y = handle(app)
        app.press(x, y)
        app.move(x + 50, y + 50)
        app.step()
        assert not np.array_equal(app.session.pose.weights, before)
        app.key("escape")
        assert app.session.pose.weights is before
        app.release(x + 50, y + 50)
        app.press(*handle(app))
        app.release(*handle(app))
        assert app.session.pose.weights is before and len(app.session.steps) == steps


def test_a_double_click_lets_them_look_ahead() -> None:
    with running(ADA) as app:
        x, y = handle(app)
        app.drag((x, y), (x - 30, y - 20))
        assert app.session.pose.weights.any()
        x, y = handle(app)
        app.step(PointerMoved(x, y), frames=2)
        # In one frame, so that a slow machine does not make two clicks of it.
        app.step(*[event for _ in range(2) for event in (PointerPressed(x, y), PointerReleased(x, y))])
        assert not app.session.pose.weights.any()
        assert app.session.undo_label == "Look straight ahead"


def test_a_locked_shape_stays_and_is_told() -> None:
    with running(ADA) as app:
        session = app.session
        locked = np.zeros(session.rig.shape_count, np.bool_)
        locked[session.rig.shape_names.index("eyeLookOutLeft")] = True
        session.set_control("Lock", replace(session.control, locked=locked))
        x, y = handle(app)
        app.drag((x, y), (x + 40, y))
        weights = dict(zip(session.rig.shape_names, session.pose.weights, strict=True))
        assert weights["eyeLookOutLeft"] == 0 and weights["eyeLookInRight"] > 0.1
        assert "eyeLookOutLeft" in app.desk.message


def test_the_handle_can_be_hidden_and_is_then_not_in_the_way() -> None:
    with running(ADA) as app:
        at = handle(app)
        app.step(PointerMoved(*at), frames=2)
        assert app.desk.view.gaze.hovered
        shown = app.screenshot().astype(int)
        app.key("e")
        assert not app.desk.view.gaze.shown
        app.step(PointerMoved(*at), frames=3)
        assert not app.desk.view.gaze.hovered
        x, y = (round(c) for c in at)
        changed = np.abs(app.screenshot().astype(int) - shown).max(axis=2)
        assert changed[y - 3 : y + 3, x - 3 : x + 3].max() > 40
        app.press(*at)
        app.release(*at)
        assert len(app.session.pose.pins) == 1  # the skin behind it


def test_a_scene_that_is_opened_again_has_the_handle_where_the_eyes_look(tmp_path: Path) -> None:
    with running(ADA) as app:
        x, y = handle(app)
        app.drag((x, y), (x - 30, y + 15))
        weights = app.session.pose.weights
        app.desk.keeper.save(app.session, tmp_path / "looking.facepin", app.desk.snapshot())
    with running(ADA) as app:
        app.ask(OpenPath(tmp_path / "looking.facepin"))
        app.until(lambda: app.desk.loading is None and app.session.pose.weights.any())
        app.step(frames=2)
        assert np.allclose(app.session.pose.weights, weights)
        assert handle(app) == pytest.approx((x - 30, y + 15), abs=1)


def test_in_a_comparison_each_pane_has_its_own() -> None:
    with running(ADA, "transpose,sparse") as app:
        x, y = handle(app, 1)
        app.drag((x, y), (x + 15, y))
        assert app.session.active == 1
        assert app.session.panes[1].pose.weights.any() and not app.session.panes[0].pose.weights.any()
        assert handle(app, 1) == pytest.approx((x + 15, y), abs=0.5)


def test_eyes_at_their_limit_come_back_to_it() -> None:
    with running(ADA) as app:
        names = app.session.rig.shape_names
        ahead = np.array(["Up" in name or "Down" in name for name in names])  # only from side to side
        app.session.set_control("Lock", replace(app.session.control, locked=ahead))
        out = names.index("eyeLookOutLeft")
        x, y = handle(app)
        app.drag((x, y), (x + 200, y))
        before = app.session.pose.weights
        assert before[out] == 1
        x, y = handle(app)
        app.press(x, y)
        app.move(x - 30, y)
        app.step()
        assert app.session.pose.weights[out] < 1
        app.move(x + 30, y)
        app.step()
        assert np.array_equal(app.session.pose.weights, before)
        app.release(x + 30, y)
