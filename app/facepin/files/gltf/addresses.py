"""Addresses in a glTF: data inside its text, or files in its own folder and nowhere else, each read once."""

import base64
import binascii
from pathlib import Path, PurePosixPath, PureWindowsPath
from urllib.parse import unquote, urlsplit

from facepin.core.errors import FacepinError
from facepin.files.safely.checked_json import JsonObject

INSIDE = "a relative address inside the model's folder"


class Addresses:
    """What the addresses of one model lead to; what several entries name is read and kept once."""

    def __init__(self, path: Path) -> None:
        """Prepare for the model at `path`."""
        self._path = path
        self._kept: dict[str | Path, bytes] = {}

    @property
    def size(self) -> int:
        """Bytes kept."""
        return sum(map(len, self._kept.values()))

    def keep(self, entries: list[tuple[JsonObject, int]]) -> list[bytes]:
        """Return what the `uri` of each entry holds, at most the bytes named beside it (or somewhat more).

        Raises
        ------
        FacepinError
            For an address that is not inside the folder of the model, or nothing there.
        """
        targets = [self._target(entry) for entry, _ in entries]
        most = dict[str | Path, int]()
        for target, (_, length) in zip(targets, entries, strict=True):
            most[target] = max(length, most.get(target, 0))
        for target, (entry, _) in zip(targets, entries, strict=True):
            if target not in self._kept:
                self._kept[target] = _content(target, most[target], entry)
        return [self._kept[target] for target in targets]

    def read(self, entry: JsonObject, most: int) -> bytes:
        """Return at most the first `most` bytes of what the `uri` of an entry holds, without keeping it.

        Raises
        ------
        FacepinError
            As `keep`.
        """
        return _content(self._target(entry), most, entry)

    def same(self, entry: JsonObject) -> str | Path:
        """Return what is equal for two entries whose addresses lead to the same place; raises as `keep`."""
        return self._target(entry)

    def _target(self, entry: JsonObject) -> str | Path:
        """Return the text of a data address, or the file that is meant; others are refused untouched."""
        uri = entry.text("uri")
        if uri[:5].lower() == "data:":
            return uri
        name = unquote(uri)
        try:
            scheme = urlsplit(uri).scheme
        except ValueError:
            entry.refuse("uri", INSIDE)
        windows = PureWindowsPath(name)
        if (
            scheme
            or "\0" in name
            or windows.drive
            or windows.root
            or ".." in windows.parts
            or ".." in PurePosixPath(name).parts
        ):
            entry.refuse("uri", INSIDE)
        folder = self._path.resolve().parent
        try:
            target = (folder / name).resolve()
            found = target.is_file()
        except (OSError, RuntimeError):  # a name too long, a loop of links
            entry.refuse("uri", INSIDE)
        if not target.is_relative_to(folder):
            entry.refuse("uri", f"{INSIDE}, but it is a link that leads out")
        if not found:
            raise FacepinError(f"{entry.place('uri')}: no file {name[:200]!a} beside {self._path.name}")
        return target


def _content(target: str | Path, most: int, entry: JsonObject) -> bytes:
    if isinstance(target, Path):
        with target.open("rb") as file:
            return file.read(min(most, target.stat().st_size))
    head, comma, body = target.partition(",")
    if not comma or not head.lower().endswith(";base64"):
        entry.refuse("uri", "data:…;base64,… or a file name")
    try:
        return base64.b64decode(unquote(body) if "%" in body else body, validate=True)
    except (binascii.Error, ValueError) as error:
        raise FacepinError(f"{entry.place('uri')} is not base64: {error}") from error
