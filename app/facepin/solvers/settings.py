"""Settings of solvers as text (`--set name=value`) and as plain values (scene and result files)."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import Field, fields
from typing import Any

from facepin.solvers.interface import SolverKind

_WORDS = {
    "true": True,
    "on": True,
    "yes": True,
    "1": True,
    "false": False,
    "off": False,
    "no": False,
    "0": False,
}

Plain = bool | int | float | str


def make_settings(kind: SolverKind, values: Mapping[str, object]) -> Any:
    """Build the settings of one solver from values by name; what is not named keeps its default.

    A value may be text (from a command line) or a plain bool, int, float or str (from a file).  Naming a
    setting that has an effect only while another one has a certain value (`gamma` only while `automatic` is
    off) sets that other one too, unless it is named itself.

    Raises
    ------
    ValueError
        In one line: a name the solver does not have, a value that is not of the setting's type, out of its
        range or not among its choices.  Says what is allowed.
    """
    known = {field.name: field for field in fields(kind.settings)}
    for name in values:
        if name not in known:
            allowed = ", ".join(known) or "none"
            raise ValueError(f"{kind.key} has no setting '{name}' (there are: {allowed})")
    made = {name: _convert(kind, known[name], value) for name, value in values.items()}
    for name in values:
        if known[name].metadata["when"] is not None:
            other, needed = known[name].metadata["when"]
            made.setdefault(other, needed)
    return kind.settings(**made)


def parse_settings(kinds: Iterable[SolverKind], assignments: Iterable[str]) -> dict[str, Any]:
    """Build the settings of each solver from `name=value` texts.

    A text goes to every one of the solvers that has a setting of that name; `key.name=value` goes to one.

    Returns
    -------
    dict
        Settings by solver key, one for each of `kinds`.

    Raises
    ------
    ValueError
        As `make_settings`; also for a text without "=", and for a name that none of the solvers has.
    """
    by_key = {kind.key: kind for kind in kinds}
    values: dict[str, dict[str, object]] = {key: {} for key in by_key}
    for text in assignments:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not (name and equals and value):
            raise ValueError(f"cannot read the setting '{text}' (write name=value or solver.name=value)")
        key, dot, own_name = name.partition(".")
        if dot and key not in by_key:
            raise ValueError(f"no solver '{key}' to give '{own_name}' to (there are: {', '.join(by_key)})")
        if dot:
            values[key][own_name] = value
            continue
        takers = [kind.key for kind in by_key.values() if name in _names(kind)]
        if not takers:
            offers = "; ".join(f"{kind.key}: {', '.join(_names(kind)) or 'none'}" for kind in by_key.values())
            raise ValueError(f"no setting '{name}' (there are: {offers})")
        for key in takers:
            values[key][name] = value
    return {key: make_settings(kind, values[key]) for key, kind in by_key.items()}


def plain_settings(settings: Any) -> dict[str, Plain]:
    """Return settings as plain values by name, ready for JSON; `make_settings` takes them back."""
    return {field.name: getattr(settings, field.name) for field in fields(settings)}


def _names(kind: SolverKind) -> list[str]:
    return [field.name for field in fields(kind.settings)]


def _convert(kind: SolverKind, field: "Field[Any]", value: object) -> Plain:
    """Return `value` as the type of the field's default, checked against what the field allows."""
    wrong = f"{kind.key}: {field.name}={value}"
    if isinstance(field.default, bool):
        word = str(value).strip().lower()
        if word not in _WORDS:
            raise ValueError(f"{wrong} is neither on nor off")
        return _WORDS[word]
    if isinstance(field.default, str):
        if value not in field.metadata["choices"]:
            raise ValueError(f"{wrong} is not one of: {', '.join(field.metadata['choices'])}")
        return str(value)
    whole = isinstance(field.default, int)
    try:
        number = float(str(value))
    except ValueError:
        number = math.nan
    if isinstance(value, bool) or not math.isfinite(number) or (whole and not number.is_integer()):
        raise ValueError(f"{wrong} is not a {'whole ' if whole else ''}number")
    low, high = field.metadata["low"], field.metadata["high"]
    if (low is not None and number < low) or (high is not None and number > high):
        raise ValueError(f"{wrong} is out of range ({low:g} to {high:g})")
    return int(number) if whole else number
