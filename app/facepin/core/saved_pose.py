"""A pose of the library: what its file says, and what of it this rig can show."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from facepin.core.arrays import Floats
from facepin.core.names import clean_name

MOST_TAGS = 16


@dataclass(frozen=True, eq=False)
class SavedPose:
    """One pose of a library, on one rig."""

    key: str
    """Name of its file without the suffix: what it is known by as long as it exists."""
    title: str
    """What it is called: one printable line of up to 64 characters."""
    tags: tuple[str, ...]
    order: float | None
    """Poses stand by rising order; those without one (files that came from elsewhere) come last."""
    weights: Floats
    """(k,) float64, read-only; shapes that the file does not name are 0."""
    report: str
    """What of the file did not match this rig, in one line; empty if all did."""
    document: Mapping[str, Any]
    """The whole file as it was read: a new title must not lose what else stands in it."""


def clean_tags(words: str) -> tuple[str, ...]:
    """Return the tags of a line with commas between them: printable, none twice."""
    tags = (clean_name(word) for word in words.split(","))
    return tuple(dict.fromkeys(tag for tag in tags if tag))[:MOST_TAGS]
