"""Where a drag began: what the hand holds is pulled from where it is, all else is held where it is."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from facepin.core.control import ShapeControl
from facepin.core.pose import Pin, Pose, as_vector
from facepin.core.rig import Rig
from facepin.session.solving.solving import snapped

MET = 0.1
"""A pin that lags by less than this share of its way is where the hand put it: taken again, it goes on from
where that drag began, so that going back ends there exactly."""


@dataclass(frozen=True, eq=False)
class Press:
    """The beginning of a drag in one pane."""

    pose: Pose
    """Weights at the press, and the pins all panes share with the goals that they had."""
    places: tuple[Pin, ...]
    """The same pins with goals where this pane's vertices were."""

    def pulled(self, pins: tuple[Pin, ...]) -> tuple[Pin, ...]:
        """Return the pins as this pane should solve them: moved from its places as by the hand.

        `pins` are the ones of the press, their goals moved.
        """
        return tuple(
            replace(pin, goal=as_vector(np.add(place.goal, np.subtract(pin.goal, was.goal))))
            for pin, was, place in zip(pins, self.pose.pins, self.places, strict=True)
        )


def press(rig: Rig, control: ShapeControl, pose: Pose) -> Press:
    """Begin a drag at a pose."""
    return Press(pose, snapped(rig, pose, control).pins)


@dataclass(frozen=True, eq=False)
class Begun:
    """The beginning of a drag in all panes."""

    presses: tuple[Press, ...]
    snap: Press | None
    """Makes pins that began where their vertices were of those that the tool moves, if they should."""

    def shown(self, pins: tuple[Pin, ...]) -> tuple[Pin, ...]:
        """Return the pins that the panes share from now on, for pins as the tool has moved them."""
        return pins if self.snap is None else self.snap.pulled(pins)


def begin(
    rig: Rig,
    control: ShapeControl,
    active: Pose,
    panes: Sequence[tuple[Pose, Pose | None]],
    pins: tuple[Pin, ...],
    *,
    snaps: bool,
) -> Begun:
    """Begin a drag that moves some of `pins`.

    Parameters
    ----------
    active : Pose
        Of the pane in which new pins were placed.
    panes : (pose, where its last drag began or None) of all panes
    snaps : bool
        Whether the goals that panes share go to where the active pane's vertices are.
    """
    held = grabbed(active.pins, pins)
    for pose, began in panes:
        if pose is active and began is not None and _goes_on(rig, control, began, pose, pins, held):
            return Begun(tuple(press(rig, control, one or other) for other, one in panes), None)
    was = {pin.vertex: pin.goal for pin in active.pins}
    fresh = snapped(rig, active.with_pins(tuple(pin for pin in pins if pin.vertex not in was)), control).pins
    was |= {pin.vertex: pin.goal for pin in fresh}
    origins = tuple(replace(pin, goal=was[pin.vertex]) for pin in pins)
    snap = press(rig, control, active.with_pins(origins)) if snaps else None
    begins = origins if snap is None else snap.places
    return Begun(tuple(press(rig, control, pose.with_pins(begins)) for pose, _ in panes), snap)


def _goes_on(
    rig: Rig, control: ShapeControl, began: Pose, pose: Pose, pins: tuple[Pin, ...], held: frozenset[int]
) -> bool:
    """Say whether the same pins are taken again after they got where they should."""
    same = [pin.vertex for pin in pins] == [pin.vertex for pin in began.pins]
    return same and grabbed(began.pins, pose.pins) == held and _met(rig, control, began, pose)


def grabbed(began: tuple[Pin, ...], pins: tuple[Pin, ...]) -> frozenset[int]:
    """Return the vertices of pins that the hand has moved."""
    was = {pin.vertex: pin.goal for pin in began}
    return frozenset(pin.vertex for pin in pins if pin.goal != was.get(pin.vertex))


def _met(rig: Rig, control: ShapeControl, began: Pose, pose: Pose) -> bool:
    """Say whether the pins that a drag has moved are where it put them, or nearly so."""
    held = grabbed(began.pins, pose.pins)
    was = {pin.vertex: pin for pin in began.pins}
    for pin, place in zip(pose.pins, snapped(rig, pose, control).pins, strict=True):
        if pin.vertex in held:
            missing, way = np.subtract(place.goal, pin.goal), np.subtract(pin.goal, was[pin.vertex].goal)
            if pin.freedom == "screen":
                missing = np.asarray(pin.axes) @ missing
            if np.linalg.norm(missing) > MET * np.linalg.norm(way):
                return False
    return True
