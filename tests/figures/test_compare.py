"""`facepin compare`: its numbers recomputed from the arrays alone, and its files."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facepin.__main__ import main
from facepin.core.look.face_view import face_camera
from facepin.core.pose import Pin, Pose
from facepin.core.rig import Rig
from facepin.figures.compare import comparison_panes
from facepin.figures.comparison import FAR, compare
from facepin.figures.pictures import Painter
from facepin.files.work.pins_file import write_pins
from facepin.files.work.pose_file import read_pose, write_pose
from facepin.session.solving.solving import choose
from facepin.sheets import Pane, sheet
from facepin.solvers import SOLVERS
from support.small_rigs import sheet as sheet_rig

RIG = sheet_rig(shapes=6)
SIZE = (96, 112)
MEANT = np.array([0.7, 0.0, 0.4, 0.0, 0.0, 0.0])
VERTICES = (30, 40, 52)


def dense(rig: Rig) -> np.ndarray:
    """B as (3n, k) float64."""
    return rig.deltas.toarray().astype(float)


def pins() -> tuple[Pin, ...]:
    """Pins near where `MEANT` has them, but not within reach."""
    wanted = RIG.neutral.astype(float) + (dense(RIG) @ MEANT).reshape(-1, 3) + [0.01, 0.02, -0.015]
    return tuple(Pin(vertex, tuple(wanted[vertex].tolist())) for vertex in VERTICES)


def save(folder: Path, rig: Rig = RIG) -> Path:
    """Write rig, pins and reference as files; return the path of the rig."""
    deltas = dense(rig).T.reshape(rig.shape_count, -1, 3)
    faces = rig.corners.reshape(-1, 4)
    np.savez(folder / "rig.npz", neutral=rig.neutral, faces=faces, deltas=deltas, names=rig.shape_names)
    write_pins(folder / "pins.json", pins())
    write_pose(folder / "meant.json", rig, Pose(MEANT))
    return folder / "rig.npz"


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder that the command writes, with all solvers and a reference."""
    folder = tmp_path_factory.mktemp("compare")
    rig = save(folder)
    arguments = [str(rig), "--pins", str(folder / "pins.json"), "--reference", str(folder / "meant.json")]
    assert main(["compare", *arguments, "--size", "96x112", "--out", str(folder / "out")]) == 0
    return folder / "out"


def table(folder: Path) -> dict[str, np.ndarray]:
    """The columns of weights.csv by heading."""
    head, *rows = csv.reader((folder / "weights.csv").read_text().splitlines())
    assert [row[0] for row in rows] == list(RIG.shape_names)
    return {name: np.array([float(row[at]) for row in rows]) for at, name in enumerate(head) if at > 0}


def test_weights_are_those_of_the_papers_formulas(made: Path) -> None:
    found = table(made)
    assert list(found) == ["reference", *SOLVERS]
    rows = np.concatenate([dense(RIG)[3 * vertex : 3 * vertex + 3] for vertex in VERTICES])
    rest = RIG.neutral[list(VERTICES)].astype(float)
    moved = (np.array([pin.goal for pin in pins()]) - rest).ravel()
    gradient = rows.T @ moved
    transpose = gradient * (gradient @ gradient) / (rows @ gradient @ rows @ gradient)
    square = rows.T @ rows + 0.001 * np.eye(RIG.shape_count)
    np.testing.assert_allclose(found["reference"], MEANT, atol=1e-12)
    np.testing.assert_allclose(found["pseudo_inverse"], np.linalg.pinv(rows) @ moved, atol=1e-6)
    np.testing.assert_allclose(found["tikhonov"], np.linalg.solve(square, gradient), atol=1e-6)
    np.testing.assert_allclose(found["transpose"], transpose, atol=1e-6)


def test_figures_are_those_of_the_weights(made: Path) -> None:
    figures = json.loads((made / "figures.json").read_text())
    assert figures["rig"] == {"name": "rig", "vertices": 81, "shapes": 6, "height": pytest.approx(2.0)}
    assert figures["pins"] == 3
    columns = table(made)
    neutral = RIG.neutral.astype(float)

    def posed(weights: np.ndarray) -> np.ndarray:
        return neutral + (dense(RIG) @ weights).reshape(-1, 3)

    meant = posed(MEANT)
    rests = np.linalg.norm(meant - neutral, axis=1) < 0.001 * 2.0
    assert 0 < rests.sum() < 81
    for key in SOLVERS:
        entry, weights = figures["solvers"][key], columns[key]
        positions = posed(weights)
        misses = [np.linalg.norm(positions[pin.vertex] - pin.goal) for pin in pins()]
        strays = np.linalg.norm(positions - neutral, axis=1)[rests]
        assert entry["pin_error"] == pytest.approx(np.mean(misses), abs=1e-6)
        assert entry["pin_error_percent"] == pytest.approx(100 * np.mean(misses) / 2.0, abs=1e-4)
        assert entry["far_motion"] == pytest.approx(strays.max(), abs=1e-6)
        assert entry["e_rms"] == pytest.approx(np.sqrt(np.mean((weights - MEANT) ** 2)))
        gaps = np.linalg.norm(positions - meant, axis=1)
        assert entry["vertex_error_percent"] == pytest.approx(50 * gaps.mean(), abs=1e-4)
        assert entry["out_of_range"] == ((weights < -1e-6) | (weights > 1 + 1e-6)).sum()
        assert entry["active"] == (np.abs(weights) > 0.05).sum()
        assert entry["milliseconds"] > 0
    assert figures["solvers"]["tikhonov"]["settings"] == {"alpha": 0.001, "relative": False, "limits": False}


def test_without_a_reference_what_is_far_from_all_pins_should_rest() -> None:
    comparison = compare(RIG, [choose("transpose")], Pose(np.zeros(6), pins()))
    (answer,) = comparison.answers
    assert answer.e_rms is None and answer.vertex_error is None
    gaps = np.linalg.norm(RIG.neutral[:, None] - RIG.neutral[list(VERTICES)], axis=2).min(axis=1)
    strays = np.linalg.norm((dense(RIG) @ answer.weights).reshape(-1, 3), axis=1)[gaps > FAR * 2.0]
    assert answer.far_motion == pytest.approx(strays.max(), abs=1e-6)


def test_a_drag_begins_at_the_start_and_motion_is_counted_from_there() -> None:
    start = Pose(MEANT, tuple(Pin(vertex, tuple(place)) for vertex, place in zip(
        VERTICES, RIG.evaluate(MEANT)[list(VERTICES)].tolist(), strict=True
    )))  # fmt: skip
    comparison = compare(RIG, [choose(key) for key in SOLVERS], start)
    for answer in comparison.answers:
        np.testing.assert_allclose(answer.weights, MEANT, atol=1e-5)
        assert answer.far_motion < 1e-4


def test_poses_and_pins_are_written_to_be_read_again(made: Path) -> None:
    columns = table(made)
    for key in SOLVERS:
        pose, report = read_pose(made / f"pose-{key}.json", RIG)
        assert report == ""
        np.testing.assert_array_equal(pose.weights, columns[key])
        assert [pin.vertex for pin in pose.pins] == list(VERTICES)
    assert json.loads((made / "pins.json").read_text())["pins"][0]["vertex"] == VERTICES[0]


def test_pictures_are_whole_and_as_large_as_asked(made: Path) -> None:
    charts = {f"{name}.{kind}" for name in ("sliders", "weights", "errors") for kind in ("png", "svg")}
    assert charts <= {path.name for path in made.iterdir()}
    for path in made.glob("*.png"):
        with Image.open(path) as picture:
            picture.load()
            assert np.ptp(np.asarray(picture)) > 100
    for name in ("comparison", "motion"):
        assert (made / f"{name}.png").is_file()
    with Image.open(made / "comparison.png") as picture:
        assert picture.width > 4 * SIZE[0] and picture.height > 2 * SIZE[1]
        assert picture.getpixel((0, 0)) == (255, 255, 255)


def test_the_same_files_but_for_times_come_from_the_same_pins(made: Path, tmp_path: Path) -> None:
    rig = save(tmp_path)
    arguments = [str(rig), "--pins", str(tmp_path / "pins.json"), "--reference", str(tmp_path / "meant.json")]
    assert main(["compare", *arguments, "--size", "96x112", "--out", str(tmp_path / "again")]) == 0
    for path in made.iterdir():
        if path.name not in ("comparison.png", "figures.json"):
            assert (tmp_path / "again" / path.name).read_bytes() == path.read_bytes(), path.name


def test_panes_show_pose_pins_and_measures() -> None:
    from facepin.gpu.picture import open_context

    comparison = compare(RIG, [choose("tikhonov")], Pose(np.zeros(6), pins()))
    with open_context() as ctx:
        painter = Painter(ctx, RIG, SIZE)
        start, solved = comparison_panes(comparison, painter, timed=False)
        bare = painter.paint(comparison.answers[0].positions)
        painter.release()
    assert (start.title, start.subtitle) == ("Start", "3 pins and their goals")
    assert (solved.title, solved.subtitle) == ("Smoothed (Tikhonov)", "α 0.001")
    assert solved.image.shape == (SIZE[1], SIZE[0], 4)
    changed = np.abs(solved.image.astype(int) - bare).max(axis=2) > 60
    where = painter.camera.project(comparison.answers[0].positions[list(VERTICES)], _whole())[:, :2]
    assert all(changed[round(y), round(x)] or changed[round(y), round(x) + 2] for x, y in where)
    assert solved.lines[0].startswith("pin error") and "ms" not in "".join(solved.lines)


def test_motion_is_grey_at_rest_and_coloured_by_length() -> None:
    from facepin.gpu.picture import open_context

    with open_context() as ctx:
        painter = Painter(ctx, RIG, SIZE)
        rest, little, much = (
            painter.paint(RIG.neutral, moved=np.full(81, share * 2.0)).astype(int)
            for share in (0, 0.02, 0.05)
        )
        painter.release()

    def spread(image: np.ndarray) -> int:
        return int(np.ptp(image[SIZE[1] // 2, SIZE[0] // 2, :3]))

    assert spread(rest) < 20 < spread(little)
    assert much[..., :3].sum() > little[..., :3].sum() > rest[..., :3].sum()


def _whole() -> object:
    from facepin.core.look.camera import Viewport

    return Viewport(0, 0, *SIZE)


def test_a_sheet_sets_panes_in_rows_and_never_writes_over_them() -> None:
    image = np.full((60, 50, 4), (200, 0, 0, 255), np.uint8)
    panes = [Pane(image, "A title that is far too long", "a subtitle as well", ("one", "two"))] * 3
    one, two = sheet(panes, 3), sheet(panes, 2)
    red = (one == (200, 0, 0)).all(axis=2)
    assert red.sum() == 3 * 60 * 50
    assert (two == (200, 0, 0)).all(axis=2).sum() == 3 * 60 * 50
    assert one.shape[1] > two.shape[1] and one.shape[0] < two.shape[0]


def test_the_camera_looks_at_what_expressions_move() -> None:
    moved = np.abs(dense(RIG)).sum(axis=1).reshape(-1, 3).sum(axis=1) > 0
    camera = face_camera(RIG, SIZE, "front")
    x, y, _ = camera.project(RIG.neutral[moved], _whole()).T
    assert x.min() > 0 and x.max() < SIZE[0] and y.min() > 0 and y.max() < SIZE[1]


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["--solvers", "magic"], "no solver 'magic'"),
        (["--pins", "nowhere.json"], "nowhere.json"),
        (["--pins", "empty.json"], "no pin in it"),
        (["--reference", "nowhere.json"], "nowhere.json"),
        (["--size", "12"], "found '12'"),
        (["--size", "9000x9000"], "9000"),
        (["--out", "pins.json"], "cannot be made a folder"),
        (["--out", "pins.json/below"], "cannot be made a folder"),
    ],
)
def test_refusals_are_one_line(
    arguments: list[str],
    says: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    rig = save(tmp_path)
    (tmp_path / "empty.json").write_text('{"pins": []}')
    monkeypatch.chdir(tmp_path)
    given = ["compare", str(rig), "--pins", "pins.json", "--out", "out", *arguments]
    assert main(given) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1 and says in lines[0]
    assert not list(tmp_path.glob("out/*"))
