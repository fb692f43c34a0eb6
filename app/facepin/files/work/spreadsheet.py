"""Tables as spreadsheets write them: commas between the cells, or semicolons where numbers have commas."""

import csv
import re
from io import StringIO
from pathlib import Path

from facepin.core.errors import FacepinError
from facepin.files.safely.reading import read_bytes

_QUOTED = re.compile(r'"[^"]*"')
_SEPARATOR = re.compile(r"sep=(.)\r?\n", re.IGNORECASE)
"""How a first line tells Excel what is between cells."""
_DECIMAL_COMMA = re.compile(r"\s*[-+]?\d*,\d+(e[-+]?\d+)?\s*", re.IGNORECASE)


def read_rows(path: Path) -> list[tuple[int, list[str]]]:
    """Return the rows of a table that are not blank, each with its line number from 1.

    Raises
    ------
    FacepinError
        If the file cannot be read or is no text in UTF-8.
    """
    try:
        text = read_bytes(path).decode("utf-8-sig")
        told = _SEPARATOR.match(text)
        first = 2 if told else 1
        text = text[told.end() :] if told else text
        delimiter = told[1] if told else _delimiter(text)
        rows = enumerate(csv.reader(StringIO(text, newline=""), delimiter=delimiter), first)
        return [(number, row) for number, row in rows if any(row)]
    except (UnicodeDecodeError, csv.Error) as error:
        raise FacepinError(f"{path.name}: not a table in UTF-8: {error}") from error


def read_number(cell: str) -> float | None:
    """Return the number in a cell, with a decimal point or a decimal comma; None where there is none."""
    try:
        return float(cell.replace(",", ".") if _DECIMAL_COMMA.fullmatch(cell) else cell)
    except ValueError:
        return None


def _delimiter(text: str) -> str:
    """Return what is between the cells: the semicolon if the first line has as many of it as commas."""
    line = _QUOTED.sub("", text.lstrip().partition("\n")[0])
    return ";" if line.count(";") >= max(line.count(","), 1) else ","
