"""Reports of faults in the program: one text file each, for whoever mends them."""

import platform
import traceback
from collections.abc import Mapping
from contextlib import suppress
from datetime import datetime
from pathlib import Path

from facepin import __version__
from facepin.core.errors import FacepinError
from facepin.files.safely.atomic import atomic_write, make_folder

MOST_REPORTS = 50
"""Reports that are kept; the oldest go."""


def write_report(folder: Path, where: str, error: BaseException, facts: Mapping[str, str]) -> Path:
    """Write down a fault; return the file.

    Parameters
    ----------
    folder : Path
        Made if it is not there.
    where : str
        What the program was about.
    error : BaseException
        With its traceback, and what caused it.
    facts : mapping of str to str
        What else is known about the machine and the work.

    Raises
    ------
    FacepinError
        If it can't be written.
    """
    make_folder(folder)
    now = datetime.now()
    known = {
        "Facepin": __version__,
        "Python": platform.python_version(),
        "System": platform.platform(),
        "Time": f"{now:%Y-%m-%d %H:%M:%S}",
        "Where": where,
        **facts,
    }
    lines = [f"{name}: {' '.join(value.split())}" for name, value in known.items()]
    text = "\n".join([*lines, "", *traceback.format_exception(error)])
    path = folder / f"fault-{now:%Y%m%d-%H%M%S-%f}.txt"
    atomic_write(path, text.encode(errors="backslashreplace"))  # names of files may be no text at all
    for old in sorted(folder.glob("fault-*.txt"))[:-MOST_REPORTS]:
        with suppress(OSError):  # another window took it away
            old.unlink()
    return path


def line_of(where: str, error: BaseException) -> str:
    """Say in one line what went wrong where."""
    what = f"{type(error).__name__}: {error}".removesuffix(": ")
    return str(FacepinError(f"{where}: a fault of the program ({what}); everything else goes on"))
