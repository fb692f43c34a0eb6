"""Pins and poses: the undoable values."""

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from facepin.core.arrays import Floats, frozen
from facepin.core.rig import Rig

Freedom = Literal["space", "screen"]
Vector = tuple[float, float, float]

FRONT_AXES: tuple[Vector, Vector] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
"""Right and up of a camera that looks the face in the eye."""


@dataclass(frozen=True)
class Pin:
    """A vertex the user holds, and where it should be.

    A `space` pin constrains all three coordinates (the paper's); a `screen` pin constrains the two that the
    mouse gave, along `axes`, and leaves depth free.
    """

    vertex: int
    goal: Vector
    freedom: Freedom = "space"
    axes: tuple[Vector, Vector] = FRONT_AXES
    """Right and up of the camera that set the goal; used by `screen` pins only."""
    stiffness: float = 1.0
    """How hard the pin pulls, > 0; its rows and displacement are scaled by the square root."""
    name: str = ""
    """What the user calls it, or the landmark it stands on."""
    locked: bool = False
    """It constrains, but is neither dragged nor removed."""
    hidden: bool = False
    """It constrains, but is neither seen nor pressed."""


@dataclass(frozen=True, eq=False)
class Pose:
    """Weights and pins.  Weights are (k,) float64, read-only."""

    weights: Floats
    pins: tuple[Pin, ...] = ()

    def with_weights(self, weights: Floats) -> "Pose":
        """Return the same pins with other weights."""
        return replace(self, weights=frozen(weights, np.float64))

    def with_pins(self, pins: tuple[Pin, ...]) -> "Pose":
        """Return the same weights with other pins."""
        return replace(self, pins=pins)


def with_changed(
    pins: tuple[Pin, ...], vertices: Collection[int], change: Callable[[Pin], Pin]
) -> tuple[Pin, ...]:
    """Return the pins with those on some vertices replaced by what `change` makes of them."""
    return tuple(change(pin) if pin.vertex in vertices else pin for pin in pins)


def hold_alike(pins: tuple[Pin, ...], others: tuple[Pin, ...]) -> bool:
    """Say whether two sets of pins constrain the same: names, locks and hiding have no part in it."""

    def bare(pin: Pin) -> Pin:
        return replace(pin, name="", locked=False, hidden=False)

    return list(map(bare, pins)) == list(map(bare, others))


def rest_pose(rig: Rig) -> Pose:
    """Return the pose a rig opens with: the file's own weights (mostly zero) and no pins."""
    return Pose(rig.rest_weights)


def as_vector(point: Floats) -> Vector:
    """Return a (3,) array as three plain floats."""
    x, y, z = (float(c) for c in point)
    return x, y, z


def pin_rows(rig: Rig, pins: tuple[Pin, ...]) -> Floats:
    """Pin rows, (r, k + c) float64: three for a space pin, two for a screen pin, times sqrt(stiffness).

    They are the paper's J on a rig without combinations; on others `Rig.slopes` makes J of them.
    """
    space = rig.rows_at([pin.vertex for pin in pins])
    return _project(space, pins)


def pin_displacement(rig: Rig, pins: tuple[Pin, ...]) -> Floats:
    """Displacement d (the paper's m), (r,) float64: goal minus neutral, scaled as `pin_rows`."""
    goals = np.array([pin.goal for pin in pins], np.float64).reshape(-1, 3)
    rest = rig.neutral[[pin.vertex for pin in pins]].astype(np.float64)
    return _project((goals - rest).reshape(-1, 1), pins)[:, 0]


def _project(space: Floats, pins: tuple[Pin, ...]) -> Floats:
    """Turn three rows per pin into the rows the pin constrains, times sqrt(stiffness)."""
    blocks = []
    for at, pin in enumerate(pins):
        block = space[3 * at : 3 * at + 3]
        if pin.freedom == "screen":
            block = np.asarray(pin.axes, np.float64) @ block
        blocks.append(block * pin.stiffness**0.5)
    return np.concatenate(blocks) if blocks else space
