"""Poses and pins across the middle of the face."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Literal

import numpy as np

from facepin.core.arrays import Floats, Points
from facepin.core.pose import Pin, Pose, Vector, as_vector
from facepin.core.shapes.mirror import Mirror

Way = Literal["left to right", "right to left"]

ONE_SIDED = 0.2
"""Balance from which on a shape belongs to one side.  Pairs such as jawLeft and jawRight, each of which moves
both sides, have less."""


def mirrored_weights(mirror: Mirror, weights: Floats, way: Way) -> Floats:
    """Return weights (k,) of a symmetric pose: one side does what the other does.

    Of pairs that move the whole face to a side, as jawLeft and jawRight, what they have in common stays.
    """
    result = np.array(weights, np.float64)
    pairs = np.flatnonzero((mirror.shapes >= 0) & (mirror.shapes != np.arange(len(weights))))
    twins = mirror.shapes[pairs]
    one, other = weights[pairs], weights[twins]
    common = np.sign(one) * np.minimum(np.abs(one), np.abs(other))
    result[pairs] = np.where(one * other > 0, common, 0.0)
    source = mirror.balance[pairs] if way == "left to right" else -mirror.balance[pairs]
    leads = (source >= ONE_SIDED) & (mirror.balance[pairs] * mirror.balance[twins] < 0)
    result[pairs[leads]] = result[twins[leads]] = weights[pairs[leads]]
    return result


def flipped_pose(mirror: Mirror, pose: Pose) -> Pose:
    """Return the pose as a mirror shows it, pins and all; a pin without a twin vertex stays where it is."""
    pins = tuple(_reflected(mirror, pin) if mirror.vertices[pin.vertex] >= 0 else pin for pin in pose.pins)
    # Two pins may have met: the one that was on the side it is on now stays.
    unique = {pin.vertex: pin for pin in pins}
    return pose.with_weights(mirror.flipped(pose.weights)).with_pins(tuple(unique.values()))


def with_twins(
    mirror: Mirror, before: tuple[Pin, ...], after: tuple[Pin, ...], positions: Points
) -> tuple[Pin, ...]:
    """Let the twins of pins that were placed or dragged do the same on their side.

    Parameters
    ----------
    mirror : Mirror
        Who is whose twin.
    before, after : tuple of Pin
        All pins as the gesture began, and as it wants them.
    positions : (n, 3) float32
        The face as the gesture began: where new twins hold it.

    Returns
    -------
    tuple of Pin
        `after`, with twins moved or added.  Where both of two twins were moved, the side of the first pin
        leads.  A pin on the middle goes to no side; a twin that is locked or hidden stays.
    """
    old = {pin.vertex: pin for pin in before}
    new = {pin.vertex: pin for pin in after}
    moved = [pin.vertex for pin in after if pin != old.get(pin.vertex)]
    side = _side(mirror, positions[moved[0]]) if moved else 0.0
    for vertex in moved:
        pin, twin = new[vertex], int(mirror.vertices[vertex])
        if twin == vertex:
            x = old[vertex].goal[0] if vertex in old else float(positions[vertex][0])
            new[vertex] = replace(pin, goal=(x, *pin.goal[1:]))
        if twin in (-1, vertex) or (twin in moved and _side(mirror, positions[vertex]) != side):
            continue
        start = np.asarray(old[vertex].goal if vertex in old else positions[vertex], np.float64)
        shift = (np.asarray(pin.goal) - start) * (-1.0, 1.0, 1.0)
        other = old.get(twin)
        if other is not None and (other.locked or other.hidden):
            continue
        rest = np.asarray(other.goal if other else positions[twin], np.float64)
        fresh = _reflected(mirror, pin) if other is None else replace(other, axes=_turned(pin.axes))
        new[twin] = replace(fresh, goal=as_vector(rest + shift))
    return tuple(new.values())


def twins_of(mirror: Mirror, vertices: Iterable[int]) -> frozenset[int]:
    """Return vertices with their twins."""
    own = frozenset(vertices)
    return own | frozenset(int(mirror.vertices[v]) for v in own if mirror.vertices[v] >= 0)


def linked_weights(mirror: Mirror, before: Floats, after: Floats) -> Floats:
    """Return weights (k,) where the twin of the only one that an edit changed takes the same value.

    An edit of several (a gain, a reset) knows what it does, and stays as it is.
    """
    changed = np.flatnonzero(before != after)
    if len(changed) != 1 or mirror.shapes[changed[0]] < 0:
        return after
    result = np.array(after, np.float64)
    result[mirror.shapes[changed]] = after[changed]
    return result


def _side(mirror: Mirror, place: Points) -> float:
    return float(np.sign(place[0] - mirror.middle))


def _reflected(mirror: Mirror, pin: Pin) -> Pin:
    goal = as_vector(mirror.across(np.array(pin.goal)))
    return replace(pin, vertex=int(mirror.vertices[pin.vertex]), goal=goal, axes=_turned(pin.axes))


def _turned(axes: tuple[Vector, Vector]) -> tuple[Vector, Vector]:
    """Return the axes of the camera in the mirror: what they constrain there is what it is here."""
    (rx, ry, rz), (ux, uy, uz) = axes
    return (-rx, ry, rz), (-ux, uy, uz)
