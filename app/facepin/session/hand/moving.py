"""Moving pins together."""

from collections.abc import Collection
from dataclasses import replace

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.look.camera import Camera
from facepin.core.pose import Pin, as_vector, with_changed


def movable(pins: tuple[Pin, ...], vertices: Collection[int]) -> frozenset[int]:
    """Return those of some vertices whose pins can be moved: neither locked nor hidden."""
    return frozenset(
        pin.vertex for pin in pins if pin.vertex in vertices and not pin.locked and not pin.hidden
    )


def carried(pins: tuple[Pin, ...], vertices: Collection[int], by: Floats, camera: Camera) -> tuple[Pin, ...]:
    """Return the pins with the goals of those on `vertices` moved by (3,), as seen through a camera."""
    right, up, _ = camera.axes
    axes = as_vector(right), as_vector(up)
    return with_changed(
        pins, vertices, lambda pin: replace(pin, goal=as_vector(np.array(pin.goal) + by), axes=axes)
    )


def amount(count: int) -> str:
    """Return "pin" or "5 pins", for the label of an undo step."""
    return "pin" if count == 1 else f"{count} pins"
