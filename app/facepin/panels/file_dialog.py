"""Asking for a file: the platform's own dialog, or a list of ours with a line to type a path in."""

from collections.abc import Sequence
from pathlib import Path
from typing import Literal

from imgui_bundle import imgui
from imgui_bundle import portable_file_dialogs as native

from facepin.core.names import readable
from facepin.panels.folder_list import Click, Entry, FolderList
from facepin.panels.plain_label import plain_label

Kind = Literal["open file", "open folder", "save file"]

ROWS = 12.0
"""Entries of a folder seen at once."""
MOST_PLACES = 6


class FileDialog:
    """One question for a path, asked over several frames."""

    def __init__(
        self, kind: Kind, title: str, start: Path, filters: tuple[str, ...], *, use_native: bool
    ) -> None:
        """Ask for a path.

        Parameters
        ----------
        kind : str
            What may be chosen.
        title : str
            What it is for.
        start : Path
            Folder to begin in, or the suggested file when saving.
        filters : tuple of str
            Name, patterns, name, patterns …
        use_native : bool
            Use the platform's dialog.
        """
        self.finished = False
        self.path: Path | None = None
        """The answer once finished; None when the user gave up."""
        self.title = title
        self.listens = False
        """Whether what is typed goes into its line."""
        self._kind = kind
        # A folder whose name is no text can't be shown in a line.
        self._typed = str(start if _is_text(start) else Path.home() / readable(start.name))
        self._suffix = start.suffix
        self._remark = "Click one, or type a path and press Enter."
        self._replaces: Path | None = None
        """A file that the next Enter replaces."""
        self._fresh = True
        self._filters = tuple(zip(filters[::2], filters[1::2], strict=True)) or (("All files", "*"),)
        self._filter = 0
        self._list = FolderList()
        self._place: tuple[str, Path] | None = None
        """What was typed when the folder was looked for last, and that folder."""
        self._native: native.open_file | native.save_file | native.select_folder | None = None
        if use_native:
            match kind:
                case "open file":
                    self._native = native.open_file(title, str(start), list(filters))
                case "save file":
                    self._native = native.save_file(title, str(start), list(filters))
                case "open folder":
                    self._native = native.select_folder(title, str(start))

    @property
    def texts(self) -> tuple[str, ...]:
        """What of it names files."""
        return self._typed, self._remark, *self._list.texts

    def close(self) -> None:
        """Give up: a native dialog that is merely dropped holds the program until the user answers it."""
        if self._native is not None and not self.finished:
            self._native.kill()
        self._finish(None)

    def draw(self, recent: Sequence[Path] = ()) -> None:
        """Show the question where it is ours to show, and take the answer when there is one.

        `recent` are files that were opened lately: their folders are near at hand.
        """
        if self._native is None:
            self._draw_prompt(recent)
        elif self._native.ready(0):
            answer = self._native.result()
            chosen = answer[0] if isinstance(answer, list) and answer else answer
            self._finish(Path(chosen) if chosen and isinstance(chosen, str) else None)

    def _draw_prompt(self, recent: Sequence[Path]) -> None:
        view, em = imgui.get_main_viewport(), imgui.get_font_size()
        middle = imgui.ImVec2(view.pos.x + view.size.x / 2, view.pos.y + view.size.y * 0.45)
        imgui.set_next_window_pos(middle, imgui.Cond_.always, imgui.ImVec2(0.5, 0.5))
        imgui.set_next_window_size(imgui.ImVec2(min(44 * em, 0.95 * view.size.x), 0))
        # Modal, as those of the platform are: what is behind it waits.
        if not imgui.is_popup_open("##path"):
            imgui.open_popup("##path")
        flags = imgui.WindowFlags_.no_decoration | imgui.WindowFlags_.no_saved_settings
        if not imgui.begin_popup_modal("##path", None, flags | imgui.WindowFlags_.no_docking)[0]:
            return
        imgui.text(self.title)
        if self._fresh:
            imgui.set_keyboard_focus_here()
            self._fresh = False
        imgui.set_next_item_width(-1)
        entered, self._typed = imgui.input_text(
            "##typed", self._typed, imgui.InputTextFlags_.enter_returns_true
        )
        self.listens = imgui.is_item_active()
        self._browse(recent, min(ROWS * imgui.get_text_line_height_with_spacing(), 0.4 * view.size.y))
        imgui.align_text_to_frame_padding()
        room = imgui.get_content_region_avail().x - 13 * imgui.get_font_size()
        imgui.push_text_wrap_pos(imgui.get_cursor_pos_x() + max(room, 8 * imgui.get_font_size()))
        imgui.text_disabled(self._remark)
        imgui.pop_text_wrap_pos()
        width = 6 * imgui.get_font_size()
        gap = imgui.get_style().item_spacing.x
        imgui.same_line(imgui.get_window_width() - 2 * width - gap - imgui.get_style().window_padding.x)
        if imgui.button("Cancel", imgui.ImVec2(width, 0)) or imgui.is_key_pressed(imgui.Key.escape):
            self._finish(None)
        imgui.same_line()
        word = "Open" if self._kind != "save file" else "Replace" if self._replaces else "Save"
        if (imgui.button(word, imgui.ImVec2(width, 0)) or entered) and self._typed.strip():
            self._take(_typed_path(self._typed))
        if self.finished:
            imgui.close_current_popup()
        imgui.end_popup()

    def _browse(self, recent: Sequence[Path], height: float) -> None:
        """Draw places and the list of the folder that the typed path is in; take what is clicked."""
        em = imgui.get_font_size()
        size = imgui.ImVec2(0, height)
        if imgui.begin_child("places", imgui.ImVec2(11 * em, height), imgui.ChildFlags_.borders):
            places = dict.fromkeys((Path.home(), *(path.parent for path in recent)))
            for number, place in enumerate(list(places)[: MOST_PLACES + 1]):
                title = "Home" if place == Path.home() else Entry(place, True).label
                flags = imgui.SelectableFlags_.no_auto_close_popups
                if imgui.selectable(plain_label(title, number), False, flags)[0]:
                    self._go_to(place)
                imgui.set_item_tooltip(readable(str(place)))
        imgui.end_child()
        imgui.same_line()
        patterns = tuple(self._filters[self._filter][1].split())
        self._list.follow(self._folder(), () if self._kind == "open folder" else patterns)
        if (clicked := self._list.draw(_typed_path(self._typed), size)) is not None:
            self._click(*clicked)
        if len(self._filters) > 1:
            imgui.set_next_item_width(14 * em)
            if imgui.begin_combo("##kind", self._filters[self._filter][0]):
                for number, (title, _) in enumerate(self._filters):
                    if imgui.selectable(title, number == self._filter)[0]:
                        self._filter = number
                imgui.end_combo()

    def _folder(self) -> Path:
        """Return the folder that the typed path is, or is in, or would be in."""
        if self._place is None or self._place[0] != self._typed:
            path = _typed_path(self._typed).absolute()
            self._place = self._typed, next((at for at in (path, *path.parents) if _is_folder(at)), path)
        return self._place[1]

    def _click(self, entry: Entry, click: Click) -> None:
        """Enter a folder; choose a file by a click, take it by two."""
        if entry.is_folder:
            self._go_to(entry.path)
        elif click == "twice" or not _is_text(entry.path):  # what can't be typed is taken as it is
            self._take(entry.path)
        else:
            self._typed, self._fresh = str(entry.path), True

    def _go_to(self, folder: Path) -> None:
        """Show another folder; a name that was suggested or typed for saving stays."""
        if not _is_text(folder):
            self._remark = "The name of this folder is no text: drop it on the window."
            return
        name = ""
        if self._kind == "save file" and not _is_folder(_typed_path(self._typed)):
            name = _typed_path(self._typed).name
        self._typed, self._replaces, self._fresh = str(folder / name), None, True

    @property
    def can_ask_again(self) -> bool:
        """Whether it is ours to show: those of the platform are gone once they are answered."""
        return self._native is None

    def ask_again(self, remark: str) -> None:
        """Show the question once more with the path as it was typed, and why it was no good."""
        self.finished, self.path, self._replaces = False, None, None
        self._remark, self._fresh = remark, True
        self._list.refresh()

    def _take(self, path: Path) -> None:
        """Take the typed path for the answer, unless it would replace a file and nobody said yes to that."""
        if _is_folder(path) and self._kind != "open folder" and not self._opens(path):
            self._go_to(path)
            return
        if self._kind == "save file" and not path.suffix:
            path = path.with_suffix(self._suffix)
        if self._kind != "save file" and not path.exists():
            self._remark = f"There is no {path.name or path}: is the path right?"
            self._fresh = True
            return
        if self._kind == "save file" and path.exists() and self._replaces != path:
            self._replaces = path
            self._remark = f"{path.name} exists: press Enter again to replace it."
            self._fresh = True
            return
        self._finish(path)

    def _opens(self, folder: Path) -> bool:
        """Say whether a folder may be what is wanted where a file is asked for: OBJ files are a face."""
        wants_obj = any("*.obj" in patterns.lower() for _, patterns in self._filters)
        return self._kind == "open file" and wants_obj and any(folder.glob("*.[oO][bB][jJ]"))

    def _finish(self, path: Path | None) -> None:
        self.path = path
        self.finished = True


def _is_folder(path: Path) -> bool:
    """Say whether a path is a folder; one that can't be looked at, or is none at all, is not."""
    try:
        return path.is_dir()
    except (OSError, ValueError):
        return False


def _is_text(path: Path) -> bool:
    """Say whether a path can be written in a line."""
    try:
        str(path).encode()
    except UnicodeEncodeError:
        return False
    return True


def _typed_path(text: str) -> Path:
    """Return the path that was meant: shells leave quotes and `~` on what is copied from them."""
    path = Path(text.strip().strip("'\""))
    try:
        return path.expanduser()
    except RuntimeError:  # no such user: then the file is not found, and that is said
        return path
