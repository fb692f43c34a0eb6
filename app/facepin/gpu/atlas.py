"""Many small pictures in few textures, so that a list of them is drawn in few calls."""

from collections.abc import Hashable
from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

ROW = 8
"""Cells along each side of a page."""
MOST_PAGES = 4


@dataclass(frozen=True)
class Tile:
    """Where a picture is."""

    texture: int
    """OpenGL's number of the texture."""
    upper_left: tuple[float, float]
    lower_right: tuple[float, float]
    """Texture coordinates."""


class Atlas:
    """Square pictures by key; when `MOST_PAGES` textures are full, the longest unused makes room."""

    def __init__(self, ctx: moderngl.Context, cell: int) -> None:
        """Pictures of `cell` x `cell` pixels."""
        self.cell = cell
        self._ctx = ctx
        self._pages: list[moderngl.Texture] = []
        self._places: dict[Hashable, int] = {}
        """The longest unused first."""

    def put(self, key: Hashable, image: NDArray[np.uint8]) -> None:
        """Store a picture, (cell, cell, 4) uint8, first row on top; one of the same key is replaced."""
        place = self._places.pop(key, None)
        if place is None and len(self._places) == MOST_PAGES * ROW * ROW:
            place = self._places.pop(next(iter(self._places)))
        self._places[key] = place = len(self._places) if place is None else place
        page, x, y = _cell(place)
        if page == len(self._pages):
            texture = self._ctx.texture((ROW * self.cell, ROW * self.cell), 4)
            texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
            self._pages.append(texture)
        corner = (x * self.cell, y * self.cell, self.cell, self.cell)
        self._pages[page].write(np.ascontiguousarray(image), viewport=corner)

    def tile(self, key: Hashable) -> Tile | None:
        """Return where the picture of a key is, or None."""
        if key not in self._places:
            return None
        self._places[key] = place = self._places.pop(key)
        page, x, y = _cell(place)
        inset = 0.5 / (ROW * self.cell)  # half a pixel: sampling must not fetch a neighbour's edge
        return Tile(
            self._pages[page].glo,
            (x / ROW + inset, y / ROW + inset),
            ((x + 1) / ROW - inset, (y + 1) / ROW - inset),
        )

    def release(self) -> None:
        """Give the graphics memory back."""
        for page in self._pages:
            page.release()
        self._pages, self._places = [], {}


def _cell(place: int) -> tuple[int, int, int]:
    """Return page, column and row of a place."""
    page, at = divmod(place, ROW * ROW)
    return page, at % ROW, at // ROW
