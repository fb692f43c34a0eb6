"""Where the panels stand, from run to run: imgui's own text, read and written as carefully as other files."""

import re
from pathlib import Path

from imgui_bundle import imgui

from facepin.core.errors import FacepinError
from facepin.files.safely.atomic import atomic_write, make_folder, set_aside
from facepin.files.safely.reading import read_bytes

MOST = 0.65
"""Largest share of the room that a panel takes when everything is made larger."""


class LayoutFile:
    """Reads the layout when it is made.  (imgui itself would leave half a file behind when it is killed.)"""

    def __init__(self, path: Path | None) -> None:
        """Take the layout from a file, if there is one; None keeps no layout."""
        self.complaint = ""
        """What was wrong with the file, in one line."""
        self._path = path
        self._text = ""
        imgui.get_io().set_ini_filename(None)
        if path is None or not path.exists():
            return
        try:
            self._text = read_bytes(path).decode("utf-8")
            _check(self._text)
        except (FacepinError, ValueError) as error:
            self.complaint = f"the layout of the panels can't be used: {error}; {set_aside(path)}"
            return
        imgui.load_ini_settings_from_memory(self._text)

    def scale(self, factor: float) -> None:
        """Make all panels so many times larger where they stand, between two frames."""
        room = imgui.get_main_viewport().work_size
        text = scaled(imgui.save_ini_settings_to_memory(), factor, (room.x, room.y))
        imgui.load_ini_settings_from_memory(text)

    def save_if_due(self) -> str | None:
        """As `save`, but only when imgui says that it is time, some seconds after a change."""
        io = imgui.get_io()
        if not io.want_save_ini_settings:
            return None
        io.want_save_ini_settings = False
        return self.save()

    def save(self) -> str | None:
        """Write the layout if it is another; return one line when that is impossible."""
        text = imgui.save_ini_settings_to_memory()
        if self._path is None or text == self._text:
            return None
        self._text = text
        try:
            make_folder(self._path.parent)
            atomic_write(self._path, text.encode())
        except FacepinError as error:
            return f"the layout of the panels could not be kept: {error}"
        return None


def _check(text: str) -> None:
    """Refuse what imgui did not write: some nonsense would stop the program.

    Raises
    ------
    ValueError
        Naming the line.
    """
    for number, line in enumerate(text.splitlines(), 1):
        if not line.replace("\t", " ").isprintable():
            raise ValueError(f"line {number} is not text")
        if line.strip() and not line.startswith("[") and "=" not in line:
            raise ValueError(f"line {number} is neither a [section] nor a name=value")


def scaled(text: str, factor: float, room: tuple[float, float]) -> str:
    """Return a layout as imgui writes it with the panels so many times larger, as far as there is room.

    Of two that share a side the first one grows, unless the picture is in it; the other takes what is left.
    """
    lines = text.splitlines()
    nodes = {}
    for at, line in enumerate(lines):
        if found := re.search(r"Dock(?:Node|Space)\s+ID=(\w+)", line):
            nodes[found[1]] = _Node(at, line)
    middle = {name for name, node in nodes.items() if "CentralNode=1" in node.line}
    while more := {nodes[name].word("Parent") for name in middle} - middle - {""}:
        middle |= more
    for name, node in nodes.items():  # outer ones first
        axis = "XY".find(node.word("Split") or "-")
        parts = sorted(
            (key for key, part in nodes.items() if part.word("Parent") == name), key=middle.__contains__
        )
        if axis < 0 or len(parts) != 2:
            continue
        first, other = (nodes[key] for key in parts)
        total = node.growth[axis] * (first.size[axis] + other.size[axis])
        most = MOST * (room[axis] if parts[1] in middle else total)
        first.resize(axis, min(first.size[axis] * factor, most))
        other.resize(axis, max(total - first.size[axis], 1.0))
    for node in nodes.values():
        size = ",".join(f"{length:.0f}" for length in node.size)
        lines[node.at] = re.sub(r"SizeRef=\d+,\d+", f"SizeRef={size}", node.line)
    return "\n".join(lines) + "\n"


class _Node:
    """A line about a part of the room."""

    def __init__(self, at: int, line: str) -> None:
        self.at, self.line = at, line
        self.size = [float(length) for length in (self.word("SizeRef") or "0,0").split(",")]
        self.growth = [1.0, 1.0]

    def resize(self, axis: int, length: float) -> None:
        """Make it another length along x or y."""
        self.growth[axis] = length / max(self.size[axis], 1.0)
        self.size[axis] = length

    def word(self, name: str) -> str:
        """Return what stands behind a name, or nothing."""
        found = re.search(rf"\b{name}=(\S+)", self.line)
        return found[1] if found else ""
