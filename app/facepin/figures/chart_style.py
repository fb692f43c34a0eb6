"""The look of all charts of the program, and how they are written.

Figures are made with matplotlib's objects, never with pyplot: nothing is kept between them and no window
system is touched.
"""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any
from warnings import catch_warnings, filterwarnings

import numpy as np

from facepin.files.safely.atomic import atomic_write
from facepin.resources import resource
from facepin.system_fonts import fonts_for, own_letters

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DPI = 200
TEXT, DIM, FAINT, TRACK, ALARM = "#16181d", "#5f6368", "#b4b8bd", "#e9ebee", "#b3261e"
NOTE = "#80868b"


@contextmanager
def chart_style(texts: Iterable[str] = ()) -> Iterator[None]:
    """Make and save figures in one look: for all charts of the program.

    `texts` are those that users and files bring: their letters may need fonts of the system.
    """
    from matplotlib import rc_context

    look: Any = {
        "font.family": _families(texts),
        "text.parse_math": False,  # names are text, whatever signs they have; what is maths says so
        "font.size": 8.5,
        "text.color": TEXT,
        "axes.edgecolor": FAINT,
        "axes.labelcolor": DIM,
        "axes.linewidth": 0.7,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.titlesize": 9.5,
        "axes.titleweight": "bold",
        "axes.titlelocation": "left",
        "axes.axisbelow": True,
        "axes.unicode_minus": True,
        "grid.color": TRACK,
        "grid.linewidth": 0.7,
        "xtick.color": FAINT,
        "ytick.color": FAINT,
        "xtick.labelcolor": DIM,
        "ytick.labelcolor": DIM,
        "xtick.major.width": 0.7,
        "ytick.major.width": 0.7,
        "legend.frameon": False,
        "savefig.facecolor": "white",
        "svg.hashsalt": "facepin",
    }
    with rc_context(look):
        yield


@cache
def _font_family() -> str:
    """Make the program's own font known to matplotlib."""
    from matplotlib.font_manager import fontManager

    for weight in ("Regular", "Bold"):
        fontManager.addfont(str(resource("assets", f"fonts/Roboto-{weight}.ttf")))
    return "Roboto"


def _families(texts: Iterable[str]) -> list[str]:
    """Return the font to use and those that stand in for its missing letters, made known to matplotlib."""
    families = [_font_family()]
    letters = {ord(letter) for text in texts if not text.isascii() for letter in text}
    if letters := letters and letters - own_letters():
        from matplotlib.font_manager import FontProperties, fontManager

        for font in fonts_for(letters)[0]:
            fontManager.addfont(str(font.path))
            families.append(FontProperties(fname=str(font.path)).get_name())
    return families


def write_chart(folder: Path, name: str, figure: "Figure") -> list[Path]:
    """Write a figure as name.png and name.svg and return their paths; the same figure gives the same bytes.

    Raises
    ------
    FacepinError
        If they cannot be written.
    """
    paths = []
    with chart_style(), catch_warnings():
        # A letter that no font has is drawn as a sign, as in the window.
        filterwarnings("ignore", r"Glyph \d+ .* missing from")
        for kind in ("png", "svg"):
            file = BytesIO()
            figure.savefig(file, format=kind, dpi=DPI, metadata={"Date": None} if kind == "svg" else None)
            figure.set_layout_engine("none")  # it is laid out now
            paths.append(folder / f"{name}.{kind}")
            atomic_write(paths[-1], file.getvalue())
    return paths


def number(value: float) -> str:
    """Return a figure with three digits that matter, as people write it."""
    if value == 0:
        return "0"
    size = abs(value)
    if size >= 1e5 or size < 1e-3:
        return f"{value:.1e}"
    return f"{value:,.{max(2 - int(np.floor(np.log10(size))), 0)}f}"


def add_note(figure: "Figure", note: str) -> None:
    """Say at the bottom of a chart what made it."""
    if note:
        figure.supxlabel(note, x=0.008, ha="left", fontsize=6.5, color=NOTE)
