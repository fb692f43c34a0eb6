"""What is run on a machine without a screen."""

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import facepin.figures.demonstration
import facepin.gpu.picture
import facepin.window
from facepin.__main__ import main
from facepin.core.errors import FacepinError
from facepin.figures.demonstration import delight, demonstrate
from facepin.figures.posing import DELIGHT
from facepin.files.work.pose_file import read_pose
from facepin.options import open_with_bar
from facepin.resources import BUILTIN, resource
from facepin.solvers import SOLVERS
from facepin.window import NoDisplay


def test_pins_sit_at_chin_mouth_corners_and_brow() -> None:
    rig = open_with_bar(None)
    comparison = delight(rig)
    places = {
        name: (rig.neutral[pin.vertex], np.subtract(pin.goal, rig.neutral[pin.vertex]))
        for name, pin in zip(sorted(DELIGHT, key=rig.shape_names.index), comparison.start.pins, strict=True)
    }
    size = rig.height
    brow, chin = places["browInnerUp"], places["jawOpen"]
    left, right = places["mouthSmileLeft"], places["mouthSmileRight"]
    assert brow[0][1] > left[0][1] > chin[0][1]
    assert left[0][0] > 0.03 * size and right[0][0] < -0.03 * size and abs(chin[0][0]) < 0.03 * size
    assert brow[1][1] > 0 and chin[1][1] < 0
    assert left[1][0] > 0 > right[1][0]
    assert all(place[2] > 0 for place, _ in places.values())


def test_it_leaves_pictures_charts_numbers_and_a_pose_of_every_solver(tmp_path: Path) -> None:
    folder = demonstrate(tmp_path / "shown")
    assert folder == tmp_path / "shown"
    rig = open_with_bar(None)
    figures = json.loads((folder / "figures.json").read_text())
    assert list(figures["solvers"]) == list(SOLVERS)
    for key in SOLVERS:
        assert read_pose(folder / f"pose-{key}.json", rig)[1] == ""
    with Image.open(folder / "comparison.png") as picture:
        picture.load()
        assert picture.width > 1600
    for chart in ("sliders", "weights", "errors"):
        assert (folder / f"{chart}.png").is_file() and (folder / f"{chart}.svg").is_file()


def test_without_opengl_it_says_so_in_a_line_and_writes_the_rest(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def none() -> None:
        raise FacepinError("no OpenGL 3.3 on this machine")

    monkeypatch.setattr(facepin.gpu.picture, "open_context", none)
    monkeypatch.setattr(facepin.figures.demonstration, "SOLVERS", ("transpose",))
    folder = demonstrate(tmp_path)
    (line,) = capsys.readouterr().err.splitlines()
    assert line == "facepin: pictures of the face are left out: no OpenGL 3.3 on this machine"
    assert not (folder / "comparison.png").exists()
    assert (folder / "sliders.png").is_file() and (folder / "pose-transpose.json").is_file()


def test_a_folder_that_cannot_be_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(FacepinError, match="cannot be made a folder"):
        demonstrate(tmp_path / "file")


@pytest.mark.parametrize("words", [["--pins", "none.json"], ["--compare", "sparse,hybrid"], ["RIG"]])
def test_what_the_demonstration_would_not_show_is_refused_without_a_screen(
    words: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    def none(*_: object) -> None:
        raise NoDisplay("there is no display")

    monkeypatch.setattr(facepin.window, "Window", none)
    monkeypatch.chdir(tmp_path)
    rig = resource("assets", BUILTIN)
    assert main([str(rig) if word == "RIG" else word for word in words]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "no display" in error and "render" in error
    assert not list(tmp_path.iterdir())
