"""The drag study, on rigs where every figure can be worked out by poser."""

import csv
import json
from dataclasses import asdict, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import moderngl
import numpy as np
import pytest
from scipy.optimize import lsq_linear

from facepin.__main__ import main
from facepin.core.arrays import Floats
from facepin.core.errors import FacepinError
from facepin.core.look.camera import Viewport
from facepin.core.rig import Rig
from facepin.core.rig_builder import build_rig
from facepin.figures.pictures import Painter
from facepin.figures.posing import in_sight
from facepin.figures.study.drag_report import short
from facepin.figures.study.drag_study import DragFigures, DragProtocol, DragStudy, drag_study
from facepin.figures.study.drags import DIRECTIONS, PIXEL, circle, drag_point, straight
from facepin.figures.study.holding import Poser, press_jump, removal_jump
from facepin.figures.study.intervals import bootstrap, median, p90, percent_above, quantile
from facepin.figures.study.maps import _blend, draw_map
from facepin.figures.study.points import movable_vertices, spread_points
from facepin.figures.study.reach import LEFT_OVER, Reach
from facepin.session.solving.solving import choose
from facepin.solvers.sparse import SparseSettings
from support.small_rigs import sheet

HEIGHT = 2.0
SIDE = 21
"""Vertices in a row of the sheet."""
PROTOCOL = DragProtocol(points=12, sizes=(3.0,), seed=4, cases=3)
KEYS = [
    *("rig", "solver", "freedom", "size_percent", "reachable", "lag_median_percent", "lag_p90_percent"),
    *("dead_percent", "far_share_percent", "active_p90", "weight_per_pixel_p90", "overdrag_change_median"),
    *("overdrag_change_p90", "press_jump_percent", "removal_jump_percent", "slip_median_percent"),
    *("milliseconds", "sequence_lag_p90_percent"),
]


def neutral() -> tuple[Floats, np.ndarray]:
    x, y = np.meshgrid(np.linspace(-1, 1, SIDE), np.linspace(1, -1, SIDE))
    at = np.arange(SIDE * SIDE).reshape(SIDE, SIDE)
    quads = np.stack([at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]], axis=-1).reshape(-1, 4)
    return np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1), quads


def block_rig(far: float = 0.0) -> Rig:
    """One shape moves the left edge by 0.2 to the right, and the middle of the right one by `far` upwards."""
    points, quads = neutral()
    delta = np.zeros_like(points)
    delta[points[:, 0] < -0.85, 0] = 0.2
    delta[(points[:, 0] > 0.85) & (np.abs(points[:, 1]) < 0.2), 1] = far
    return build_rig("blocks", points, quads.ravel(), np.full(len(quads), 4), [("right", delta)])


def edge_points(rig: Rig) -> list[int]:
    return np.flatnonzero(rig.neutral[:, 0] < -0.85).tolist()


def single_rig(count: int = 10) -> Rig:
    """Every shape moves one vertex, each in another direction and by 0.4, far from all others."""
    points, quads = neutral()
    vertices = np.arange(SIDE * SIDE).reshape(SIDE, SIDE)[2::5, 2::5].ravel()[:count]
    shapes = []
    for number, vertex in enumerate(vertices.tolist()):
        for axis, name in enumerate("xy"):
            delta = np.zeros_like(points)
            delta[vertex, axis] = 0.4
            shapes.append((f"{name}{number}", delta))
    limits = np.tile([-1.0, 1.0], (len(shapes), 1))
    rig = build_rig("single", points, quads.ravel(), np.full(len(quads), 4), shapes)
    return replace(rig, limits=limits)


def figures(study: DragStudy) -> DragFigures:
    return study.rows[0].figures


def drags_of(
    rig: Rig, key: str, *, limits: bool = True, settings: Any = None, freedom: Any = "screen"
) -> Any:
    """One size, one point at the left edge."""
    vertex = edge_points(rig)[3]
    far = np.array([Reach(rig, vertex).far(direction) for direction in DIRECTIONS])
    return drag_point(rig, (choose(key, settings, limits), freedom), vertex, far, [3.0])


# Points


def test_points_are_seen_moved_and_far_apart() -> None:
    rig = sheet(25, 25, shapes=6)
    largest = np.zeros(rig.vertex_count)
    for column in rig.deltas.toarray().T:
        largest = np.maximum(largest, np.linalg.norm(column.reshape(-1, 3), axis=1))
    assert movable_vertices(rig).tolist() == np.flatnonzero(largest >= 0.01 * rig.height).tolist()
    chosen = spread_points(rig, 20, seed=1)
    assert len(set(chosen)) == 20 and set(chosen) <= set(movable_vertices(rig).tolist())
    assert all(in_sight(rig, vertex) for vertex in chosen)
    places = rig.neutral[list(chosen)]
    gaps = np.linalg.norm(places[:, None] - places[None], axis=2)[~np.eye(20, dtype=bool)]
    assert gaps.min() > 0.1
    assert spread_points(rig, 20, seed=1) == chosen
    assert set(spread_points(rig, 20, seed=2)) != set(chosen)


def test_what_lies_behind_the_face_is_no_point() -> None:
    front, quads = neutral()
    points = np.concatenate([front, front - (0, 0, 1)])
    corners = np.concatenate([quads, quads + len(front)])
    delta = np.zeros_like(points)
    delta[:, 1] = 0.3
    rig = build_rig("two", points, corners.ravel(), np.full(len(corners), 4), [("up", delta)])
    assert max(spread_points(rig, 40, seed=1)) < len(front)


def test_fewer_points_are_taken_where_there_are_fewer() -> None:
    assert sorted(spread_points(block_rig(), 500, seed=1)) == edge_points(block_rig())


def test_a_face_that_nothing_moves_is_refused() -> None:
    points, quads = neutral()
    delta = np.zeros_like(points)
    delta[5, 0] = 0.019
    rig = build_rig("still", points, quads.ravel(), np.full(len(quads), 4), [("hardly", delta)])
    with pytest.raises(FacepinError, match="still: no point is seen from the front and moved"):
        spread_points(rig, 10, 1)


# Reach


def test_reach_is_that_of_least_squares_within_limits() -> None:
    rig = sheet(13, 13, shapes=9, seed=3)
    vertex = int(np.argmax(np.abs(rig.deltas.toarray()).sum(axis=1).reshape(-1, 3).sum(axis=1)))
    rows, reach = rig.rows_at([vertex])[:2], Reach(rig, vertex)
    for move in np.random.default_rng(2).normal(0, 0.3, (10, 2)):
        best = lsq_linear(rows, move, rig.limits.T, method="bvls")
        assert reach.missed(move) == pytest.approx(np.sqrt(2 * best.cost), abs=1e-6)
    for direction in DIRECTIONS:
        far = reach.far(direction)
        for length, inside in ((0.99 * far, True), (1.01 * far + 1e-3, False)):
            left = np.sqrt(2 * lsq_linear(rows, length * direction, rig.limits.T, method="bvls").cost)
            assert (left <= LEFT_OVER * length) == inside


def test_reach_by_hand() -> None:
    """The shape goes 0.2 to the right and nowhere else; a tenth may be left over."""
    reach = Reach(block_rig(), edge_points(block_rig())[0])
    far = [reach.far(direction) for direction in DIRECTIONS]
    assert far == pytest.approx([0.2 / 0.9, 0.0, 0.0, 0.0], abs=1e-4)


def test_ties_bind_the_reach() -> None:
    """A shape that may go only as far as another, which moves the vertex the other way, reaches nothing."""
    points, quads = neutral()
    one, other = np.zeros_like(points), np.zeros_like(points)
    one[:, 0], other[:, 0] = 0.2, -0.2
    rig = build_rig("tied", points, quads.ravel(), np.full(len(quads), 4), [("a", one), ("b", other)])
    right = np.array([1.0, 0.0])
    assert Reach(rig, 0).far(right) == pytest.approx(0.2 / 0.9, abs=1e-3)
    assert Reach(replace(rig, ties=((0, 1),)), 0).far(right) == pytest.approx(0.0, abs=1e-3)


# Single drags: 3 % of a height of 2 is 0.06, a weight of 0.3; α of Tikhonov is 0.001, JᵀJ is 0.04


def test_lag_by_hand() -> None:
    exact, damped = (drags_of(block_rig(), key) for key in ("pseudo_inverse", "tikhonov"))
    assert exact.lag[0] == pytest.approx([0, 1, 1, 1], abs=1e-6)
    assert damped.lag[0] == pytest.approx([0.001 / 0.041, 1, 1, 1], abs=1e-6)
    sparse = drags_of(block_rig(), "sparse", settings=SparseSettings(price=0.1))
    assert sparse.lag[0] == pytest.approx([1 / 3, 1, 1, 1], abs=1e-4)


def test_depth_of_pins_in_space_is_not_lag() -> None:
    points, quads = neutral()
    delta = np.tile([0.2, 0.0, 0.2], (len(points), 1))
    rig = build_rig("deep", points, quads.ravel(), np.full(len(quads), 4), [("out", delta)])
    assert drags_of(rig, "pseudo_inverse", freedom="screen").lag[0, 0] == pytest.approx(0, abs=1e-6)
    assert drags_of(rig, "pseudo_inverse", freedom="space").lag[0, 0] == pytest.approx(0.5, abs=1e-6)


def test_far_motion_by_hand() -> None:
    found = drags_of(block_rig(far=0.6), "pseudo_inverse")
    assert found.far[0] == pytest.approx([0.3 * 0.6 / 0.06, 0, 0, 0], abs=1e-5)
    near = drags_of(block_rig(), "pseudo_inverse")  # only its own edge moves, of which some is far away
    assert near.far[0] == pytest.approx([1, 0, 0, 0], abs=1e-5)


def test_overdrag_by_hand() -> None:
    """Without limits the weight goes on in proportion: from 1 / 0.9 to six times that, and from -0.3."""
    free = drags_of(block_rig(), "pseudo_inverse", limits=False)
    assert free.overdrag[0] == pytest.approx([5 / 0.9, 0, 1.5, 0], rel=1e-3, abs=1e-6)
    assert drags_of(block_rig(), "pseudo_inverse").overdrag[0] == pytest.approx([0] * 4, abs=1e-6)


def test_weight_per_pixel_by_hand() -> None:
    """0.2 of motion is a weight of 1: per pixel 5 × 2 / 720; on the circle too, whatever the direction."""
    found = drags_of(block_rig(), "pseudo_inverse", limits=False)
    assert found.per_pixel[0] == pytest.approx([5 * HEIGHT * PIXEL] * 4, rel=0.01)
    assert found.active[0].tolist() == [1, 0, 1, 0]


def test_paths_go_pixel_by_pixel() -> None:
    way = straight(0.06, PIXEL * HEIGHT)[:, 0]
    assert way[0] == 0 and way[-1] == 0.06
    assert np.diff(way) == pytest.approx([0.06 / 22] * 22)
    ring = circle(0.06, PIXEL * HEIGHT)
    assert np.linalg.norm(ring, axis=1) == pytest.approx([0.06] * len(ring))
    assert ring[0] == pytest.approx([0.06, 0]) and ring[-1] == pytest.approx([0.06, 0])
    steps = np.linalg.norm(np.diff(ring, axis=0), axis=1)
    assert steps.min() > 0.95 * PIXEL * HEIGHT and steps.max() <= PIXEL * HEIGHT


# Rows


def test_a_row_counts_drags() -> None:
    """A quarter of the drags can be reached; of these a third is left, or nearly all at a higher price."""
    rig = block_rig()
    for price, weight, dead in ((0.1, 0.2, 0), (0.29, 0.01, 100)):
        method = (choose("sparse", SparseSettings(price=price)), "screen")
        (row,) = drag_study(rig, PROTOCOL, [cast(Any, method)]).rows
        assert row.figures.reachable == 25
        assert row.figures.lag_median_percent == pytest.approx(100 * (1 - weight / 0.3), abs=0.1)
        assert row.figures.lag_p90_percent == pytest.approx(100 * (1 - weight / 0.3), abs=0.1)
        assert row.figures.dead_percent == dead
        assert np.isnan(row.lag[:, 1:]).all() and row.lag.shape == (12, 4)
        assert row.figures.milliseconds > 0


def test_drags_that_are_felt_far_away_are_counted_among_all() -> None:
    """Only what pulls the left edge to the right moves the right edge by more than itself."""
    rig = block_rig(far=0.6)
    study = drag_study(rig, PROTOCOL, [(choose("pseudo_inverse", keep_limits=True), "screen")])
    left = np.isin(study.vertices, edge_points(rig))
    assert 0 < left.sum() < len(left)
    assert figures(study).far_share_percent == pytest.approx(25 * left.mean())
    assert figures(study).dead_percent == 0


def test_nothing_in_reach_is_no_figure() -> None:
    far = replace(PROTOCOL, points=2, sizes=(50.0,))
    found = figures(drag_study(block_rig(), far, [(choose("transpose", keep_limits=True), "screen")]))
    assert found.reachable == 0
    assert np.isnan([found.lag_median_percent, found.lag_p90_percent, found.dead_percent]).all()


def test_a_single_point_is_enough() -> None:
    """There is nothing then to be held, to slip or to jump."""
    one = replace(PROTOCOL, points=1)
    found = drag_study(block_rig(), one, [(choose("transpose"), "screen")], intervals=True).rows[0]
    assert np.isnan([found.figures.slip_median_percent, found.figures.press_jump_percent]).all()
    assert "slip_median_percent" not in found.intervals and "lag_p90_percent" in found.intervals


def test_pins_of_their_own_shapes_hold_and_nothing_jumps() -> None:
    found = figures(drag_study(single_rig(), PROTOCOL, [(choose("pseudo_inverse"), "screen")]))
    assert found.press_jump_percent == pytest.approx(0, abs=1e-5)
    assert found.removal_jump_percent == pytest.approx(0, abs=1e-5)
    assert found.slip_median_percent == pytest.approx(0, abs=1e-4)
    assert found.sequence_lag_p90_percent == pytest.approx(0, abs=1e-4)


def test_pins_on_one_shape_slip_as_far_as_it_is_dragged() -> None:
    """One pin after the other is dragged on a shape that moves all alike: the others are taken along."""
    points, quads = neutral()
    deltas = [(name, np.tile(way, (len(points), 1))) for name, way in (("x", (1, 0, 0)), ("y", (0, 1, 0)))]
    rig = build_rig("whole", points, quads.ravel(), np.full(len(quads), 4), deltas)
    found = figures(drag_study(rig, PROTOCOL, [(choose("pseudo_inverse"), "screen")]))
    # n pins agree on the mean of their goals: of the m-th drag 1/m arrives, and all move by that much
    slips = [100 / m for m in range(2, 9) for _ in range(m - 1)]
    lags = [100 * (1 - 1 / m) for m in range(1, 9)]
    assert found.slip_median_percent == pytest.approx(np.median(slips), abs=0.01)
    assert found.sequence_lag_p90_percent == pytest.approx(np.quantile(lags * 3, 0.9), abs=0.01)


class _FakePoser:
    """A hand under which the face moves as a test says."""

    def __init__(self, rig: Rig, jump: Floats) -> None:
        self.face, self._jump, self.done = rig.neutral, jump, list[str]()
        self.session = SimpleNamespace(
            step=3,
            cancel=lambda: self.done.append("cancel"),
            go_to=lambda step: self.done.append(f"to {step}"),
        )

    def drag(self, vertex: int, move: Floats, *, final: bool) -> None:
        self.done.append(f"{'drag' if move.any() else 'press'} {vertex}")
        assert not final
        self.face = self.face + self._jump

    def remove(self, vertex: int) -> None:
        self.done.append(f"remove {vertex}")


def test_jumps_are_the_largest_moves_and_trials_are_taken_back() -> None:
    rig = block_rig()
    jump = np.zeros((rig.vertex_count, 3), np.float32)
    jump[7] = (0.0, 0.3, 0.4)
    jump[200] = (0.9, 0.0, 0.0)
    poser = _FakePoser(rig, jump)
    assert press_jump(rig, cast(Poser, poser), 5) == pytest.approx(0.9)
    assert poser.done == ["press 5", "cancel"]
    poser = _FakePoser(rig, jump)  # what is near the nudged pin may move
    assert removal_jump(rig, cast(Poser, poser), removed=5, nudged=200) == pytest.approx(0.5)
    assert poser.done == ["remove 5", "drag 200", "to 3"]


def test_a_study_is_the_same_for_any_number_of_processes_and_another_with_every_seed() -> None:
    rig = sheet(25, 25, shapes=6)
    methods = [(choose(key, keep_limits=True), "screen") for key in ("transpose", "sparse")]

    def told(seed: int, jobs: int) -> list[dict[str, float]]:
        found = drag_study(rig, replace(PROTOCOL, seed=seed), cast(Any, methods), jobs)
        return [{**asdict(row.figures), "milliseconds": 0.0} for row in found.rows]

    first = told(4, 1)
    assert told(4, 2) == first
    assert told(5, 1) != first


# Intervals


def test_quantiles_pass_over_what_is_missing() -> None:
    values = np.random.default_rng(1).normal(size=(6, 40))
    values[values > 1] = np.nan
    for share in (0.0, 0.1, 0.5, 0.9, 1.0):
        np.testing.assert_allclose(quantile(values, share), np.nanquantile(values, share, axis=1))
    values[2] = np.nan
    assert np.isnan(median(values)).tolist() == [False, False, True, False, False, False]
    assert p90(np.array([7.0])) == 7.0
    assert percent_above(np.array([[1, 2, np.nan, 3], [np.nan] * 4]), 1.5).tolist() == pytest.approx(
        [200 / 3, np.nan], nan_ok=True
    )


def test_intervals_hold_what_belongs_together_together() -> None:
    random = np.random.default_rng(3)
    trials = random.normal(size=(60, 1))
    low, high = bootstrap(trials, median)
    assert low < median(trials.ravel()) < high
    wide = bootstrap(np.repeat(trials, 50, axis=1), median)
    assert wide == pytest.approx((low, high), abs=0.2)  # fifty copies of a trial say no more than one
    assert bootstrap(np.full((5, 2), 4.0), median) == (4.0, 4.0)
    assert bootstrap(trials, median) == (low, high)


# Maps


def test_dead_spots_are_bright_and_unknown_ones_are_rings(gl: moderngl.Context) -> None:
    rig = block_rig()
    study = drag_study(rig, replace(PROTOCOL, points=4), [(choose("transpose"), "screen")])
    values = np.array([0.0, 1.0, np.nan, 2.0])
    painter = Painter(gl, rig, (400, 400))
    image = draw_map(study, painter, values, _blend(rig, study.vertices)).astype(int)
    places = painter.camera.project(rig.neutral[list(study.vertices)], Viewport(0, 0, 400, 400))
    painter.release()
    quiet, dead, unknown, beyond = (image[round(y), round(x)] for x, y, _ in places.tolist())
    assert dead[0] > 230 and dead[2] < 140  # yellow
    assert quiet.max() < 120 and unknown.max() < 200
    assert beyond.min() > 240


# The command


@pytest.fixture
def npz(tmp_path: Path) -> Path:
    rig = sheet(25, 25, shapes=6)
    path = tmp_path / "sheet.npz"
    deltas = rig.deltas.toarray().T.reshape(rig.shape_count, -1, 3)
    np.savez(path, neutral=rig.neutral, faces=rig.corners.reshape(-1, 4), deltas=deltas)
    return path


def command(npz: Path, *options: str) -> int:
    return main(["study", str(npz), "--drags", "--points", "6", "--jobs", "1", *options])


def test_command_prints_json_only_and_writes_files(
    npz: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "deep" / "out"
    assert command(npz, "--json", "--out", str(out), "--solvers", "transpose,sparse", "--size", "2", "5") == 0
    told = json.loads(capsys.readouterr().out)
    assert told == json.loads((out / "drags.json").read_text(encoding="utf-8"))
    assert [(row["solver"], row["freedom"], row["size_percent"]) for row in told["rows"]] == [
        (key, "screen", size) for key in ("transpose", "sparse") for size in (2, 5)
    ]
    assert list(told["rows"][0]) == KEYS
    settings = told["settings"]
    assert settings["rigs"] == [{"rig": "sheet", "points": 6}]
    assert settings["solvers"]["transpose"]["limits"] is True
    with (out / "drags.csv").open(encoding="utf-8", newline="") as file:
        table = list(csv.DictReader(file))
    assert [float(row["slip_median_percent"]) for row in table] == [
        row["slip_median_percent"] for row in told["rows"]
    ]
    assert (out / "drags.png").stat().st_size > 10_000


def test_command_says_how_sure_it_is(npz: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert command(npz, "--json", "--solvers", "transpose", "--size", "3", "--intervals", "--no-limits") == 0
    told = json.loads(capsys.readouterr().out)
    (row,) = told["rows"]
    assert told["settings"]["solvers"]["transpose"]["limits"] is False
    assert [key for key in row if not key.endswith("_interval")] == KEYS
    for name in ("lag_median_percent", "far_share_percent", "slip_median_percent"):
        low, high = row[f"{name}_interval"]
        assert low <= row[name] <= high
    assert "press_jump_percent_interval" not in row  # a maximum only grows with more cases


def test_command_prints_one_table_of_several_rigs(
    npz: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    second = npz.with_name("again.npz")
    second.write_bytes(npz.read_bytes())
    assert (
        main(["study", str(npz), str(second), "--drags", "--points", "4", "--size", "3", "--jobs", "1"]) == 0
    )
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= 80
    assert not any("…" in line for line in lines)
    assert [line.strip() for line in lines if line.strip().endswith(", 3 %")] == ["sheet, 3 %", "again, 3 %"]
    assert sum(line.startswith("sparse") for line in lines) == 2


@pytest.mark.parametrize(
    ("options", "line"),
    [
        (["--drags", "--size", "0"], "--size: found 0, allowed: above 0"),
        (["--drags", "--size", "nan"], "--size: found nan, allowed: above 0"),
        (["--drags", "--points", "0"], "--points: found 0, allowed: 1 or more"),
        (["--drags", "--trials", "3"], "--trials is not used with --drags"),
        (["--size", "3"], "--size is used only with --drags"),
        (["--drags", "--out", "{npz}"], "cannot be made a folder"),
    ],
)
def test_what_makes_no_sense_is_refused_in_one_line(
    npz: Path, options: list[str], line: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["study", str(npz), *(option.format(npz=npz) for option in options)]) == 2
    told = capsys.readouterr()
    assert line in told.err and told.err.count("\n") == 1 and not told.out


@pytest.mark.parametrize(
    ("figure", "text"),
    [
        *((99.6, "100"), (12.34, "12"), (2.0, "2"), (2.04, "2"), (2.16, "2.2"), (0.057, ".06"), (0.996, "1")),
        *((0.0, "0"), (np.nan, "-"), (1234.0, "1,234")),
    ],
)
def test_figures_are_short(figure: float, text: str) -> None:
    assert short(figure) == text
