"""Letters of any script: fonts of the system join the program's own when a text needs them."""

from collections.abc import Iterable
from unicodedata import name

from imgui_bundle import imgui

from facepin.core.names import listed
from facepin.panels.theme import FONT_SIZE
from facepin.system_fonts import SystemFont, fonts_for

_SCRIPTS = ("CJK", "HANGUL", "HIRAGANA", "KATAKANA", "THAI", "ARABIC", "HEBREW", "DEVANAGARI", "BENGALI")
"""Names that a reader knows; letters of others are told by their numbers."""


class Letters:
    """Remembers which letters were looked for, and which fonts are there."""

    def __init__(self) -> None:
        self._asked = set[int]()
        self._fonts = set[SystemFont]()

    def load(self, texts: Iterable[str]) -> str:
        """Find fonts for what texts need; return one line about letters that no font has, or nothing.

        To be called between two frames, after the theme has loaded the program's own font.
        """
        letters = {ord(letter) for text in texts if not text.isascii() for letter in text} - self._asked
        self._asked |= letters
        font = imgui.get_io().fonts.fonts[0]
        wanted = {letter for letter in letters if not font.is_glyph_in_font(letter)}
        if not wanted:
            return ""
        found, missing = fonts_for(wanted)
        for each in found:
            if each not in self._fonts:
                self._fonts.add(each)
                _merge(each)
        seen = sorted(letter for letter in missing if chr(letter).isprintable())
        if not seen:
            return ""
        kinds = list(dict.fromkeys(_kind(letter) for letter in seen))
        return f"No font of this system has {listed(kinds)}: such letters are shown as a sign"


def _merge(font: SystemFont) -> None:
    """Let a font stand in where those before it lack a letter."""
    config = imgui.ImFontConfig()
    config.merge_mode = True
    config.font_no = font.number
    imgui.get_io().fonts.add_font_from_file_ttf(str(font.path), FONT_SIZE, config)


def _kind(letter: int) -> str:
    """Return what to call a letter that can't be shown: its script, or its number."""
    script = name(chr(letter), "").split(" ")[0]
    if script not in _SCRIPTS:
        return f"U+{letter:04X}"
    return f"{script if script == 'CJK' else script.capitalize()} letters"
