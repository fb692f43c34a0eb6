import os
import sys
import time
from pathlib import Path

import pytest

from facepin.panels.file_dialog import FileDialog, _typed_path


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
