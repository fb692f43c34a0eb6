"""The weights panel under a real mouse's habits: a button stays down for several frames."""

import numpy as np
import pytest
from imgui_bundle import imgui

from driver import App, running
from facepin.core.events import PointerMoved, PointerPressed, PointerReleased
from facepin.session.edit import Edit


def click(app: App, x: float, y: float) -> None:
    app.step(PointerPressed(x, y))
    app.step(PointerMoved(x, y), frames=3)
    app.step(PointerReleased(x, y), frames=3)


def test_a_double_click_on_a_slider_or_on_its_name_resets_it_for_good() -> None:
    slider, name, y = 1180.0, 990.0, 445.0
    for at in (slider, name):
        with running() as app:
            imgui.get_io().mouse_single_click_delay = 11
            imgui.get_io().mouse_double_click_time = 10  # a slow machine is not a slow hand
            weights = app.session.pose.weights.copy()
            weights[:] = 0.6
            app.session.apply(Edit("Set", True, weights=weights))
            app.step(PointerMoved(at, y), frames=3)
            click(app, at, y)
            click(app, at, y)
            (reset,) = np.flatnonzero(app.session.pose.weights != weights)
            assert app.session.pose.weights[reset] == 0
            assert app.session.undo_label == f"Reset {app.session.rig.shape_names[reset]}"
            assert not app.session.in_gesture


def test_a_hand_stops_at_the_tie_and_a_loaded_weight_beyond_it_stays() -> None:
    with running() as app:
        rig = app.session.rig
        close, jaw = rig.ties[0]
        weights = app.session.pose.weights.copy()
        weights[jaw] = 0.4
        app.session.apply(Edit("Set", True, weights=weights))
        app.desk.view.weights.search = "mouthclose"
        row = 421.0
        app.step(PointerMoved(1110.0, row), frames=3)
        app.drag((1110.0, row), (1250.0, row), moves=5)
        assert app.session.pose.weights[close] == pytest.approx(0.4)
        assert app.session.undo_label == "Set mouthClose"
        weights = app.session.pose.weights.copy()
        weights[close] = 0.9
        app.session.apply(Edit("Load", True, weights=weights))
        app.step(PointerMoved(1200.0, row), frames=3)
        assert app.session.pose.weights[close] == 0.9
