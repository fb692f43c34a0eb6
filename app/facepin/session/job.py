"""Something long, done a little in every frame: the window goes on, and the user may give it up."""

from collections.abc import Callable, Generator
from threading import Thread
from time import monotonic
from typing import TypeVar

from facepin.core.errors import FacepinError, Fault

T = TypeVar("T")

Steps = Generator[float, None, str]
"""Some milliseconds of work at a time, after each how much is done, 0..1; at last, what came of it."""


class Job:
    """Steps being taken."""

    def __init__(self, title: str, steps: Steps) -> None:
        self.title = title
        self.fraction = 0.0
        self._began = monotonic()
        self._steps = steps

    @property
    def is_long(self) -> bool:
        """Whether it takes long enough to be spoken of."""
        return monotonic() - self._began > 0.25

    def advance(self) -> str | None:
        """Take one step; return what came of it all when that was the last one.

        Raises
        ------
        FacepinError, OSError
            Whatever goes wrong ends the job.
        """
        try:
            self.fraction = next(self._steps)
        except StopIteration as end:
            return str(end.value)
        return None

    def cancel(self) -> None:
        """Give up between two steps; what was written so far stays."""
        self._steps.close()


def beside(work: Callable[[], T], fraction: float) -> Generator[float, None, T]:
    """Do work in a thread of its own, as steps of a job; it must not touch what the window touches.

    Raises
    ------
    FacepinError, OSError
        What `work` raises; a fault in it as an error in one line.
    """
    results: list[T] = []
    errors: list[BaseException] = []

    def run() -> None:
        try:
            results.append(work())
        except BaseException as error:  # handed over below: a thread has no one to tell
            errors.append(error)

    thread = Thread(target=run, daemon=True)
    thread.start()
    while thread.is_alive():
        yield fraction
    if errors and isinstance(errors[0], FacepinError | OSError):
        raise errors[0]
    if errors:
        raise Fault(f"it could not be made ({type(errors[0]).__name__}: {errors[0]})") from errors[0]
    return results[0]
