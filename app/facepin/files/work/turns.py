"""How the user turned faces, by the path of their files: kept in the settings folder."""

import json
from pathlib import Path

from facepin.core.errors import FacepinError
from facepin.core.turn import Turn
from facepin.files.safely.atomic import atomic_write, make_folder
from facepin.files.safely.checked_json import JsonObject, parse_json

NAME = "turns.json"
MOST = 500
"""How many faces are remembered."""


def read_turn(settings: Path | None, rig: Path) -> Turn | None:
    """Return how the face of a file was turned, None where that is not known."""
    found = _read(settings).get(str(rig.resolve()))
    return turn_of(found)


def write_turn(settings: Path | None, rig: Path, turn: Turn) -> None:
    """Remember how the face of a file was turned.

    Raises
    ------
    FacepinError
        When it cannot be written.
    """
    if settings is None:
        return
    key = str(rig.resolve())
    known = {other: value for other, value in _read(settings).items() if other != key}
    kept = dict([*known.items(), (key, list(turn))][-MOST:])
    make_folder(settings)
    atomic_write(settings / NAME, (json.dumps(kept, indent=1) + "\n").encode())


def turn_of(found: object) -> Turn | None:
    """Return a turn as JSON has it, None for what is none."""
    match found:
        case [int(x), int(y), int(z)] if sorted(map(abs, (x, y, z))) == [1, 2, 3] and _is_turn((x, y, z)):
            return x, y, z
    return None


def turn_in(entry: JsonObject, key: str, default: Turn) -> Turn:
    """Return a turn in a file.

    Raises
    ------
    FacepinError
        For what is none.
    """
    if key not in entry:
        return default
    turn = turn_of(entry.values[key])
    if turn is None:
        entry.refuse(key, "three signed axes such as [1, -3, 2]")
    return turn


def _read(settings: Path | None) -> dict[str, object]:
    """Return what the file holds; nothing where it is missing or broken: it is then written anew."""
    if settings is None:
        return {}
    try:
        return dict(parse_json((settings / NAME).read_bytes(), NAME).values)
    except (OSError, FacepinError):  # what a face looks like from another side is no reason not to open it
        return {}


def _is_turn(axes: Turn) -> bool:
    """Say whether three axes are a turn, and not a mirror image."""
    order = [abs(axis) for axis in axes]
    even = order in ([1, 2, 3], [2, 3, 1], [3, 1, 2])
    negative = sum(axis < 0 for axis in axes) % 2 == 1
    return even != negative
