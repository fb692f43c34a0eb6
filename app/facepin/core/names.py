"""Names that come from files, made fit to be shown: printable, short, unique."""

import re
from collections.abc import Sequence

LONGEST = 64
LONGEST_SHAPE = 256
"""Exporters chain the names of correctives, and what tells the left from the right is at their end."""
MOST_LISTED = 6
TERMINAL_CODE = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")


def clean_name(name: str, longest: int = LONGEST) -> str:
    """Return `name` without what cannot be seen, blanks folded, shortened to `longest`; maybe empty.

    Dropped are control, format and direction characters and terminal codes.
    """
    name = TERMINAL_CODE.sub("", name[: 16 * longest])
    visible = "".join(c for c in name if c.isprintable() or c.isspace())
    visible = " ".join(visible.split())
    return visible if len(visible) <= longest else visible[: longest - 1].rstrip() + "…"


def shown_name(name: str) -> str:
    """Return what lists and charts show of a name: one line of up to 64 characters, both of its ends kept."""
    visible = clean_name(name, len(name) or 1)
    if len(visible) <= LONGEST:
        return visible
    return visible[: LONGEST // 2].rstrip() + "…" + visible[1 + LONGEST // 2 - LONGEST :].lstrip()


def readable(text: str) -> str:
    """Return a text with a sign for each byte of it that is none: names of files may hold any bytes."""
    return text.encode("utf-8", "replace").decode()


def clean_names(
    names: Sequence[str], *, unnamed: str = "shape", longest: int = LONGEST
) -> tuple[list[str], list[str]]:
    """Clean all `names` and make them unique: empty becomes shape_j, a repeated one gets " 2", " 3", ….

    Returns
    -------
    names : list of str
        As many as came in, unique and printable.
    remarks : list of str
        One line for each kind of mending that was needed.
    """
    taken = set[str]()
    clean = []
    numbered, mended, empty = [], [], []
    wanted = {clean_name(name, longest) for name in names}
    next_number = dict[str, int]()
    for j, name in enumerate(names):
        base = clean_name(name, longest)
        if not base:
            base = f"{unnamed}_{j}"
            while base in wanted:
                base += "_"
            empty.append(base)
        elif base != name:
            mended.append(base)
        unique = base
        if base in taken:
            number = next_number.get(base, 2)
            while (unique := f"{base} {number}") in taken or unique in wanted:
                number += 1
            next_number[base] = number + 1
            numbered.append(unique)
        taken.add(unique)
        clean.append(unique)
    remarks = []
    if empty:
        remarks.append(f"{unnamed}s without a name, now called {listed(empty)}")
    if mended:
        remarks.append(f"{unnamed} names with unprintable or too many characters, now {listed(mended)}")
    if numbered:
        remarks.append(f"{unnamed} names that repeat, now {listed(numbered)}")
    return clean, remarks


def listed(items: Sequence[str]) -> str:
    """Join what is shown of names with commas; after a few, say how many more there are."""
    shown = ", ".join(map(shown_name, items[:MOST_LISTED]))
    hidden = len(items) - MOST_LISTED
    return f"{shown} and {hidden} more" if hidden > 0 else shown


def brief(title: str) -> str:
    """Return a title without what it says in brackets at its end: "Few shapes (sparse)" is "Few shapes"."""
    return title.partition(" (")[0]


def without_author(title: str) -> str:
    """Return a title without whose work it is: "A (b, Name 2017)" is "A (b)"."""
    kept, comma, _ = title.partition(",")
    return kept + ")" * bool(comma)
