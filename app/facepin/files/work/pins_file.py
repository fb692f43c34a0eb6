"""Pins as JSON: `{"pins": [{"vertex": 219, "move": [0, -1, 0.2]}, {"vertex": 57, "goal": [0.1, -3, 8]}]}`."""

import json
from pathlib import Path
from typing import Any

import numpy as np

from facepin.core.delta_columns import FARTHEST
from facepin.core.errors import FacepinError
from facepin.core.pose import FRONT_AXES, Pin, Vector
from facepin.core.rig import Rig
from facepin.files.safely.atomic import atomic_write
from facepin.files.safely.checked_json import JsonObject, parse_json
from facepin.files.safely.reading import read_bytes

HARDEST = 1e6
LONGEST_NAME = 80


def read_pins(path: Path, rig: Rig) -> tuple[Pin, ...]:
    """Read the pins of a pins file or of a pose file.

    A pin has a `vertex` and either a `goal` or a `move` from the neutral; optional are `freedom` ("space" or
    "screen"), `stiffness` (> 0), for screen pins `axes` (right and up of the camera), `name`, `locked`,
    `hidden` and `held` (see `held_vertices`).

    Raises
    ------
    FacepinError
        If the file is not that, or a vertex is not one of `rig`.
    """
    document = parse_json(read_bytes(path), path.name)
    if "pins" not in document:
        document.refuse("pins", "a list of pins")
    return parse_pins(document, rig)


def held_vertices(path: Path, rig: Rig) -> frozenset[int]:
    """Return the vertices of pins that a pins file calls `held`: no hand has them, they hold what is there.

    Raises
    ------
    FacepinError
        As `read_pins`.
    """
    entries = parse_json(read_bytes(path), path.name).children("pins")
    return frozenset(
        entry.integer("vertex", high=rig.vertex_count - 1) for entry in entries if entry.flag("held", False)
    )


def write_pins(path: Path, pins: tuple[Pin, ...]) -> None:
    """Write a pins file.

    Raises
    ------
    FacepinError
        If it cannot be written.
    """
    atomic_write(path, (json.dumps({"pins": pins_as_json(pins)}, indent=1) + "\n").encode())


def parse_pins(document: JsonObject, rig: Rig) -> tuple[Pin, ...]:
    """Return the pins under the key `pins`, none where it is missing."""
    entries = document.children("pins")
    pins = tuple(_pin(entry, rig) for entry in entries)
    first: dict[int, JsonObject] = {}
    for pin, entry in zip(pins, entries, strict=True):
        other = first.setdefault(pin.vertex, entry)
        if other is not entry:
            raise FacepinError(
                f"{entry.where}: vertex {pin.vertex} is held by {other.where} already, allowed: one pin each"
            )
    return pins


def pins_as_json(pins: tuple[Pin, ...]) -> list[dict[str, Any]]:
    """Return pins as the file has them; what is as usual is left out."""
    entries = []
    for pin in pins:
        entry: dict[str, Any] = {"vertex": pin.vertex, "goal": list(pin.goal)}
        if pin.freedom != "space":
            entry |= {"freedom": pin.freedom, "axes": [list(axis) for axis in pin.axes]}
        if pin.stiffness != 1.0:
            entry["stiffness"] = pin.stiffness
        if pin.name:
            entry["name"] = pin.name
        entry |= {flag: True for flag in ("locked", "hidden") if getattr(pin, flag)}
        entries.append(entry)
    return entries


def _pin(entry: JsonObject, rig: Rig) -> Pin:
    vertex = entry.integer("vertex", high=rig.vertex_count - 1)
    if ("goal" in entry) == ("move" in entry):
        raise FacepinError(f"{entry.where}: a pin needs either a goal or a move from the neutral")
    if "goal" in entry:
        goal = _vector(entry, "goal")
    else:
        x, y, z = (np.asarray(_vector(entry, "move")) + rig.neutral[vertex]).tolist()
        goal = (x, y, z)
    freedom = entry.text("freedom", "space")
    if freedom not in ("space", "screen"):
        entry.refuse("freedom", '"space" or "screen"')
    stiffness = entry.number("stiffness", 1.0, low=1 / HARDEST, high=HARDEST)
    return Pin(
        vertex,
        goal,
        "screen" if freedom == "screen" else "space",
        _axes(entry),
        stiffness,
        pin_name(entry, ""),
        entry.flag("locked", False),
        entry.flag("hidden", False),
    )


def pin_name(entry: JsonObject, default: str | None = None) -> str:
    """Return the name of a pin: one short line."""
    name = entry.text("name", default)
    if len(name) > LONGEST_NAME or not (name.isprintable() and name == name.strip()):
        entry.refuse("name", f"a text of at most {LONGEST_NAME} characters without line ends")
    return name


def _vector(entry: JsonObject, key: str) -> Vector:
    x, y, z = entry.numbers(key, 3)
    if max(abs(x), abs(y), abs(z)) > FARTHEST:
        entry.refuse(key, f"three numbers up to {FARTHEST:.0e}")
    return x, y, z


def _axes(entry: JsonObject) -> tuple[Vector, Vector]:
    if "axes" not in entry:
        return FRONT_AXES
    found = entry.values["axes"]
    if not isinstance(found, list) or len(found) != 2:
        entry.refuse("axes", "two vectors, right and up of the camera")
    right, up = (_vector(JsonObject({"axes": axis}, entry.where), "axes") for axis in found)
    square = np.array([right, up]) @ np.array([right, up]).T
    if not np.allclose(square, np.eye(2), atol=1e-3):
        entry.refuse("axes", "two vectors of length 1 at right angles")
    return right, up
