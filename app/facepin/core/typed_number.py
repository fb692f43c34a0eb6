"""Numbers as people type them."""

import re
from math import isfinite

from facepin.core.errors import FacepinError

_NUMBER = r"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?"
_TYPED = re.compile(rf"({_NUMBER})(?:/({_NUMBER}))?(%?)")
_MINUS_SIGNS = str.maketrans({"\N{MINUS SIGN}": "-", "\N{EN DASH}": "-", "\N{FRACTION SLASH}": "/"})


def typed_number(text: str) -> float:
    """Return the number that was typed: 0.5, 0,5, 50% and 1/2 are the same one.

    Raises
    ------
    FacepinError
        For anything else, and for what is not finite.
    """
    found = _TYPED.fullmatch("".join(text.translate(_MINUS_SIGNS).split()))
    if found is None:
        raise FacepinError(f"{text.strip()!r} is no number: allowed are the likes of 0.5, 0,5, 50% and 1/2")
    upper, lower, percent = found.groups()
    divisor = (_plain(lower) if lower else 1.0) * (100.0 if percent else 1.0)
    value = _plain(upper) / divisor if divisor else float("inf")
    if not isfinite(value):
        raise FacepinError(f"{text.strip()!r} is not a finite number")
    return value


def _plain(text: str) -> float:
    return float(text.replace(",", "."))
