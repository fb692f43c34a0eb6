"""Uses the window by chance for hours, as a hand that never rests, and watches what it keeps.

    PYTHONPATH=tests python -m fuzz.soak --hours 4

Drags, sliders, commands, undo and redo, panes, faces and sizes of the window come in any order.  A bug ends
it with a traceback; so does growth of memory, of objects on the graphics card, of undo.
"""

import argparse
import gc
import resource
import sys
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

import moderngl
import numpy as np

from facepin.core.events import KeyPressed, Scrolled
from facepin.panels.commands import Command
from facepin.panels.requests import AddPane, ClosePane, OpenPath, RandomReference
from facepin.resources import builtin_faces
from facepin.session.edit import Edit
from facepin.session.solving.solving import choose
from support.driver import App, running

ROUND = 60
"""Actions after which what is kept is looked at."""
WARM = 8
"""Rounds until every panel, shader and face has been seen."""
MOST_UNDO = 201
ALLOWED = 1.25
"""Times what was kept at the end of the warm rounds."""
QUIET = (Command.UNDO, Command.REDO, Command.RESET_POSE, Command.FLIP_POSE, Command.MIRROR_LEFT)
QUIET += (Command.SELECT_PINS, Command.DELETE_PINS, Command.LOCK_PINS, Command.HIDE_PINS, Command.SHOW_PINS)
QUIET += (Command.CLEAR_PINS, Command.FRAME, Command.FRONT, Command.LEFT, Command.BACK, Command.TURN_LEFT)
QUIET += (Command.TURN_UP, Command.SHADING, Command.HEAT, Command.WIREFRAME, Command.GHOST, Command.GAZE)
QUIET += (Command.REFERENCE_FROM_POSE, Command.SHOW_REFERENCE, Command.FORGET_REFERENCE, Command.CHART)
QUIET += (Command.PALETTE, Command.KEYBOARD, Command.ABOUT, Command.GUIDE, Command.SYMMETRY, Command.HISTORY)
QUIET += (Command.SAVE_TO_LIBRARY, Command.FILMSTRIP, Command.TIDY, Command.SCREENSHOT)
"""Commands that ask for no path."""


class Hand:
    """What is done, drawn by chance."""

    def __init__(self, app: App, rng: np.random.Generator, faces: list[Path]) -> None:
        self._app, self._rng, self._faces = app, rng, faces
        acts: dict[Callable[[], None], int] = {
            self.drag: 30,
            self.slide: 10,
            self.command: 20,
            self.undo: 10,
            self.scroll: 5,
            self.orbit: 5,
            self.pane: 3,
            self.resize: 1,
            self.face: 1,
            self.reference: 2,
        }
        self._acts = list(acts)
        weights = np.array(list(acts.values()), float)
        self._chances = weights / weights.sum()
        self.done: Counter[str] = Counter()

    def act(self) -> None:
        """Do one thing, and leave whatever it opened."""
        act = self._acts[int(self._rng.choice(len(self._acts), p=self._chances))]
        self.done[act.__name__] += 1
        act()
        self._app.step(KeyPressed("escape"))

    def place(self) -> tuple[float, float]:
        """Return a place in one of the pictures."""
        views = self._app.frame.viewports
        view = views[int(self._rng.integers(len(views)))]
        x, y = self._rng.uniform(0.1, 0.9, 2).tolist()
        return view.x + x * view.width, view.y + y * view.height

    def drag(self) -> None:
        start = self.place()
        end = tuple(np.add(start, self._rng.normal(0, 40, 2)).tolist())
        held = {"shift": True} if self._rng.random() < 0.1 else {}
        self._app.drag(start, end, moves=int(self._rng.integers(1, 6)), **held)

    def orbit(self) -> None:
        start = self.place()
        end = tuple(np.add(start, self._rng.normal(0, 80, 2)).tolist())
        self._app.drag(start, end, button=["right", "middle"][int(self._rng.integers(2))], moves=3)

    def scroll(self) -> None:
        x, y = self.place()
        self._app.move(x, y)
        self._app.step(Scrolled(x, y, float(self._rng.integers(-3, 4))))

    def slide(self) -> None:
        weights = self._app.session.pose.weights.copy()
        weights[int(self._rng.integers(len(weights)))] = self._rng.uniform(0, 1)
        for step in (False, False, True):
            self._app.desk.apply(Edit("Set a shape", step, weights=weights))
            self._app.step()

    def command(self) -> None:
        self._app.ask(QUIET[int(self._rng.integers(len(QUIET)))])
        self._app.step(frames=2)

    def undo(self) -> None:
        for _ in range(int(self._rng.integers(1, 5))):
            self._app.ask(Command.UNDO if self._rng.random() < 0.6 else Command.REDO)
        self._app.step()

    def pane(self) -> None:
        count = len(self._app.session.panes)
        if count < 3 and self._rng.random() < 0.5:
            self._app.ask(AddPane(choose("sparse")))
        elif count > 1:
            self._app.ask(ClosePane(int(self._rng.integers(count))))
        self._app.step(frames=2)

    def resize(self) -> None:
        self._app.window.resize(tuple(int(side) for side in self._rng.integers(300, 700, 2)))
        self._app.step(frames=2)

    def reference(self) -> None:
        self._app.ask(RandomReference(4))
        self._app.step()

    def face(self) -> None:
        self._app.ask(OpenPath(self._faces[int(self._rng.integers(len(self._faces)))]))
        self._app.until(lambda: self._app.desk.loading is None)


def kept(app: App) -> dict[str, float]:
    """Return what the program keeps: memory in bytes, objects on the graphics card by kind, steps of undo."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    kinds = (moderngl.Texture, moderngl.Buffer, moderngl.VertexArray, moderngl.Framebuffer, moderngl.Program)
    alive = Counter(
        type(thing).__name__
        for thing in gc.get_objects()
        if isinstance(thing, kinds) and not isinstance(thing.mglo, moderngl.InvalidObject)
    )
    steps = len(app.session.steps)
    return {"memory": float(pages * resource.getpagesize()), "undo": float(steps), **alive}


def main() -> int:
    """Run until the time is over."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--hours", type=float, default=4.0)
    parser.add_argument("--seed", type=int, default=0)
    chosen = parser.parse_args()
    until = time.monotonic() + 3600 * chosen.hours
    faces = list(builtin_faces().values())
    with (
        TemporaryDirectory() as folder,
        running(
            faces[0], "hand", size=(500, 400), settings_folder=Path(folder), pictures=Path(folder)
        ) as app,
    ):
        hand = Hand(app, np.random.default_rng(chosen.seed), faces)
        most: dict[str, float] = {}
        number = 0
        while time.monotonic() < until or number < WARM:
            for _ in range(ROUND):
                hand.act()
            number += 1
            now = kept(app)
            print(number * ROUND, {key: round(value) for key, value in now.items()}, flush=True)
            if now["undo"] > MOST_UNDO:
                raise AssertionError(f"undo keeps {now['undo']:.0f} steps")
            if number <= WARM:
                most = {key: max(value, most.get(key, 0.0)) for key, value in now.items()}
                continue
            for key in now.keys() - {"undo"}:
                if now[key] > ALLOWED * most.get(key, 0.0) + 20:
                    raise AssertionError(f"{key} has grown from {most.get(key, 0):.0f} to {now[key]:.0f}")
        print(dict(hand.done))
    return 0


if __name__ == "__main__":
    sys.exit(main())
