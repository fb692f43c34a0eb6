"""Scenes as .facepin: JSON that refers to the rig and holds all the work on it.

The version counts changes that an older program would misread.  What is merely added gets a section (a key at
the top) of its own: a program that does not know it keeps it as it is.
"""

import hashlib
import json
import os
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from math import pi
from pathlib import Path
from typing import Any

from facepin.core.errors import FacepinError
from facepin.core.look.camera import Camera
from facepin.core.turn import AS_IN_FILE, Turn
from facepin.files.safely.atomic import atomic_write
from facepin.files.safely.checked_json import JsonObject, parse_json
from facepin.files.safely.reading import read_bytes
from facepin.files.work.turns import turn_in
from facepin.solvers.settings import Plain

FORMAT, VERSION = "facepin-scene", 1
SUFFIX = ".facepin"
KNOWN = {
    *("format", "version", "rig", "of", "of_digest", "panes", "active", "linked"),
    *("pins", "control", "twins", "reference", "reference_shown"),
}
"""Sections that this program knows."""
MOST_PANES = 16
"""More than any window shows."""
FAR = 1e15
"""Further than any camera stands."""

Weights = Mapping[str, float]
"""By the names of shapes; those that are not named are 0."""


class NewerVersion(FacepinError):
    """The scene was written by a newer program."""


@dataclass(frozen=True)
class RigReference:
    """Which rig a scene is about."""

    name: str
    path: Path | None
    """Where it was, absolute; None for one of the program's own."""
    neutral: str | None
    """For a folder of OBJ files: the one with the neutral, where it was named."""
    asset: str = ""
    """For one of the program's own faces: its place among the assets."""
    relative: str = ""
    """Where it was, from the folder of the scene."""
    vertices: int = 0
    shapes: tuple[str, ...] = ()
    fingerprint: str = ""
    turn: Turn = AS_IN_FILE
    """How the face was turned, compared with its file."""


@dataclass(frozen=True, eq=False)
class ScenePane:
    """One solver at work."""

    solver: str
    settings: Mapping[str, Plain]
    keep_limits: bool
    weights: Weights
    hand: Weights
    """Weights last made otherwise than by dragging."""
    began: Weights | None
    """Weights before the drag that led here."""
    camera: Camera | None
    shown: Mapping[str, Plain]
    """What lies over the face."""


@dataclass(frozen=True)
class SceneControl:
    """What holds for the shapes, by their names; of the others nothing but the limits of the rig."""

    limits: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """Where they are others than the rig's."""
    locked: tuple[str, ...] = ()
    muted: tuple[str, ...] = ()
    solo: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Scene:
    """What a scene file says, before it is put on a rig."""

    rig: RigReference
    panes: tuple[ScenePane, ...]
    pins: tuple[Mapping[str, Any], ...]
    """As in a pins file; all panes share them."""
    control: SceneControl = field(default_factory=SceneControl)
    twins: tuple[tuple[str, str], ...] | None = None
    """Shapes that are each other's mirror images, where the user has said so."""
    reference: Weights | None = None
    active: int = 0
    linked: bool = True
    """One camera for all panes."""
    reference_shown: bool = False
    """The reference has a pane of its own."""
    of: Path | None = None
    """For a draft: the scene file whose unsaved work it is."""
    sections: Mapping[str, Any] = field(default_factory=dict)
    """What else the file holds, for other versions of the program."""
    digest: str = ""
    """See `digest_of`: of the scene file as it was when the work on it began; empty where that is unknown."""

    @property
    def is_touched(self) -> bool:
        """Whether there is more in it than a face at rest: a weight, a pin, a restraint, a reference.

        Of what is in a scene file, a face at rest is a change too.
        """
        posed = any(weight for pane in self.panes for weight in pane.weights.values())
        more = self.pins or self.reference or self.twins is not None or self.of is not None
        return bool(posed or more or self.control != SceneControl())


def read_scene(path: Path) -> Scene:
    """Read a scene file.

    Raises
    ------
    FacepinError
        If it cannot be read, is not a scene, or is of a newer version.
    """
    content = read_bytes(path)
    return replace(parse_scene(content, path.name), digest=_digest(content))


def digest_of(path: Path) -> str:
    """Return what tells whether a file still holds what it did; empty where it can't be read."""
    try:
        return _digest(path.read_bytes())
    except OSError:
        return ""


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:32]


def write_scene(path: Path, scene: Scene) -> str:
    """Write a scene file; return its digest.

    Raises
    ------
    FacepinError
        For another suffix, or if it cannot be written.
    """
    if path.suffix.lower() != SUFFIX:
        raise FacepinError(f"{path.name}: scenes are files that end in {SUFFIX}")
    content = scene_bytes(scene, path.parent, indent=1)
    atomic_write(path, content)
    return _digest(content)


def places(rig: RigReference, scene_file: Path | None) -> Iterator[Path]:
    """Yield where the rig of a scene may be, likeliest first."""
    if scene_file is not None and rig.relative:
        yield Path(os.path.normpath(scene_file.absolute().parent / rig.relative))
    if rig.path is not None:
        yield rig.path
        if scene_file is not None:
            yield scene_file.absolute().parent / rig.path.name


def scene_bytes(scene: Scene, beside: Path | None, *, indent: int | None = None) -> bytes:
    """Return a scene as a file has it; `beside` is the folder that the rig's relative path starts from."""
    rig: dict[str, Any] = {"name": scene.rig.name}
    if scene.rig.asset:
        rig["asset"] = scene.rig.asset
    elif scene.rig.path is not None:
        if beside is not None and (relative := _relative(scene.rig.path, beside)):
            rig["relative"] = relative
        rig["path"] = str(scene.rig.path)
        if scene.rig.neutral is not None:
            rig["neutral"] = scene.rig.neutral
    rig |= {
        "vertices": scene.rig.vertices,
        "fingerprint": scene.rig.fingerprint,
        "shapes": list(scene.rig.shapes),
    }
    if scene.rig.turn != AS_IN_FILE:
        rig["turn"] = list(scene.rig.turn)
    document: dict[str, Any] = {"format": FORMAT, "version": VERSION, "rig": rig}
    if scene.of is not None:
        document["of"] = str(scene.of)
        document["of_digest"] = scene.digest
    document["panes"] = [_pane_as_json(pane) for pane in scene.panes]
    document |= {"active": scene.active, "linked": scene.linked, "pins": list(scene.pins)}
    document["control"] = asdict(scene.control)
    if scene.twins is not None:
        document["twins"] = [list(pair) for pair in scene.twins]
    if scene.reference is not None:
        document["reference"] = dict(scene.reference)
        document["reference_shown"] = scene.reference_shown
    document |= {key: value for key, value in scene.sections.items() if key not in document}
    return (json.dumps(document, indent=indent, allow_nan=False) + "\n").encode()


def parse_scene(content: bytes, where: str) -> Scene:
    """Read the content of a scene file; `where` is its name for messages.

    Raises
    ------
    FacepinError
        If it is not a scene, or of a newer version.
    """
    document = parse_json(content, where)
    if document.text("format", "") != FORMAT:
        document.refuse("format", f'"{FORMAT}"')
    if document.integer("version", low=1) > VERSION:
        raise NewerVersion(f"{where}: a newer Facepin wrote this scene; this one reads version {VERSION}")
    panes = document.children("panes")
    if not 1 <= len(panes) <= MOST_PANES:
        document.refuse("panes", f"a list of 1 to {MOST_PANES} panes")
    return Scene(
        _rig(document.child("rig")),
        tuple(_pane(pane) for pane in panes),
        tuple(pin.values for pin in document.children("pins")),
        _control(document.child("control")),
        _twins(document) if "twins" in document else None,
        _weights(document, "reference") if "reference" in document else None,
        document.integer("active", 0, high=len(panes) - 1),
        document.flag("linked", True),
        document.flag("reference_shown", False),
        _path(document, "of"),
        _sections({key: value for key, value in document.values.items() if key not in KNOWN}, where),
        document.text("of_digest", ""),
    )


def _sections(values: dict[str, Any], where: str) -> dict[str, Any]:
    """Return sections that are only kept, sure that they can be written again."""
    try:
        json.dumps(values, allow_nan=False)
    except (ValueError, RecursionError) as error:
        raise FacepinError(f"{where}: {', '.join(values)} can't be kept: {error}") from error
    return values


def _rig(entry: JsonObject) -> RigReference:
    path, asset = _path(entry, "path"), entry.text("asset", "")
    if path is None and not asset:
        entry.refuse("path", "the path of a rig")
    return RigReference(
        entry.text("name", path.stem if path else asset),
        path,
        entry.text("neutral") if "neutral" in entry else None,
        asset,
        entry.text("relative", ""),
        entry.integer("vertices", 0),
        tuple(entry.strings("shapes")),
        entry.text("fingerprint", ""),
        turn_in(entry, "turn", AS_IN_FILE),
    )


def _control(entry: JsonObject) -> SceneControl:
    limits: dict[str, tuple[float, float]] = {}
    found = entry.child("limits")
    for name in found.values:
        low, high = found.numbers(name, 2)
        if low > high:
            found.refuse(name, "two numbers, the lowest first")
        limits[name] = low, high
    locked, muted, solo = (tuple(entry.strings(key)) for key in ("locked", "muted", "solo"))
    return SceneControl(limits, locked, muted, solo)


def _twins(document: JsonObject) -> tuple[tuple[str, str], ...]:
    pairs: list[tuple[str, str]] = []
    found = document.values["twins"]
    for pair in found if isinstance(found, list) else [None]:
        match pair:
            case [str(one), str(other)]:
                pairs.append((one, other))
            case _:
                document.refuse("twins", "a list of pairs of names")
    return tuple(pairs)


def _pane(entry: JsonObject) -> ScenePane:
    weights = _weights(entry, "weights")
    return ScenePane(
        entry.text("solver"),
        _plain(entry.child("settings")),
        entry.flag("keep_limits", False),
        weights,
        _weights(entry, "hand") if "hand" in entry else weights,
        _weights(entry, "began") if "began" in entry else None,
        _camera(entry.child("camera")) if "camera" in entry else None,
        _plain(entry.child("shown")),
    )


def _pane_as_json(pane: ScenePane) -> dict[str, Any]:
    entry: dict[str, Any] = {"solver": pane.solver, "settings": dict(pane.settings)}
    entry |= {"keep_limits": pane.keep_limits, "weights": dict(pane.weights)}
    if pane.hand != pane.weights:
        entry["hand"] = dict(pane.hand)
    if pane.began is not None:
        entry["began"] = dict(pane.began)
    if pane.camera is not None:
        entry["camera"] = asdict(pane.camera)
    return entry | {"shown": dict(pane.shown)}


def _weights(entry: JsonObject, key: str) -> Weights:
    found = entry.child(key)
    return {name: found.number(name) for name in found.values}


def _plain(entry: JsonObject) -> dict[str, Plain]:
    for name, value in entry.values.items():
        if not isinstance(value, bool | int | float | str):
            entry.refuse(name, "a number, a text, true or false")
    return dict(entry.values)


def _camera(entry: JsonObject) -> Camera:
    x, y, z = entry.numbers("target", 3)
    return Camera(
        (x, y, z),
        entry.number("distance", low=1 / FAR, high=FAR),
        entry.number("yaw", 0.0, low=-2 * pi, high=2 * pi),
        entry.number("pitch", 0.0, low=-pi / 2, high=pi / 2),
        entry.number("fov_y", Camera().fov_y, low=0.001, high=3.0),
        entry.number("least_aspect", 0.0, low=0.0, high=100.0),
        entry.number("radius", low=1 / FAR, high=FAR),
    )


def _path(entry: JsonObject, key: str) -> Path | None:
    if key not in entry:
        return None
    text = entry.text(key)
    if not text or "\0" in text:
        entry.refuse(key, "a path")
    return Path(text)


def _relative(path: Path, folder: Path) -> str:
    """Return the way from a folder to a path; empty where there is none (another drive)."""
    try:
        return Path(os.path.relpath(path, folder.absolute())).as_posix()
    except ValueError:
        return ""
