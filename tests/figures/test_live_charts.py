import csv
from pathlib import Path

import numpy as np

from facepin.figures.live import write_session_charts
from facepin.session.edit import Edit
from facepin.session.session import Session
from facepin.session.solving.solving import choose
from support.small_rigs import sheet


def test_what_the_panes_show_is_in_the_table_and_in_pictures(tmp_path: Path) -> None:
    rig = sheet()
    session = Session(rig, [choose("transpose"), choose("tikhonov")])
    session.apply(Edit("Set", True, weights=np.array([0.5, 0, 0.25, 0])))
    session.set_reference(np.array([1.0, 0, 0, 0.5]))
    write_session_charts(session, tmp_path / "charts")
    found = sorted(path.name for path in (tmp_path / "charts").iterdir())
    pictures = [f"{name}.{kind}" for name in ("errors", "sliders", "weights") for kind in ("png", "svg")]
    assert found == sorted([*pictures, "weights.csv"])
    header, *rows = csv.reader((tmp_path / "charts/weights.csv").read_text().splitlines())
    assert header == ["shape", "reference", "1 transpose", "2 tikhonov"]
    assert [row[0] for row in rows] == list(rig.shape_names)
    values = np.array([row[1:] for row in rows], float)
    np.testing.assert_array_equal(values, np.transpose([[1, 0, 0, 0.5], [0.5, 0, 0.25, 0], [0, 0, 0, 0]]))
