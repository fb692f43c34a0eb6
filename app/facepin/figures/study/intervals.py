"""How sure a figure is: what it would have been with other trials like these."""

from collections.abc import Callable

import numpy as np

from facepin.core.arrays import Floats

RESAMPLES = 1000
LEVEL = 0.95

Interval = tuple[float, float]
Statistic = Callable[[Floats], Floats]
"""(…, m) -> (…): of the last axis; what is not a number is not there."""


def bootstrap(trials: Floats, statistic: Statistic, seed: int = 0) -> Interval:
    """Return the 95 % interval of a statistic by drawing the trials (m, …) again and again, with repeats.

    What belongs to one trial stays together: four drags of one point say less than four points.
    """
    drawn = np.random.default_rng(seed).integers(0, len(trials), (RESAMPLES, len(trials)))
    found = statistic(trials[drawn].reshape(RESAMPLES, -1))
    low, high = quantile(found, (1 - LEVEL) / 2), quantile(found, (1 + LEVEL) / 2)
    return float(low), float(high)


def quantile(values: Floats, share: float) -> Floats:
    """Return the value below which `share` of the last axis lies, (…), between two of them in proportion.

    NaN where there are no values.
    """
    if not values.shape[-1]:
        return np.full(values.shape[:-1], np.nan)
    ordered = np.sort(values, axis=-1)  # what is not a number comes last
    place = np.maximum(share * (np.count_nonzero(~np.isnan(ordered), axis=-1) - 1), 0.0)[..., None]
    below = np.floor(place).astype(np.intp)
    low = np.take_along_axis(ordered, below, -1)
    high = np.take_along_axis(ordered, np.ceil(place).astype(np.intp), -1)
    found: Floats = (low + (place - below) * (high - low))[..., 0]
    return found


def median(values: Floats) -> Floats:
    """Return the median of the last axis."""
    return quantile(values, 0.5)


def p90(values: Floats) -> Floats:
    """Return what nine in ten of the last axis stay below."""
    return quantile(values, 0.9)


def percent_above(values: Floats, bound: float) -> Floats:
    """Return how many of the last axis are larger than a bound, in per cent; NaN where there are none."""
    there = np.count_nonzero(~np.isnan(values), axis=-1)
    above = 100.0 * np.count_nonzero(values > bound, axis=-1)
    found: Floats = np.where(there > 0, above / np.maximum(there, 1), np.nan)
    return found
