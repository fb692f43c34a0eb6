"""What is in a folder, to be clicked on."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path
from typing import Literal

from imgui_bundle import imgui

from facepin.core.names import readable
from facepin.panels.plain_label import plain_label

Click = Literal["once", "twice"]


@dataclass(frozen=True)
class Entry:
    """A folder, or a file that fits."""

    path: Path
    is_folder: bool

    @property
    def label(self) -> str:
        """What it is called, with signs for bytes that are no text."""
        return readable(self.path.name) + "/" * self.is_folder


def entries_of(folder: Path, patterns: Sequence[str]) -> list[Entry]:
    """Return what is in a folder: its folders, then the files that fit one of some patterns, by name.

    Hidden ones are left out; so is what can't be looked at.

    Raises
    ------
    OSError
        If the folder itself can't be read.
    """
    found = []
    with os.scandir(folder) as entries:
        for entry in entries:
            try:
                is_folder = entry.is_dir()
            except OSError:
                continue
            fits = is_folder or any(fnmatch(entry.name.lower(), pattern.lower()) for pattern in patterns)
            if fits and not entry.name.startswith("."):
                found.append(Entry(Path(entry.path), is_folder))
    return sorted(found, key=lambda entry: (not entry.is_folder, entry.path.name.lower()))


class FolderList:
    """The list of a folder; read again when it is another folder or other files are wanted."""

    def __init__(self) -> None:
        self.folder: Path | None = None
        self.remark = ""
        """Why there is nothing to see, if there is not."""
        self._patterns: tuple[str, ...] = ()
        self._entries: list[Entry] = []

    def follow(self, folder: Path, patterns: tuple[str, ...]) -> None:
        """Show a folder."""
        if (folder, patterns) == (self.folder, self._patterns):
            return
        self.folder, self._patterns = folder, patterns
        self.refresh()

    def refresh(self) -> None:
        """Read the folder again."""
        self._entries, self.remark = [], ""
        if self.folder is None:
            return
        try:
            self._entries = entries_of(self.folder, self._patterns)
        except OSError as error:
            self.remark = f"This folder can't be read: {error.strerror}"
        if not self._entries and not self.remark:
            self.remark = "There is nothing of this kind here."

    @property
    def texts(self) -> tuple[str, ...]:
        """What is listed."""
        return tuple(entry.label for entry in self._entries)

    def draw(self, chosen: Path, size: imgui.ImVec2) -> tuple[Entry, Click] | None:
        """Draw the list; return what was clicked, and how often.

        Parameters
        ----------
        chosen : Path
            Shown as selected, if it is listed.
        size : width, height
            In imgui units.
        """
        clicked: tuple[Entry, Click] | None = None
        if imgui.begin_child("folder", size, imgui.ChildFlags_.borders):
            if self.folder is not None and self.folder.parent != self.folder:
                up = Entry(self.folder.parent, True)
                if imgui.selectable("../", False, imgui.SelectableFlags_.no_auto_close_popups)[0]:
                    clicked = up, "once"
            if self.remark:
                imgui.text_disabled(self.remark)
            clipper = imgui.ListClipper()
            clipper.begin(len(self._entries))
            while clipper.step():
                for number in range(clipper.display_start, clipper.display_end):
                    clicked = self._row(number, chosen) or clicked
        imgui.end_child()
        return clicked

    def _row(self, number: int, chosen: Path) -> tuple[Entry, Click] | None:
        entry = self._entries[number]
        flags = imgui.SelectableFlags_.allow_double_click | imgui.SelectableFlags_.no_auto_close_popups
        label = plain_label(entry.label, number)
        if not imgui.selectable(label, entry.path == chosen, flags)[0]:
            return None
        return entry, "twice" if imgui.is_mouse_double_clicked(0) else "once"
