"""Drives the whole application without a screen: events in, frames out."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from time import monotonic

import numpy as np
from PIL import Image

from facepin.actions import carry_out
from facepin.core.events import KeyPressed, Modifiers, PointerMoved, PointerPressed, PointerReleased
from facepin.core.pose import Pose
from facepin.core.rig import Rig
from facepin.desk.desk import Desk
from facepin.main_loop import Frame, Start, frames
from facepin.panels.requests import Request
from facepin.session.session import Session
from facepin.session.solving.solving import choose
from facepin.window import Window


@dataclass
class App:
    """The running program, one frame at a time."""

    window: Window
    loop: Iterator[Frame]
    frame: Frame

    @property
    def desk(self) -> Desk:
        return self.frame.desk

    @property
    def session(self) -> Session:
        assert self.desk.session is not None
        return self.desk.session

    def step(self, *events: object, frames: int = 1) -> None:
        """Let events happen, then draw some frames: at least until all of them were heard."""
        self.window.inject(*events)
        for _ in range(frames):
            self.frame = next(self.loop)
        while self.window.behind:
            self.frame = next(self.loop)

    def until(self, condition: Callable[[], bool], seconds: float = 60.0) -> None:
        """Draw frames until something is so."""
        end = monotonic() + seconds
        while not condition():
            assert monotonic() < end, "it never came to pass"
            self.frame = next(self.loop)

    def move(self, x: float, y: float) -> None:
        self.step(PointerMoved(x, y))

    def press(self, x: float, y: float, button: str = "left", **held: bool) -> None:
        # imgui learns where the mouse is a frame before it learns of the press.
        self.step(PointerMoved(x, y), frames=2)
        self.step(PointerPressed(x, y, button, Modifiers(**held)))

    def release(self, x: float, y: float, button: str = "left") -> None:
        self.step(PointerReleased(x, y, button), frames=2)

    def drag(
        self,
        start: tuple[float, float],
        end: tuple[float, float],
        button: str = "left",
        moves: int = 30,
        **held: bool,
    ) -> None:
        """Press, move in equal steps, release."""
        self.press(*start, button, **held)
        for at in np.linspace(start, end, moves + 1)[1:]:
            self.move(*at)
        self.release(*end, button)

    def key(self, key: str, **held: bool) -> None:
        self.step(KeyPressed(key, Modifiers(**held)), frames=2)

    def ask(self, request: Request) -> None:
        """Ask for something as a menu would."""
        carry_out(request, self.desk)

    def pixel_of(self, vertex: int) -> tuple[float, float]:
        """Where a vertex of the active pane is on the screen."""
        assert self.desk.stage is not None
        position = self.desk.stage.positions(self.session.active)[vertex]
        x, y, _ = self.desk.camera.project(position[None], self.frame.viewport)[0]
        return float(x), float(y)

    def screenshot(self) -> np.ndarray:
        """The window as it is shown, (h, w, 3) uint8."""
        return self.window.read()

    def save(self, path: Path) -> None:
        """Write the window as a picture, to look at."""
        Image.fromarray(self.screenshot()).save(path)


@contextmanager
def running(
    rig: Path | None = None,
    solver: str = "transpose",
    *,
    size: tuple[int, int] = (1280, 720),
    scale: float | None = None,
    settings_folder: Path | None = None,
    pictures: Path = Path(),
    first_pose: Callable[[Rig], Pose] | None = None,
    solve_first: bool = False,
    wait: bool = True,
    windowless: bool = True,
    caught: bool = False,
) -> Iterator[App]:
    """Run the application with a rig open, on the null platform unless told otherwise."""
    with Window("test", size, windowless=windowless, scale=scale) as window:
        start = Start(
            [choose(key) for key in solver.split(",")],
            rig,
            first_pose,
            settings_folder,
            pictures,
            native_dialogs=False,
            solve_first=solve_first,
            caught=caught,
        )
        loop = frames(window, start)
        app = App(window, loop, next(loop))
        if wait:
            app.until(lambda: app.desk.loading is None)
            app.until(lambda: app.desk.stage is None or app.desk.stage.refined)
            app.step(frames=4)
        try:
            yield app
        finally:
            loop.close()
