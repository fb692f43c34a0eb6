"""Pictures side by side on paper, with titles."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats
from facepin.files.safely.atomic import atomic_write
from facepin.resources import resource
from facepin.system_fonts import fonts_for, letters_of, own_letters

if TYPE_CHECKING:
    from PIL.ImageFont import FreeTypeFont

Image = NDArray[np.uint8]

TITLE_INK, TEXT_INK, DIM_INK, FOOTER_INK = "#16181d", "#33363c", "#5f6368", "#80868b"
LEGEND_WIDTH = 20.0
"""In letter heights."""


@dataclass(frozen=True, eq=False)
class Pane:
    """One picture of a sheet, with what stands over and under it."""

    image: Image
    title: str
    subtitle: str = ""
    lines: tuple[str, ...] = ()
    """What was measured, under the picture."""
    colour: str = ""
    """Of the mark before the title, #rrggbb."""


@dataclass(frozen=True, eq=False)
class Legend:
    """A bar of colours."""

    colours: Floats
    """(m, 3) sRGB 0..1 from left to right."""
    labels: tuple[str, ...]
    """Evenly spaced below it."""


def sheet(panes: Sequence[Pane], columns: int = 0, footer: str = "", legend: Legend | None = None) -> Image:
    """Return panes side by side on white paper, (h, w, 3) uint8.

    Parameters
    ----------
    panes : sequence of Pane
        Pictures of one size.
    columns : int
        Panes in a row; 0 for as many as look well.
    footer : str
        What made the sheet, in small letters at the bottom.
    legend : Legend
        Of the colours in the panes, at the bottom on the right.
    """
    from PIL import Image as Pillow
    from PIL import ImageDraw

    columns = min(columns or _columns(len(panes)), len(panes))
    rows = [panes[at : at + columns] for at in range(0, len(panes), columns)]
    height, width = panes[0].image.shape[:2]
    em = max(width / 24, columns * width / 110, 9.0)  # readable where many panes share the width of a page
    gap, line, inch = round(0.8 * em), 1.22 * em, round(0.5 * em)
    bold, plain, small = font("Bold", 1.1 * em), font("Regular", 0.86 * em), font("Regular", 0.72 * em)
    tops = [_head_height(row, em) for row in rows]
    bottoms = [round(line * max(len(pane.lines) for pane in row) + 0.5 * em) for row in rows]
    foot = round((2.6 if legend else 1.4 if footer else 0) * em)
    whole = sum(tops) + sum(bottoms) + len(rows) * height + gap + foot
    paper = Pillow.new("RGB", (columns * width + (columns + 1) * gap, whole), "white")
    draw = ImageDraw.Draw(paper)
    y = inch
    for row, top, bottom in zip(rows, tops, bottoms, strict=True):
        for place, pane in enumerate(row):
            x = gap + place * (width + gap)
            left: float = x
            if pane.colour:
                draw.rounded_rectangle((x, y + 0.2 * em, x + 0.8 * em, y + 1.0 * em), 0.18 * em, pane.colour)
                left += 1.25 * em
            draw.text((left, y), pane.title, TITLE_INK, font_for(pane.title, bold))
            under = font_for(pane.subtitle, plain)
            draw.text((x, y + 1.5 * em), shortened(pane.subtitle, under, width), DIM_INK, under)
            paper.paste(Pillow.fromarray(pane.image[..., :3]), (x, y + top - inch))
            for number, text in enumerate(pane.lines):
                below = y + top - inch + height + 0.35 * em + number * line
                words = font_for(text, plain)
                draw.text((x, below), shortened(text, words, width), TEXT_INK, words)
        y += top + height + bottom
    if footer:
        room = paper.width - 2 * gap - (0 if legend is None else LEGEND_WIDTH * em)
        at_foot = font_for(footer, small)
        corner = (gap, paper.height - gap - 0.7 * em)
        draw.text(corner, shortened(footer, at_foot, room), FOOTER_INK, at_foot)
    if legend is not None:
        bar = np.rint(255 * legend.colours).astype(np.uint8)[None]
        wide, high = round((LEGEND_WIDTH - 4) * em), round(0.7 * em)
        left, y = paper.width - gap - wide - round(1.4 * em), paper.height - gap - round(2.0 * em)
        paper.paste(Pillow.fromarray(bar).resize((wide, high), Pillow.Resampling.BILINEAR), (round(left), y))
        for at, label in enumerate(legend.labels):
            x = left + wide * at / (len(legend.labels) - 1)
            draw.text((x, y + high + 0.25 * em), label, TEXT_INK, small, anchor="ma")
    return np.asarray(paper)


def _head_height(row: Sequence[Pane], em: float) -> int:
    """Return the room for titles over a row of panes."""
    if any(pane.subtitle for pane in row):
        return round(3.4 * em)
    return round((2.2 if any(pane.title for pane in row) else 0.5) * em)


def write_sheet(
    path: Path, panes: Sequence[Pane], footer: str = "", columns: int = 0, legend: Legend | None = None
) -> Path:
    """Write a sheet as .png and return its path.

    Raises
    ------
    FacepinError
        If it cannot be written.
    """
    from facepin.gpu.picture import png_bytes

    atomic_write(path, png_bytes(sheet(panes, columns, footer, legend)))
    return path


def contact_columns(count: int, aspect: float = 1.0) -> int:
    """Return into how many columns pictures (width over height: `aspect`) go to fill a page in landscape."""
    return max(1, min(count, round(sqrt(1.4 * count / aspect))))


def _columns(count: int) -> int:
    """Return into how many columns panes go: one row up to five, then rows as even as can be."""
    rows = -(-count // 5)
    return -(-count // rows)


def font(weight: str, size: float) -> "FreeTypeFont":
    """Return the program's font, "Bold" or "Regular", in a size in pixels."""
    from PIL import ImageFont

    return ImageFont.truetype(str(resource("assets", f"fonts/Roboto-{weight}.ttf")), size)


def font_for(text: str, usual: "FreeTypeFont") -> "FreeTypeFont":
    """Return the font to write a text with: a system's in the same size where `usual` lacks letters of it."""
    from PIL import ImageFont

    if text.isascii() or not (letters := frozenset(map(ord, text)) - own_letters()):
        return usual
    # One font writes it all, so that it is measured as it is drawn: the one that has most of it.
    found = max(fonts_for(letters)[0], key=lambda font: len(letters & letters_of(font)), default=None)
    return usual if found is None else ImageFont.truetype(str(found.path), usual.size, index=found.number)


def shortened(text: str, font: "FreeTypeFont", width: float) -> str:
    """Cut a text that is too long for its place."""
    if font.getlength(text) <= width:
        return text
    while text and font.getlength(text + "…") > width:
        text = text[:-1]
    return text.rstrip(" ,") + "…"
