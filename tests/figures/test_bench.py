"""The benchmark measures what it says; how long things take is not tested."""

import json
from argparse import ArgumentParser
from io import StringIO

import moderngl
import numpy as np
import pytest
from rich.console import Console

from facepin.core.errors import FacepinError
from facepin.core.look.shading import MODES
from facepin.core.mesh.normals import NormalField
from facepin.core.quality import LEVELS
from facepin.core.rig_builder import build_rig
from facepin.core.shapes.deform import Deformer
from facepin.figures.bench import command as bench
from facepin.figures.bench import plain_frame
from facepin.figures.bench.command import as_json, as_tables, machine, measure
from facepin.figures.bench.frame_times import frame_times, frames_as_table
from facepin.figures.bench.plain_frame import PlainFrame
from facepin.figures.study.animator import FRAMES, Protocol
from facepin.gpu.picture import open_context
from facepin.session.solving.solving import PinSolver, choose
from facepin.solvers import SOLVERS
from support.small_rigs import sheet

FEW = Protocol(pins=3, shapes=2)


@pytest.fixture(scope="module")
def ctx() -> moderngl.Context:
    with open_context() as context:
        yield context


def test_a_row_has_the_counts_of_the_rig_and_the_sum_of_its_parts(ctx: moderngl.Context) -> None:
    rig = sheet()
    row = measure(rig, ctx, protocol=FEW)
    assert (row.vertices, row.edges, row.faces, row.shapes, row.pins) == (81, 144, 64, 4, 3)
    parts = row.parts
    assert parts.upload is not None and parts.draw is not None
    assert all(
        time > 0 for time in (row.t_pin, parts.solve, parts.deform, parts.normals, parts.upload, parts.draw)
    )
    assert row.t_edit >= max(parts.solve, parts.deform, parts.normals, parts.upload), (
        "a sum of all in every frame"
    )


@pytest.mark.parametrize("key", SOLVERS)
def test_every_solver_can_be_measured_and_every_pin_is_dragged(
    key: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    solved: list[int] = []
    solve = PinSolver.solve
    monkeypatch.setattr(
        PinSolver, "solve", lambda self, pins, start: solved.append(len(pins)) or solve(self, pins, start)
    )
    row = measure(sheet(), choice=choose(key), protocol=FEW)
    assert solved == [1] * (1 + FRAMES) + [2] * (1 + FRAMES) + [3] * (1 + FRAMES)
    assert row.parts.draw is None and row.parts.upload is None


def test_rigs_with_fewer_shapes_or_less_room_than_the_protocol_wants() -> None:
    row = measure(sheet(shapes=1))
    assert 1 <= row.pins <= 15


def test_a_rig_that_does_not_move_is_refused() -> None:
    rig = sheet()
    still = build_rig("still", rig.neutral, rig.corners, rig.face_sizes, [("nothing", np.zeros((81, 3)))])
    with pytest.raises(FacepinError, match="still: no shape moves the face"):
        measure(still)


def test_json_is_the_documented_shape() -> None:
    row = measure(sheet(), protocol=FEW)
    document = json.loads(json.dumps(as_json(machine(), [row])))
    assert set(document) == {"machine", "rows", "frames"} and "no OpenGL" in document["machine"]
    counts = ["vertices", "edges", "faces", "shapes", "pins"]
    assert list(document["rows"][0]) == ["rig", *counts, "t_pin", "t_edit", "parts", "plain"]
    assert list(document["rows"][0]["parts"]) == ["solve", "deform", "normals", "upload", "draw"]


def test_the_plain_frame_gives_the_same_face_and_is_measured_in_the_same_run(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    rig = sheet(shapes=6)
    weights = np.random.default_rng(0).uniform(0, 0.1, 6)
    positions, normals = PlainFrame(rig).compute(weights)
    np.testing.assert_allclose(positions, Deformer(rig).deform(weights), atol=1e-5)
    ours = NormalField(rig).normals(positions)
    ours = ours / np.linalg.norm(ours, axis=1, keepdims=True)
    assert (ours * normals).sum(axis=1).min() > 0.99
    row = measure(sheet(), protocol=FEW)
    assert row.plain is not None and row.plain > 0
    written = StringIO()
    Console(width=80, file=written).print(*as_tables("a machine", [row]), sep="\n")
    shares = [line.split()[-1] for line in written.getvalue().splitlines() if line.split()[:1] == ["sheet"]]
    assert shares[1] == f"{row.t_edit / row.plain:.2f}"
    monkeypatch.setattr(plain_frame, "MOST_BYTES", 0)
    assert measure(sheet(), protocol=FEW).plain is None, "where memory would not do"


def test_the_tables_fit_a_terminal_and_show_the_papers_times() -> None:
    row = bench.BenchRow(
        "stand-in for Face 4",
        5692,
        11282,
        5584,
        127,
        15,
        2e-3,
        1e-3,
        bench.Parts(1e-4, 2e-4, 3e-4, None, None),
    )
    written = StringIO()
    Console(width=80, file=written).print(*as_tables("a machine", [row]), sep="\n")
    text = written.getvalue()
    assert "…" not in text
    times = text.split("Face 4")[-1].splitlines()[0].split()
    assert times == ["2.00", "1750", "1.00", "15.0", "0.10", "0.20", "0.30", "-", "-"]


def test_every_mode_is_drawn_at_every_level(ctx: moderngl.Context) -> None:
    times = frame_times(sheet(), ctx, (160, 90))
    assert [(time.mode, time.quality) for time in times] == [
        (mode, quality) for mode in MODES for quality in LEVELS
    ]
    assert all(time.seconds > 0 and time.samples <= LEVELS[time.quality].samples for time in times)
    (first, *_) = as_json("a machine", [], times)["frames"]
    assert list(first) == ["rig", "mode", "quality", "samples", "seconds"]
    written = StringIO()
    Console(width=80, file=written).print(frames_as_table(times, (160, 90)))
    lines = [line.split() for line in written.getvalue().splitlines() if line.strip().startswith("sheet")]
    assert [(line[1], len(line)) for line in lines] == [(mode, 2 + len(LEVELS)) for mode in MODES]


def test_the_command_measures_stand_ins_and_rigs(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    measured: list[str] = []

    def quick(rig: object, ctx: object) -> bench.BenchRow:
        measured.append(rig.name)  # type: ignore[attr-defined]
        return bench.BenchRow(measured[-1], 1, 1, 1, 1, 1, 1.0, 1.0, bench.Parts(1.0, 1.0, 1.0, 1.0, 1.0))

    monkeypatch.setattr(bench, "measure", quick)
    drawn: list[str] = []
    monkeypatch.setattr(bench, "frame_times", lambda rig, ctx, size: drawn.append(rig.name) or [])
    parser = ArgumentParser()
    bench.add_options(parser)
    bench.run(parser.parse_args(["--json"]))
    rows = json.loads(capsys.readouterr().out)["rows"]
    assert [row["rig"] for row in rows] == measured
    assert measured[:5] == [f"stand-in for Face {i}" for i in range(1, 6)] and len(measured) == 6
    assert drawn == measured[5:]
