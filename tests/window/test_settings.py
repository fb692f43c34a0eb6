"""What is chosen in the menu Settings is followed at once, and remembered."""

import json
import os
from pathlib import Path
from typing import get_args

import numpy as np
import pytest
from PIL import Image

from facepin.core.events import CloseRequested, KeyPressed, PointerMoved
from facepin.files.work import preferences
from facepin.files.work.preferences import read_preferences
from facepin.main_loop import ICON_SIZES
from facepin.panels import theme
from facepin.panels.commands import Command
from facepin.panels.help.palette import entries
from facepin.panels.requests import Choose, OpenPath
from facepin.panels.theme import THEMES
from facepin.resources import resource
from facepin.session import navigation
from support.driver import running
from support.small_rigs import write_sheet


def test_theme_and_habit_are_remembered(tmp_path: Path) -> None:
    with running(settings_folder=tmp_path) as app:
        dark = app.screenshot()
        for choice in (Choose("theme_name", "light"), Choose("habit", "blender")):
            app.ask(choice)
        app.step(PointerMoved(5, 5), frames=4)
        light = app.screenshot()
        panel = np.round(255 * np.array(THEMES["light"].panel[:3]))
        np.testing.assert_allclose(light[320, 1000], panel, atol=1)
        assert dark[320, 1000].max() < 60 < light[320, 1000].min()
        # The studio wall is the same in both: colours of a face are judged before the same ground.
        np.testing.assert_array_equal(light[300, 100], dark[300, 100])
    with running(settings_folder=tmp_path) as app:
        assert app.desk.view.theme_name == "light"
        assert app.desk.view.habit == "blender"
        np.testing.assert_allclose(app.screenshot()[320, 1000], panel, atol=1)


def test_a_habit_changes_mouse_and_keys_at_once() -> None:
    with running() as app:
        beside = (60.0, 600.0)
        before = app.desk.camera
        app.ask(Choose("habit", "maya"))
        app.drag(beside, (100.0, 600.0))
        assert app.desk.camera == before
        app.drag(beside, (100.0, 600.0), alt=True)
        assert app.desk.camera.yaw != before.yaw
        app.step(KeyPressed("a"), frames=2)
        assert app.desk.camera.distance < before.distance  # the face without its bust
        app.ask(Choose("habit", "blender"))
        turned = app.desk.camera
        app.drag(beside, (100.0, 600.0), "middle")
        assert app.desk.camera.yaw != turned.yaw


@pytest.mark.parametrize("habit", ["maya", "blender"])
def test_where_the_left_button_is_not_the_camera_s_it_selects_in_a_box(habit: str) -> None:
    with running() as app:
        app.ask(Choose("habit", habit))
        x, y, z = app.session.rig.neutral.T
        chin = app.pixel_of(int(np.argmin(np.abs(x) + np.abs(y - np.median(y[z > 0.9 * z.max()])) - z)))
        app.press(*chin)
        app.release(*chin)
        (pin,) = app.session.pose.pins
        camera = app.desk.camera
        app.press(60, 600)
        app.release(60, 600)
        assert not app.desk.tool.selected  # a click beside the face lets go of all
        app.drag((60, 600), (900, 100))
        assert app.desk.tool.selected == {pin.vertex}
        assert app.desk.camera is camera


def test_preferences_know_the_same_themes_and_habits() -> None:
    assert set(get_args(preferences.Theme)) == set(get_args(theme.ThemeName)) == set(THEMES)
    assert set(get_args(preferences.Habit)) == set(get_args(navigation.Habit)) == set(navigation.PRESETS)


def test_what_makes_no_sense_in_the_preferences_is_replaced(tmp_path: Path) -> None:
    file = tmp_path / "preferences.json"
    file.write_text('{"theme": "pink", "habit": 3, "guide": true, "lately": [1], "ui_scale": 1.5}')
    found, line = preferences.read_preferences(file)
    assert found == preferences.Preferences(ui_scale=1.5)
    assert line is not None
    for name in ("theme", "habit", "guide", "lately"):
        assert name in line


def test_the_window_and_the_order_of_the_weights_are_found_again(tmp_path: Path) -> None:
    with running(settings_folder=tmp_path, size=(900, 640)) as app:
        app.window.resize((1000, 700))
        app.desk.view.weights.arrangement = "by side"
        app.step(PointerMoved(5, 5), frames=3)
        with pytest.raises(StopIteration):
            app.step(CloseRequested(), frames=3)
    found, line = preferences.read_preferences(tmp_path / "preferences.json")
    assert line is None
    assert found.window == (1000, 700)
    with running(settings_folder=tmp_path) as app:
        assert app.desk.view.weights.arrangement == "by side"


@pytest.mark.parametrize("window", [[10, 700], [1e3, 700.5], ["a", "b"], [900], 900, [True, 700]])
def test_a_window_that_nobody_can_use_is_not_opened(window: object, tmp_path: Path) -> None:
    (tmp_path / "preferences.json").write_text(json.dumps({"window": window}))
    found, line = preferences.read_preferences(tmp_path / "preferences.json")
    assert found.window == (1280, 720)
    assert line is not None and "window" in line


def test_help_works_before_a_face_is_open(tmp_path: Path) -> None:
    (tmp_path / "broken.npz").write_text("no rig")
    with running(tmp_path / "broken.npz") as app:
        assert app.desk.stage is None
        for command in (Command.PALETTE, Command.KEYBOARD, Command.ABOUT):
            app.ask(command)
            app.step(PointerMoved(5, 5), frames=3)
        assert app.desk.view.about


@pytest.mark.parametrize("size", ICON_SIZES)
def test_the_icon_is_there_in_every_size(size: int) -> None:
    picture = Image.open(resource("assets", f"icon/facepin-{size}.png"))
    assert picture.size == (size, size)
    pixels = np.asarray(picture.convert("RGBA"), np.int64)
    assert pixels[0, 0, 3] < 10  # round corners
    red, _, blue, _ = pixels.reshape(-1, 4).T
    assert 0.01 < np.mean(red - blue > 120) < 0.2  # the orange pin


def test_the_number_pad_steps_round_the_face() -> None:
    with running() as app:
        front = app.desk.camera
        app.key("numpad 6")
        app.key("numpad 8")
        assert app.desk.camera.yaw > front.yaw  # from the right of the picture: the character's left side
        assert app.desk.camera.pitch > front.pitch
        app.key("numpad 4")
        app.key("numpad 2")
        assert app.desk.camera.yaw == pytest.approx(front.yaw)
        assert app.desk.camera.pitch == pytest.approx(front.pitch)
        app.key("1", control=True)
        assert abs(app.desk.camera.yaw) == pytest.approx(np.pi)


def test_a_file_whose_name_is_no_text_is_opened_shown_and_found_again(tmp_path: Path) -> None:
    rig = Path(os.fsdecode(bytes(tmp_path) + b"/caf\xe9.npz"))
    try:
        write_sheet(rig)
    except (OSError, UnicodeError):
        pytest.skip("this system has no such names")
    settings = tmp_path / "settings"
    with running(rig, size=(900, 600), settings_folder=settings, wait=False) as app:
        app.until(lambda: app.desk.stage is not None)
        app.step(frames=3)
        app.ask(Command.SAVE_AS)
        app.step(frames=3)
        assert app.desk.dialog is not None
        scene = rig.with_suffix(".facepin")
        app.desk.dialog._finish(scene)
        app.step(frames=3)
        assert "\ufffd.facepin" in app.desk.message
    assert {os.fsencode(rig.name), os.fsencode(scene.name)} <= {
        os.fsencode(path.name) for path in tmp_path.iterdir()
    }
    recent = [Path(path) for path in read_preferences(settings / "preferences.json")[0].recent]
    assert recent == [scene, rig] and all(path.exists() for path in recent)
    with running(scene, size=(900, 600), settings_folder=settings, wait=False) as app:
        app.until(lambda: app.desk.stage is not None)
        app.ask(Command.PALETTE)
        app.step(frames=4)
        (entry,) = [each for each in entries(app.desk.view, app.session, [rig]) if each.topic == "Recent"]
        assert entry.title == "Open caf\ufffd.npz" and entry.request == OpenPath(rig)
        app.ask(Command.OPEN_FILE)
        app.step(frames=3)
