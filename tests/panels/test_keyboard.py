"""The keyboard map says what the keys and the mouse really do."""

import pytest
from imgui_bundle import imgui

from facepin.core.events import KeyPressed, PointerMoved
from facepin.panels.commands import Command, keys_of
from facepin.panels.help.keyboard import Section, height, in_columns, sections
from facepin.session.navigation import PRESETS
from support.driver import running


@pytest.mark.parametrize("habit", PRESETS)
def test_every_key_is_in_it(habit: str) -> None:
    shown = {key for section in sections(habit) for keys, _ in section.lines for key in keys}
    assert {key for command in Command for key in keys_of(command, habit)} <= shown


def test_the_mouse_is_that_of_the_habit() -> None:
    def gestures(habit: str) -> set[str]:
        (camera,) = (section for section in sections(habit) if section.title.startswith("Camera"))
        return {key for keys, _ in camera.lines for key in keys}

    assert gestures("maya") == {"Wheel", "Alt+Left drag", "Alt+Middle drag", "Alt+Right drag"}
    assert "Shift+Middle drag" in gestures("blender")
    assert "Left drag" in gestures("facepin") - gestures("blender")


def test_columns_keep_the_order_and_are_about_equally_long() -> None:
    found = [Section(str(at), (((), ""),) * lines) for at, lines in enumerate([5, 3, 4, 8, 2, 6])]
    columns = in_columns(found, 3)
    assert [section for column in columns for section in column] == found
    assert len(columns) == 3
    assert (
        max(height(column) for column in columns) <= height(found) / 3 + max(one.height for one in found) / 2
    )
    assert in_columns(found, 1) == [found]
    assert in_columns(found[:1], 3) == [found[:1]]


@pytest.mark.parametrize(("size", "scale"), [((1280, 720), 1.0), ((2560, 1440), 2.0)])
def test_it_fits_opens_with_a_question_mark_and_closes(size: tuple[int, int], scale: float) -> None:
    with running(size=size, scale=scale) as app:
        app.step(KeyPressed("?"), frames=4)
        window = imgui.internal.find_window_by_name("##keyboard")
        assert window is not None
        assert window.active
        assert window.scroll_max.y == 0
        assert window.size.x <= size[0]
        app.step(KeyPressed("?"), frames=3)
        assert not app.desk.view.keyboard
        app.step(KeyPressed("f1"), frames=3)
        assert app.desk.view.keyboard
        app.press(8, size[1] - 60)
        app.release(8, size[1] - 60)
        app.step(PointerMoved(9, 300), frames=2)
        assert not app.desk.view.keyboard


def test_a_question_mark_is_one_wherever_the_keyboard_has_it() -> None:
    import glfw  # not before the window has shared it with imgui

    from facepin.window.listener import Listener

    with running() as app:
        listener = Listener(glfw.get_current_context(), app.window._address, app.window._incoming)
        listener._on_char(None, ord("?"))
        app.step(frames=3)
        assert app.desk.view.keyboard
        listener._on_char(None, ord("ß"))
        app.step(frames=3)
        assert app.desk.view.keyboard
