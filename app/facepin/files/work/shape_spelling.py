"""Shapes of one meaning go by several spellings: eyeBlink_L, eyeBlinkLeft, EyeBlinkLeft, x.eyeBlinkLeft."""

from collections import Counter
from collections.abc import Callable, Hashable, Sequence
from unicodedata import normalize

from facepin.core.names import clean_name

SIDES = (("Left", "L"), ("Right", "R"), ("_L", "L"), ("_R", "R"), (".L", "L"), (".R", "R"))

Spelling = tuple[str, str]
"""Name without prefix and side, and the side."""


def spelling(name: str) -> Spelling:
    """Return what all spellings of a shape have in common: its name without prefix and side, and the side."""
    return _split(name)[1]


def match_shapes(names: Sequence[str], shapes: Sequence[str]) -> list[int | None]:
    """Return for each of `names` the place in `shapes` of the same shape, or None.

    The very name comes first, then the same letters encoded otherwise or with other blanks, then another
    spelling; a prefix counts for nothing where all names of a list have it, or the other name has none.
    What is not the very name has to be the only such one in both lists.  No shape is given twice.
    """
    places = {shape: j for j, shape in enumerate(shapes)}
    found = [places.get(name) for name in names]
    here, there = _without_shared_prefix(names), _without_shared_prefix(shapes)
    ways: list[tuple[Sequence[Hashable], Sequence[Hashable]]] = [
        (
            _keys(names, lambda name: normalize("NFC", name)),
            _keys(shapes, lambda name: normalize("NFC", name)),
        ),
        (_keys(names, _tidied), _keys(shapes, _tidied)),
        (here, there),
    ]
    for ours, theirs in ways:
        _match_unique(found, ours, theirs, lambda at, j: True)
    _match_unique(
        found,
        [spelled for _, spelled in here],
        [spelled for _, spelled in there],
        lambda at, j: not (here[at][0] and there[j][0]),
    )
    return found


def _match_unique(
    found: list[int | None],
    names: Sequence[Hashable],
    shapes: Sequence[Hashable],
    allowed: Callable[[int, int], bool],
) -> None:
    """Fill in what is not found yet and has a key that is there once on both sides."""
    taken = {j for j in found if j is not None}
    counts, places = Counter(names), dict[Hashable, list[int]]()
    for j, key in enumerate(shapes):
        places.setdefault(key, []).append(j)
    for at, key in enumerate(names):
        same = places.get(key, [])
        if (
            found[at] is None
            and counts[key] == 1 == len(same)
            and same[0] not in taken
            and allowed(at, same[0])
        ):
            found[at] = same[0]


def _keys(names: Sequence[str], key: Callable[[str], str]) -> list[str]:
    return [key(name) for name in names]


def _tidied(name: str) -> str:
    """Return a name as older files have it: blanks folded, and shortened."""
    return clean_name(normalize("NFC", name))


def _without_shared_prefix(names: Sequence[str]) -> list[tuple[str, Spelling]]:
    """Return prefix and spelling of each name, without a prefix where all of several names have the same."""
    split = [_split(normalize("NFC", name)) for name in names]
    shared = len(split) > 1 and len({prefix for prefix, _ in split}) == 1
    return [("" if shared else prefix, spelled) for prefix, spelled in split]


def _split(name: str) -> tuple[str, Spelling]:
    """Return the prefix of a name, "" where it has none, and its spelling."""
    side = ""
    for ending, letter in SIDES:
        if name.endswith(ending) and len(name) > len(ending):
            name, side = name.removesuffix(ending).rstrip("_"), letter
            break
    prefix, _, tail = name.rpartition(".")
    if not any(letter.isalpha() for letter in tail):  # smile.001 and blink.001 are no 001 of smile and blink
        prefix, tail = "", name
    return prefix, (tail[:1].lower() + tail[1:], side)
