"""Names made to fit."""

from imgui_bundle import imgui

MOST_KEPT = 4000


class Elider:
    """Shortens names in the middle, where the words that tell shapes apart are not; remembers the answers."""

    def __init__(self) -> None:
        self._font = 0.0, 0
        self._forget()

    def _forget(self) -> None:
        self._widths: dict[str, float] = {}
        self._fitted: dict[tuple[str, int], str] = {}
        self._widest: tuple[tuple[str, ...], float] = ((), 0.0)

    def follow_font(self) -> None:
        """Begin a frame: texts of another size, or with letters of another font, have other widths."""
        font = imgui.get_font_size(), len(imgui.get_font().sources)
        if font != self._font or len(self._widths) + len(self._fitted) > MOST_KEPT:
            self._font = font
            self._forget()

    def width(self, text: str) -> float:
        """Return how wide a text is, in imgui units."""
        width = self._widths.get(text)
        if width is None:
            width = self._widths[text] = imgui.calc_text_size(text).x
        return width

    def widest(self, texts: tuple[str, ...]) -> float:
        """Return how wide the widest of some texts is; the same tuple is measured once."""
        if self._widest[0] is not texts:
            self._widest = texts, max((imgui.calc_text_size(text).x for text in texts), default=0.0)
        return self._widest[1]

    def fitted(self, text: str, room: float) -> str:
        """Return the text, with "…" for its middle if it is wider than `room`."""
        if self.width(text) <= room:
            return text
        key = (text, int(room))
        fitted = self._fitted.get(key)
        if fitted is None:
            fitted = self._fitted[key] = self._shortened(text, room)
        return fitted

    def _shortened(self, text: str, room: float) -> str:
        low, high = 1, len(text) - 1
        while low < high:  # how many letters may be kept: more are wider
            kept = (low + high + 1) // 2
            fits = imgui.calc_text_size(_middle_out(text, kept)).x <= room
            low, high = (kept, high) if fits else (low, kept - 1)
        return _middle_out(text, low) if low > 1 else "…"


def _middle_out(text: str, kept: int) -> str:
    """Return the first and the last of the letters, `kept` together, with "…" between."""
    front = (kept + 1) // 2
    return f"{text[:front]}…{text[len(text) - (kept - front) :]}"
