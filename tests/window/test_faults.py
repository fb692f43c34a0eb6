"""A fault in one place is told there, the window goes on, and nothing is lost."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from imgui_bundle import imgui, implot

from facepin.core.events import PointerMoved
from facepin.files.work import fault_reports
from facepin.files.work.drafts import leftovers
from facepin.panels.commands import Command
from facepin.session.edit import Edit
from facepin.session.job import Job, Steps, beside
from support.driver import App, running
from support.small_rigs import write_sheet


@pytest.fixture
def rig(tmp_path: Path) -> Path:
    return write_sheet(tmp_path / "sheet.npz")


@contextmanager
def guarded(rig: Path, settings: Path | None) -> Iterator[App]:
    """The program as users have it; the moving pictures of the first steps are not waited for."""
    with running(rig, size=(700, 500), settings_folder=settings, caught=True, wait=False) as app:
        app.until(lambda: app.desk.stage is not None)
        app.step(frames=4)
        yield app


def reports_in(folder: Path) -> list[str]:
    return [path.read_text() for path in sorted((folder / "reports").glob("*.txt"))]


def broken(*_: object, **__: object) -> object:
    """A panel that fails amid windows, tables, styles and plots that it has begun."""
    imgui.push_style_var(imgui.StyleVar_.window_padding, imgui.ImVec2(1, 1))
    imgui.begin_child("inside")
    imgui.push_id("deep")
    imgui.begin_disabled()
    if imgui.begin_table("table", 2):
        imgui.table_next_column()
    if implot.begin_plot("plot"):
        implot.push_style_color(implot.Col_.plot_bg, imgui.ImVec4(1, 0, 0, 1))
    raise ZeroDivisionError("nothing by nothing")


PARTS = (
    "frame.docks.solver_panel",
    "frame.docks.weights_panel",
    "frame.docks.chart_window",
    "frame.bars.menu_bar",
    "frame.bars.status_line",
    "frame.cards.history_window",
    "main_loop.over_picture",
    "main_loop.Painting.draw",
    "main_loop.Router.take",
    "desk.stage.Stage.update",
    "frame.docks.library_panel",
)


def test_a_part_that_fails_in_every_frame_takes_nothing_else_with_it(
    rig: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with guarded(rig, tmp_path / "settings") as app:
        app.desk.apply(Edit("Set", True, weights=np.array([0.125, 0.0, 0.5, 0.0])))
        app.step(PointerMoved(5, 5), frames=4)
        usual = app.screenshot()
        for number, where in enumerate(PARTS):
            app.desk.say("")
            # These lie over the weights.
            app.desk.view.library_opens = "library" in where
            app.desk.view.history, app.desk.view.chart = "history" in where, "chart" in where
            with monkeypatch.context() as once:
                once.setattr(f"facepin.{where}", broken)
                app.step(PointerMoved(9, 9), frames=2)
                assert app.desk.is_error, where
                assert "nothing by nothing" in app.desk.message and "see " in app.desk.message
                app.desk.say("")
                app.step(PointerMoved(8, 9), frames=2)
                assert not app.desk.message, "what comes again is told once"
            assert len(reports_in(tmp_path / "settings")) == number + 1, where
        report = reports_in(tmp_path / "settings")[0]
        assert "ZeroDivisionError" in report and "Graphics: " in report and "in broken" in report
        # Nothing is left of it: the guard is off, and what imgui finds unbalanced it raises.
        monkeypatch.setattr(app.desk.faults, "_caught", False)
        app.desk.view.history = app.desk.view.chart = False
        app.step(PointerMoved(5, 5), frames=4)
        assert np.abs(app.screenshot().astype(int) - usual)[:, :350].mean() < 2
        app.key("z", control=True)
        assert not app.session.pose.weights.any()
        app.ask(Command.QUIT)
        assert app.desk.closing


def test_a_request_that_fails_is_told_and_leaves_the_work_kept(
    rig: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with guarded(rig, tmp_path / "settings") as app:
        app.desk.apply(Edit("Set", True, weights=np.array([0.125, 0.0, 0.5, 0.0])))
        monkeypatch.setattr("facepin.actions.files.picture_of", broken_picture)
        app.ask(Command.SCREENSHOT)
        assert app.desk.is_error and Command.SCREENSHOT.title in app.desk.message
        app.step(frames=2)
    ((leftover,), _) = leftovers(tmp_path / "settings/autosave")
    assert leftover.scene.panes[0].weights["shape0"] == 0.125


def broken_picture(*_: object, **__: object) -> Path:
    raise RuntimeError("caf\udce9 \n two lines")


def failing() -> Steps:
    yield 0.5
    raise IndexError("too far")


def failing_beside() -> Steps:
    yield from beside(lambda: [][1], 0.5)
    return ""


@pytest.mark.parametrize("steps", [failing, failing_beside])
def test_a_job_that_fails_is_told_and_written_down(
    steps: Callable[[], Steps], rig: Path, tmp_path: Path
) -> None:
    with guarded(rig, tmp_path / "settings") as app:
        app.desk.start(Job("Drawing", steps()))
        app.until(lambda: app.desk.job is None)
        assert app.desk.is_error and "IndexError" in app.desk.message
        (report,) = reports_in(tmp_path / "settings")
        assert "Where: Drawing" in report and "test_faults.py" in report


def test_what_can_not_be_refined_is_given_up(
    rig: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with guarded(rig, None) as app:
        assert app.desk.stage is not None
        monkeypatch.setattr(type(app.desk.stage), "refined", False)
        monkeypatch.setattr(type(app.desk.stage), "refine", broken_picture)
        app.until(lambda: app.desk.is_error)
        app.until(lambda: app.desk.refined)
        assert len(app.desk._given_up) == 1


def test_with_the_guard_off_bugs_are_raised(rig: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def step(app: App) -> None:
        app.step(PointerMoved(5, 5))

    with pytest.raises(ZeroDivisionError), running(rig, size=(700, 500)) as app:
        monkeypatch.setattr("facepin.frame.docks.solver_panel", broken)
        step(app)


def test_reports_do_not_pile_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fault_reports, "MOST_REPORTS", 3)
    paths = [fault_reports.write_report(tmp_path, "A test", KeyError(n), {}) for n in range(5)]
    assert sorted(tmp_path.iterdir()) == paths[2:]
