"""The simulated animator and its study, recomputed with plain numpy on a rig small enough to check."""

import csv
import json
import os
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest

from facepin.__main__ import main
from facepin.core.errors import FacepinError
from facepin.core.rig import Rig
from facepin.figures.study.animator import (
    FRAMES,
    PULL,
    SPACING,
    Protocol,
    Task,
    animate,
    drawable,
    make_task,
    most_moved,
)
from facepin.figures.study.processes import spread
from facepin.figures.study.study import study
from facepin.session.solving.solving import choose
from facepin.solvers import SOLVERS
from support.small_rigs import sheet

PROTOCOL = Protocol(pins=5, shapes=3, seed=7)
Answer = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]


@pytest.fixture(scope="module")
def rig() -> Rig:
    return sheet(13, 13, shapes=7)


def dense(rig: Rig) -> np.ndarray:
    return rig.deltas.toarray().astype(np.float64)


def transposed(J: np.ndarray, d: np.ndarray, w0: np.ndarray) -> np.ndarray:
    g = J.T @ (d - J @ w0)
    return w0 + (g @ g) / ((J @ g) @ (J @ g)) * g


def regularised(J: np.ndarray, d: np.ndarray, w0: np.ndarray) -> np.ndarray:
    return np.linalg.solve(J.T @ J + 0.001 * np.eye(len(w0)), J.T @ d + 0.001 * w0)


def simulated(rig: Rig, task: Task, answer: Answer, kept: list[int]) -> np.ndarray:
    """The weights of all frames, (frames, k); `kept` are the coordinates that a pin constrains."""
    B, rest = dense(rig), rig.neutral.astype(np.float64)
    w, path, blocks = np.zeros(B.shape[1]), [np.zeros(B.shape[1])], []
    for v, tremor in zip(task.vertices, task.tremor, strict=True):
        block = B[3 * v : 3 * v + 3]
        w0, aim = w, rest[v] + block @ w
        blocks = [*blocks, block]
        rows = [each[kept] for each in blocks]
        goals = [each @ w for each in blocks]  # what is held is held where it is at the press
        for shake in tremor:
            aim[:2] += PULL * (task.wanted[v] - rest[v] - block @ w)[:2]
            goals[-1] = aim - rest[v] + [shake[0], shake[1], 0.0]
            w = answer(np.concatenate(rows), np.concatenate([goal[kept] for goal in goals]), w0)
            path.append(w)
    return np.array(path)


@pytest.mark.parametrize(("key", "answer"), [("transpose", transposed), ("tikhonov", regularised)])
@pytest.mark.parametrize(("freedom", "kept"), [("space", [0, 1, 2]), ("screen", [0, 1])])
def test_every_figure_is_what_it_says(
    rig: Rig, key: str, answer: Answer, freedom: str, kept: list[int]
) -> None:
    task = make_task(rig, PROTOCOL, 2)
    path = simulated(rig, task, answer, kept)
    weights, wanted = path[-1], task.wanted.astype(np.float64)
    face = rig.neutral + (dense(rig) @ weights).reshape(-1, 3)
    at_rest = np.linalg.norm(wanted - rig.neutral, axis=1) < 0.001 * 2.0
    pins = list(task.vertices)
    expected = {
        "e_rms": np.sqrt(np.mean((weights - task.reference) ** 2)),
        "pin_error_percent": 50 * np.linalg.norm((face - wanted)[pins, :2], axis=1).mean(),
        "vertex_error_percent": 50 * np.linalg.norm(face - wanted, axis=1).mean(),
        "far_motion_percent": 50 * np.linalg.norm((face - rig.neutral)[at_rest], axis=1).max(),
        "out_of_range": np.sum((weights < -1e-6) | (weights > 1 + 1e-6)),
        "active": np.sum(np.abs(weights) > 0.05),
        "travel": np.abs(path[1:] - path[:-1]).sum(),
    }
    outcome = asdict(animate(rig, task, choose(key), freedom))
    assert outcome.pop("milliseconds") > 0
    assert outcome == pytest.approx(expected, rel=1e-4)


def test_tasks_follow_the_protocol(rig: Rig) -> None:
    for trial in range(5):
        task = make_task(rig, PROTOCOL, trial)
        drawn = task.reference[task.reference != 0]
        assert len(drawn) == PROTOCOL.shapes
        assert drawn.min() >= 0.4 and drawn.max() <= 1.0
        np.testing.assert_allclose(task.wanted, rig.evaluate(task.reference))
        assert task.tremor.shape == (len(task.vertices), FRAMES, 2)
        again = make_task(rig, PROTOCOL, trial)
        assert again.vertices == task.vertices
        np.testing.assert_array_equal(again.tremor, task.tremor)
    shakes = np.concatenate([make_task(rig, PROTOCOL, t).tremor.ravel() for t in range(10)])
    assert shakes.std() == pytest.approx(0.003 * rig.height, rel=0.1)
    assert not np.array_equal(
        make_task(rig, Protocol(seed=8), 0).reference, make_task(rig, PROTOCOL, 0).reference
    )


def test_pins_go_where_most_moves_far_enough_apart(rig: Rig) -> None:
    wanted = make_task(rig, PROTOCOL, 1).wanted
    moved = np.linalg.norm(wanted - rig.neutral, axis=1)
    expected: list[int] = []
    for v in np.argsort(-moved, kind="stable").tolist():
        gaps = np.linalg.norm(rig.neutral[expected] - rig.neutral[v], axis=1)
        if moved[v] >= 0.001 * rig.height and (gaps > SPACING * rig.height).all():
            expected.append(v)
    assert most_moved(rig, wanted, 8) == tuple(expected[:8])
    assert most_moved(rig, wanted, 500) == tuple(expected)


def test_a_steady_hand_and_exact_pins_find_the_pose(rig: Rig) -> None:
    """With as many measurements as shapes and no noise, only what 20 frames leave over is missed."""
    task = make_task(rig, Protocol(pins=12, shapes=3, noise=0.0), 0)
    outcome = animate(rig, task, choose("pseudo_inverse"), "screen")
    assert outcome.e_rms < 0.02
    assert outcome.pin_error_percent < 0.1


def test_limits_are_respected_by_those_who_promise_it(rig: Rig) -> None:
    for trial in range(3):
        task = make_task(rig, PROTOCOL, trial)
        for key in ("sparse", "bounded"):
            assert animate(rig, task, choose(key), "screen").out_of_range == 0
        assert animate(rig, task, choose("transpose", keep_limits=True), "space").out_of_range == 0


def test_the_number_of_processes_changes_nothing(rig: Rig) -> None:
    choices = [choose("transpose"), choose("sparse")]
    one, two = (study(rig, PROTOCOL, choices, trials=5, jobs=jobs) for jobs in (1, 2))
    assert [(row.choice.kind.key, row.freedom) for row in one.rows] == [
        (key, freedom) for key in ("transpose", "sparse") for freedom in ("space", "screen")
    ]
    for a, b in zip(one.rows, two.rows, strict=True):
        assert {**asdict(a.outcome), "milliseconds": 0} == {**asdict(b.outcome), "milliseconds": 0}


def test_rows_are_medians_over_the_trials(rig: Rig) -> None:
    choice, done = choose("tikhonov"), []
    found = study(rig, PROTOCOL, [choice], ["space"], trials=4, progress=done.append)
    outcomes = [animate(rig, make_task(rig, PROTOCOL, t), choice, "space") for t in range(4)]
    assert found.rows[0].outcome.travel == np.median([outcome.travel for outcome in outcomes])
    assert found.rows[0].outcome.active == np.median([outcome.active for outcome in outcomes])
    assert done == [0.25, 0.5, 0.75, 1.0]


def test_shapes_can_be_left_out_of_the_poses(rig: Rig) -> None:
    without = Protocol(shapes=3, without=("shape[0-3]",))
    assert drawable(rig, without) == [4, 5, 6]
    assert not make_task(rig, without, 0).reference[:4].any()
    with pytest.raises(FacepinError, match="4 shapes was asked for, found 3 that may be used"):
        study(rig, Protocol(shapes=4, without=("shape[0-3]",)), [choose("sparse")], trials=1)


def _die(number: int) -> int:
    if number == 3:
        os._exit(1)
    return number * number


def _square(number: int) -> int:
    return number * number


def test_work_is_spread_and_comes_back() -> None:
    for jobs in (1, 3):
        assert sorted(spread(_square, 10, jobs)) == [(n, n * n) for n in range(10)]
    assert list(spread(_square, 0, 4)) == []


def test_a_process_that_dies_is_an_error_and_not_a_hang() -> None:
    with pytest.raises(FacepinError, match="a process ended"):
        list(spread(_die, 8, 2))


@pytest.fixture
def npz(rig: Rig, tmp_path: Path) -> Path:
    path = tmp_path / "sheet.npz"
    deltas = dense(rig).T.reshape(rig.shape_count, -1, 3)
    np.savez(path, neutral=rig.neutral, faces=rig.corners.reshape(-1, 4), deltas=deltas)
    return path


def command(npz: Path, *options: str) -> int:
    small = ["--trials", "2", "--pins", "3", "--shapes", "2", "--jobs", "1"]
    return main(["study", str(npz), *small, *options])


def test_command_prints_json_only_and_writes_files(
    npz: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "deep" / "out"
    assert command(npz, "--json", "--out", str(out), "--set", "price=0.3") == 0
    told = json.loads(capsys.readouterr().out)
    assert told == json.loads((out / "study.json").read_text(encoding="utf-8"))
    settings, rows = told["settings"], told["rows"]
    assert (settings["trials"], settings["pins"], settings["shapes"], settings["seed"]) == (2, 3, 2, 1)
    assert settings["solvers"]["sparse"]["price"] == 0.3
    assert [(row["solver"], row["freedom"]) for row in rows] == [
        (key, freedom) for key in SOLVERS for freedom in ("space", "screen")
    ]
    keys = (
        "solver freedom e_rms pin_error_percent vertex_error_percent far_motion_percent out_of_range active"
    )
    assert list(rows[0]) == [*keys.split(), "travel", "milliseconds"]
    with (out / "study.csv").open(encoding="utf-8", newline="") as file:
        table = list(csv.DictReader(file))
    assert [float(row["travel"]) for row in table] == [row["travel"] for row in rows]
    assert (out / "study.png").stat().st_size > 10_000
    assert "<svg" in (out / "study.svg").read_text(encoding="utf-8")


def test_command_prints_a_table_that_fits_80_columns(
    npz: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    assert command(npz, "--freedom", "screen", "--solvers", "transpose,sparse") == 0
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= 80
    assert sum("screen" in line for line in lines) == 2
    assert not any("…" in line for line in lines)
    assert any(line.rstrip().endswith("ms") for line in lines)


@pytest.mark.parametrize(
    ("option", "value", "allowed"),
    [("--pins", "0", "1 or more"), ("--noise", "-1", "0 or more"), ("--noise", "nan", "0 or more")],
)
def test_senseless_numbers_are_refused(
    npz: Path, option: str, value: str, allowed: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command(npz, option, value) == 2
    assert allowed in capsys.readouterr().err
