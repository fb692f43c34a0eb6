"""The one error that is meant for the person at the screen."""

LONGEST = 400


class FacepinError(Exception):
    """Says in one line what is wrong, where, what was found and what is allowed.

    Everything a user can cause (a bad file, a bad option, a missing display) is raised as this; the command
    line prints it and exits with 2, the window shows it in the status line.  Anything else is a bug.
    """

    def __init__(self, line: str) -> None:
        """Keep `line`, made one printable line whatever foreign names and messages it quotes."""
        shown = "".join(character if character.isprintable() else " " for character in line[: LONGEST + 1])
        super().__init__(shown if len(shown) <= LONGEST else shown[: LONGEST - 1] + "…")


class Fault(FacepinError):
    """A bug, caught where it could do no harm to what else goes on; its cause is what was raised."""
