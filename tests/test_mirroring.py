"""Left and right in the whole program."""

from dataclasses import replace

import numpy as np
import pytest

from driver import App, running
from facepin.panels.requests import Command, PairShapes
from facepin.session.edit import Edit


def pose(app: App, **weights: float) -> np.ndarray:
    names = app.session.rig.shape_names
    values = np.array([weights.get(name, 0.0) for name in names])
    app.desk.apply(Edit("Pose", True, weights=values))
    return values


def weight(app: App, name: str) -> float:
    return float(app.session.pose.weights[app.session.rig.shape_names.index(name)])


@pytest.fixture(scope="module")
def app() -> App:
    with running() as app:
        yield app


def test_flip_and_mirror_and_back(app: App) -> None:
    before = pose(app, mouthSmileLeft=0.8, eyeBlinkRight=0.3, jawOpen=0.4)
    app.key("m", control=True)
    assert (weight(app, "mouthSmileRight"), weight(app, "mouthSmileLeft")) == (0.8, 0.0)
    assert (weight(app, "eyeBlinkLeft"), weight(app, "jawOpen")) == (0.3, 0.4)
    assert app.session.undo_label == "Flip the pose"
    app.key("z", control=True)
    np.testing.assert_array_equal(app.session.pose.weights, before)
    app.key("m", shift=True)
    assert (weight(app, "mouthSmileRight"), weight(app, "eyeBlinkRight")) == (0.8, 0.0)
    app.key("z", control=True)
    app.ask(Command.MIRROR_RIGHT)
    assert (weight(app, "mouthSmileLeft"), weight(app, "eyeBlinkLeft")) == (0.0, 0.3)


def test_what_has_no_twin_is_left_alone_and_named(app: App) -> None:
    names = app.session.rig.shape_names
    app.ask(PairShapes(names.index("mouthSmileLeft"), None))
    pose(app, mouthSmileLeft=0.8, eyeBlinkLeft=0.5)
    app.ask(Command.FLIP_POSE)
    assert (weight(app, "mouthSmileLeft"), weight(app, "eyeBlinkRight")) == (0.8, 0.5)
    assert "mouthSmileLeft" in app.desk.message
    app.ask(PairShapes(names.index("mouthSmileLeft"), names.index("mouthSmileRight")))
    app.ask(Command.FLIP_POSE)
    assert weight(app, "mouthSmileRight") == 0.8


def test_locked_weights_are_not_mirrored(app: App) -> None:
    pose(app, mouthSmileLeft=0.8)
    control = app.session.control
    locked = np.array([name == "mouthSmileRight" for name in app.session.rig.shape_names])
    app.session.set_control("Lock", replace(control, locked=locked))
    app.ask(Command.MIRROR_LEFT)
    assert weight(app, "mouthSmileRight") == 0.0
    assert "mouthSmileRight" in app.desk.message
    app.session.set_control("Unlock", control)
