"""Unsaved work: drafts, their locks, the thread that writes them, and whoever finds them."""

import errno
import json
import multiprocessing
import os
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from threading import Event, Timer

import numpy as np
import pytest

from facepin import platforms
from facepin.core.errors import FacepinError
from facepin.core.look.camera import Camera
from facepin.desk.keeping import Keeper
from facepin.desk.scenes import RigSource, Snapshot, resume
from facepin.files.safely.file_lock import take_lock
from facepin.files.work.drafts import Draft, leftovers
from facepin.session.autosave import Autosave
from facepin.session.edit import Edit
from facepin.session.session import Session
from facepin.session.solving.solving import choose
from support.small_rigs import sheet

RIG = sheet()


class Window:
    """What of a window matters here."""

    def __init__(self, folder: Path) -> None:
        self.keeper = Keeper(folder)
        self.session = Session(RIG, [choose("transpose")])
        self.keeper.begin(self.session, None)

    def snapshot(self) -> Snapshot:
        cameras, shown = (Camera(),) * 4, ({},) * 4
        source = RigSource(Path("/faces/sheet.npz"))
        file = self.keeper.file
        return Snapshot(RIG, source, self.session.committed, 0, cameras, shown, True, file, {})

    def work(self, weight: float) -> None:
        """Do one step, and have it kept."""
        self.session.apply(Edit("Set", True, weights=np.full(4, weight)))
        self.keep()

    def keep(self) -> None:
        self.keeper.follow(self.session, self.snapshot)

    def die(self) -> None:
        """End without a word, as a killed process does: the system takes the locks away."""
        if self.keeper._draft is not None and self.keeper._draft._lock is not None:
            os.close(self.keeper._draft._lock._file)


@pytest.fixture
def window(tmp_path: Path) -> Iterator[Window]:
    window = Window(tmp_path)
    yield window
    window.keeper.close()


def drafts_in(folder: Path) -> list[Path]:
    return sorted(folder.glob("[!.]*.facepin"))


def kept_in(folder: Path) -> list[float]:
    """The first weight of every draft."""
    found = [json.loads(path.read_bytes())["panes"][0]["weights"] for path in drafts_in(folder)]
    return [weights.get("shape0", 0.0) for weights in found]


def wait_for(condition: Callable[[], bool], seconds: float = 10.0) -> None:
    until = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < until, "it never came to pass"
        time.sleep(0.002)


def test_a_draft_follows_the_undo_steps_and_goes_when_everything_is_saved(
    tmp_path: Path, window: Window
) -> None:
    window.keep()
    assert not list(tmp_path.iterdir())  # nothing done, nothing written
    for weight in (0.25, 0.5):
        window.work(weight)
        wait_for(lambda weight=weight: kept_in(tmp_path) == [weight])
    window.session.undo()
    window.keep()
    wait_for(lambda: kept_in(tmp_path) == [0.25])
    window.session.apply(Edit("Drag", False, weights=np.full(4, 0.9)))  # a gesture is no step yet
    window.keep()
    time.sleep(0.02)
    assert kept_in(tmp_path) == [0.25]
    window.session.cancel()
    scene = tmp_path.parent / "saved.facepin"
    window.keeper.save(window.session, scene, window.snapshot())
    assert window.keeper.is_saved(window.session)
    window.keep()
    wait_for(lambda: not drafts_in(tmp_path))
    window.work(0.75)
    wait_for(lambda: kept_in(tmp_path) == [0.75])
    window.session.undo()  # back to what is saved
    window.keep()
    wait_for(lambda: not drafts_in(tmp_path))
    assert not window.keeper.close()
    assert not list(tmp_path.iterdir())


def test_what_a_window_left_is_found_once_and_goes_on_in_its_own_draft(tmp_path: Path) -> None:
    first = Window(tmp_path)
    first.work(0.5)
    assert not first.keeper.close()
    second, third = Window(tmp_path), Window(tmp_path)
    (leftover,), (other,) = second.keeper.left, third.keeper.left
    leftover = second.keeper.take_up(leftover)
    for late in (third.keeper.take_up, third.keeper.discard):
        with pytest.raises(FacepinError, match="another window"):
            late(other)
    found = resume(leftover.scene, RIG)
    assert found.work.panes[0].pose.weights.tolist() == [0.5] * 4
    second.session = Session.resumed(RIG, found.work)
    second.keeper.begin(second.session, None, leftover)
    assert not second.keeper.is_saved(second.session)
    second.keep()
    second.work(0.625)
    wait_for(lambda: kept_in(tmp_path) == [0.625])
    for window in (second, third):
        assert not window.keeper.close()
    assert len(Window(tmp_path).keeper.left) == 1


def test_later_leaves_it_to_the_next_window_and_discard_ends_it(tmp_path: Path) -> None:
    first = Window(tmp_path)
    first.work(0.5)
    first.keeper.close()
    second = Window(tmp_path)
    second.keeper.close()
    third = Window(tmp_path)
    third.keeper.discard(third.keeper.left[0])
    assert not third.keeper.left
    third.keeper.close()
    assert not list(tmp_path.iterdir())


def test_another_rig_in_the_same_window_leaves_the_work_behind(tmp_path: Path, window: Window) -> None:
    assert window.keeper.let_go(window.session, window.snapshot) is None
    window.work(0.5)
    left = window.keeper.let_go(window.session, window.snapshot)
    assert left is not None
    window.session = Session(RIG, [choose("transpose")])
    window.keeper.begin(window.session, None)
    window.work(0.25)
    wait_for(lambda: sorted(kept_in(tmp_path)) == [0.25, 0.5])
    assert [leftover.scene.panes[0].weights["shape0"] for leftover in window.keeper.left] == [0.5]
    (found,) = Window(tmp_path).keeper.left
    assert found.scene.panes[0].weights["shape0"] == 0.5, "what is open is not offered to others"


def test_two_windows_at_once_keep_apart(tmp_path: Path) -> None:
    windows = [Window(tmp_path) for _ in range(3)]
    for number, window in enumerate(windows, 1):
        for weight in (0.1, 0.2):
            window.work(number + weight)
    wait_for(lambda: sorted(kept_in(tmp_path)) == [1.2, 2.2, 3.2])
    assert not Window(tmp_path).keeper.left  # all of them live
    windows[1].die()
    (found,) = Window(tmp_path).keeper.left
    assert found.scene.panes[0].weights["shape0"] == 2.2
    for window in (windows[0], windows[2]):
        window.keeper.close()


def _hold(path: Path, locked: Event, done: Event) -> None:
    assert take_lock(path) is not None
    locked.set()
    done.wait(20)
    os._exit(1)


def test_a_lock_holds_between_processes_and_ends_with_its_process(tmp_path: Path) -> None:
    context = multiprocessing.get_context("fork")
    locked, done = context.Event(), context.Event()
    process = context.Process(target=_hold, args=(tmp_path / "a.lock", locked, done))
    process.start()
    assert locked.wait(20)
    assert take_lock(tmp_path / "a.lock") is None
    process.kill()
    process.join()
    lock = take_lock(tmp_path / "a.lock")
    assert lock is not None
    assert take_lock(tmp_path / "a.lock") is None
    lock.release()
    assert not (tmp_path / "a.lock").exists()


@pytest.mark.parametrize(
    ("note", "free"),
    [("", True), ("{host} {pid}", False), ("{host} 999999999", True), ("elsewhere 999999999", False)],
)
def test_where_there_are_no_locks_the_note_in_the_file_counts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, note: str, free: bool
) -> None:
    import socket

    def none(_: int) -> None:
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr("facepin.platforms.lock", none)
    (tmp_path / "a.lock").write_text(note.format(host=socket.gethostname(), pid=os.getpid()))
    assert (take_lock(tmp_path / "a.lock") is not None) is free


def test_what_is_broken_is_set_aside_and_said_and_what_is_newer_is_left_alone(tmp_path: Path) -> None:
    window = Window(tmp_path)
    window.work(0.5)
    window.keeper.close()
    (whole,) = drafts_in(tmp_path)
    content = whole.read_bytes()
    for name, text in (("torn", content[:100]), ("newer", content.replace(b'"version": 1', b'"version": 9'))):
        (tmp_path / f"{name}.facepin").write_bytes(text)
    for name in ("torn", "newer", "empty"):
        (tmp_path / f"{name}.lock").touch()
    (tmp_path / f".{whole.stem}-1a2b3c4d.facepin").write_bytes(content[:50])  # killed while writing
    found, remarks = leftovers(tmp_path)
    assert [leftover.draft.path for leftover in found] == [whole]
    (remark,) = remarks
    assert "torn.facepin" in remark
    assert "set aside as torn.facepin.broken" in remark
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(
        ["newer.facepin", "torn.facepin.broken", whole.name]
    )


def test_a_draft_whose_lock_is_gone_is_found_all_the_same(tmp_path: Path) -> None:
    window = Window(tmp_path)
    window.work(0.5)
    window.keeper.close()
    for lock in tmp_path.glob("*.lock"):
        lock.unlink()
    assert len(Window(tmp_path).keeper.left) == 1


def test_however_much_is_left_all_of_it_is_offered_and_none_of_it_held_open(tmp_path: Path) -> None:
    first = Window(tmp_path)
    first.work(0.5)
    first.keeper.close()
    (draft,) = drafts_in(tmp_path)
    content = json.loads(draft.read_bytes())
    for number in range(46):
        content["panes"][0]["weights"]["shape0"] = 1.0 + number
        (tmp_path / f"{number:016x}.facepin").write_text(json.dumps(content))
    draft.unlink()
    before = open_files()
    late = Window(tmp_path)
    assert sorted(leftover.scene.panes[0].weights["shape0"] for leftover in late.keeper.left) == [
        1.0 + number for number in range(46)
    ]
    assert open_files() <= before
    assert len(drafts_in(tmp_path)) == 46


def open_files() -> int:
    """How many files this process has open; 0 where the system does not say."""
    folder = Path("/proc/self/fd")
    return len(list(folder.iterdir())) if folder.is_dir() else 0


def test_a_face_at_rest_makes_no_draft_and_is_not_offered(tmp_path: Path, window: Window) -> None:
    window.session.choose_solver(0, choose("sparse"))
    window.keep()
    assert window.keeper.let_go(window.session, window.snapshot) is None
    assert not window.keeper.left and not drafts_in(tmp_path)
    window.keeper.begin(window.session, None)
    window.work(0.5)
    wait_for(lambda: kept_in(tmp_path) == [0.5])
    window.work(0.0)
    wait_for(lambda: not drafts_in(tmp_path))


def test_what_another_window_took_up_and_finished_is_offered_no_more(tmp_path: Path) -> None:
    first = Window(tmp_path)
    first.work(0.5)
    first.keeper.close()
    second, third = Window(tmp_path), Window(tmp_path)
    second.keeper.discard(second.keeper.left[0])
    with pytest.raises(FacepinError, match="already"):
        third.keeper.take_up(third.keeper.left[0])
    assert not third.keeper.left
    third.keeper.close()
    second.keeper.close()
    assert not list(tmp_path.iterdir())


def test_work_that_another_window_went_on_with_is_taken_up_as_that_left_it(tmp_path: Path) -> None:
    first = Window(tmp_path)
    first.work(0.5)
    first.keeper.close()
    early, late = Window(tmp_path), Window(tmp_path)
    early.keeper.begin(early.session, None, early.keeper.take_up(early.keeper.left[0]))
    early.work(0.75)
    early.keeper.close()
    assert late.keeper.take_up(late.keeper.left[0]).scene.panes[0].weights["shape0"] == 0.75
    late.keeper.close()


def test_a_lock_that_is_taken_away_in_the_moment_it_is_asked_for_is_taken_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a.lock"
    lock, held = platforms.lock, take_lock(path)
    assert held is not None

    def after_release(file: int) -> None:
        monkeypatch.setattr(platforms, "lock", lock)
        held.release()
        lock(file)

    monkeypatch.setattr(platforms, "lock", after_release)
    mine = take_lock(path)
    assert mine is not None and path.exists()
    assert take_lock(path) is None


def full(*_: object) -> None:
    raise OSError(errno.ENOSPC, "No space left on device")


def test_a_full_disk_is_said_and_tried_again_until_it_is_not(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("facepin.session.autosave.RETRY", 0.01)
    window = Window(tmp_path)
    window.keeper._saver._retry = 0.01
    window.work(0.25)
    wait_for(lambda: kept_in(tmp_path) == [0.25])
    with monkeypatch.context() as disk:
        disk.setattr(Path, "write_bytes", full)
        window.work(0.5)
        wait_for(lambda: "No space left on device" in window.keeper.complaint)
        assert kept_in(tmp_path) == [0.25]  # what was there is still there, whole
        assert "\n" not in window.keeper.complaint
        assert window.session.pose.weights[0] == 0.5
        # It can't be closed unawares, nor can another rig take its place.
        doubt = window.keeper.may_close(window.session, window.snapshot)
        assert "No space left" in doubt
        with pytest.raises(FacepinError, match="stays open"):
            window.keeper.let_go(window.session, window.snapshot)
        assert not window.keeper.may_close(window.session, window.snapshot)  # said once
        with pytest.raises(FacepinError, match="No space left"):
            window.keeper.save(window.session, tmp_path / "saved.facepin", window.snapshot())
        assert not window.keeper.is_saved(window.session)
    wait_for(lambda: not window.keeper.complaint)
    assert kept_in(tmp_path) == [0.5]
    assert not window.keeper.close()


def test_a_read_only_folder_is_said_and_the_end_says_what_was_lost(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def read_only(*_: object, **__: object) -> None:
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr(Path, "mkdir", read_only)
    window = Window(tmp_path / "none")
    window.work(0.5)
    wait_for(lambda: bool(window.keeper.complaint))
    assert "Permission denied" in window.keeper.complaint
    assert "Permission denied" in window.keeper.close()


def test_whoever_puts_a_value_never_waits_and_only_the_newest_is_written() -> None:
    going, written = Event(), []

    def slow(value: int) -> None:
        going.wait(10)
        written.append(value)

    saver: Autosave[int] = Autosave(slow)
    began = time.perf_counter()
    for value in range(1000):
        saver.put(value)
    assert time.perf_counter() - began < 5  # not a thousand times ten seconds
    going.set()
    assert saver.flush()
    assert len(written) <= 2
    assert written[-1] == 999
    assert saver.close()


def test_a_fault_of_the_writer_is_told_and_does_not_end_the_thread() -> None:
    written = []

    def faulty(value: int) -> None:
        if value == 1:
            raise ZeroDivisionError
        written.append(value)

    saver: Autosave[int] = Autosave(faulty, retry=0.01)
    saver.put(1)
    assert not saver.flush()
    assert saver.complaint == "ZeroDivisionError"
    saver.put(2)
    assert saver.flush()
    assert not saver.complaint
    assert written == [2]
    assert saver.close()


def test_what_is_newest_is_written_at_the_end_though_one_before_it_failed() -> None:
    begun, go_on = Event(), Event()
    written: list[str] = []

    def write(value: str) -> None:
        if value == "first":
            begun.set()
            go_on.wait(5)
            raise OSError("the disk was busy")
        time.sleep(0.2)  # so that whoever waits looks in between
        written.append(value)

    saver: Autosave[str] = Autosave(write, retry=60)
    saver.put("first")
    assert begun.wait(5)
    saver.put("second")
    Timer(0.1, go_on.set).start()  # when the end is waited for already
    assert saver.close()
    assert written == ["second"]
    assert saver.complaint == ""


def test_a_draft_that_another_window_has_is_not_written(tmp_path: Path) -> None:
    one, other = Draft(tmp_path, "same"), Draft(tmp_path, "same")
    one.write(b"one")
    with pytest.raises(FacepinError, match="another window"):
        other.write(b"other")
    assert one.path.read_bytes() == b"one"
    one.release()
