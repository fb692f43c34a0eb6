"""What the desk does with requests, driven through the whole program."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facepin.core.errors import FacepinError
from facepin.core.events import PointerMoved
from facepin.core.look.camera import Camera
from facepin.core.pose import Pin, Pose
from facepin.core.rig import Rig
from facepin.panels.commands import Command
from facepin.panels.requests import AddPane, ClosePane, KeepPane, Request, SetControl, UseSolver
from facepin.resources import resource
from facepin.session.edit import Edit
from facepin.session.solving.solving import PinSolver, choose
from support.driver import running


def test_requests_of_one_frame_build_on_each_other(tmp_path: Path) -> None:
    with running(pictures=tmp_path) as app:
        for request in (AddPane(choose("tikhonov")), Command.FRAME, Command.SCREENSHOT):
            app.ask(request)
        app.until(lambda: not app.desk.errands.busy)
        assert not app.desk.is_error
        assert len(list(tmp_path.iterdir())) == 1
        app.step(PointerMoved(5, 5), frames=2)
        assert len(app.frame.viewports) == 2


CALMER = choose("transpose", keep_limits=True)


@pytest.mark.parametrize("request_", [UseSolver(0, CALMER), AddPane(choose("sparse"))])
def test_a_solver_that_fails_on_the_last_drag_says_so(
    request_: Request, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise FacepinError("no solution for these pins")

    with running() as app:
        x, y, z = app.session.rig.neutral[4000].astype(float).tolist()
        app.desk.apply(Edit("Drag pin", True, (Pin(4000, (x, y - 0.5, z)),), solve=True))
        weights = app.session.pose.weights
        monkeypatch.setattr(PinSolver, "solve", fail)
        app.ask(request_)
        assert app.desk.is_error
        assert app.desk.message == "no solution for these pins"
        np.testing.assert_array_equal(app.session.pose.weights, weights)


def test_one_question_for_a_file_at_a_time() -> None:
    with running() as app:
        app.ask(Command.SAVE_POSE)
        asked = app.desk.dialog
        app.ask(Command.OPEN_FILE)
        assert app.desk.dialog is asked
        assert app.desk.is_error
        app.desk.release()
        assert asked.finished


def test_a_pane_keeps_its_camera_and_overlays_when_others_are_closed() -> None:
    with running(size=(1600, 900)) as app:
        for key in ("tikhonov", "sparse"):
            app.ask(AddPane(choose(key)))
        app.step(PointerMoved(5, 5), frames=3)
        app.desk.view.linked = False
        for at in range(3):
            app.desk.look(app.desk.camera.orbited(0.1 * at, 0), at)
        cameras = list(app.desk.cameras)
        app.desk.view.panes[1].wireframe = True

        def seen(request: object) -> tuple[list[Camera], list[bool]]:
            app.ask(request)
            app.step(PointerMoved(6, 6), frames=2)
            return app.desk.cameras, [view.wireframe for view in app.desk.view.panes]

        assert seen(ClosePane(0)) == (cameras[1:], [True, False])
        assert seen(KeepPane(1)) == (cameras[2:], [False])
        assert seen(AddPane(choose("hybrid"))) == ([cameras[2]] * 2, [False, False])
        for _ in range(2):
            app.ask(Command.UNDO)
        assert seen(Command.UNDO) == (cameras, [False, True, False])
        # Linked cameras are one also for a pane that comes back.
        app.desk.view.linked = True
        app.ask(ClosePane(0))
        app.desk.look(cameras[1].orbited(1, 0))
        assert seen(Command.UNDO)[0] == [cameras[1].orbited(1, 0)] * 3


@pytest.mark.parametrize("solve", [False, True])
def test_a_saved_pose_opens_as_it_was_saved_and_a_pins_file_is_solved(solve: bool) -> None:
    def first(rig: Rig) -> Pose:
        vertex = int(np.argmax(abs(rig.deltas).sum(axis=1)) // 3)
        x, y, z = rig.neutral[vertex].astype(float).tolist()
        return Pose(np.full(rig.shape_count, 0.1), (Pin(vertex, (x, y - 0.5, z)),))

    with running(first_pose=first, solve_first=solve) as app:
        same = bool((app.session.pose.weights == 0.1).all())
        assert same is not solve
        assert len(app.session.pose.pins) == 1
        assert "*" not in app.desk.title


def test_a_rig_opens_even_if_its_first_pose_does_not() -> None:
    def first(rig: Rig) -> Pose:
        raise FacepinError("pose.json: no such file")

    with running(first_pose=first) as app:
        assert not app.session.pose.weights.any()
        assert app.desk.is_error
        assert app.desk.message == "pose.json: no such file"


def test_a_solver_is_found_again_with_its_settings() -> None:
    with running(solver="tikhonov") as app:
        choice = app.session.pane.choice
        changed = replace(choice, settings=replace(choice.settings, alpha=0.5))
        for request in (UseSolver(0, changed), UseSolver(0, choose("transpose"))):
            app.ask(request)  # no panel has been drawn between: they need not be open
        shown = app.desk.view.panes[0]
        assert shown.choice("tikhonov", app.session.pane.choice) == changed
        assert shown.choice("hybrid", app.session.pane.choice) == choose("hybrid")


def test_what_was_wrong_with_one_step_is_not_said_of_the_next() -> None:
    with running() as app:
        locked = np.zeros(app.session.rig.shape_count, bool)
        locked[0] = True
        app.ask(SetControl("Lock", replace(app.session.control, locked=locked)))
        weights = np.zeros(len(locked))
        weights[0] = 1.0
        app.desk.apply(Edit("Set", True, weights=weights))
        assert app.desk.is_error
        assert "locked" in app.desk.message
        for request in (Command.REFERENCE_FROM_POSE, AddPane(choose("hybrid")), ClosePane(1)):
            app.ask(request)
            assert not app.desk.is_error
            assert not app.desk.message


def test_a_path_that_cannot_be_written_can_be_typed_again(tmp_path: Path) -> None:
    with running(size=(500, 400)) as app:
        app.ask(Command.SAVE_POSE)
        asked = app.desk.dialog
        for path in (tmp_path / "no folder" / "a.json", tmp_path / f"{'x' * 300}.json"):
            asked._finish(path)
            app.step(PointerMoved(5, 5), frames=2)
            assert app.desk.is_error
            assert app.desk.dialog is asked
            assert not asked.finished
        asked._finish(tmp_path / "a.json")
        app.step(PointerMoved(6, 6), frames=2)
        assert app.desk.dialog is None
        assert (tmp_path / "a.json").exists()


def test_an_answer_that_comes_after_another_face_saves_nothing(tmp_path: Path) -> None:
    with running(size=(500, 400)) as app:
        app.ask(Command.SAVE_AS)
        asked = app.desk.dialog
        before = app.session
        app.desk.opener.open(resource("assets", "faces/bruno.npz"))
        app.until(lambda: app.session is not before)
        asked._finish(tmp_path / "a.facepin")
        app.step(PointerMoved(5, 5), frames=2)
        assert "Another face" in app.desk.message
        assert not list(tmp_path.iterdir())
        assert app.desk.dialog is None  # whatever path is typed, it would be no better


def test_a_slider_says_that_it_lets_the_goals_of_pins_go() -> None:
    with running(solver="transpose,sparse") as app:
        x, y, z = app.session.rig.neutral[4000].astype(float).tolist()
        app.desk.apply(Edit("Drag pin", True, (Pin(4000, (x, y - 2.0, z)),), solve=True))
        assert app.desk.message == ""
        weights = app.session.pose.weights.copy()
        weights[0] = 0.5
        app.desk.apply(Edit("Set", True, weights=weights))
        assert "goals of the pins" in app.desk.message and not app.desk.is_error
        weights[0] = 0.6
        app.desk.apply(Edit("Set", True, weights=weights))
        assert app.desk.message == ""
