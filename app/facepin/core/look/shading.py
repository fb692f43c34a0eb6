"""The ways to show a face."""

from dataclasses import dataclass
from typing import Literal

Shading = Literal["studio", "clay", "normals", "heat"]
"""What colours a face: its own colours and the lamps; the lamps alone; where its surface faces; how far it
moved."""


@dataclass(frozen=True)
class Mode:
    """What a menu, a key and the command line offer under one name: a shading, with its edges or without."""

    title: str
    shading: Shading
    wireframe: bool = False


MODES: dict[str, Mode] = {
    "studio": Mode("Studio", "studio"),
    "clay": Mode("Clay", "clay"),
    "wireframe": Mode("Wireframe over clay", "clay", True),
    "normals": Mode("Normals", "normals"),
    "heat": Mode("Heat map of the move", "heat"),
}
"""In the order in which a key goes through them."""
