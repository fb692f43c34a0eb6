"""Undo history: immutable snapshots, so that a step can't be wrong."""

from dataclasses import dataclass
from typing import Generic, TypeVar

T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class Step(Generic[T]):
    """One undo step: what was done, and the value it led to."""

    label: str
    value: T


class History(Generic[T]):
    """A line of values with a current one.  The first is where the session began and can't be undone."""

    def __init__(self, first: T, limit: int = 200) -> None:
        self._steps = [Step("Open", first)]
        self._at = 0
        self._limit = limit

    @property
    def current(self) -> T:
        """The value now."""
        return self._steps[self._at].value

    @property
    def steps(self) -> tuple[Step[T], ...]:
        """All steps, the first and the undone ones among them."""
        return tuple(self._steps)

    @property
    def at(self) -> int:
        """Which of the steps is the current one."""
        return self._at

    @property
    def undo_label(self) -> str | None:
        """What undo would take back, or None."""
        return self._steps[self._at].label if self._at > 0 else None

    @property
    def redo_label(self) -> str | None:
        """What redo would bring back, or None."""
        return self._steps[self._at + 1].label if self._at + 1 < len(self._steps) else None

    def commit(self, label: str, value: T) -> None:
        """Make `value` current; what was undone is forgotten, and the oldest step past the limit too."""
        del self._steps[self._at + 1 :]
        self._steps.append(Step(label, value))
        del self._steps[: max(0, len(self._steps) - 1 - self._limit)]
        self._at = len(self._steps) - 1

    def go_to(self, at: int) -> bool:
        """Make step number `at` current, as so many undos or redos would; False when there is none."""
        if not 0 <= at < len(self._steps):
            return False
        self._at = at
        return True

    def undo(self) -> bool:
        """Go one step back; False when there is none."""
        if self._at == 0:
            return False
        self._at -= 1
        return True

    def redo(self) -> bool:
        """Go one step forward; False when there is none."""
        if self._at + 1 >= len(self._steps):
            return False
        self._at += 1
        return True
