"""The first cases of the fuzzer, and that it would notice."""

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import fuzz.worker
from facepin.core.errors import FacepinError
from fuzz.__main__ import Worker
from fuzz.kinds import KINDS, Kind
from fuzz.mutations import BYTES
from fuzz.worker import outcome, write_case

EACH = 8
"""Cases of every kind of file."""


@pytest.fixture(scope="module")
def worker() -> Iterator[Worker]:
    one = Worker()
    yield one
    one.end()


@pytest.mark.parametrize("kind", range(len(KINDS)), ids=[kind.name for kind in KINDS])
def test_broken_files_are_read_or_refused_in_one_line(worker: Worker, kind: int) -> None:
    for seed in range(kind, EACH * len(KINDS), len(KINDS)):
        assert worker.run(seed) is None, f"PYTHONPATH=tests python -m fuzz --seed {seed}"


def test_a_process_that_hangs_or_dies_is_a_finding_and_the_next_case_is_run(worker: Worker) -> None:
    assert worker.run(0) is None
    assert worker.process is not None
    os.kill(worker.process.pid, 9)
    assert worker.run(0) == "the process ended with -9"
    assert worker.run(0) is None
    assert worker.run(0, patience=0.0) == "took more than 0 seconds"


def test_a_case_is_the_same_each_time(tmp_path: Path) -> None:
    for seed in range(2 * len(KINDS)):
        contents = []
        for name in ("one", "other"):
            folder = tmp_path / f"{seed}{name}"
            folder.mkdir()
            contents.append(write_case(seed, folder).read_bytes())
        assert contents[0] == contents[1]


def made_up(monkeypatch: pytest.MonkeyPatch, read: Callable[[Path], None]) -> None:
    kind = Kind("made up", lambda at: (at / "a.bin").write_bytes(b"0" * 99) and None, {".bin": BYTES}, read)
    monkeypatch.setattr(fuzz.worker, "KINDS", (kind,))


def refuse(line: str) -> Callable[[Path], None]:
    def read(folder: Path) -> None:
        raise FacepinError(line)

    return read


@pytest.mark.parametrize(
    ("read", "noticed"),
    [
        (lambda folder: None, None),
        (refuse("a.bin: 7 is not allowed"), None),
        (refuse(" "), "not one line"),
        (refuse("a.bin: does not fit into memory"), "memory"),
        (lambda folder: 1 / 0, "ZeroDivisionError"),
        (lambda folder: bytearray(1 << 30), "MemoryError"),
    ],
)
def test_what_goes_wrong_is_noticed(
    monkeypatch: pytest.MonkeyPatch, read: Callable[[Path], None], noticed: str | None
) -> None:
    made_up(monkeypatch, read)
    found = outcome(0)
    assert found is None if noticed is None else noticed in str(found)
