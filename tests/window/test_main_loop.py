"""When frames are drawn, and what the loop lives through."""

import time
from pathlib import Path

import pytest
from imgui_bundle import imgui

from facepin.core.events import CloseRequested, PointerMoved, Stirred
from facepin.window import Window
from support.driver import App, running


def drawn_within(app: App, seconds: float) -> int:
    """How many frames are drawn while nothing happens for so long."""
    until = time.monotonic() + seconds
    drawn = 0
    while time.monotonic() < until:
        app.step()
        drawn += app.frame.drawn
        time.sleep(0.005)
    return drawn


def test_a_mouse_that_rests_on_a_setting_is_told_what_it_is_and_then_all_is_quiet() -> None:
    with running() as app:
        app.step(PointerMoved(1000, 445), frames=2)  # a name in the weights panel
        drawn_within(app, 0.6)
        tooltip = imgui.internal.find_window_by_name("##Tooltip_00")
        assert tooltip is not None
        assert tooltip.active
        assert drawn_within(app, 1.0) == 0


def test_what_is_stirred_is_drawn() -> None:
    with running() as app:
        assert drawn_within(app, 0.5) == 0
        app.step(Stirred())
        assert app.frame.drawn


def test_a_minimised_window_waits_and_comes_back_or_is_closed(monkeypatch: pytest.MonkeyPatch) -> None:
    with running() as app:
        panels = app.frame.viewport
        with monkeypatch.context() as minimised:
            minimised.setattr(Window, "size", property(lambda _: (0, 0)))
            assert app.window.pixel_ratio == 1.0
            app.step(PointerMoved(5, 5), frames=3)
            assert not app.frame.drawn
        app.step(frames=2)
        assert app.frame.drawn
        assert app.frame.viewport == panels
        monkeypatch.setattr(Window, "size", property(lambda _: (0, 0)))
        with pytest.raises(StopIteration):
            app.step(CloseRequested())


def test_a_folder_that_keeps_nothing_does_not_stop_the_start(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    with running(settings_folder=tmp_path / "file" / "facepin") as app:
        assert app.session.rig.name == "ada"
        assert app.desk.is_error
        assert "Not a directory" in app.desk.message


def test_what_is_wrong_with_the_preferences_stays_to_be_read(tmp_path: Path) -> None:
    (tmp_path / "preferences.json").write_text("{ broken")
    with running(settings_folder=tmp_path) as app:
        assert "preferences" in app.desk.message
