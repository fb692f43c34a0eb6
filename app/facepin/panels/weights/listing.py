"""Which shapes the weights panel lists, and in which order."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from facepin.core.arrays import Floats, Indices
from facepin.core.rig import Rig
from facepin.core.shapes.measures import ACTIVE
from facepin.core.shapes.regions import REGIONS, SIDES, regions_and_sides

Arrangement = Literal["rig order", "by weight", "by region", "by side"]
ARRANGEMENTS: tuple[Arrangement, ...] = get_args(Arrangement)


@dataclass(frozen=True, eq=False)
class Group:
    """Shapes under one header."""

    name: str
    shapes: Indices
    """In rig order."""


Line = int | Group
"""A shape, or the header of those that follow."""


class Listing:
    """The lines of one rig; kept from frame to frame, made anew only when something about them changed."""

    def __init__(self, rig: Rig) -> None:
        self.rig = rig
        self._lower = [name.lower() for name in rig.shape_names]
        self._groups: dict[Arrangement, tuple[Group, ...]] = {}
        self._ranking: tuple[int, ...] = ()
        self._ranked: Floats | None = None
        self._key: object = None
        self._lines: Sequence[Line] = ()
        self._counted: tuple[Floats, tuple[Group, ...]] | None = None
        self._counts: tuple[int, ...] = ()

    def lines(
        self,
        arrangement: Arrangement,
        search: str,
        folded: frozenset[str],
        weights: Floats,
        *,
        in_gesture: bool,
    ) -> Sequence[Line]:
        """Return what to list, from top to bottom.

        Parameters
        ----------
        arrangement : str
            Order, or groups.
        search : str
            Words that must all be part of a name; groups open up for what is found in them.
        folded : set of str
            Names of groups of which only the header is listed.
        weights : (k,)
            For the order by weight.
        in_gesture : bool
            Whether something is being moved: no line then runs away from the mouse.
        """
        if arrangement == "by weight" and self._ranked is not weights and not (in_gesture and self._ranking):
            self._ranked = weights
            self._ranking = tuple(np.argsort(-np.abs(weights), kind="stable").tolist())
        key = (arrangement, search, folded, self._ranking if arrangement == "by weight" else None)
        if key != self._key:
            self._key, self._lines = key, tuple(self._listed(arrangement, search.lower().split(), folded))
        return self._lines

    def groups(self, arrangement: Arrangement) -> tuple[Group, ...]:
        """Return the groups of an arrangement that have any shapes; none for a flat one."""
        if arrangement in ("by region", "by side") and not self._groups:
            regions, sides = regions_and_sides(self.rig)
            self._groups["by region"] = _grouped(REGIONS, regions)
            self._groups["by side"] = _grouped(SIDES, sides)
        return self._groups.get(arrangement, ())

    def active(self, arrangement: Arrangement, weights: Floats) -> dict[str, int]:
        """Return for each group how many of its shapes are active."""
        groups = self.groups(arrangement)
        if self._counted is None or self._counted[0] is not weights or self._counted[1] is not groups:
            self._counted = weights, groups
            large = np.abs(weights) > ACTIVE
            self._counts = tuple(int(np.count_nonzero(large[group.shapes])) for group in groups)
        return {group.name: count for group, count in zip(groups, self._counts, strict=True)}

    def _listed(self, arrangement: Arrangement, words: list[str], folded: frozenset[str]) -> list[Line]:
        def found(shapes: Sequence[int]) -> list[int]:
            return (
                [j for j in shapes if all(word in self._lower[j] for word in words)]
                if words
                else list(shapes)
            )

        if arrangement == "rig order":
            return [*found(range(self.rig.shape_count))]
        if arrangement == "by weight":
            return [*found(self._ranking)]
        lines: list[Line] = []
        for group in self.groups(arrangement):
            shapes = found(group.shapes.tolist())
            if shapes:
                lines.append(group)
            if words or group.name not in folded:
                lines += shapes
        return lines


def _grouped(names: Sequence[str], of_shapes: Sequence[str]) -> tuple[Group, ...]:
    """Return a group for each name that any shape has."""
    labels = np.array(of_shapes)
    groups = (Group(name, np.flatnonzero(labels == name).astype(np.int32)) for name in names)
    return tuple(group for group in groups if len(group.shapes))
