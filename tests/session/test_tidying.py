"""Tidying up: fewer shapes, the same face."""

import json
from pathlib import Path

import numpy as np
import pytest

from facepin.__main__ import main
from facepin.core.control import ShapeControl
from facepin.core.pose import FRONT_AXES, Pin, Pose, as_vector
from facepin.core.rig import Rig
from facepin.core.shapes.measures import active
from facepin.files.formats import open_rig
from facepin.panels.commands import Command
from facepin.panels.requests import LeaveTidy, TakeTidy, Tidy
from facepin.resources import resource
from facepin.session.edit import Edit
from facepin.session.solving.tidying import tidied
from support.driver import running


@pytest.fixture(scope="module")
def ada() -> Rig:
    return open_rig(resource("assets", "faces/ada.npz"))


def messy(rig: Rig, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """A pose of three shapes, and the same with traces of others."""
    random = np.random.default_rng(seed)
    strong = np.flatnonzero(rig.largest_moves > 0.02 * rig.height)
    meant = np.zeros(rig.shape_count)
    meant[random.choice(strong, 3, replace=False)] = random.uniform(0.4, 0.9, 3)
    traces = random.uniform(0, 0.08, rig.shape_count) * (random.random(rig.shape_count) < 0.4)
    return meant, np.clip(meant + traces, 0, 1)


@pytest.mark.parametrize("seed", range(5))
def test_traces_go_and_the_face_stays_within_the_tolerance(ada: Rig, seed: int) -> None:
    _, pose = messy(ada, seed)
    found = tidied(ada, ShapeControl.of(ada), Pose(pose), 1.0)
    assert active(found) <= active(pose)
    assert np.count_nonzero(found) < np.count_nonzero(pose)
    moved = np.linalg.norm(ada.evaluate(found) - ada.evaluate(pose), axis=1).max()
    assert moved <= 0.017 * ada.height
    low, high = ada.limits.T
    assert ((found >= low) & (found <= high)).all()


def test_pins_stay_within_the_tolerance_and_locks_are_kept(ada: Rig) -> None:
    meant, pose = messy(ada, 7)
    moved = np.linalg.norm(ada.evaluate(pose) - ada.neutral, axis=1)
    vertices = np.random.default_rng(1).choice(np.flatnonzero(moved > 0.2), 12, replace=False).tolist()
    places = ada.evaluate(pose)[vertices]
    pins = tuple(
        Pin(v, as_vector(p.astype(float)), "screen", FRONT_AXES)
        for v, p in zip(vertices, places, strict=True)
    )
    control = ShapeControl.of(ada)
    locked = int(np.flatnonzero((pose > 0) & (meant == 0))[0])
    flags = np.zeros(ada.shape_count, np.bool_)
    flags[locked] = True
    control = ShapeControl(control.limits, flags, control.muted, control.solo, control.ties)
    found = tidied(ada, control, Pose(pose, pins), 1.0)
    assert found[locked] == pose[locked]
    assert np.count_nonzero(found) < np.count_nonzero(pose)
    gaps = np.linalg.norm((ada.evaluate(found)[vertices] - places)[:, :2], axis=1)
    assert gaps.max() <= 0.015 * ada.height


def test_a_clean_pose_stays_as_it_is(ada: Rig) -> None:
    clean = np.zeros(ada.shape_count)
    clean[ada.shape_names.index("jawOpen")] = 0.5
    np.testing.assert_array_equal(tidied(ada, ShapeControl.of(ada), Pose(clean), 0.5), clean)
    nothing = np.zeros(ada.shape_count)
    np.testing.assert_array_equal(tidied(ada, ShapeControl.of(ada), Pose(nothing), 0.5), nothing)


def test_it_is_shown_before_it_is_taken(ada: Rig) -> None:
    _, pose = messy(ada, 3)
    with running() as app:
        app.session.apply(Edit("Set", True, weights=pose))
        before = app.session.work
        app.ask(Command.TIDY)
        app.step(frames=2)
        assert app.session.in_gesture and app.session.committed is before
        shown = np.count_nonzero(app.session.pose.weights)
        assert shown < np.count_nonzero(pose)
        app.ask(Tidy(5.0))
        assert np.count_nonzero(app.session.pose.weights) <= shown
        app.ask(LeaveTidy())
        assert app.session.work is before and app.desk.view.tidy is None
        app.ask(Command.TIDY)
        app.step(frames=2)
        app.ask(TakeTidy())
        assert app.session.undo_label == "Tidy the pose"
        assert np.count_nonzero(app.session.committed.panes[0].pose.weights) == shown
        app.key("z", control=True)
        assert app.session.work is before


def test_the_command_tidies_and_refuses(ada: Rig, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, pose = messy(ada, 2)
    weights = {ada.shape_names[j]: float(pose[j]) for j in np.flatnonzero(pose)}
    (tmp_path / "messy.json").write_text(
        json.dumps({"format": "facepin-pose", "version": 1, "weights": weights})
    )
    words = ["tidy", "ada", "--pose", str(tmp_path / "messy.json"), "--out", str(tmp_path / "tidy.json")]
    assert main([*words, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["active"] <= told["active_before"] and told["moved_percent"] <= 1.7
    written = json.loads((tmp_path / "tidy.json").read_text())["weights"]
    assert sum(value != 0 for value in written.values()) < len(weights)
    assert main([*words, "--tolerance", "0"]) == 2
    assert "--tolerance 0" in capsys.readouterr().err
