"""What `facepin` does on a machine without a screen: the built-in face, a few pins, every solver."""

from pathlib import Path

from facepin.core.arrays import frozen
from facepin.core.pose import Pose
from facepin.core.rig import Rig
from facepin.figures.compare import made_folder, progress_line, write_comparison
from facepin.figures.comparison import Comparison, compare
from facepin.figures.posing import DELIGHT, dragged, handles, named_weights
from facepin.options import open_with_bar
from facepin.session.solving.solving import choose
from facepin.solvers import SOLVERS


def demonstrate(folder: Path) -> Path:
    """Pose the built-in face with every solver and write pictures, charts, numbers and poses into `folder`.

    Needs no screen; without OpenGL the pictures of the face are left out, with a line on stderr that says so.

    Returns
    -------
    Path
        The folder.

    Raises
    ------
    FacepinError
        If it cannot be written to.
    """
    made_folder(folder)
    with progress_line() as tell:
        rig = open_with_bar(None)
        write_comparison(folder, delight(rig), tell=tell)
    return folder


def delight(rig: Rig) -> Comparison:
    """Compare all solvers on the pins an animator would use for `DELIGHT`: chin, mouth corners, brow.

    Each pin sits where its shape moves the face most, and is dragged to where the expression has it.
    """
    meant = frozen(named_weights(rig, DELIGHT), "float64")
    pins = dragged(rig, handles(rig, meant), rig.evaluate(meant))
    return compare(rig, [choose(key) for key in SOLVERS], Pose(0 * meant, pins), meant)
