"""The fewest shapes that bring places where they should be, within a tolerance."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from facepin.solvers.boxed import Price, prepare_boxed
from facepin.solvers.interface import Floats, PinSystem

RIDGE = 1e-4
"""Pull towards the start, in units of the scale: keeps what the places hardly show from growing."""
PRICES = tuple(0.01 * 2.0**step for step in range(7))
"""Prices of motion that choices are begun from, as in `sparse`."""
MOST_TRIED = 24
"""Shapes a choice may begin with; those of lower prices are left to trembling hands."""
WORTH = 3.0
"""A shape stays if without it the squared misses grow by more than tolerance² over this."""


@dataclass(frozen=True, eq=False)
class Places:
    """What should be where."""

    rows: Floats
    """(r, k) how the shapes move them."""
    starts: NDArray[np.intp]
    """(p,) first row of each place, ascending."""
    wanted: Floats
    """(r,) what the rows times the weights should be."""
    limits: Floats
    """(k, 2) lowest and highest weight."""
    sizes: Floats
    """(k,) largest vertex move of each shape."""
    scale: float
    """Mean squared size."""

    def misses(self, weights: Floats) -> Floats:
        """Return how far each place is from where it should be, (p,) lengths."""
        missing = self.rows @ weights - self.wanted
        misses: Floats = np.sqrt(np.add.reduceat(missing * missing, self.starts))
        return misses


def fewest(places: Places, start: Floats, tolerance: float) -> Floats:
    """Find weights (k,) of few shapes that bring every place within a tolerance.

    A choice begins with the shapes that `sparse` uses at some price; once chosen, these are free of it.  Then
    one after the other is left out, the least missed first, as long as every place stays within the tolerance
    and what is missed does not grow as if the shape were meant.  Of the choices that come of all
    prices the one is taken that has the best of both, few shapes and small misses.  Nothing promises that no
    smaller choice exists: to find that out would take too long.

    Parameters
    ----------
    places
        At least one.
    start : (k,) float64
        Weights of shapes that are not used.
    tolerance : float
        A length > 0.  Where all shapes together miss by more, a place may stay as far away as they leave it.
    """
    fit = _Fit(places, start)
    everything = np.flatnonzero(places.rows.any(axis=0))
    allowed = np.maximum(tolerance, 1.05 * places.misses(fit.weights(everything)))
    worth = tolerance**2 / WORTH
    best, lowest = fit.weights(everything), np.inf
    for price in PRICES:
        chosen = np.flatnonzero(fit.sparse(price) != start)
        if len(chosen) > MOST_TRIED and price != PRICES[-1]:
            continue
        weights = fit.weights(chosen)
        while len(chosen):
            trials = [np.delete(chosen, at) for at in range(len(chosen))]
            fits = [fit.weights(trial) for trial in trials]
            misses = [places.misses(each) for each in fits]
            squares = [float(each @ each) if (each <= allowed).all() else np.inf for each in misses]
            at = int(np.argmin(squares))
            now = places.misses(weights)
            if squares[at] - float(now @ now) > worth:
                break
            chosen, weights = trials[at], fits[at]
        misses_now = places.misses(weights)
        score = float(misses_now @ misses_now) / worth + len(chosen)
        if (misses_now <= allowed).all() and score < lowest:
            best, lowest = weights, score
    return best


class _Fit:
    """Least squares with some of the shapes."""

    def __init__(self, places: Places, start: Floats) -> None:
        self._places, self._start = places, start
        self._rows, self._wanted = places.rows, places.wanted
        if len(places.rows) > places.rows.shape[1] + 1:  # as many rows as shapes tell as much as all of them
            both = np.asarray(np.linalg.qr(np.column_stack([places.rows, places.wanted]), mode="r"))
            self._rows, self._wanted = both[:, :-1], both[:, -1]

    def weights(self, chosen: NDArray[np.intp]) -> Floats:
        """Return weights (k,) that bring the places nearest with the chosen shapes alone."""
        weights, places = self._start.copy(), self._places
        if len(chosen):
            others = weights.copy()
            others[chosen] = 0.0
            free = np.zeros(len(chosen))
            system = PinSystem(self._rows[:, chosen], places.limits[chosen], places.scale)
            minimise = prepare_boxed(system, RIDGE * places.scale)
            left = self._wanted - self._rows @ others
            weights[chosen] = minimise(left, weights[chosen], Price(free, free, free)).weights
        return weights

    def sparse(self, price: float) -> Floats:
        """Return weights (k,) at a price of motion."""
        places, unit = self._places, self._places.scale**0.5
        prices = price * unit * np.maximum(places.sizes, unit / 3)
        minimise = prepare_boxed(PinSystem(self._rows, places.limits, places.scale), 1e-6 * places.scale)
        return minimise(self._wanted, self._start, Price(self._start, prices, prices)).weights
