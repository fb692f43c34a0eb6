"""What is done on systems that the tests do not run on."""

import os
import re
import shutil
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from facepin import platforms
from facepin.__main__ import main
from facepin.figures.study.processes import spread
from facepin.window import context

PACKAGE = Path(platforms.__file__).parent


def test_all_that_differs_stands_in_one_module() -> None:
    asks = re.compile(r"sys\.platform|os\.name\b")
    found = [path.name for path in PACKAGE.rglob("*.py") if asks.search(path.read_text(encoding="utf-8"))]
    assert found == ["platforms.py"]


@pytest.mark.parametrize(("system", "folders"), [("win32", False), ("darwin", True), ("linux", True)])
def test_files_are_pushed_to_the_disk_as_each_system_can(
    system: str, folders: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pushed: list[str] = []
    monkeypatch.setattr(platforms, "SYSTEM", system)
    monkeypatch.setattr(os, "fsync", lambda _: pushed.append("sync"))
    monkeypatch.setattr(platforms.fcntl, "fcntl", lambda *_: pushed.append("full"), raising=False)
    platforms.push_folder(tmp_path)
    assert pushed == ["sync"] * folders
    platforms.push(0)
    assert pushed[-1] == ("full" if system == "darwin" else "sync")


@pytest.mark.parametrize("system", ["win32", "darwin"])
def test_dialogs_and_windows_elsewhere(system: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(platforms, "SYSTEM", system)
    assert platforms.has_native_dialogs()
    hints: dict[int, object] = {}
    monkeypatch.setattr(context.glfw, "default_window_hints", lambda: None)
    monkeypatch.setattr(context.glfw, "window_hint", hints.__setitem__)
    monkeypatch.setattr(context.glfw, "create_window", lambda *_: "window")
    assert context.create("title", (8, 8), windowless=True) == "window"
    assert hints[context.glfw.VISIBLE] is False
    assert context.glfw.CONTEXT_CREATION_API not in hints, "there is no EGL"


def disk(free: int) -> object:
    return lambda _: SimpleNamespace(free=free)


@pytest.mark.parametrize(
    ("system", "free", "given", "off"),
    [
        ("linux", 1 << 40, {}, False),
        ("linux", 4096, {}, True),
        ("linux", 4096, {"MESA_SHADER_CACHE_DISABLE": "false"}, False),
        ("win32", 4096, {}, False),
    ],
)
def test_shaders_are_kept_only_where_there_is_room(
    system: str,
    free: int,
    given: dict[str, str],
    off: bool,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(platforms, "SYSTEM", system)
    monkeypatch.setattr(shutil, "disk_usage", disk(free))
    environment = {"HOME": str(tmp_path / "nobody"), **given}
    platforms.spare_a_full_disk(environment)
    assert (environment.get("MESA_SHADER_CACHE_DISABLE") == "true") == off


def test_shaders_are_not_kept_in_a_folder_that_can_not_be_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[Path] = []

    def refuse(path: Path, _: int) -> bool:
        asked.append(Path(path))
        return False

    monkeypatch.setattr(platforms, "SYSTEM", "linux")
    monkeypatch.setattr(os, "access", refuse)
    environment = {"XDG_CACHE_HOME": str(tmp_path / "none/cache")}
    platforms.spare_a_full_disk(environment)
    assert environment["MESA_SHADER_CACHE_DISABLE"] == "true"
    assert asked == [tmp_path], "the nearest folder that is there"


class Line:
    """What another system's connections look like: no class that ours knows."""

    def __init__(self) -> None:
        self.given: list[int | None] = []

    def send(self, number: int | None) -> None:
        self.given.append(number)

    def recv(self) -> tuple[int, int]:
        number = self.given[-1]
        assert number is not None
        return number, number**2

    def close(self) -> None:
        pass


def test_work_is_spread_over_processes_whatever_their_connections_are(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    nobody = SimpleNamespace(start=lambda: None)
    other = SimpleNamespace(Pipe=lambda: (Line(), Line()), Process=lambda **_: nobody)
    monkeypatch.setattr("facepin.figures.study.processes.get_context", lambda _: other)
    monkeypatch.setattr("facepin.figures.study.processes.wait", lambda lines: list(lines))
    assert dict(spread(lambda number: number, 5, 2)) == {n: n * n for n in range(5)}


def test_a_program_without_a_console_says_nothing_and_works(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdout", None)
    monkeypatch.setattr("sys.stderr", None)
    assert main(["info", "ada"]) == 0
    assert main(["info", "nothing"]) == 2
    sys.stdout.close()
    sys.stderr.close()


def test_a_frozen_program_serves_its_own_processes(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[bool] = []
    monkeypatch.setattr("sys.frozen", True, raising=False)
    monkeypatch.setattr("facepin.__main__.freeze_support", lambda: asked.append(True))
    assert main(["info", "nothing"]) == 2
    assert asked == [True]
