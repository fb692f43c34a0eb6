"""The gesture of a stroke sketched on the skin, along which pins are laid.

After Cetinaslan, Orvalho and Lewis, "Sketch-Based Controllers for Blendshape Facial Animation" (2015): what
is drawn on the face is what moves it.
"""

from dataclasses import dataclass, field
from math import hypot

import numpy as np

from facepin.core.mesh.picking import Hit
from facepin.session.edit import Edit
from facepin.session.hand.moving import amount
from facepin.session.hand.sight import Pixel, Sight

SPACING = 4.0
"""Distance of the samples of a stroke, in pixels at 1x scale: each costs a ray cast at the face."""


@dataclass
class Stroke:
    """A line on the face; see `Gesture`."""

    count: int
    """How many pins it will carry."""
    sight: Sight
    before: frozenset[int]
    """Pins that stay selected with those of the stroke."""
    selected: frozenset[int]
    remark: str = ""
    samples: list[tuple[Pixel, Hit | None]] = field(default_factory=list)
    """Where the mouse was, and what of the face is there."""

    def move(self, pixel: Pixel) -> Edit | None:
        """Go on with the line."""
        last = self.samples[-1][0] if self.samples else None
        if last is None or hypot(pixel[0] - last[0], pixel[1] - last[1]) >= SPACING * self.sight.scale:
            self.samples.append((pixel, self.sight.hit(pixel)))
        return None

    def release(self, pixel: Pixel) -> Edit | None:
        """Lay the pins along the line, and select them."""
        if len(self.samples) > 1 or self.sight.apart(pixel, self.samples[0][0]):  # else it is a mere click
            self.samples.append((pixel, self.sight.hit(pixel)))
        found = self._vertices()
        pins = self.sight.pose.pins
        there = {pin.vertex for pin in pins}
        new = tuple(self.sight.new_pin(vertex) for vertex in found if vertex not in there)
        hidden = {pin.vertex for pin in pins if pin.hidden}
        self.selected = self.before | (frozenset(found) - hidden)
        if new and not self.sight.rig.rows_at([pin.vertex for pin in new]).any():
            self.remark = "No shape of this rig moves the points under the stroke"
        elif 1 < len(found) < self.count:
            self.remark = f"{len(found)} pins are laid: the mesh has no more points along so short a line"
        return Edit(f"Sketch {amount(len(new))}", True, (*pins, *new)) if new else None

    def _vertices(self) -> list[int]:
        """Return the vertices nearest to points spread evenly along the line, in its order."""
        path = [(pixel, hit) for pixel, hit in self.samples if hit is not None]
        if not path:
            return []
        pixels = np.array([pixel for pixel, _ in path])
        steps = np.diff([hit.point for _, hit in path], axis=0)
        way = np.concatenate([[0.0], np.cumsum(np.linalg.norm(steps, axis=1))])
        vertices = []
        for at in np.linspace(0, way[-1], self.count):
            pixel = float(np.interp(at, way, pixels[:, 0])), float(np.interp(at, way, pixels[:, 1]))
            # Between two samples the skin may be elsewhere than on the straight line between them.
            hit = self.sight.hit(pixel) or path[int(np.argmin(np.abs(way - at)))][1]
            vertices.append(hit.vertex)
        return list(dict.fromkeys(vertices))


def sketch(pressed: Pixel, count: int, sight: Sight, before: frozenset[int]) -> Stroke:
    """Begin a stroke of `count` pins."""
    stroke = Stroke(count, sight, before, before)
    stroke.move(pressed)
    return stroke
