"""One colour per solver, the same in every chart and every pane."""

from typing import NamedTuple


class Ink(NamedTuple):
    """How a solver is drawn."""

    colour: str
    """sRGB as #rrggbb."""
    marker: str
    """Mark in a scatter plot (matplotlib's letter), so that colour is never the only difference."""


INKS: dict[str, Ink] = {
    "pseudo_inverse": Ink("#d55e00", "^"),
    "tikhonov": Ink("#e69f00", "s"),
    "transpose": Ink("#0072b2", "o"),
    "hybrid": Ink("#cc79a7", "D"),
    "sparse": Ink("#009e73", "v"),
    "bounded": Ink("#56b4e9", "P"),
    "hand": Ink("#999933", "*"),
}
"""By solver key.  Okabe and Ito's colours, which remain different for colour-blind eyes."""

REFERENCE = Ink("#5f6368", "x")
"""The pose that the solvers are measured against."""
