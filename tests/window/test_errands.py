"""What is written beside the work holds nothing up, and is written whatever ends the window."""

from pathlib import Path
from threading import Event

import numpy as np
import pytest
from PIL import Image

from facepin.core.errors import FacepinError
from facepin.gpu.picture import png_bytes
from facepin.panels.commands import Command
from support.driver import running
from support.small_rigs import write_sheet


@pytest.fixture
def rig(tmp_path: Path) -> Path:
    return write_sheet(tmp_path / "sheet.npz")


def test_pictures_are_written_beside_the_work_one_after_the_other_and_at_the_end_too(
    rig: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    may_go_on = Event()

    def slow(image: np.ndarray) -> bytes:
        assert may_go_on.wait(30)
        return png_bytes(image)

    monkeypatch.setattr("facepin.desk.papers.png_bytes", slow)
    with running(rig, pictures=tmp_path / "shots", size=(300, 300)) as app:
        for _ in range(3):
            app.ask(Command.SCREENSHOT)
        app.step(frames=4)  # none of them waits
        assert app.desk.errands.busy and not (tmp_path / "shots").exists()
        may_go_on.set()
    pictures = sorted((tmp_path / "shots").iterdir())
    assert len(pictures) == 3
    for path in pictures:
        with Image.open(path) as picture:
            picture.load()


def test_a_picture_that_can_not_be_written_is_told(rig: Path, tmp_path: Path) -> None:
    (tmp_path / "taken").touch()
    with running(rig, pictures=tmp_path / "taken", size=(300, 300)) as app:
        app.ask(Command.SCREENSHOT)
        app.until(lambda: not app.desk.errands.busy)
        assert app.desk.is_error and "taken" in app.desk.message


def test_a_picture_that_can_not_be_written_at_the_end_is_told_there(rig: Path, tmp_path: Path) -> None:
    (tmp_path / "taken").touch()
    with (
        pytest.raises(FacepinError, match=r"Save picture: .*taken"),
        running(rig, pictures=tmp_path / "taken", size=(300, 300)) as app,
    ):
        app.ask(Command.SCREENSHOT)
