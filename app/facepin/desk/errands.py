"""What is made of things that are known already, beside the window: no frame and no draft waits for it."""

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass

from facepin.core.errors import FacepinError


@dataclass(frozen=True, eq=False)
class Errand:
    """One piece of work, and what came of it."""

    title: str
    outcome: Future[str]


class Errands:
    """Done one after the other, in the order in which they were asked for."""

    def __init__(self) -> None:
        self._open: list[Errand] = []
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="errands")

    @property
    def busy(self) -> bool:
        """Whether something is not done, or nobody was told of it."""
        return bool(self._open)

    def start(self, title: str, work: Callable[[], str]) -> None:
        """Have `work` done, which returns what to say then; it must not touch what the window touches."""
        self._open.append(Errand(title, self._thread.submit(work)))

    def take(self) -> Errand | None:
        """Return the oldest errand if it is done, once."""
        return self._open.pop(0) if self._open and self._open[0].outcome.done() else None

    def close(self) -> str:
        """Do what is still to be done; return what could not be, in one line, or nothing."""
        self._thread.shutdown()
        failed = [(each.title, error) for each in self._open if (error := each.outcome.exception())]
        self._open = []
        return str(FacepinError("; ".join(f"{title}: {error}" for title, error in failed)))
