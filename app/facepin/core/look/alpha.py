"""What of a surface is there: its alpha and that of its texture decide what is drawn and what is picked."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats, Indices
from facepin.core.rig import Part, Rig, Texture

CLEAR = 0.02
"""Opacity below which a surface is not there at all."""
SOLID = 0.95
"""Alpha from which on what is blended hides what is behind it."""
GRASPED = 0.5
"""Alpha from which on a press takes what is blended, and not what is seen through it."""


def opacity(part: Part) -> float:
    """Return the share of what is behind a part that it hides where its texture is solid, 0..1."""
    return part.opacity * (1.0 - part.transmission)


def is_clear(part: Part) -> bool:
    """Say whether nothing of a part is ever seen: the moisture of an eye, a cornea of glass."""
    if part.cutout is not None and not part.blends:
        return part.opacity < part.cutout
    return opacity(part) < CLEAR


def is_blended(part: Part) -> bool:
    """Say whether something is seen through a part; many files say so of all they have, solid or not."""
    if opacity(part) < SOLID:
        return part.cutout is None or part.blends or part.transmission > 0.0
    return part.blends and part.texture is not None and bool(part.texture.pixels[..., 3].min() < 255 * SOLID)


class Presence:
    """Tells of the triangles of some parts where they are there to be pressed."""

    def __init__(self, rig: Rig, parts: Sequence[Part]) -> None:
        self._places = rig.texture_places
        self._parts = tuple(parts)
        self._part = np.repeat(np.arange(len(parts)), [len(part.triangles) for part in parts])
        runs = [rig.triangles[part.triangles.start : part.triangles.stop] for part in parts]
        self.triangles: Indices = np.concatenate(runs) if runs else rig.triangles[:0]
        """(t, 3) of all parts, one after the other."""

    def __call__(self, triangle: int, shares: Floats) -> bool:
        """Say whether there is anything at a point of a triangle: its corners times `shares` (3,)."""
        part = self._parts[self._part[triangle]]
        least = part.cutout if part.cutout is not None and not part.blends else GRASPED
        textured = part.texture is not None and self._places is not None
        if not textured or (part.cutout is None and not part.blends):
            return not is_blended(part) or opacity(part) >= least
        assert part.texture is not None and self._places is not None
        at = shares @ self._places[self.triangles[triangle]].astype(np.float64)
        alpha = _texel(part.texture, at)[3] / 255
        return bool(alpha * opacity(part) >= least)


def _texel(texture: Texture, at: Floats) -> NDArray[np.uint8]:
    """Return the pixel (4,) of a texture at a place (2,)."""
    height, width, _ = texture.pixels.shape
    (x, y), sizes = at, (width, height)
    across = []
    for place, size, repeats in zip((x, y), sizes, texture.repeats, strict=True):
        number = int(np.floor(place * size)) if np.isfinite(place) else 0
        across.append(number % size if repeats else min(max(number, 0), size - 1))
    pixel: NDArray[np.uint8] = texture.pixels[across[1], across[0]]
    return pixel
