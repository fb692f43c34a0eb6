"""Asking for a file: the platform's own dialog, or a line to type a path in where there is none."""

import shutil
import sys
from pathlib import Path
from typing import Literal

from imgui_bundle import imgui
from imgui_bundle import portable_file_dialogs as native

Kind = Literal["open file", "open folder", "save file"]

_LINUX_HELPERS = ("zenity", "kdialog", "matedialog", "qarma")


def has_native_dialogs() -> bool:
    """Say whether the platform's own dialogs can be shown."""
    return sys.platform in ("win32", "darwin") or any(shutil.which(name) for name in _LINUX_HELPERS)


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
            Pairs for the native dialog: name, patterns, name, patterns …
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
        self._typed = str(start)
        self._suffix = start.suffix
        self._remark = "Type a path and press Enter."
        self._replaces: Path | None = None
        """A file that the next Enter replaces."""
        self._fresh = True
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
        return self._typed, self._remark

    def close(self) -> None:
        """Give up: a native dialog that is merely dropped holds the program until the user answers it."""
        if self._native is not None and not self.finished:
            self._native.kill()
        self._finish(None)

    def draw(self) -> None:
        """Show the question where it is ours to show, and take the answer when there is one."""
        if self._native is None:
            self._draw_prompt()
        elif self._native.ready(0):
            answer = self._native.result()
            chosen = answer[0] if isinstance(answer, list) and answer else answer
            self._finish(Path(chosen) if chosen and isinstance(chosen, str) else None)

    def _draw_prompt(self) -> None:
        view = imgui.get_main_viewport()
        middle = imgui.ImVec2(view.pos.x + view.size.x / 2, view.pos.y + view.size.y * 0.4)
        imgui.set_next_window_pos(middle, imgui.Cond_.always, imgui.ImVec2(0.5, 0.5))
        imgui.set_next_window_size(imgui.ImVec2(34 * imgui.get_font_size(), 0))
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

    @property
    def can_ask_again(self) -> bool:
        """Whether it is ours to show: those of the platform are gone once they are answered."""
        return self._native is None

    def ask_again(self, remark: str) -> None:
        """Show the question once more with the path as it was typed, and why it was no good."""
        self.finished, self.path, self._replaces = False, None, None
        self._remark, self._fresh = remark, True

    def _take(self, path: Path) -> None:
        """Take the typed path for the answer, unless it would replace a file and nobody said yes to that."""
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

    def _finish(self, path: Path | None) -> None:
        self.path = path
        self.finished = True


def _typed_path(text: str) -> Path:
    """Return the path that was meant: shells leave quotes and `~` on what is copied from them."""
    path = Path(text.strip().strip("'\""))
    try:
        return path.expanduser()
    except RuntimeError:  # no such user: then the file is not found, and that is said
        return path
