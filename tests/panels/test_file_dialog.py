import os
import sys
import time
from pathlib import Path

import pytest
from imgui_bundle import imgui

from facepin.core.events import PointerMoved
from facepin.panels.commands import Command
from facepin.panels.file_dialog import FileDialog, _typed_path
from facepin.panels.folder_list import Entry, entries_of
from facepin.panels.theme import FONT_SIZE
from support.driver import running


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        (" /faces/a b.glb ", Path("/faces/a b.glb")),
        ("'/faces/a b.glb'", Path("/faces/a b.glb")),
        ("~/a.glb", Path.home() / "a.glb"),
        ("~nobody-of-that-name/a.glb", Path("~nobody-of-that-name/a.glb")),
    ],
)
def test_a_typed_path_is_what_was_meant(typed: str, meant: Path) -> None:
    assert _typed_path(typed) == meant


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="elsewhere no program shows the dialog")
def test_a_native_dialog_can_be_given_up_without_waiting_for_its_answer(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    helper = tmp_path / "zenity"
    helper.write_text("#!/bin/sh\nexec sleep 60\n")
    helper.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.setenv("DISPLAY", ":0")
    dialog = FileDialog("open file", "Open", tmp_path, ("All files", "*"), use_native=True)
    dialog.draw()
    assert not dialog.finished
    began = time.monotonic()
    dialog.close()
    del dialog
    assert time.monotonic() - began < 30  # not until the answer


def test_a_typed_path_that_leads_nowhere_can_be_mended(tmp_path: Path) -> None:
    dialog = FileDialog("open file", "Open", tmp_path, (), use_native=False)
    dialog._take(tmp_path / "face.glb")
    assert not dialog.finished
    assert "face.glb" in dialog._remark
    (tmp_path / "face.glb").touch()
    dialog._take(tmp_path / "face.glb")
    assert dialog.path == tmp_path / "face.glb"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name in ("b.glb", "A.NPZ", "notes.txt", ".hidden.glb", "x##1.glb", "笑.glb"):
        (tmp_path / name).touch()
    (tmp_path / "sub").mkdir()
    return tmp_path


FILTERS = ("Faces", "*.glb *.npz *.obj", "All files", "*")


def test_a_folder_lists_its_folders_and_the_files_that_fit(folder: Path) -> None:
    labels = [entry.label for entry in entries_of(folder, ("*.glb", "*.npz"))]
    assert labels == ["sub/", "A.NPZ", "b.glb", "x##1.glb", "笑.glb"]
    assert [entry.label for entry in entries_of(folder, ())] == ["sub/"]
    with pytest.raises(OSError):
        entries_of(folder / "gone", ("*",))


def test_the_list_follows_what_is_typed_and_a_click_writes_the_path(folder: Path) -> None:
    dialog = FileDialog("open file", "Open", folder / "sub", FILTERS, use_native=False)
    assert dialog._folder() == folder / "sub"
    dialog._typed = str(folder / "half a na")
    assert dialog._folder() == folder
    dialog._click(Entry(folder / "b.glb", False), "once")
    assert dialog._typed == str(folder / "b.glb") and not dialog.finished
    dialog._click(Entry(folder / "sub", True), "once")
    assert dialog._folder() == folder / "sub"
    dialog._click(Entry(folder / "b.glb", False), "twice")
    assert dialog.path == folder / "b.glb"


def test_a_folder_is_entered_unless_it_is_a_face_of_obj_files(folder: Path) -> None:
    dialog = FileDialog("open file", "Open", folder, FILTERS, use_native=False)
    dialog._take(folder / "sub")
    assert not dialog.finished and dialog._folder() == folder / "sub"
    (folder / "sub" / "neutral.OBJ").touch()
    dialog._take(folder / "sub")
    assert dialog.path == folder / "sub"


def test_saving_keeps_the_new_name_in_another_folder_and_never_replaces_a_folder(folder: Path) -> None:
    dialog = FileDialog("save file", "Save", folder / "new.json", ("Poses", "*.json"), use_native=False)
    dialog._click(Entry(folder / "sub", True), "once")
    assert dialog._typed == str(folder / "sub" / "new.json")
    for _ in range(2):
        dialog._take(folder / "sub")
        assert not dialog.finished
    dialog._take(folder / "sub" / "new")
    assert dialog.path == folder / "sub" / "new.json"


@pytest.mark.parametrize(("size", "scale"), [((1280, 720), 1.0), ((1280, 720), 2.0), ((500, 300), 1.0)])
def test_the_browser_fits_the_window_listens_and_opens_what_is_clicked_twice(
    folder: Path, size: tuple[int, int], scale: float
) -> None:
    with running(size=size, scale=scale) as app:
        imgui.get_io().mouse_single_click_delay = 11
        imgui.get_io().mouse_double_click_time = 10  # a slow machine is not a slow hand
        answers: list[Path] = []
        app.desk.ask("open file", Command.OPEN_FILE, folder, FILTERS, answers.append)
        app.step(PointerMoved(5, 5), frames=6)
        assert app.desk.title.startswith("Open file - ")
        window = imgui.internal.find_window_by_name("##path")
        area = imgui.get_main_viewport().size
        assert window.pos.x >= 0 and window.pos.x + window.size.x <= area.x
        assert window.pos.y >= 0 and window.pos.y + window.size.y <= area.y
        rows = next(w for w in window.dc.child_windows if "folder" in w.name)
        line = imgui.get_style().item_spacing.y + FONT_SIZE * scale
        y = rows.pos.y + imgui.get_style().window_padding.y + 3.4 * line  # ../, sub/, A.NPZ, b.glb
        for _ in range(2):
            app.press(rows.pos.x + 40, y)
            app.release(rows.pos.x + 40, y)
        app.until(lambda: bool(answers))
        assert answers == [folder / "b.glb"]
