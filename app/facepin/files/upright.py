"""Opening a rig so that its face is upright and looks at the user."""

from pathlib import Path

from facepin.core.look.upright import upright
from facepin.core.rig import Rig
from facepin.core.turn import AS_IN_FILE, Turn
from facepin.files.formats import open_rig
from facepin.files.options import Progress
from facepin.files.work.turns import read_turn


def open_upright(
    path: Path,
    *,
    neutral: str | None = None,
    progress: Progress | None = None,
    turn: Turn | None = None,
    settings: Path | None = None,
) -> Rig:
    """Open a rig as `open_rig` does and turn it.

    Parameters
    ----------
    path, neutral, progress
        As for `open_rig`.
    turn : Turn
        How; None for as the user turned it before, else as file and shapes tell, with a warning then.
    settings : Path
        Folder that remembers how faces were turned.

    Raises
    ------
    FacepinError
        As `open_rig`.
    """
    rig = open_rig(path, neutral=neutral, progress=progress)
    if turn is None:
        turn = read_turn(settings, path)
    if turn is None:
        turn = upright(rig)
        if turn != AS_IN_FILE and rig.front is None:
            line = "in its file the face lies or looks away: it was turned (View, Turn the face)"
            return rig.turned(turn, line)
    return rig if turn == AS_IN_FILE else rig.turned(turn)
