"""How the poses of a library stand: found, ordered, moved; and what undo brings back of that.

The contents of a library are files, which undo leaves alone: going back in the work must never take a saved
pose from the disk.  What was done to poses that were there already (renamed, moved, replaced, removed) is
undoable: the work holds it as a shelf, changes by key since the library was opened.  A pose that was saved
later than the step that undo leads to is not mentioned there, and stays.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.saved_pose import SavedPose
from facepin.core.sorting import SortKey, natural_key

Shelf = Mapping[str, SavedPose | None]
"""Poses by key as they are since they were changed; None for one that was removed."""

LISTED = 0.005
"""Weights that differ by less are the same in a list of differences."""


def standing(stored: Mapping[str, SavedPose], shelf: Shelf) -> tuple[SavedPose, ...]:
    """Return the poses of a library in their order: `stored` as first seen, with the changes of a shelf."""
    poses = [pose for pose in {**stored, **shelf}.values() if pose is not None]
    return tuple(sorted(poses, key=_place))


def next_order(poses: Iterable[SavedPose]) -> float:
    """Return the order of a pose that comes after all that have one."""
    return max((pose.order for pose in poses if pose.order is not None), default=0.0) + 1.0


def moved(poses: Sequence[SavedPose], key: str, before: str | None) -> dict[str, SavedPose]:
    """Return the poses that change when one is put before another, or last for None.

    As few as possible, since each is a file: mostly the moved one alone, more where no number lies between.
    """
    if before == key:
        return {}
    (pose,) = (pose for pose in poses if pose.key == key)
    others = [other for other in poses if other is not pose]
    at = next((at for at, other in enumerate(others) if other.key == before), len(others))
    whole = [*others[:at], pose, *others[at:]]
    if whole == list(poses):
        return {}
    left = others[at - 1].order if at > 0 else -np.inf
    right = others[at].order if at < len(others) else None
    if left is not None:  # else it would stand before others without an order
        order = _between(left, np.inf if right is None else right)
        if left < order and (right is None or order < right):
            return {key: replace(pose, order=order)}
    # Those after it that have no order stay last without one.
    last = max(at for at, each in enumerate(whole) if each is pose or each.order is not None)
    return {
        each.key: replace(each, order=float(number))
        for number, each in enumerate(whole[: last + 1], 1)
        if each.order != number
    }


def found(poses: Sequence[SavedPose], search: str) -> tuple[SavedPose, ...]:
    """Return the poses whose name or tags hold every word of a search."""
    words = search.lower().split()
    if not words:
        return tuple(poses)
    return tuple(
        pose for pose in poses if all(word in " ".join((pose.title, *pose.tags)).lower() for word in words)
    )


def blended(start: Floats, goal: Floats, amount: float) -> Floats:
    """Return weights (k,) on the way from one pose (amount 0) to another (1); both ends exactly."""
    mixed: Floats = (1 - amount) * start + amount * goal
    return mixed


def differences(first: Floats, second: Floats) -> tuple[int, ...]:
    """Return the shapes in which two poses differ, biggest difference first."""
    gaps = np.abs(second - first)
    order = np.argsort(-gaps, kind="stable")
    return tuple(order[gaps[order] > LISTED].tolist())


def _place(pose: SavedPose) -> tuple[bool, float, SortKey, str]:
    return (pose.order is None, pose.order or 0.0, natural_key(pose.title), pose.key)


def _between(left: float, right: float) -> float:
    """Return a number between two of which one may be infinite; not quite, where there is none."""
    if np.isinf(left):
        return 0.0 if np.isinf(right) else right - 1.0
    return left + 1.0 if np.isinf(right) else 0.5 * (left + right)
