"""JSON from strangers: every value is asked for with type and range, and a wrong one says where it stands."""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite
from typing import Any, NoReturn

from facepin.core.errors import FacepinError

ANY = 2**53
"""No upper limit: what a JSON number holds exactly."""


@dataclass(frozen=True)
class JsonObject:
    """One object of a JSON document, and its place in it for messages.

    Every getter raises `FacepinError` for a value of the wrong type or range; a key that is missing gives the
    default, or an error where there is none.
    """

    values: dict[str, Any]
    where: str
    """File and place inside it: `face.glb: meshes[0].primitives[1]`; the root's is the file and a colon."""

    def __contains__(self, key: str) -> bool:
        return key in self.values

    def refuse(self, key: str, allowed: str) -> NoReturn:
        """Raise the line that says what was found at `key` and what is allowed there."""
        if key not in self.values:
            raise FacepinError(f"{self.place(key)} is missing, allowed: {allowed}")
        raise FacepinError(f"{self.place(key)} is {_short(self.values[key])}, allowed: {allowed}")

    def place(self, key: str) -> str:
        """Return where the value of `key` stands."""
        return f"{self.where} {key}" if self.where.endswith(":") else f"{self.where}.{key}"

    def integer(self, key: str, default: int | None = None, *, low: int = 0, high: int = ANY) -> int:
        """Return a whole number within `low` .. `high`."""
        value = self.values.get(key, default)
        if type(value) is float and value.is_integer():
            value = int(value)
        if type(value) is not int or not low <= value <= high:
            self.refuse(key, f"a whole number {low} {'to ' + str(high) if high < ANY else 'or more'}")
        return value

    def optional_integer(self, key: str, *, high: int = ANY) -> int | None:
        """Return a whole number within 0 .. `high`, or None where the key is missing."""
        return self.integer(key, high=high) if key in self.values else None

    def number(
        self, key: str, default: float | None = None, *, low: float = -1e300, high: float = 1e300
    ) -> float:
        """Return a finite number within `low` .. `high`."""
        value = self.values.get(key, default)
        if type(value) not in (int, float) or value is None or not low <= value <= high:
            self.refuse(key, f"a number {low:g} to {high:g}")
        return float(value)

    def numbers(self, key: str, count: int | None = None) -> list[float]:
        """Return a list of finite numbers, `count` of them if given."""
        found = self.values.get(key)
        if (
            not isinstance(found, list)
            or (count is not None and len(found) != count)
            or not _all_finite(found)
        ):
            if isinstance(found, list) and (count is None or len(found) == count):
                wrong = next(value for value in found if not _all_finite([value]))
                raise FacepinError(f"{self.place(key)} holds {_short(wrong)}, allowed: finite numbers")
            self.refuse(key, f"a list of {'' if count is None else f'{count} '}finite numbers")
        return [float(value) for value in found]

    def text(self, key: str, default: str | None = None) -> str:
        """Return a string."""
        value = self.values.get(key, default)
        if not isinstance(value, str):
            self.refuse(key, "a text")
        return value

    def flag(self, key: str, default: bool) -> bool:
        """Return true or false."""
        value = self.values.get(key, default)
        if not isinstance(value, bool):
            self.refuse(key, "true or false")
        return value

    def strings(self, key: str) -> list[str]:
        """Return a list of strings, empty where the key is missing."""
        found = self.values.get(key, [])
        if not isinstance(found, list) or not all(isinstance(value, str) for value in found):
            self.refuse(key, "a list of texts")
        return list(found)

    def indices(self, key: str, high: int) -> list[int]:
        """Return a list of whole numbers 0 .. `high`, empty where the key is missing."""
        found = self.values.get(key, [])
        if not isinstance(found, list) or not all(type(i) is int and 0 <= i <= high for i in found):
            self.refuse(key, f"a list of whole numbers 0 to {high}")
        return list(found)

    def child(self, key: str) -> "JsonObject":
        """Return an object, empty where the key is missing."""
        found = self.values.get(key, {})
        if not isinstance(found, dict):
            self.refuse(key, "an object")
        return JsonObject(found, self.place(key))

    def children(self, key: str) -> "JsonList":
        """Return a list of objects, empty where the key is missing."""
        found = self.values.get(key, [])
        if not isinstance(found, list):
            self.refuse(key, "a list of objects")
        return JsonList(found, self.place(key))


@dataclass(frozen=True)
class JsonList:
    """A list of objects, each checked when it is asked for."""

    values: list[Any]
    where: str

    def __len__(self) -> int:
        return len(self.values)

    def __getitem__(self, index: int) -> JsonObject:
        if not 0 <= index < len(self.values):
            raise FacepinError(f"{self.where}[{index}] is asked for, there are {len(self.values)}")
        found = self.values[index]
        if not isinstance(found, dict):
            raise FacepinError(f"{self.where}[{index}] is {_short(found)}, allowed: an object")
        return JsonObject(found, f"{self.where}[{index}]")

    def __iter__(self) -> Iterator[JsonObject]:
        return (self[index] for index in range(len(self.values)))


def parse_json(text: bytes, where: str) -> JsonObject:
    """Parse UTF-8 JSON whose root is an object; NaN and Infinity, which JSON does not have, are refused.

    Raises
    ------
    FacepinError
        If it is not that.
    """

    def refuse_constant(word: str) -> NoReturn:
        raise FacepinError(f"{where}: {word} is not a JSON number, allowed are finite numbers")

    try:
        root = json.loads(text.decode("utf-8-sig"), parse_constant=refuse_constant)
    except UnicodeDecodeError as error:
        raise FacepinError(
            f"{where}: byte {error.start} is not UTF-8 text, allowed is JSON in UTF-8"
        ) from error
    except RecursionError as error:
        raise FacepinError(f"{where}: JSON is nested too deeply") from error
    except ValueError as error:
        raise FacepinError(f"{where}: not JSON: {error}") from error
    if not isinstance(root, dict):
        raise FacepinError(f"{where}: the JSON root is {_short(root)}, allowed: an object")
    return JsonObject(root, f"{where}:")


def _all_finite(values: list[Any]) -> bool:
    return all(type(value) in (int, float) and abs(value) <= 1e300 and isfinite(value) for value in values)


def _short(value: Any) -> str:
    """Show a found value in a few characters, whatever its size."""
    if isinstance(value, dict):
        return f"an object of {len(value)}"
    if isinstance(value, list):
        return f"a list of {len(value)}"
    shown = ascii(value[:60]) if isinstance(value, str) else str(value)
    return shown if len(shown) <= 60 else shown[:57] + "…"
