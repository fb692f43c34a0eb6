"""Things on the graphics card that are made when they are first needed."""

from collections.abc import Callable
from typing import Protocol, TypeVar, cast


class Releasable(Protocol):
    """Has graphics memory to give back."""

    def release(self) -> None:
        """Give it back."""


Made = TypeVar("Made", bound=Releasable)


class Kept:
    """At most one of each kind; they belong to the owner of this."""

    def __init__(self) -> None:
        self._made: dict[object, Releasable] = {}

    def get(self, make: Callable[[], Made], kind: type[Made]) -> Made:
        """Return the one of `kind`, from `make` if there is none yet."""
        if kind not in self._made:
            self._made[kind] = make()
        return cast(Made, self._made[kind])

    def release(self) -> None:
        """Give the graphics memory back."""
        for thing in self._made.values():
            thing.release()
        self._made.clear()
