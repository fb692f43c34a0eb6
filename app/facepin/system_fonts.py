"""Fonts of this machine for letters that the program's own font does not have."""

import subprocess
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from shutil import which

from facepin import platforms
from facepin.resources import resource

SUFFIXES = (".ttf", ".otf", ".ttc", ".otc")
PATIENCE = 20.0
"""Seconds that fontconfig may take: the first time, it reads every font there is."""


@dataclass(frozen=True)
class SystemFont:
    """A font in a file."""

    path: Path
    number: int
    """Of the font among those in the file."""


def own_letters() -> frozenset[int]:
    """Return the code points that the program's own font has."""
    return letters_of(SystemFont(resource("assets", "fonts/Roboto-Regular.ttf"), 0))


def fonts_for(letters: Iterable[int]) -> tuple[list[SystemFont], frozenset[int]]:
    """Return fonts that together have some letters, and what none of them has.

    Parameters
    ----------
    letters : iterable of int
        Code points.

    Returns
    -------
    fonts : list of SystemFont
        The best one first; where two have a letter the first one is for it.
    missing : frozenset of int
        Letters that no font of this machine has.
    """
    left = set(letters)
    found = []
    for font, has in _system_fonts():
        if not left:
            break
        if here := left & has:
            found.append(font)
            left -= here
    return found, frozenset(left)


def _system_fonts() -> Iterator[tuple[SystemFont, frozenset[int]]]:
    """Go through the fonts of this machine, the best first, each with its letters."""
    known = platforms.known_fonts()
    if known is None:
        yield from _by_fontconfig()
    else:
        for path in known:
            font = SystemFont(path, 0)
            yield font, letters_of(font)


@cache
def _by_fontconfig() -> tuple[tuple[SystemFont, frozenset[int]], ...]:
    """Ask fontconfig for all fonts in the order in which it would take them for text; nothing without it."""
    if which("fc-match") is None:
        return ()
    form = "%{file}\t%{index}\t%{color}\t%{charset}\n"
    try:
        told = subprocess.run(
            ["fc-match", "-a", "--format", form, "sans-serif"],
            capture_output=True,
            timeout=PATIENCE,
            check=True,
        ).stdout
    except (OSError, subprocess.SubprocessError):
        return ()  # as without it: what can't be shown is said
    found = []
    for line in told.decode("utf-8", "surrogateescape").splitlines():
        name, number, colour, ranges = line.split("\t")
        # The upper half of the number is a variation of a font that may stand anywhere between two.
        if name.lower().endswith(SUFFIXES) and colour != "True":
            found.append((SystemFont(Path(name), int(number) & 0xFFFF), _ranges(ranges)))
    return tuple(found)


def _ranges(text: str) -> frozenset[int]:
    """Return the code points of what fontconfig writes as "20-7e a0"."""
    ends = [[int(end, 16) for end in part.split("-")] for part in text.split()]
    return frozenset(point for first, *last in ends for point in range(first, (last or [first])[0] + 1))


@cache
def letters_of(font: SystemFont) -> frozenset[int]:
    """Return the code points that a font has; none where it can't be read."""
    from fontTools.ttLib import TTFont, TTLibError

    try:
        with TTFont(font.path, fontNumber=font.number, lazy=True) as opened:
            return frozenset(opened.getBestCmap() or ())
    except (OSError, TTLibError):
        return frozenset()
