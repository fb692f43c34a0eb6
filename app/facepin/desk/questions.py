"""Questions for a path: one at a time, and what its answer is for."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from facepin.core.errors import FacepinError
from facepin.panels.commands import Command
from facepin.panels.file_dialog import FileDialog, Kind
from facepin.session.session import Session


@dataclass(frozen=True, eq=False)
class Question:
    """A question for a path that waits for its answer."""

    dialog: FileDialog
    then: Callable[[Path], None]
    """What the answer is for; not called when the user gives up."""
    saves: bool
    """The answer is where to write what was open."""
    session: Session | None
    """What was open."""


class Questions:
    """Asks the user for paths."""

    def __init__(self, *, native: bool) -> None:
        """`native`: use the platform's file dialogs."""
        self._native = native
        self._question: Question | None = None

    @property
    def dialog(self) -> FileDialog | None:
        """The dialog that waits for an answer, if any."""
        return self._question.dialog if self._question else None

    def ask(
        self,
        kind: Kind,
        command: Command,
        start: Path,
        filters: tuple[str, ...],
        then: Callable[[Path], None],
        session: Session | None,
    ) -> None:
        """Ask, see `Desk.ask`; `session` is what is open.

        Raises
        ------
        FacepinError
            When another question is still open.
        """
        if self._question is not None:
            raise FacepinError("another question for a file waits for its answer")
        dialog = FileDialog(kind, command.title.rstrip("…"), start, filters, use_native=self._native)
        self._question = Question(dialog, then, kind == "save file", session)

    def take(self) -> Question | None:
        """Return the question if it was answered or given up, which is then no longer asked."""
        question = self._question
        if question is None or not question.dialog.finished:
            return None
        self._question = None
        return question

    def ask_again(self, question: Question, why: str) -> None:
        """Ask once more for a path that was no good, unless something else is asked meanwhile."""
        if self._question is None and question.dialog.can_ask_again:
            question.dialog.ask_again(why)
            self._question = question

    def close(self) -> None:
        """Ask no more."""
        if self._question is not None:
            self._question.dialog.close()
