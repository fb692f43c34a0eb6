"""Ctrl+C and Ctrl+V."""

import numpy as np
import pytest
from imgui_bundle import imgui

from facepin.panels.commands import Command
from facepin.panels.requests import CopyShapes, PasteShapes
from facepin.session.edit import Edit
from support.driver import App, running


def pose(app: App, **weights: float) -> np.ndarray:
    values = np.zeros(app.session.rig.shape_count)
    for name, weight in weights.items():
        values[app.session.rig.shape_names.index(name)] = weight
    app.session.apply(Edit("Set", True, weights=values))
    return values


def test_copy_and_paste_of_a_pose_and_of_a_region(monkeypatch: pytest.MonkeyPatch) -> None:
    held = [""]  # the clipboard of a system that has none
    monkeypatch.setattr(imgui, "set_clipboard_text", lambda text: held.__setitem__(0, text))
    monkeypatch.setattr(imgui, "get_clipboard_text", lambda: held[0])
    with running() as app:
        app.key("v", control=True)
        assert app.desk.is_error and "no text" in app.desk.message
        first = pose(app, jawOpen=0.4, browInnerUp=0.7)
        app.key("c", control=True)
        assert not app.desk.is_error
        app.ask(Command.RESET_POSE)
        app.key("v", control=True)
        np.testing.assert_array_equal(app.session.pose.weights, first)
        assert app.session.undo_label == "Paste the pose"

        brows = tuple(j for j, name in enumerate(app.session.rig.shape_names) if name.startswith("brow"))
        app.ask(CopyShapes("brows", brows))
        pose(app, jawOpen=0.9, browDownLeft=0.3)
        app.ask(Command.PASTE_POSE)
        expected = first.copy()
        expected[app.session.rig.shape_names.index("jawOpen")] = 0.9
        np.testing.assert_array_equal(app.session.pose.weights, expected)

        work = app.session.work
        app.ask(PasteShapes("jaw", (app.session.rig.shape_names.index("jawOpen"),)))
        assert app.desk.is_error and app.session.work is work, "nothing of the jaw was copied"
        held[0] = "what somebody wrote"
        app.key("v", control=True)
        assert app.desk.is_error and app.session.work is work
