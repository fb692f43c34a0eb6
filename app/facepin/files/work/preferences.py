"""What the program remembers between runs, in the platform's own folder."""

import json
from collections.abc import Callable
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path
from typing import Any, Literal

from facepin.core.errors import FacepinError
from facepin.core.pose import Freedom
from facepin.core.quality import LEVELS, Quality
from facepin.files.safely.atomic import atomic_write, make_folder, set_aside
from facepin.files.safely.checked_json import parse_json

Theme = Literal["dark", "light"]
Habit = Literal["facepin", "maya", "blender"]

RECENT = 10
"""How many rigs are remembered."""


@dataclass(frozen=True)
class Preferences:
    """Small choices of the user; a value that makes no sense is replaced by its default."""

    recent: tuple[str, ...] = ()
    """Rigs and scenes opened lately, newest first, absolute paths."""
    freedom: Freedom = "screen"
    quality: Quality = "auto"
    steady: bool = True
    ui_scale: float = 1.0
    solver: str = "hand"
    theme: Theme = "dark"
    habit: Habit = "facepin"
    """Whose mouse and keys the user knows."""
    guide: int = 0
    """How many of the first steps are done."""
    lately: tuple[str, ...] = ()
    """What was chosen in the command palette, newest first."""
    arrangement: str = "rig order"
    """How weights are listed."""
    window: tuple[int, int] = (1280, 720)
    """Width and height, in pixels of a 1x screen."""

    def opened(self, path: Path) -> "Preferences":
        """Return the preferences with a rig or scene put first among the recent ones."""
        entry = str(path.resolve())
        return replace(self, recent=(entry, *(other for other in self.recent if other != entry))[:RECENT])


_RENAMED = {"quality": {"always": "good", "off": "fast"}}
"""What earlier versions called a value."""
_CHECKS: dict[str, Callable[[Any], bool]] = {
    "recent": lambda value: isinstance(value, list) and all(isinstance(entry, str) for entry in value),
    "freedom": lambda value: value in ("space", "screen"),
    "quality": lambda value: value in ("auto", *LEVELS),
    "steady": lambda value: isinstance(value, bool),
    "ui_scale": lambda value: isinstance(value, int | float) and 0.5 <= value <= 4,
    "solver": lambda value: isinstance(value, str),
    "theme": lambda value: value in ("dark", "light"),
    "habit": lambda value: value in ("facepin", "maya", "blender"),
    "guide": lambda value: isinstance(value, int) and not isinstance(value, bool) and 0 <= value <= 1000,
    "lately": lambda value: isinstance(value, list) and all(isinstance(entry, str) for entry in value),
    "arrangement": lambda value: isinstance(value, str),
    "window": lambda value: (
        isinstance(value, list)
        and len(value) == 2
        and all(
            isinstance(side, int) and not isinstance(side, bool) and 200 <= side <= 16384 for side in value
        )
    ),
}


def read_preferences(path: Path) -> tuple[Preferences, str | None]:
    """Return the preferences in a file, and one line about what in it could not be used (or None).

    A missing file gives the defaults; a broken one too, so that the program always starts: it is set aside,
    so that nothing overwrites it.
    """
    try:
        found = parse_json(path.read_bytes(), path.name).values
    except FileNotFoundError:
        return Preferences(), None
    except OSError as error:
        return (
            Preferences(),
            f"the preferences can't be read ({error.strerror or error}); the defaults are used",
        )
    except FacepinError as error:
        return Preferences(), f"the preferences can't be used: {error}; {set_aside(path)}"
    for key, names in _RENAMED.items():
        if isinstance(found.get(key), str):
            found[key] = names.get(found[key], found[key])
    usable = {name: found[name] for name, check in _CHECKS.items() if name in found and check(found[name])}
    wrong = sorted(set(found) & {field.name for field in fields(Preferences)} - set(usable))
    if "recent" in usable:
        usable["recent"] = tuple(usable["recent"][:RECENT])
    if "window" in usable:
        usable["window"] = tuple(usable["window"])
    if "lately" in usable:
        usable["lately"] = tuple(usable["lately"][:RECENT])
    line = f"{path.name}: {', '.join(wrong)} could not be used; the default stands" if wrong else None
    return Preferences(**usable), line


def write_preferences(path: Path, preferences: Preferences) -> str | None:
    """Write the preferences; return one line when that is impossible (they are not worth an interruption)."""
    text = json.dumps(asdict(preferences), indent=2) + "\n"
    try:
        make_folder(path.parent)
        atomic_write(path, text.encode())
    except FacepinError as error:
        return f"preferences could not be kept: {error}"
    return None
