"""A folder of shapes in which nothing says which file is the face at rest."""

from pathlib import Path

import numpy as np
import pytest

from facepin.panels.requests import CancelLoading, OpenPath, UseNeutral
from support.driver import running
from support.sample_files import POSITIONS, obj_lines


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    folder = tmp_path / "walk"
    folder.mkdir()
    for number in (1, 2, 10):
        points = POSITIONS + np.float32(0.1 * number)
        (folder / f"head-{number:02}.obj").write_text(obj_lines(points, "f 1 2 3 4\n"))
    return folder


def test_a_card_asks_for_the_neutral_and_opens_with_it(folder: Path, tmp_path: Path) -> None:
    with running(folder, settings_folder=tmp_path / "settings", wait=False) as app:
        app.until(lambda: app.desk.opener.unclear is not None)
        app.step(frames=3)
        assert not app.desk.is_error
        assert app.desk.opener.unclear is not None
        assert app.desk.opener.unclear.likely == "head-01.obj"
        app.ask(UseNeutral("head-02.obj"))
        app.until(lambda: app.desk.session is not None)
        assert app.session.rig.shape_names == ("head-01", "head-10")
        assert app.desk.opener.unclear is None
        app.ask(OpenPath(folder))
        app.until(lambda: app.desk.opener.unclear is not None)
        app.ask(CancelLoading())
        app.step(frames=2)
        assert app.desk.opener.unclear is None
        assert app.session.rig.shape_names == ("head-01", "head-10"), "what was open stays so"
