"""Opening a rig beside the window, so that the window never freezes."""

from collections.abc import Callable
from pathlib import Path
from threading import Thread
from time import monotonic

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
        FacepinError
            When the file can't be opened.
        """
        self._thread.join()
        if isinstance(self._error, _GivenUp):
            return None
        if self._error is not None:
            raise self._error
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
