from collections.abc import Callable
from pathlib import Path
from threading import Event

import pytest

from facepin.core.errors import FacepinError
from facepin.core.rig import Rig
from facepin.session.loading import Loading
from support.small_rigs import sheet

RIG = sheet()
Report = Callable[[float, str], None]


def failing(error: BaseException) -> Callable[[Path, Report], Rig]:
    def open_path(path: Path, report: Report) -> Rig:
        raise error

    return open_path


def test_the_rig_comes_with_the_progress_that_was_made() -> None:
    def open_path(path: Path, report: Report) -> Rig:
        report(0.5, "Reading")
        return RIG

    loading = Loading(Path("face.npz"), open_path)
    assert loading.result() is RIG
    assert loading.finished
    assert (loading.fraction, loading.line) == (0.5, "Reading")


@pytest.mark.parametrize("reports", [0, 1])
def test_what_was_cancelled_does_not_come_even_if_it_was_read_to_the_end(reports: int) -> None:
    go_on = Event()

    def open_path(path: Path, report: Report) -> Rig:
        go_on.wait(10)
        for _ in range(reports):
            report(1.0, "Done")
        return RIG

    loading = Loading(Path("face.npz"), open_path)
    loading.cancel()
    go_on.set()
    assert loading.result() is None


@pytest.mark.parametrize("error", [FacepinError("face.npz: no faces"), OSError("disk on fire")])
def test_what_a_reader_complains_of_is_passed_on(error: Exception) -> None:
    with pytest.raises(type(error)) as caught:
        Loading(Path("face.npz"), failing(error)).result()
    assert caught.value is error


@pytest.mark.parametrize(
    ("error", "line"),
    [
        (MemoryError(), "face.npz: opening it failed (MemoryError)"),
        (ValueError("bad shape"), "face.npz: opening it failed (ValueError: bad shape)"),
    ],
)
def test_a_fault_of_a_reader_is_one_line_and_not_the_end(error: Exception, line: str) -> None:
    with pytest.raises(FacepinError) as caught:
        Loading(Path("face.npz"), failing(error)).result()
    assert str(caught.value) == line
    assert caught.value.__cause__ is error
