"""The order in which people expect names: pose 2 before pose 10, capitals no matter."""

import re
from unicodedata import normalize

_DIGITS = re.compile(r"(\d{1,300})")  # Python refuses to read far longer numbers

SortKey = tuple[tuple[tuple[str, int], ...], str]


def natural_key(name: str) -> SortKey:
    """Return what to sort names by so that numbers in them count as numbers; equal for equal names only."""
    pieces = _DIGITS.split(normalize("NFC", name).casefold())
    numbers = [int(digits) for digits in pieces[1::2]]
    return tuple(zip(pieces[::2], [*numbers, -1], strict=True)), name
