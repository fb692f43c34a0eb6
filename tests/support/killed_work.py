"""Works on a face until it is killed.  A program of its own, for `test_nothing_lost`.

Reads lines "RIG SETTINGS LOG SCENE" and starts a worker for each, telling its process.  A worker counts its
gestures in the first weight: minus the number while one goes on, the number when it is done.
"""

import os
import signal
import sys
from pathlib import Path

import numpy as np

from facepin.core.events import PointerMoved
from facepin.panels.commands import Command
from facepin.session.edit import Edit
from support.driver import App, running


def work(rig: Path, settings: Path, log: Path, scene: Path) -> None:
    """Make one gesture after another; save the scene after every third, a picture before it."""
    journal = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_APPEND)
    with running(rig, size=(320, 240), settings_folder=settings, pictures=log.parent) as app:
        number = 0
        while True:
            number += 1
            os.write(journal, f"{number}\n".encode())
            for step in range(3):
                gesture(app, -number + step / 10, final=False)
            gesture(app, number, final=True)
            # The hand rests until the disk has it: no gesture begins on one that is not there yet.
            assert app.desk.keeper._saver.flush()
            if number % 3 == 0:
                save(app, scene)
            elif number % 3 == 2:
                app.ask(Command.SCREENSHOT)
                app.step(PointerMoved(5, 5))


def gesture(app: App, weight: float, *, final: bool) -> None:
    weights = np.full(app.session.rig.shape_count, 0.5)
    weights[0] = weight
    app.desk.apply(Edit("Set", final, weights=weights))
    app.step(PointerMoved(*np.random.default_rng().uniform(5, 100, 2)))


def save(app: App, scene: Path) -> None:
    app.ask(Command.SAVE)
    if app.desk.dialog is not None:
        app.desk.dialog._finish(scene)
    app.step(PointerMoved(5, 5), frames=2)
    assert "Saved" in app.desk.message


if __name__ == "__main__":
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    for line in sys.stdin:
        worker = os.fork()
        if worker == 0:
            work(*(Path(word) for word in line.split()))
        os.write(1, f"{worker}\n".encode())
