"""Shapes of one meaning go by several spellings: eyeBlink_L, eyeBlinkLeft, EyeBlinkLeft, x.eyeBlinkLeft."""

from collections.abc import Sequence

SIDES = (("Left", "L"), ("Right", "R"), ("_L", "L"), ("_R", "R"), (".L", "L"), (".R", "R"))


def spelling(name: str) -> tuple[str, str]:
    """Return what all spellings of a shape have in common: its name without prefix and side, and the side."""
    side = ""
    for ending, letter in SIDES:
        if name.endswith(ending) and len(name) > len(ending):
            name, side = name.removesuffix(ending).rstrip("_"), letter
            break
    name = name.rpartition(".")[2] or name
    return name[:1].lower() + name[1:], side


def match_shapes(names: Sequence[str], shapes: Sequence[str]) -> list[int | None]:
    """Return for each of `names` the place in `shapes` of the same shape, or None.

    The very name comes first, then another spelling of it; no shape is given twice.
    """
    places = {shape: j for j, shape in enumerate(shapes)}
    found = [places.get(name) for name in names]
    taken = {j for j in found if j is not None}
    others: dict[tuple[str, str], list[int]] = {}
    for j, shape in enumerate(shapes):
        if j not in taken:
            others.setdefault(spelling(shape), []).append(j)
    for at, name in enumerate(names):
        if found[at] is None and (same := others.get(spelling(name))):
            found[at] = same.pop(0)
    return found
