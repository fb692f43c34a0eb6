"""Files appear whole or not at all."""

import os
import signal
import stat
from pathlib import Path

import pytest

from facepin.core.errors import FacepinError
from facepin.files.safely.atomic import atomic_file, atomic_write, set_aside


def test_a_new_file_and_one_that_is_replaced(tmp_path):
    path = tmp_path / "a.txt"
    atomic_write(path, b"one")
    atomic_write(path, b"two")
    assert path.read_bytes() == b"two"
    assert list(tmp_path.iterdir()) == [path]


def test_permissions_are_those_of_any_new_file_or_of_the_one_replaced(tmp_path):
    (tmp_path / "plain").write_bytes(b"")
    atomic_write(tmp_path / "new", b"x")
    assert (tmp_path / "new").stat().st_mode == (tmp_path / "plain").stat().st_mode
    (tmp_path / "new").chmod(0o640)
    atomic_write(tmp_path / "new", b"y")
    assert stat.S_IMODE((tmp_path / "new").stat().st_mode) == 0o640


def test_a_link_stays_a_link(tmp_path):
    (tmp_path / "real").write_bytes(b"one")
    (tmp_path / "link").symlink_to("real")
    atomic_write(tmp_path / "link", b"two")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_bytes() == b"two"


@pytest.mark.parametrize("step", ["write", "sync", "rename"])
def test_a_failure_leaves_what_was_there(tmp_path, monkeypatch, step):
    path = tmp_path / "a.txt"
    path.write_bytes(b"before")

    def fails(*arguments):
        raise OSError(28, "No space left on device")

    if step == "sync":
        monkeypatch.setattr(os, "fsync", fails)
    if step == "rename":
        monkeypatch.setattr(type(path), "replace", fails)
    with (
        pytest.raises(FacepinError, match=r"a\.txt: cannot be written: No space left"),
        atomic_file(path) as temporary,
    ):
        temporary.write_bytes(b"half")
        assert temporary.suffix == ".txt"
        if step == "write":
            fails()
    assert path.read_bytes() == b"before"
    assert list(tmp_path.iterdir()) == [path]


def test_the_folder_is_pushed_to_the_disk_too_after_the_rename(tmp_path, monkeypatch):
    pushed = []
    monkeypatch.setattr(os, "fsync", lambda file: pushed.append(stat.S_ISDIR(os.fstat(file).st_mode)))
    atomic_write(tmp_path / "a", b"x")
    assert pushed == ([False, True] if os.name == "posix" else [False])


def test_a_disk_that_is_full_in_the_middle_of_a_file(tmp_path):
    """Not a pretended error: the system itself stops writing."""
    resource = pytest.importorskip("resource")
    path = tmp_path / "a.txt"
    path.write_bytes(b"before")
    _, most = resource.getrlimit(resource.RLIMIT_FSIZE)
    before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, most))
    try:
        with pytest.raises(FacepinError, match=r"a\.txt: cannot be written: File too large"):
            atomic_write(path, b"x" * 10_000)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
        signal.signal(signal.SIGXFSZ, before)
    assert path.read_bytes() == b"before"
    assert list(tmp_path.iterdir()) == [path]


def test_what_is_set_aside_says_so_and_keeps_its_content(tmp_path):
    path = tmp_path / "a.json"
    path.write_bytes(b"odd")
    assert set_aside(path) == "it is set aside as a.json.broken"
    assert (tmp_path / "a.json.broken").read_bytes() == b"odd"
    assert not path.exists()
    assert "could not be set aside" in set_aside(path)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="only a process that can be forked is killed here")
@pytest.mark.parametrize("where", ["write", "sync", "before the rename", "after the rename"])
def test_a_process_killed_while_writing_leaves_the_old_file_or_the_new_one(tmp_path, where):
    path = tmp_path / "a.txt"
    atomic_write(path, b"before")
    child = os.fork()
    if child == 0:
        _die_at(where)
        atomic_write(path, b"after")
        os._exit(0)
    _, status = os.waitpid(child, 0)
    assert os.WTERMSIG(status) == signal.SIGKILL
    assert path.read_bytes() == (b"after" if where == "after the rename" else b"before")


def _die_at(where):
    """Have this process killed when it comes to a step of writing a file."""

    def die(*_):
        os.kill(os.getpid(), signal.SIGKILL)

    def half(path, content):
        with path.open("wb") as file:
            file.write(content[: len(content) // 2])
            file.flush()
            die()

    replace = Path.replace
    if where == "write":
        Path.write_bytes = half
    elif where == "sync":
        os.fsync = die
    elif where == "before the rename":
        Path.replace = die
    else:
        Path.replace = lambda path, target: (replace(path, target), die())


def test_other_errors_pass_and_clean_up(tmp_path):
    with pytest.raises(KeyError), atomic_file(tmp_path / "a") as temporary:
        temporary.write_bytes(b"half")
        raise KeyError
    assert not list(tmp_path.iterdir())


def test_no_folder_a_folder_in_the_way_and_a_name_too_long(tmp_path):
    for path in (tmp_path / "none" / "a", tmp_path, tmp_path / ("x" * 300)):
        with pytest.raises(FacepinError, match="cannot be written"):
            atomic_write(path, b"x")
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="the superuser may write everywhere")
def test_a_read_only_folder_and_a_read_only_file(tmp_path):
    (tmp_path / "a").write_bytes(b"before")
    (tmp_path / "a").chmod(0o444)
    with pytest.raises(FacepinError, match="read-only"):
        atomic_write(tmp_path / "a", b"x")
    tmp_path.chmod(0o555)
    with pytest.raises(FacepinError, match="Permission denied"):
        atomic_write(tmp_path / "b", b"x")
    tmp_path.chmod(0o755)
    assert (tmp_path / "a").read_bytes() == b"before"
