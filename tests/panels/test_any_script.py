"""Whatever script a name is in and whatever signs: it is shown as it is, or the user is told why not."""

import os
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from imgui_bundle import imgui

from facepin.core.events import PointerMoved
from facepin.panels.commands import Command
from facepin.panels.plain_label import plain_label
from facepin.panels.theme import THEMES, apply_theme
from facepin.panels.weights.menu import found_twins
from facepin.system_fonts import fonts_for, own_letters
from facepin.window import Window
from support.driver import running
from support.small_rigs import sheet

NAMES = [
    "mouth##1",
    "mouth##2",
    "###x",
    "%s%n 50%",
    "a/b",
    "$smile$",
    "まばたき",
    "Улыбка",
    "あ",
    "眨眼",
    "ยิ้ม",
    "x",
]


@pytest.fixture(scope="module")
def rig(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("names") / "名前.npz"
    axis = np.linspace(-1, 1, 9)
    x, y = (side.ravel() for side in np.meshgrid(axis, axis))
    neutral = np.stack([x, y, 0.2 - 0.1 * (x**2 + y**2)], axis=1)
    corner = np.array([row * 9 + column for row in range(8) for column in range(8)])
    faces = np.stack([corner, corner + 1, corner + 10, corner + 9], axis=1)
    deltas = np.zeros((len(NAMES), 81, 3))
    deltas[np.arange(len(NAMES)), np.arange(len(NAMES)) * 6 + 3, 2] = 0.2
    np.savez(path, neutral=neutral, faces=faces, deltas=deltas, names=np.array(NAMES))
    return path


def test_labels_show_all_of_a_text_and_two_of_the_same_text_are_two_items() -> None:
    with Window("test", (64, 48), windowless=True) as window:
        apply_theme(THEMES["dark"], 1.0)
        window.begin_frame()
        for text in (*NAMES[:6], "####", "#"):
            label = plain_label(text, 7)
            shown = imgui.calc_text_size(label, hide_text_after_double_hash=True).x
            assert shown == imgui.calc_text_size(text).x, text
            assert imgui.get_id(label) == imgui.get_id(plain_label("another", 7))
            assert imgui.get_id(label) != imgui.get_id(plain_label(text, 8))
        window.end_frame()


def test_every_letter_of_a_rig_is_there_or_it_is_said_whose_is_not(rig: Path) -> None:
    with running(rig, size=(900, 600)) as app:
        names = app.session.rig.shape_names
        assert list(names) == NAMES
        letters = {ord(letter) for name in (*names, app.session.rig.name) for letter in name}
        font = imgui.get_io().fonts.fonts[0]
        without = {letter for letter in letters if not font.is_glyph_in_font(letter)}
        assert without == fonts_for(letters - own_letters())[1]
        assert bool(without) == app.desk.message.startswith("No font of this system has")


def test_a_rig_in_latin_letters_needs_no_font_of_the_system(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("facepin.panels.letters.fonts_for", lambda _: pytest.fail("looked for fonts"))
    with running() as app:
        app.desk.say("Größe 0,5 · naïve – “café”")
        app.step(PointerMoved(5, 5), frames=3)


def test_a_twin_is_found_among_many_by_some_words_of_its_name() -> None:
    small = replace(sheet(), shape_names=("mouth##1", "mouth##2", "###x", "眨眼"))
    assert found_twins(small, 0, "") == [1, 2, 3]
    assert found_twins(small, 0, "2 MOUTH") == [1]
    assert found_twins(small, 1, "mouth") == [0]
    assert found_twins(small, 0, "眨") == [3]
    assert found_twins(small, 0, "jaw") == []


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="names of files are text there")
def test_a_file_whose_name_is_no_text_is_listed_everywhere_and_opened_by_its_true_name(
    rig: Path, tmp_path: Path
) -> None:
    odd = Path(os.fsdecode(os.fsencode(tmp_path) + b"/caf\xe9.npz"))
    odd.write_bytes(rig.read_bytes())
    (tmp_path / "settings").mkdir()
    with running(odd, size=(900, 600), settings_folder=tmp_path / "settings") as app:
        assert app.session.rig.shape_count == len(NAMES)
        for command in (Command.PALETTE, Command.OPEN_FILE):
            app.ask(command)
            app.step(PointerMoved(5, 5), frames=4)
        assert app.desk.dialog is not None
        plain_label(odd.name, 0).encode()  # what imgui does
        app.desk.say(f"Saved {odd}")
        app.step(PointerMoved(6, 5), frames=3)
        assert not app.desk.is_error
