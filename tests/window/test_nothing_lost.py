"""Killed, torn, full or read-only: what was done before the gesture in hand is there again."""

import errno
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from imgui_bundle import imgui
from PIL import Image

from facepin.__main__ import main
from facepin.core.errors import FacepinError
from facepin.core.events import CloseRequested, FilesDropped, PointerMoved
from facepin.files.work.drafts import leftovers
from facepin.files.work.scene_file import Scene, read_scene
from facepin.frame import bars
from facepin.panels.commands import Command
from facepin.panels.help.guide import Guide
from facepin.panels.requests import AddPane, CancelLoading, DiscardWork, OpenPath, RestoreWork
from facepin.resources import builtin_faces
from facepin.session.edit import Edit
from facepin.session.solving.solving import choose
from support.driver import App, running
from support.small_rigs import write_sheet

KILLS, STARTS = 20, 2
"""How often work is killed, and after how many of them the whole program is started again."""


@pytest.fixture(scope="module")
def rig(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sheet as a file."""
    return write_sheet(tmp_path_factory.mktemp("faces") / "sheet.npz")


@pytest.fixture(scope="module")
def workshop() -> Iterator[subprocess.Popen[str]]:
    """A program that starts workers, with everything imported already."""
    tests = Path(__file__).resolve().parents[1]
    program = subprocess.Popen(
        [sys.executable, str(tests / "support/killed_work.py")],
        env={**os.environ, "PYTHONPATH": os.pathsep.join([str(tests), *filter(None, sys.path)])},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    yield program
    program.communicate()


@contextmanager
def small(rig: Path, *, settings_folder: Path | None = None, wait: bool = True) -> Iterator[App]:
    """Run the program in a small window, for someone who needs no first steps: both take less time."""
    if settings_folder is not None:
        experienced(settings_folder)
    with running(rig, size=(480, 320), settings_folder=settings_folder, wait=wait) as app:
        yield app


def experienced(settings: Path) -> None:
    """Remember that the first steps are done, where nothing is remembered yet."""
    settings.mkdir(exist_ok=True)
    if not (settings / "preferences.json").exists():
        (settings / "preferences.json").write_text('{"guide": 1000}')


def step_of(scene: Scene) -> float:
    """The number of the gesture that a scene holds."""
    return scene.panes[scene.active].weights.get("shape0", 0.0)


def gone(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return True
    return False


def frames(app: App, count: int = 3) -> None:
    app.step(PointerMoved(5, 5), frames=count)


def wait_for(app: App, condition: Callable[[], bool], seconds: float = 20.0) -> None:
    """Draw frames until something is so that another thread sees to."""
    until = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < until, "it never came to pass"
        time.sleep(0.002)
        app.step()


def set_first(app: App, weight: float) -> None:
    """One undo step."""
    weights = app.session.pose.weights.copy()
    weights[0] = weight
    app.desk.apply(Edit("Set", True, weights=weights))
    frames(app)


def answer(app: App, command: Command, path: Path) -> None:
    """Ask for a command that asks for a path, and answer it."""
    app.ask(command)
    assert app.desk.dialog is not None
    app.desk.dialog._finish(path)
    frames(app)


def opened(app: App) -> None:
    app.until(lambda: app.desk.loading is None)
    frames(app)


def test_killed_at_random_moments_at_most_the_gesture_in_hand_is_lost(
    rig: Path, tmp_path: Path, workshop: subprocess.Popen[str]
) -> None:
    chance = random.Random(5)
    assert workshop.stdin is not None
    assert workshop.stdout is not None
    for trial in range(KILLS):
        settings, log, scene = (tmp_path / f"{trial}" / name for name in ("settings", "log", "a.facepin"))
        log.parent.mkdir()
        experienced(settings)
        workshop.stdin.write(f"{rig} {settings} {log} {scene}\n")
        workshop.stdin.flush()
        worker = int(workshop.stdout.readline())
        until = time.monotonic() + 120
        while not (log.exists() and log.read_text()):
            assert time.monotonic() < until, "the worker did not begin"
            time.sleep(0.002)
        time.sleep(chance.uniform(0, 0.25))
        os.kill(worker, signal.SIGKILL)
        while not gone(worker):
            time.sleep(0.002)
        begun = len(log.read_text().split())
        left, remarks = leftovers(settings / "autosave")
        assert not remarks
        assert len(left) <= 1
        for picture in log.parent.glob("[!.]*.png"):
            Image.open(picture).load()  # whole, or not there
        saved = step_of(read_scene(scene)) if scene.exists() else 0.0  # whole, or not there
        there = step_of(left[0].scene) if left else saved
        assert there in (begun - 1, begun)
        assert saved in (begun - begun % 3, begun - 1 - (begun - 1) % 3)
        for leftover in left:
            leftover.draft.release()
        if left and trial % (KILLS // STARTS) == 0:
            with small(rig, settings_folder=settings) as app:
                (leftover,) = app.desk.keeper.left
                app.ask(RestoreWork(leftover.draft.path))
                opened(app)
                assert app.session.rig.name == "sheet"
                assert app.session.pose.weights[0] == there
                assert "*" in app.desk.title


def test_a_scene_is_saved_and_opened_by_keys_drop_menu_and_command_line(rig: Path, tmp_path: Path) -> None:
    settings, scene = tmp_path / "settings", tmp_path / "one.facepin"
    with small(rig, settings_folder=settings) as app:
        app.ask(AddPane(choose("tikhonov")))
        app.desk.view.linked = False
        app.desk.view.panes[0].wireframe = True
        set_first(app, 0.75)
        app.desk.look(app.desk.camera.orbited(0.3, 0), 1)
        cameras = list(app.desk.cameras)
        assert app.desk.title == "sheet* - Facepin"
        app.key("s", control=True)
        app.desk.dialog._finish(tmp_path / "one")  # what a dialog of the system may leave out
        frames(app)
        assert app.desk.title == "one.facepin - sheet - Facepin"
        set_first(app, 0.5)
        assert app.desk.title == "one.facepin* - sheet - Facepin"
        app.key("z", control=True)
        assert app.desk.title == "one.facepin - sheet - Facepin"  # as it was saved
        set_first(app, 0.25)
        app.key("s", control=True)  # no question any more
        assert app.desk.dialog is None
        assert step_of(read_scene(scene)) == 0.25
        work = app.session.work
        answer(app, Command.SAVE_AS, tmp_path / "two.facepin")
        assert app.desk.title == "two.facepin - sheet - Facepin"
        (tmp_path / "three.facepin").touch()
        answer(app, Command.SAVE_AS, tmp_path / "three")
        assert "to replace it, give its full name" in app.desk.message
        answer(app, Command.SAVE_AS, tmp_path / "four.json")
        assert ".facepin" in app.desk.message
        assert not (tmp_path / "four.json").exists()
    with small(scene, settings_folder=settings) as app:
        assert not app.desk.keeper.left
        assert app.desk.title == "one.facepin - sheet - Facepin"
        for pane, before in zip(app.session.panes, work.panes, strict=True):
            assert pane.choice == before.choice
            np.testing.assert_array_equal(pane.pose.weights, before.pose.weights)
        assert app.desk.cameras == cameras
        assert app.desk.view.panes[0].wireframe
        assert not app.desk.view.linked
        assert app.session.undo_label is None
        for ask in (
            lambda: app.step(FilesDropped((tmp_path / "two.facepin",)), frames=2),
            lambda: app.ask(OpenPath(scene)),
            lambda: answer(app, Command.OPEN_FILE, tmp_path / "two.facepin"),
        ):
            ask()
            opened(app)
            assert app.desk.message == ""
        assert app.desk.title == "two.facepin - sheet - Facepin"
    recent = (settings / "preferences.json").read_text()
    assert "two.facepin" in recent


def test_quitting_asks_nothing_and_the_next_start_offers_what_was_left(rig: Path, tmp_path: Path) -> None:
    scene = tmp_path / "one.facepin"
    with small(rig, settings_folder=tmp_path) as app:
        answer(app, Command.SAVE_AS, scene)
        set_first(app, 0.625)
        with pytest.raises(StopIteration):
            app.step(CloseRequested(), frames=2)
    with small(rig, settings_folder=tmp_path) as app:
        assert app.desk.view.recovery.shown
        (leftover,) = app.desk.keeper.left
        assert leftover.scene.of == scene
        app.ask(RestoreWork(leftover.draft.path))
        opened(app)
        assert app.desk.title == "one.facepin* - sheet - Facepin"
        assert app.session.pose.weights[0] == 0.625
        assert not app.desk.keeper.left
        app.key("s", control=True)
        assert step_of(read_scene(scene)) == 0.625
    with small(rig, settings_folder=tmp_path) as app:
        assert not app.desk.keeper.left


def test_what_another_window_saved_meanwhile_is_not_replaced_unasked(rig: Path, tmp_path: Path) -> None:
    scene = tmp_path / "one.facepin"
    with small(rig, settings_folder=tmp_path / "mine") as app:
        answer(app, Command.SAVE_AS, scene)
        set_first(app, 0.25)
        app.ask(Command.SAVE)
        assert step_of(read_scene(scene)) == 0.25 and app.desk.dialog is None
        other = scene.read_bytes().replace(b"0.25", b"0.75")
        scene.write_bytes(other)  # as another window would
        set_first(app, 0.5)
        app.ask(Command.SAVE)
        assert app.desk.is_error and "elsewhere" in app.desk.message
        assert scene.read_bytes() == other
        assert app.desk.dialog is not None
        app.desk.dialog._finish(tmp_path / "two.facepin")
        app.step(frames=2)
        assert step_of(read_scene(tmp_path / "two.facepin")) == 0.5
        assert app.desk.keeper.file == tmp_path / "two.facepin"
        answer(app, Command.OPEN_FILE, scene)
        opened(app)
        set_first(app, 0.125)
    scene.write_bytes(other.replace(b"0.75", b"0.875"))
    with small(rig, settings_folder=tmp_path / "mine") as app:  # work that was left knows it too
        app.ask(RestoreWork(app.desk.keeper.left[0].draft.path))
        opened(app)
        app.ask(Command.SAVE)
        assert app.desk.is_error and app.desk.dialog is not None
        app.desk.dialog._finish(scene)  # knowingly
        app.step(frames=2)
        assert step_of(read_scene(scene)) == 0.125
        set_first(app, 0.375)
        app.ask(Command.SAVE)
        assert step_of(read_scene(scene)) == 0.375


def test_a_face_that_was_not_touched_is_not_offered(rig: Path, tmp_path: Path) -> None:
    with small(rig, settings_folder=tmp_path) as app:
        app.session.choose_solver(0, choose("sparse"))
        app.step(frames=2)
    with small(rig, settings_folder=tmp_path) as app:
        assert not app.desk.keeper.left
        assert not app.desk.view.recovery.shown
        app.ask(Command.UNSAVED_WORK)
        assert "no unsaved work" in app.desk.message
        set_first(app, 0.5)
    with small(rig, settings_folder=tmp_path) as app:
        assert len(app.desk.keeper.left) == 1
        assert app.desk.view.recovery.shown
        app.step(PointerMoved(5, 5), frames=3)
        strip = imgui.internal.find_window_by_name("##recovery")
        assert strip.size.y < 2 * imgui.get_frame_height()
        assert app.frame.viewport.y >= strip.pos.y + strip.size.y - 1, "the face is not covered"
        low = app.frame.viewport.y
        x, y = strip.pos.x + strip.size.x - 30, strip.pos.y + strip.size.y / 2
        app.press(x, y)
        app.release(x, y)
        app.step(PointerMoved(5, 5), frames=3)
        assert not app.desk.view.recovery.shown and app.frame.viewport.y < low
        assert len(app.desk.keeper.left) == 1


def test_another_rig_leaves_the_work_behind_and_it_can_be_discarded(rig: Path, tmp_path: Path) -> None:
    with small(rig, settings_folder=tmp_path) as app:
        set_first(app, 0.5)
        app.ask(OpenPath(builtin_faces()["ada"]))
        opened(app)
        assert "The unsaved work on sheet is kept" in app.desk.message
        set_first(app, 0.25)
        assert not app.desk.view.recovery.shown
        (leftover,) = app.desk.keeper.left
        app.ask(RestoreWork(leftover.draft.path))
        opened(app)
        assert app.session.rig.name == "sheet"
        assert app.session.pose.weights[0] == 0.5
        (leftover,) = app.desk.keeper.left  # now the other one
        app.ask(DiscardWork(leftover.draft.path))
        assert not app.desk.keeper.left
        app.ask(RestoreWork(leftover.draft.path))
        assert app.desk.is_error
        answer(app, Command.SAVE_AS, tmp_path / "one.facepin")
    assert not list((tmp_path / "autosave").iterdir())


def test_a_fault_in_a_frame_keeps_the_work(
    rig: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(ZeroDivisionError), small(rig, settings_folder=tmp_path) as app:
        app.desk.apply(Edit("Set", True, weights=np.array([0.125, 1e-17, 0.5, 0.0])))
        monkeypatch.setattr("facepin.main_loop.panels", lambda *_: 1 // 0)
        app.step(PointerMoved(5, 5))
    (leftover,), _ = leftovers(tmp_path / "autosave")
    assert step_of(leftover.scene) == 0.125
    assert "2 active" in bars._work_row(leftover).about, "as the panel counts them"


def test_a_scene_whose_rig_is_gone_waits_until_it_is_shown(rig: Path, tmp_path: Path) -> None:
    moved, scene = tmp_path / "moved.npz", tmp_path / "one.facepin"
    moved.write_bytes(rig.read_bytes())
    with small(moved) as app:
        set_first(app, 0.5)
        answer(app, Command.SAVE_AS, scene)
    moved.rename(tmp_path / "elsewhere.npz")
    (broken := tmp_path / "broken.npz").write_bytes(b"not a face")
    for show in (
        lambda app: app.step(FilesDropped((tmp_path / "elsewhere.npz",)), frames=2),
        lambda app: answer(app, Command.LOCATE_RIG, tmp_path / "elsewhere.npz"),
    ):
        with small(scene, wait=False) as app:
            frames(app)
            assert app.desk.stage is None
            answer(app, Command.OPEN_FILE, scene)
            assert app.desk.dialog is None, "a card asks for the rig"
            assert f"one.facepin: its rig moved was not found, looked for {moved}" in app.desk.message
            app.ask(OpenPath(builtin_faces()["ada"]))
            opened(app)
            assert app.desk.opener.lost is None
            app.ask(OpenPath(scene))
            frames(app)
            assert app.session.rig.name == "ada"
            app.ask(CancelLoading())
            assert app.desk.opener.lost is None
            app.ask(OpenPath(scene))
            app.ask(OpenPath(broken))
            app.until(lambda: app.desk.opener.loading is None)
            assert "broken.npz" in app.desk.message
            show(app)  # the scene waits still
            opened(app)
            assert app.session.pose.weights[0] == 0.5
            assert app.desk.title == "one.facepin* - elsewhere - Facepin"  # the scene says otherwise yet


@pytest.mark.parametrize(
    ("content", "said"),
    [(b"{", "not JSON"), (b'{"format": "facepin-scene", "version": 2}', "newer Facepin"), (b"{}", "format")],
)
def test_a_scene_that_cannot_be_read_leaves_everything_in_place(
    rig: Path, tmp_path: Path, content: bytes, said: str
) -> None:
    (tmp_path / "bad.facepin").write_bytes(content)
    with small(rig) as app:
        work = app.session.work
        app.step(FilesDropped((tmp_path / "bad.facepin",)), frames=2)
        assert said in app.desk.message
        assert "bad.facepin" in app.desk.message
        assert app.session.work is work
    with small(tmp_path / "bad.facepin", wait=False) as app:
        frames(app)
        assert said in app.desk.message


def test_broken_preferences_layout_and_drafts_are_set_aside_and_said(
    rig: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Guide, "moving", lambda *_: False)  # without preferences everyone is a newcomer
    odd = b"\xff\x00\x01 not what anyone wrote"
    (tmp_path / "autosave").mkdir()
    for name in ("preferences.json", "layout.ini", "autosave/1234.facepin"):
        (tmp_path / name).write_bytes(odd)
        with small(rig, settings_folder=tmp_path) as app:
            assert app.desk.is_error
            assert f"set aside as {Path(name).name}.broken" in app.desk.message
            assert app.session.rig.name == "sheet"
        assert (tmp_path / f"{name}.broken").read_bytes() == odd
    with small(rig, settings_folder=tmp_path) as app:
        assert not app.desk.is_error


def test_no_layout_stops_the_start(rig: Path, tmp_path: Path) -> None:
    """A layout torn anywhere, or with wild numbers, is refused or read over."""
    with small(rig, settings_folder=tmp_path) as app:
        frames(app)
    whole = (tmp_path / "layout.ini").read_text()
    assert "[Docking]" in whole
    chance = random.Random(2)
    texts = [whole[: len(whole) * part // 4] for part in (1, 3)]
    texts += [
        "".join(chance.choice("0x1F,9-") if c in "0123456789ABCDEF" else c for c in whole) for _ in range(3)
    ]
    for text in texts:
        (tmp_path / "layout.ini").write_text(text)
        with small(rig, settings_folder=tmp_path) as app:
            app.ask(Command.RESET_LAYOUT)
            frames(app)
            assert app.frame.drawn


def test_on_a_full_disk_the_work_stays_and_quitting_warns_once(
    rig: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    with small(rig, settings_folder=tmp_path) as app:
        app.desk.keeper._saver._retry = 0.01
        with monkeypatch.context() as disk:
            disk.setattr(Path, "write_bytes", full)
            set_first(app, 0.5)
            wait_for(app, lambda: bool(app.desk.keeper.complaint))
            frames(app)
            app.ask(Command.QUIT)
            assert not app.desk.closing
            assert "No space left on device" in app.desk.message
            answer(app, Command.SAVE_AS, tmp_path / "one.facepin")
            assert app.desk.is_error
            assert "*" in app.desk.title
            app.ask(OpenPath(builtin_faces()["ada"]))
            app.until(lambda: app.desk.loading is None)
            frames(app)
            assert "stays open" in app.desk.message
            assert app.session.rig.name == "sheet"
            assert app.session.pose.weights[0] == 0.5
        wait_for(app, lambda: not app.desk.keeper.complaint)
        app.ask(Command.QUIT)
        with pytest.raises(StopIteration):
            app.step(frames=2)
    (leftover,), _ = leftovers(tmp_path / "autosave")
    assert step_of(leftover.scene) == 0.5


def test_what_can_be_kept_nowhere_is_said_at_the_end(
    rig: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "autosave").touch()  # a file where the folder should be
    with (
        pytest.raises(FacepinError, match="could not be kept"),
        small(rig, settings_folder=tmp_path) as app,
    ):
        set_first(app, 0.5)


def test_the_history_window_goes_to_any_step(rig: Path) -> None:
    with small(rig) as app:
        for step in range(1, 6):
            set_first(app, step / 10)
        app.key("z", control=True, alt=True)
        assert app.desk.view.history
        frames(app)
        window = imgui.internal.find_window_by_name("History")
        top = window.pos.y + imgui.get_frame_height() + imgui.get_style().window_padding.y - window.scroll.y
        row = top + 2.5 * imgui.get_text_line_height_with_spacing()
        app.press(window.pos.x + 60, row)
        app.release(window.pos.x + 60, row)
        frames(app)
        assert app.session.step == 2
        assert app.session.pose.weights[0] == 0.2
        assert app.session.redo_label == "Set"
        app.key("z", control=True, alt=True)
        assert not app.desk.view.history


def test_a_scene_brings_its_own_solvers_and_pins(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "one.facepin").touch()
    assert main([str(tmp_path / "one.facepin"), "--pose", "p.json", "--solver", "hybrid"]) == 2
    assert "one.facepin is a scene, which has its own --solver and --pose" in capsys.readouterr().err
