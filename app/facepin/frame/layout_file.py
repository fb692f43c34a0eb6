"""Where the panels stand, from run to run: imgui's own text, read and written as carefully as other files."""

from pathlib import Path

from imgui_bundle import imgui

from facepin.core.errors import FacepinError
from facepin.files.atomic import atomic_write, make_folder, set_aside
from facepin.files.reading import read_bytes


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
