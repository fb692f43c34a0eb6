"""A fault in one place is told there, and everything else goes on."""

import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Protocol

import moderngl

from facepin.core.errors import FacepinError, Fault
from facepin.files.work.fault_reports import line_of, write_report


class Say(Protocol):
    """Shows a message in the status line."""

    def __call__(self, message: str, *, error: bool = False) -> None:
        """Show `message`, as an error or not."""


class Faults:
    """Tells the user what goes wrong, and writes down what should not have.

    What comes again in every frame is told and written once.
    """

    def __init__(
        self, say: Say, graphics: Callable[[], str], folder: Path | None = None, *, caught: bool = False
    ) -> None:
        """Nothing went wrong yet.

        Parameters
        ----------
        say : callable
            Shows a message.
        graphics : callable
            Returns the graphics driver, in words.
        folder : Path
            Where reports go; None writes none.
        caught : bool
            Whether bugs are told instead of raised.  Tests raise them.
        """
        self._say = say
        self._graphics = graphics
        self._folder = folder
        self._caught = caught
        self._known: set[tuple[str, ...]] = set()

    def within(self, where: str) -> "Within":
        """Return a `with` block that tells what goes wrong inside it; `where` says what it is about.

        Errors of the user and of the machine never leave it; bugs do unless they are caught.
        """
        return Within(self, where)

    def tell(self, where: str, error: BaseException) -> bool:
        """Tell of an error; return whether it is one that goes no further."""
        cause = error.__cause__ if isinstance(error, Fault) else None
        # moderngl.Error: a graphics card without memory must not take the pose with it.
        if isinstance(error, FacepinError | OSError | moderngl.Error):
            self._say(str(error), error=True)
            if cause is not None:
                self.write(where, cause)
            return True
        if not self._caught or not isinstance(error, Exception):
            return False
        if self._is_new(where, error):
            self._say(line_of(where, error) + self._report(where, error), error=True)
        return True

    def write(self, where: str, error: BaseException) -> str:
        """Write a report, unless it is written; return where it is, in words for the end of a line."""
        return self._report(where, error) if self._is_new(where, error) else ""

    def _is_new(self, where: str, error: BaseException) -> bool:
        last = traceback.extract_tb(error.__traceback__)[-1:]
        key = (where, type(error).__name__, *(f"{step.filename}:{step.lineno}" for step in last))
        is_new = key not in self._known
        self._known.add(key)
        return is_new

    def _report(self, where: str, error: BaseException) -> str:
        if self._folder is None:
            return ""
        try:
            return f"; see {write_report(self._folder, where, error, {'Graphics': self._graphics()})}"
        except FacepinError as problem:
            return f"; no report of it: {problem}"


class Within:
    """See `Faults.within`."""

    def __init__(self, faults: Faults, where: str) -> None:
        self._faults = faults
        self._where = where
        self.failed = False
        """Whether it ended before its end."""

    def __enter__(self) -> "Within":
        return self

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> bool:
        self.failed = error is not None
        return error is not None and self._faults.tell(self._where, error)
