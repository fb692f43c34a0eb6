"""The program in a real X window, driven by a real mouse."""

import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from facepin.core.events import Stirred
from facepin.panels.commands import Command
from facepin.window import Window
from support.driver import running


@pytest.fixture(scope="module")
def screen() -> Iterator[str]:
    """A display of our own: the one CI names, or an Xvfb started here."""
    named = os.environ.get("FACEPIN_SCREEN")
    if named:
        yield named
        return
    if not (shutil.which("Xvfb") and shutil.which("xdotool")):
        pytest.skip("Xvfb and xdotool are needed to try the real window")
    read, write = os.pipe()
    # One that resets itself when the last window is gone may refuse the next.
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", "1920x1080x24", "-noreset", "-nolisten", "tcp"],
        pass_fds=[write],
        stderr=subprocess.DEVNULL,
    )
    os.close(write)
    with os.fdopen(read) as number:
        yield f":{number.readline().strip()}"
    server.terminate()
    server.wait()


class Hand:
    """A mouse and a keyboard."""

    def __init__(self, screen: str) -> None:
        self.environment = {**os.environ, "DISPLAY": screen}

    def do(self, *words: object) -> str:
        command = ["xdotool", *map(str, words)]
        done = subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False)
        return done.stdout.strip()


def test_press_drag_undo_save_in_a_real_window(screen: str, tmp_path: Path) -> None:
    hand = Hand(screen)
    home = tmp_path / "home"
    home.mkdir()
    environment = {
        **hand.environment,
        "HOME": str(home),
        "XDG_CONFIG_HOME": str(home / "config"),
        "PATH": os.defpath,  # no helper for native dialogs: the path is typed
    }
    program = subprocess.Popen(
        [sys.executable, "-m", "facepin", "--solver", "tikhonov"], env=environment, stderr=subprocess.PIPE
    )
    try:
        window = _wait_for(lambda: hand.do("search", "--name", "^ada - Facepin$"), 90.0)
        geometry = dict(
            line.split("=")
            for line in hand.do("getwindowgeometry", "--shell", window.split()[0]).splitlines()
        )
        left, top = int(geometry["X"]), int(geometry["Y"])
        # The chin of the built-in face stands below the middle of the picture.
        _drag(hand, (left + 473, top + 480), 30)
        saved = _save(hand, home / "dragged.facepin")
        assert saved["panes"][0]["weights"]["jawOpen"] > 0.1
        assert len(saved["pins"]) == 1
        hand.do("key", "ctrl+z")
        unsaved = r"\* - ada - Facepin$"
        assert _wait_for(lambda: hand.do("search", "--name", unsaved)), "undone, so not as saved"
        undone = _save(hand, home / "undone.facepin")
        assert not undone["panes"][0]["weights"]
        assert not undone["pins"]
        hand.do("key", "ctrl+shift+z")
        assert _wait_for(lambda: hand.do("search", "--name", unsaved)), "redone, so not as saved"
        redone = _save(hand, home / "redone.facepin")
        assert redone["panes"] == saved["panes"]
        hand.do("key", "ctrl+q")
        _, complaints = program.communicate(timeout=120)
        assert program.returncode == 0
        assert complaints == b""
    finally:
        program.kill()
        program.communicate()


def _drag(hand: Hand, start: tuple[int, int], way: int) -> None:
    """Drag down, until the title says that something has changed: a window that just opened may not hear."""
    for _ in range(5):
        hand.do("mousemove", *start)
        hand.do("mousedown", 1)
        for _ in range(way // 2):
            hand.do("mousemove_relative", "--", 0, 2)
        hand.do("mouseup", 1)
        if _wait_for(lambda: hand.do("search", "--name", r"^ada\* - Facepin$")):
            return
    raise AssertionError("the pose should be unsaved")


def _save(hand: Hand, path: Path) -> dict[str, Any]:
    """Save the scene under a typed path, and read it."""
    asking = f"^{Command.SAVE_AS.title.rstrip('…')} - "
    for _ in range(5):
        hand.do("key", "ctrl+shift+s")
        # Until the line for the path listens, what is typed would be commands.
        assert _wait_for(lambda: hand.do("search", "--name", asking)), "nobody asked for a path"
        hand.do("key", "ctrl+a")
        hand.do("type", "--delay", 8, f"~/{path.name}")
        hand.do("key", "Return")
        if _wait_for(lambda: hand.do("search", "--name", f"^{path.name} - ")):
            return json.loads(path.read_text())
        # A key was lost on the way, as happens on a busy machine.
        hand.do("key", "Escape")
        assert _wait_for(lambda: "" if hand.do("search", "--name", asking) else "gone"), "Esc was not heard"
    raise AssertionError(f"{path.name} was not saved")


def _wait_for(ask: object, seconds: float = 60.0) -> str:
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        if answer := ask():
            return answer
        time.sleep(0.1)
    return ""


def test_a_resized_window_and_a_typed_character_are_heard(
    screen: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("DISPLAY", screen)
    hand = Hand(screen)
    with Window("stirred", (400, 300)) as window:

        def heard(wanted: type) -> bool:
            return any(isinstance(event, wanted) for event in window.poll(0.1))

        (number,) = _wait_for(lambda: hand.do("search", "--name", "^stirred$")).split()
        while window.poll(0.5):
            pass
        hand.do("windowsize", number, 500, 350)
        assert _wait_for(lambda: heard(Stirred))
        assert window.size == (500, 350)
        while window.poll(0.5):
            pass
        hand.do("windowfocus", number)
        while window.poll(0.5):
            pass
        hand.do("key", "underscore")  # a key without a name among the events
        assert _wait_for(lambda: heard(Stirred))


def test_a_resized_window_is_filled(screen: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DISPLAY", screen)

    def lit(picture: np.ndarray, rows: slice, columns: slice) -> bool:
        return bool((picture[rows, columns].max(axis=2) > 8).mean() > 0.99)

    with running(size=(700, 500), windowless=False) as app:
        for size in ((1500, 900), (500, 400), (900, 1000)):
            app.window.resize(size)
            app.until(lambda size=size: app.window.size == size)
            app.until(lambda: app.frame.drawn)
            app.until(lambda: not app.frame.drawn)
            picture = app.screenshot()
            assert picture.shape == (size[1], size[0], 3)
            viewport = app.frame.viewport
            right, bottom = int(viewport.width) - 4, int(viewport.y + viewport.height)
            # Wall behind the head at the top, bust and wall at the bottom: nothing is left black.
            assert lit(picture, slice(25, 60), slice(0, right))
            assert lit(picture, slice(bottom - 40, bottom - 2), slice(0, right))
            # The face is in the middle of what is free: skin is warm, the wall is not.
            middle = picture[int(viewport.y + viewport.height / 2), right // 2].astype(int)
            assert middle[0] > middle[2] + 20


def test_four_panes_follow_one_drag_in_a_real_window(screen: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DISPLAY", screen)
    hand = Hand(screen)
    solvers = ("transpose", "sparse", "tikhonov", "hybrid")
    with running(size=(1600, 900), windowless=False, solver=",".join(solvers)) as app:
        number = _wait_for(lambda: hand.do("search", "--name", "^ada - Facepin$")).split()[0]
        app.until(lambda: len(app.frame.viewports) == 4)
        place = hand.do("getwindowgeometry", "--shell", number).splitlines()
        geometry = dict(line.split("=") for line in place)
        left, top = int(geometry["X"]), int(geometry["Y"])
        before = app.session.work
        viewport = app.frame.viewports[1]
        jaw = app.session.rig.shape_names.index("jawOpen")
        move = app.session.rig.deltas[:, [jaw]].toarray().reshape(-1, 3)
        chin = int(np.argmin(np.where(app.session.rig.neutral[:, 2] > 6, move[:, 1], 0)))
        x, y, _ = app.desk.cameras[1].project(app.session.rig.neutral[chin][None], viewport)[0]
        hand.do("mousemove", left + round(x), top + round(y))
        app.until(lambda: app.frame.drawn)
        hand.do("mousedown", 1)
        app.until(lambda: app.desk.tool.holding)
        for _ in range(10):
            hand.do("mousemove_relative", "--", 0, 2)
            app.step()
        hand.do("mouseup", 1)
        app.until(lambda: not app.desk.tool.holding)
        panes = app.session.panes
        assert [pane.choice.kind.key for pane in panes] == list(solvers)
        assert app.session.active == 1
        assert len({pane.pose.pins for pane in panes}) == 1
        for pane in panes:
            assert pane.pose.weights[jaw] > 0.02
        hand.do("windowfocus", number)
        hand.do("key", "ctrl+z")
        app.until(lambda: app.session.work is before)


def test_a_box_a_shared_drag_and_a_held_arrow_key_in_a_real_window(
    screen: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("DISPLAY", screen)
    hand = Hand(screen)
    with running(solver="tikhonov", windowless=False) as app:
        number = _wait_for(lambda: hand.do("search", "--name", "^ada - Facepin$")).split()[0]
        place = hand.do("getwindowgeometry", "--shell", number).splitlines()
        geometry = dict(line.split("=") for line in place)
        left, top = int(geometry["X"]), int(geometry["Y"])
        hand.do("windowfocus", number)
        viewport = app.frame.viewport
        x, y = left + round(viewport.x + viewport.width / 2), top + round(viewport.y + 0.66 * viewport.height)

        def drag(start: tuple[int, int], end: tuple[int, int]) -> None:
            hand.do("mousemove", *start)
            app.step(frames=3)
            hand.do("mousedown", 1)
            app.until(lambda: app.desk.tool.holding, 100)
            for share in (0.3, 0.6, 1.0):
                at = [round(a + share * (b - a)) for a, b in zip(start, end, strict=True)]
                hand.do("mousemove", *at)
                app.step()
            hand.do("mouseup", 1)
            app.until(lambda: not app.desk.tool.holding)

        # A stroke of pins, let go, and caught again with a rubber band.
        hand.do("key", "b")
        app.until(lambda: app.desk.view.pins.sketching)
        drag((x - 40, y), (x + 40, y))
        laid = app.session.work
        vertices = {pin.vertex for pin in app.session.pose.pins}
        assert len(vertices) == 6
        hand.do("key", "Escape")
        hand.do("key", "Escape")
        app.until(lambda: not app.desk.tool.selected)
        assert not app.desk.view.pins.sketching
        hand.do("keydown", "ctrl")
        drag((x - 90, y - 40), (x + 90, y + 40))
        hand.do("keyup", "ctrl")
        assert app.desk.tool.selected == vertices
        assert app.session.work is laid

        # A key that is held goes on until it is let go, as one step.
        hand.do("keydown", "Down")
        app.until(lambda: app.session.in_gesture)
        held = app.session.pose.pins[0].goal
        hand.do("keyup", "Down")
        app.until(lambda: not app.session.in_gesture)
        assert app.session.undo_label == "Nudge 6 pins"
        assert held[1] < laid.panes[0].pose.pins[0].goal[1]
        hand.do("key", "ctrl+z")
        app.until(lambda: app.session.work is laid)
        hand.do("key", "Delete")
        app.until(lambda: not app.session.pose.pins)
        assert not app.desk.tool.selected
