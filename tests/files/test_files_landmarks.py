"""Landmarks as files."""

import json
from pathlib import Path

import pytest

from facepin.core.errors import FacepinError
from facepin.core.pose import Pin
from facepin.files.work.landmarks_file import read_landmarks, write_landmarks
from support.small_rigs import sheet

RIG = sheet()
HERE = (0.0, 0.0, 0.0)


def document(**changes: object) -> str:
    whole = {
        "format": "facepin-landmarks",
        "version": 1,
        "rig": {"name": "sheet", "vertices": 81},
        "landmarks": [{"name": "chin", "vertex": 7}, {"name": "nose", "vertex": 80}],
    }
    return json.dumps(whole | changes)


def test_names_come_back_with_their_vertices_and_pins_without_a_name_do_not(tmp_path: Path) -> None:
    path = tmp_path / "sheet.landmarks.json"
    pins = (Pin(7, HERE, name="chin"), Pin(8, HERE), Pin(3, HERE, name="Ohr – links", locked=True))
    assert write_landmarks(path, RIG, pins) == 2
    assert read_landmarks(path, RIG) == {"chin": 7, "Ohr – links": 3}
    assert json.loads(path.read_text(encoding="utf-8"))["rig"] == {"name": "sheet", "vertices": 81}


def test_what_is_no_landmark_is_not_written(tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    with pytest.raises(FacepinError, match="no pin has a name"):
        write_landmarks(path, RIG, (Pin(7, HERE),))
    with pytest.raises(FacepinError, match="2 pins share 1 names"):
        write_landmarks(path, RIG, (Pin(7, HERE, name="a"), Pin(8, HERE, name="a")))
    assert not path.exists()


def test_a_whole_file_is_read(tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    path.write_text(document(later="something"))
    assert read_landmarks(path, RIG) == {"chin": 7, "nose": 80}


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[", "not JSON"),
        ('{"weights": {}}', "format is missing"),
        (document(format="facepin-pose"), "format is 'facepin-pose'"),
        (document(version=2), "newer Facepin"),
        (document(rig={"vertices": 26719}), "for a mesh of 26,719 vertices, sheet has 81"),
        (document(rig={}), "vertices is missing"),
        (document(landmarks=[]), "one landmark or more"),
        (document(landmarks=[{"name": "a", "vertex": 81}]), r"landmarks\[0\].vertex is 81"),
        (document(landmarks=[{"name": "", "vertex": 1}]), r"landmarks\[0\].name"),
        (document(landmarks=[{"name": "a\nb", "vertex": 1}]), r"landmarks\[0\].name"),
        (document(landmarks=[{"name": "a" * 81, "vertex": 1}]), r"landmarks\[0\].name"),
        (document(landmarks=[{"vertex": 1}]), r"landmarks\[0\].name is missing"),
        (document(landmarks=[{"name": "a", "vertex": 1}, {"name": "a", "vertex": 2}]), r"\[1\].name"),
        (document(landmarks=[{"name": "a", "vertex": 1}, {"name": "b", "vertex": 1}]), r"\[1\].vertex"),
    ],
)
def test_what_is_wrong_is_said_in_one_line(tmp_path: Path, text: str, words: str) -> None:
    path = tmp_path / "bad.json"
    path.write_text(text)
    with pytest.raises(FacepinError, match=words) as error:
        read_landmarks(path, RIG)
    assert "bad.json" in str(error.value)
    assert "\n" not in str(error.value)
