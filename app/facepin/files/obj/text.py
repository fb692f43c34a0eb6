"""The text of one .obj file as arrays.  Vertices keep the order of their `v` lines, never split or welded."""

import re
from dataclasses import dataclass
from io import StringIO

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats
from facepin.core.errors import FacepinError

BLANKS = (ord(" "), ord("\t"))
PART_WORDS = (b"usemtl", b"g", b"o")
"""What divides a mesh into parts: the first of these that a file uses."""

FURTHEST = 1e30
"""Largest coordinate: geometry is float32, and lengths are made of squares."""


@dataclass(frozen=True, eq=False)
class ObjText:
    """An .obj file cut into lines."""

    name: str
    content: bytes
    starts: NDArray[np.int64]
    """Offset of every line, and the end."""

    def lines_of(self, word: bytes) -> NDArray[np.int64]:
        """Return the numbers (from 0) of the lines that begin with `word` and a blank."""
        buffer = np.frombuffer(self.content, np.uint8)
        found = np.flatnonzero(buffer[self.starts[:-1]] == word[0])
        for at in range(1, len(word) + 1):
            places = self.starts[found] + at
            found, places = found[places < len(buffer)], places[places < len(buffer)]
            wanted = (word[at],) if at < len(word) else BLANKS
            found = found[np.isin(buffer[places], wanted)]
        return found

    def line(self, number: int) -> bytes:
        """Return line `number`, from 0."""
        return self.content[self.starts[number] : self.starts[number + 1]]

    def joined(self, lines: NDArray[np.int64]) -> bytes:
        """Return the given lines, ascending, as one text."""
        if not len(lines):
            return b""
        breaks = np.flatnonzero(np.diff(lines) != 1) + 1
        runs = zip(np.append(0, breaks), np.append(breaks, len(lines)), strict=True)
        return b"".join(self.content[self.starts[lines[a]] : self.starts[lines[b - 1] + 1]] for a, b in runs)


def check_text(content: bytes, name: str) -> None:
    """Refuse what is no text.

    Raises
    ------
    FacepinError
        For text that is not one byte per character (UTF-16), or no text at all.
    """
    if content[:2] in (b"\xff\xfe", b"\xfe\xff") or b"\0" in content:
        raise FacepinError(f"{name}: UTF-16 or binary content, allowed: OBJ as plain text (ASCII or UTF-8)")


def cut_lines(content: bytes, name: str) -> ObjText:
    """Cut the content of a file into lines, continuations joined, indentation and a byte order mark removed.

    Raises
    ------
    FacepinError
        For text that is not one byte per character (UTF-16, or no text at all).
    """
    check_text(content, name)
    content = content.removeprefix(b"\xef\xbb\xbf")
    if b"\r" in content and b"\n" not in content:
        content = content.replace(b"\r", b"\n")
    if b"\\\n" in content or b"\\\r\n" in content:
        content = _join_continuations(content)
    if content[:1] in (b" ", b"\t") or b"\n " in content or b"\n\t" in content:
        content = re.sub(rb"(?m)^[ \t]+", b"", content)
    if not content.endswith(b"\n"):
        content += b"\n"
    ends = np.flatnonzero(np.frombuffer(content, np.uint8) == ord("\n")) + 1
    return ObjText(name, content, np.concatenate([[0], ends]))


def read_vertices(text: ObjText) -> Floats:
    """Return the `v` lines, (n, 3) float64; vertex colours and other further numbers are passed over.

    Decimal commas are read as points, where all lines have them or whole numbers.

    Raises
    ------
    FacepinError
        With file and line, for a line that has not three finite numbers, or if there is none.
    """
    lines = text.lines_of(b"v")
    if not len(lines):
        raise FacepinError(f"{text.name}: no vertices (lines that begin with 'v')")
    block = text.joined(lines).decode("ascii", "replace")
    try:
        vertices = _numbers(block)
    except ValueError as error:
        if "," not in block:
            raise _first_wrong_vertex(text, lines) from error
        try:  # 1,5 is one and a half where that is how people write it
            vertices = _numbers(block.replace(",", "."))
        except ValueError:
            raise _first_wrong_vertex(text, lines) from error
    if len(vertices) != len(lines) or not (np.abs(vertices) <= FURTHEST).all():
        raise _first_wrong_vertex(text, lines)
    return vertices


def _numbers(block: str) -> Floats:
    """Return the first three numbers of each line, (n, 3)."""
    return np.loadtxt(StringIO(block), np.float64, comments=None, usecols=(1, 2, 3), ndmin=2)


@dataclass(frozen=True, eq=False)
class ObjFaces:
    """The `f` lines of a file."""

    corners: NDArray[np.int64]
    """Vertex indices from 0, face after face."""
    sizes: NDArray[np.int64]
    part_names: list[str]
    part_of_face: NDArray[np.int64]


def read_faces(text: ObjText, vertices: int) -> ObjFaces:
    """Return the `f` lines; relative indices count back from the vertices read so far.

    Raises
    ------
    FacepinError
        With file and line, for a face with fewer than three corners or an index that is no vertex.
    """
    lines = text.lines_of(b"f")
    block = re.sub(rb"#[^\n]*|/[^\s]*", b"", text.joined(lines))
    words = block.split()
    if max(map(len, words), default=0) > 18:
        raise _first_wrong_face(text, lines, vertices)
    table = np.array(words, dtype="S18")
    heads = np.flatnonzero(table == b"f")
    sizes = np.diff(np.append(heads, len(table))) - 1
    try:
        indices = np.delete(table, heads).astype(np.int64)
    except ValueError as error:
        raise _first_wrong_face(text, lines, vertices) from error
    if len(sizes) != len(lines) or (len(sizes) and sizes.min() < 3):
        raise _first_wrong_face(text, lines, vertices)
    if (indices < 0).any():
        before = np.searchsorted(text.lines_of(b"v"), lines)
        indices = np.where(indices < 0, indices + np.repeat(before, sizes), indices - 1)
    else:
        indices = indices - 1
    if len(indices) and not 0 <= indices.min() <= indices.max() < vertices:
        raise _first_wrong_face(text, lines, vertices)
    names, parts = _parts(text, lines)
    return ObjFaces(indices, sizes, names, parts)


def _parts(text: ObjText, faces: NDArray[np.int64]) -> tuple[list[str], NDArray[np.int64]]:
    """Return part names in order of appearance, and the part of each face."""
    for word in PART_WORDS:
        markers = text.lines_of(word)
        if not len(markers):
            continue
        numbers: dict[str, int] = {}
        labels = [text.line(at)[len(word) :].decode("utf-8", "replace").strip() for at in markers.tolist()]
        if len(faces) and faces[0] < markers[0]:
            labels.insert(0, "rest")
            markers = np.concatenate([[-1], markers])
        part_of_marker = np.array([numbers.setdefault(label, len(numbers)) for label in labels])
        return list(numbers), part_of_marker[np.searchsorted(markers, faces) - 1]
    return [], np.zeros(len(faces), np.int64)


def _join_continuations(content: bytes) -> bytes:
    """Join lines that end in a backslash with the next; blank lines keep the numbers of the others."""
    joined: list[bytes] = []
    pending: list[bytes] = []
    for line in content.split(b"\n"):
        bare = line.rstrip(b"\r")
        if bare.endswith(b"\\"):
            pending.append(bare[:-1])
        else:
            joined += [b" ".join([*pending, line]), *[b""] * len(pending)]
            pending = []
    return b"\n".join([*joined, b" ".join(pending)])


def _first_wrong_vertex(text: ObjText, lines: NDArray[np.int64]) -> FacepinError:
    for number in lines.tolist():
        words = text.line(number).split()[1:]
        try:
            fine = len(words) >= 3 and all(
                abs(float(word)) <= FURTHEST and b"_" not in word for word in words[:3]
            )
        except ValueError:
            fine = False
        if not fine:
            return _wrong_line(text, number, f"v and three finite numbers up to {FURTHEST:.0e}")
    return FacepinError(f"{text.name}: its vertices cannot be read")


def _first_wrong_face(text: ObjText, lines: NDArray[np.int64], vertices: int) -> FacepinError:
    vertex_lines = text.lines_of(b"v")
    for number in lines.tolist():
        words = text.line(number).split(b"#")[0].split()[1:]
        before = int(np.searchsorted(vertex_lines, number))
        for word in words:
            digits = word.split(b"/")[0]
            index = int(digits) if re.fullmatch(rb"[-+]?\d{1,18}", digits) else 0
            if not (1 <= index <= vertices or -before <= index <= -1):
                return _wrong_line(
                    text, number, f"vertex numbers 1 to {vertices}, or -1 to -{before} counted back"
                )
        if len(words) < 3:
            return _wrong_line(text, number, "f and three or more vertex numbers")
    return FacepinError(f"{text.name}: its faces cannot be read")


def _wrong_line(text: ObjText, number: int, allowed: str) -> FacepinError:
    found = text.line(number).decode("utf-8", "replace").strip()
    return FacepinError(f"{text.name}:{number + 1}: found {found[:60]!a}, allowed: {allowed}")
