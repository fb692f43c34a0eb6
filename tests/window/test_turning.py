"""The user turns a face, and it stays so."""

import json
from pathlib import Path

import numpy as np
import pytest

from facepin.core.pose import Pin
from facepin.core.turn import AS_IN_FILE, QUARTERS, turn_points
from facepin.files import open_rig, write_model
from facepin.files.upright import open_upright
from facepin.files.work.turns import read_turn, write_turn
from facepin.panels.commands import Command
from facepin.session.edit import Edit
from support.driver import running
from support.small_rigs import sheet


@pytest.fixture
def face(tmp_path: Path) -> Path:
    path = tmp_path / "face.glb"
    write_model(sheet(), np.zeros(4), path)
    return path


def test_a_turn_takes_the_work_along_and_is_remembered(face: Path, tmp_path: Path) -> None:
    settings = tmp_path / "settings"
    with running(face, settings_folder=settings, size=(640, 480)) as app:
        before = app.session.rig.neutral
        app.desk.apply(
            Edit("pose", True, (Pin(12, (0.1, 0.2, 0.3)),), weights=np.array([0.5, 0.0, 0.0, 0.0]))
        )
        app.ask(Command.FACE_FORWARD)
        app.step(frames=2)
        assert not app.desk.is_error
        np.testing.assert_array_equal(app.session.rig.neutral, turn_points(before, QUARTERS["x"]))
        assert app.session.pose.weights.tolist() == [0.5, 0.0, 0.0, 0.0]
        assert app.session.pose.pins[0].goal == pytest.approx((0.1, -0.3, 0.2))
        assert "*" in app.desk.title, "it is not saved"
    assert read_turn(settings, face) == QUARTERS["x"]
    rig = open_upright(face, settings=settings)
    assert rig.turn == QUARTERS["x"]
    write_model(rig, np.zeros(4), tmp_path / "again.glb")
    np.testing.assert_array_equal(open_rig(tmp_path / "again.glb").neutral, open_rig(face).neutral)


def test_a_turn_that_makes_no_sense_is_forgotten(face: Path, tmp_path: Path) -> None:
    write_turn(tmp_path, face, QUARTERS["z"])
    assert open_upright(face, settings=tmp_path).turn == QUARTERS["z"]
    for text in ("[]", "{", *(json.dumps({str(face): axes}) for axes in ([1, 2, 2], [-1, 2, 3], 1))):
        (tmp_path / "turns.json").write_text(text)
        assert open_upright(face, settings=tmp_path).turn == AS_IN_FILE


def test_parts_are_hidden_and_shown_again(face: Path) -> None:
    with running(face, size=(640, 480)) as app:
        from facepin.panels.requests import ShowParts

        stage = app.desk.stage
        assert stage is not None
        (name,) = {part.name for part in app.session.rig.parts}
        app.ask(ShowParts(frozenset({name})))
        app.step(frames=2)
        assert stage.vertex_under(0, app.desk.camera, app.frame.viewport, app.pixel_of(40)) is None
        app.ask(ShowParts(frozenset()))
        app.step(frames=2)
        assert stage.vertex_under(0, app.desk.camera, app.frame.viewport, app.pixel_of(40)) is not None
