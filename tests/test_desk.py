"""What the desk does with requests, driven through the whole program."""

from pathlib import Path

import numpy as np
import pytest

from driver import running
from facepin.core.errors import FacepinError
from facepin.core.events import PointerMoved
from facepin.core.pose import Pin
from facepin.panels.requests import AddPane, Command, UseSolver
from facepin.session.edit import Edit
from facepin.session.solving import PinSolver, choose


def test_requests_of_one_frame_build_on_each_other(tmp_path: Path) -> None:
    with running(pictures=tmp_path) as app:
        for request in (AddPane(choose("tikhonov")), Command.FRAME, Command.SCREENSHOT):
            app.desk.carry_out(request, app.frame.viewport)
        assert not app.desk.is_error
        assert len(list(tmp_path.iterdir())) == 1
        app.step(PointerMoved(5, 5), frames=2)
        assert len(app.frame.viewports) == 2


@pytest.mark.parametrize("request_of", [lambda choice: UseSolver(0, choice), AddPane])
def test_a_solver_that_fails_when_it_is_chosen_says_so(
    request_of: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise FacepinError("no solution for these pins")

    with running() as app:
        x, y, z = app.session.rig.neutral[4000].astype(float).tolist()
        app.desk.apply(Edit("Drag pin", True, (Pin(4000, (x, y - 0.5, z)),), solve=True))
        weights = app.session.pose.weights
        monkeypatch.setattr(PinSolver, "solve", fail)
        app.desk.carry_out(request_of(choose("tikhonov")), app.frame.viewport)
        assert app.desk.is_error
        assert app.desk.message == "no solution for these pins"
        np.testing.assert_array_equal(app.session.pose.weights, weights)


def test_one_question_for_a_file_at_a_time() -> None:
    with running() as app:
        app.desk.carry_out(Command.SAVE_POSE, app.frame.viewport)
        asked = app.desk.dialog
        app.desk.carry_out(Command.OPEN_FILE, app.frame.viewport)
        assert app.desk.dialog is asked
        assert app.desk.is_error
        app.desk.release()
        assert asked.finished
