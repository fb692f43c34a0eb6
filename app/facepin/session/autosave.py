"""Writing behind the user's back: a thread of its own, the newest value only, again until it succeeds."""

from collections.abc import Callable
from threading import Condition, Thread
from time import monotonic
from typing import Generic, TypeVar

T = TypeVar("T")

RETRY = 3.0
"""Seconds from a failure to the next try."""


class Autosave(Generic[T]):
    """Hands the newest value to a writer that may be slow or fail; whoever puts a value never waits."""

    def __init__(self, write: Callable[[T], None], retry: float = RETRY) -> None:
        """Start with nothing to write; the thread begins with the first value.

        Parameters
        ----------
        write : callable
            Called in the thread; what it raises is kept in `complaint`, and it is called again.
        retry : float
            Seconds until then.
        """
        self.complaint = ""
        """Why the newest value that was tried is not written; empty when it is."""
        self._write = write
        self._retry = retry
        self._changed = Condition()
        self._waiting: list[T] = []
        """The newest value, until it is written."""
        self._refused: list[T] = []
        """The value that the complaint is about."""
        self._tries = 0
        self._hurried = self._ended = False
        self._thread: Thread | None = None

    def put(self, value: T) -> None:
        """Have a value written, instead of one that still waits."""
        with self._changed:
            self._waiting = [value]
            self._hurried = True
            self._changed.notify_all()
        if self._thread is None:
            self._thread = Thread(target=self._run, name="autosave", daemon=True)
            self._thread.start()

    def flush(self, seconds: float = 5.0) -> bool:
        """Wait until everything is written; False when that fails or takes too long."""
        until = monotonic() + seconds
        with self._changed:
            tried = self._tries
            self._hurried = True
            self._changed.notify_all()
            while self._waiting:
                refused = self._refused and self._refused[0] is self._waiting[0]
                if (refused and self._tries > tried) or not self._changed.wait(max(until - monotonic(), 0.0)):
                    self.complaint = self.complaint or "writing takes too long"
                    return False
        return True

    def close(self) -> bool:
        """Write what still waits, then end the thread; False when something could not be written."""
        written = self.flush()
        with self._changed:
            self._ended = True
            self._changed.notify_all()
        return written

    def _run(self) -> None:
        while True:
            with self._changed:
                while not self._waiting and not self._ended:
                    self._changed.wait()
                if self._ended:
                    return
                (value,) = self._waiting
                self._hurried = False
            complaint = self._tried(value)
            with self._changed:
                self.complaint = complaint
                self._refused = [value] if complaint else []
                self._tries += 1
                if not complaint and self._waiting[0] is value:
                    self._waiting = []
                self._changed.notify_all()
                if complaint and not self._hurried and not self._ended:
                    self._changed.wait(self._retry)

    def _tried(self, value: T) -> str:
        """Write a value; return what went wrong, or nothing."""
        try:
            self._write(value)
        except Exception as error:  # whatever it is, the thread goes on and the user is told
            return str(error) or type(error).__name__
        return ""
