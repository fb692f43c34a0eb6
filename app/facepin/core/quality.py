"""How much a picture may cost: a few levels, so that it stays smooth on every machine."""

from dataclasses import dataclass
from typing import Literal

Quality = Literal["auto", "fast", "good", "best"]
"""What the user chooses."""


@dataclass(frozen=True)
class Level:
    """What a picture is made with."""

    samples: int
    """Per pixel, as far as the machine goes: how smooth edges are."""
    fine: bool
    """Light at every pixel; otherwise at the vertices of what is not glossy."""


LEVELS: dict[Quality, Level] = {
    "fast": Level(0, fine=False),
    "good": Level(4, fine=True),
    "best": Level(8, fine=True),
}


def level(quality: Quality, *, software: bool, moving: bool) -> Level:
    """Return the level of a picture.

    Parameters
    ----------
    quality : Quality
        Automatic is good, but for pictures in motion where a processor draws them: those are fast.
    software, moving : bool
        There is no graphics card; something moves.
    """
    if quality == "auto":
        return LEVELS["fast" if software and moving else "good"]
    return LEVELS[quality]
