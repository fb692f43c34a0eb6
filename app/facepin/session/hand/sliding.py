"""What hands on sliders do to the weights: everything that is not a solver's."""

from collections.abc import Mapping

from facepin.core.arrays import Floats, Indices
from facepin.core.control import ShapeControl


def slid(weights: Floats, values: Mapping[int, float]) -> Floats:
    """Return weights (k,) after some sliders were put to new values.

    Every edit of single sliders comes through here: dragged, typed, turned or reset.
    """
    changed = weights.copy()
    for shape, value in values.items():
        changed[shape] = value
    return changed


def within(control: ShapeControl, weights: Floats, shape: int, value: float) -> float:
    """Return the value that a slider stops at on its way from weights (k,) to `value`.

    These are its limits and ties; where the weight was beyond them, it can go back but not further out.
    """
    low, high = (float(limit) for limit in control.limits_at(weights)[shape])
    start = float(weights[shape])
    return min(max(value, min(low, start)), max(high, start))


def gained(control: ShapeControl, weights: Floats, gain: float) -> Floats:
    """Return weights (k,) times `gain`, within their limits; locked ones stay."""
    return control.keeping_locked(control.clipped(weights * gain, weights), weights)


def reset(control: ShapeControl, weights: Floats, shapes: Indices | slice = slice(None)) -> Floats:
    """Return weights (k,) with those of `shapes` at zero; locked ones stay."""
    changed = weights.copy()
    changed[shapes] = 0.0
    return control.keeping_locked(changed, weights)
