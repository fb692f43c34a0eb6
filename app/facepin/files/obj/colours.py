"""Colours of vertices in .obj files: three numbers more in each `v` line, or ZBrush's `#MRGB` comments."""

from io import StringIO

import numpy as np

from facepin.core.arrays import Points
from facepin.files.obj.text import ObjText

LARGEST_BYTE = 255.0


def read_colours(text: ObjText) -> Points | None:
    """Return the colours of all vertices, (n, 3) sRGB 0..1; None where not every vertex has one."""
    lines = text.lines_of(b"v")
    if len(text.line(int(lines[0])).split(b"#")[0].split()) >= 7:
        return _further_numbers(text)
    return _polypaint(text, len(lines))


def _further_numbers(text: ObjText) -> Points | None:
    """Return r, g, b behind x, y, z: 0..1, or 0..255 where any is more than 1."""
    block = text.joined(text.lines_of(b"v")).decode("ascii", "replace")
    try:
        found = np.loadtxt(StringIO(block), np.float64, comments="#", usecols=(4, 5, 6), ndmin=2)
    except ValueError:  # not every line has them
        return None
    if not np.isfinite(found).all() or found.min() < 0 or found.max() > LARGEST_BYTE:
        return None
    return (found / (LARGEST_BYTE if found.max() > 1 else 1.0)).astype(np.float32)


def _polypaint(text: ObjText, vertices: int) -> Points | None:
    """Return what `#MRGB` lines say: eight hex digits a vertex, of mask, red, green and blue."""
    digits = b"".join(text.line(at)[5:].strip() for at in text.lines_of(b"#MRGB").tolist())
    try:
        levels = np.frombuffer(bytes.fromhex(digits.decode("ascii", "replace")), np.uint8)
    except ValueError:
        return None
    if not vertices or len(levels) != 4 * vertices:
        return None
    return (levels.reshape(-1, 4)[:, 1:] / LARGEST_BYTE).astype(np.float32)
