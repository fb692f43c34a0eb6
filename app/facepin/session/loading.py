"""Opening a rig beside the window, so that the window never freezes."""

from collections.abc import Callable
from pathlib import Path
from threading import Thread
from time import monotonic

from facepin.core.errors import FacepinError, Fault
from facepin.core.rig import Rig

Open = Callable[[Path, Callable[[float, str], None]], Rig]
"""(path, progress) -> rig."""


class _GivenUp(Exception):
    """Raised inside the reader when the user cancels."""


class Loading:
    """A rig being opened in a thread of its own."""

    def __init__(self, path: Path, open_path: Open) -> None:
        self.path = path
        self.fraction = 0.0
        self.began = monotonic()
        self.line = "Opening"
        self._cancelled = False
        self._rig: Rig | None = None
        self._error: BaseException | None = None
        self._thread = Thread(target=self._run, args=(open_path,), name=f"open {path.name}", daemon=True)
        self._thread.start()

    def cancel(self) -> None:
        """Give up as soon as the reader reports progress."""
        self._cancelled = True

    @property
    def is_long(self) -> bool:
        """Whether it takes long enough to be spoken of."""
        return monotonic() - self.began > 0.25

    @property
    def finished(self) -> bool:
        """Whether `result` has an answer."""
        return not self._thread.is_alive()

    def result(self) -> Rig | None:
        """Return the rig, or None when it was cancelled.

        Raises
        ------
        FacepinError, OSError
            When the file can't be opened; also when the reader has a fault, since a file must not take what
            is being posed down with it.
        """
        self._thread.join()
        if self._cancelled:
            return None
        if isinstance(self._error, FacepinError | OSError):
            raise self._error
        if self._error is not None:
            fault = f"{type(self._error).__name__}: {self._error}".removesuffix(": ")
            raise Fault(f"{self.path.name}: opening it failed ({fault})") from self._error
        return self._rig

    def _run(self, open_path: Open) -> None:
        try:
            self._rig = open_path(self.path, self._report)
        except BaseException as error:  # handed to whoever asks for the result: a thread has no one to tell
            self._error = error

    def _report(self, fraction: float, line: str) -> None:
        if self._cancelled:
            raise _GivenUp
        self.fraction, self.line = fraction, line
