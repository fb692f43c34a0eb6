"""Landmarks of a rig: names for vertices, kept as JSON so that pins can be put on all of them at once.

`{"format": "facepin-landmarks", "version": 1, "rig": {"name": "ada", "vertices": 5821},
"landmarks": [{"name": "chin", "vertex": 219}]}`
"""

import json
from pathlib import Path

from facepin.core.errors import FacepinError
from facepin.core.pose import Pin
from facepin.core.rig import Rig
from facepin.files.safely.atomic import atomic_write
from facepin.files.safely.checked_json import parse_json
from facepin.files.safely.reading import read_bytes
from facepin.files.work.pins_file import pin_name

FORMAT, VERSION = "facepin-landmarks", 1
SUFFIX = ".landmarks.json"
"""How the names of such files end."""


def read_landmarks(path: Path, rig: Rig) -> dict[str, int]:
    """Read the landmarks of a rig: the vertex of each name.

    Raises
    ------
    FacepinError
        If the file cannot be read, is not that, is of a newer version or for a mesh of another vertex count.
    """
    document = parse_json(read_bytes(path), path.name)
    if document.text("format") != FORMAT:
        document.refuse("format", f'"{FORMAT}"')
    if document.integer("version", low=1) > VERSION:
        document.refuse("version", f"{VERSION}, a newer Facepin wrote this")
    count = document.child("rig").integer("vertices")
    if count != rig.vertex_count:
        raise FacepinError(
            f"{path.name}: these landmarks are for a mesh of {count:,} vertices, "
            f"{rig.name} has {rig.vertex_count:,}"
        )
    found: dict[str, int] = {}
    taken: set[int] = set()
    for entry in document.children("landmarks"):
        name, vertex = pin_name(entry), entry.integer("vertex", high=rig.vertex_count - 1)
        if not name or name in found:
            entry.refuse("name", "a name that no other landmark has")
        if vertex in taken:
            entry.refuse("vertex", "a vertex that is no other landmark's")
        found[name] = vertex
        taken.add(vertex)
    if not found:
        document.refuse("landmarks", "one landmark or more")
    return found


def write_landmarks(path: Path, rig: Rig, pins: tuple[Pin, ...]) -> int:
    """Write the pins that have a name as landmarks; return how many these are.

    Raises
    ------
    FacepinError
        If no pin has a name, two have the same, or the file cannot be written.
    """
    named = {pin.name: pin.vertex for pin in pins if pin.name}
    count = sum(bool(pin.name) for pin in pins)
    if not named:
        raise FacepinError("no pin has a name yet: give one in the list of pins (double click)")
    if count > len(named):
        raise FacepinError(f"{count} pins share {len(named)} names: a landmark needs one of its own")
    document = {
        "format": FORMAT,
        "version": VERSION,
        "rig": {"name": rig.name, "vertices": rig.vertex_count},
        "landmarks": [{"name": name, "vertex": vertex} for name, vertex in named.items()],
    }
    atomic_write(path, (json.dumps(document, indent=1, ensure_ascii=False) + "\n").encode())
    return count
