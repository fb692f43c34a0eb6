"""What every solver takes and returns.  Arrays in, arrays out: no rig, no mesh, no window."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Grasp:
    """What the hand holds, and what it should leave alone: for solvers that are relative to the press."""

    starts: NDArray[np.intp]
    """(p,) first row of each pin, ascending."""
    grabbed: NDArray[np.bool_]
    """(p,) pins in the hand; the others hold what is where it is."""
    stiffness: Floats
    """(p,) how hard each pin pulls; its rows are scaled by the square root."""
    height: float
    """Face height, the length that all lengths of a hand are shares of."""
    far: Floats
    """(s, 3, k) slopes of places that are far from all pins in the hand: these should not go along."""
    likeness: Floats
    """(k, k) cosines between the motions of shapes: negative where one undoes what the other does."""
    answers: NDArray[np.bool_] | None = None
    """(k,) shapes that may follow the pins in the hand; None for all."""


@dataclass(frozen=True, eq=False)
class PinSystem:
    """The part of the problem that stays the same during a drag.  All entries are finite."""

    rows: Floats
    """Pin rows J, (r, k); both may be 0."""
    limits: Floats
    """(k, 2) lowest and highest weight of each shape."""
    scale: float = 1.0
    """Mean over shapes of the squared largest vertex move of the rig: the unit of relative strengths."""
    sizes: Floats | None = None
    """(k,) largest vertex move of each shape, anywhere on the rig; None: all alike, the root of `scale`."""
    locality: Floats | None = None
    """(k,) share of each shape that happens near the pins, 0..1, for solvers with a setting `radius` > 0."""
    ties: tuple[tuple[int, int], ...] = ()
    """Pairs (a, b) of shapes: the weight of a may be at most that of b.  For solvers that obey limits."""
    guess: Floats | None = None
    """(k,) weights that an answer is likely to be near to, for solvers that search; None: the start."""
    forces: Floats | None = None
    """(r,) forces on the rows that an answer is likely to have, for solvers that search for them."""
    grasp: Grasp | None = None
    """What the hand holds, for solvers that ask for it; None: every row is a pin in the hand."""


@dataclass(frozen=True, eq=False)
class Solution:
    """Weights, and what the solver can say about how it found them."""

    weights: Floats
    """(k,)"""
    notes: Mapping[str, float] = field(default_factory=dict)
    """Figures worth showing, by name: gamma, step, iterations, optimality."""
    forces: Floats | None = None
    """(r,) forces on the rows, of solvers that search for them."""


Solve = Callable[[Floats, Floats], Solution]
"""(displacement d (r,), start w0 (k,)) -> Solution.  Called once per drag frame."""


@dataclass(frozen=True)
class SolverKind:
    """One entry of the registry."""

    key: str
    title: str
    summary: str
    """One sentence for the animator."""
    settings: type
    """A frozen dataclass whose fields are made with `setting`."""
    prepare: Callable[[PinSystem, Any], Solve]
    """Does the work that needs J only (a factorisation), so that a drag frame does the rest."""
    obeys_limits: bool = False
    afresh: bool = False
    """Solves all pins afresh on every drag: its start is the last pose that no drag made (the neutral,
    sliders, a loaded pose), not the weights at the press.  A new pin starts where its vertex is, which leaves
    the answer as it was: nothing jumps at a press, and the order of the drags leaves no trace."""
    grasps: bool = False
    """Is told which pins are in the hand and what lies far from them (`PinSystem.grasp`)."""


def setting(
    default: Any,
    help: str,
    *,
    low: float | None = None,
    high: float | None = None,
    log: bool = False,
    choices: tuple[str, ...] = (),
    when: tuple[str, Any] | None = None,
    ends: tuple[str, str] | None = None,
) -> Any:
    """Declare one field of a settings class, with what a panel or a command line needs to offer it.

    Parameters
    ----------
    default : float, int, bool or str
        Its type is the setting's type.
    help : str
        One sentence saying what it does to the face.
    low, high : float
        Allowed range of a number, both included.
    log : bool
        The range is best shown on a logarithmic scale.
    choices : tuple of str
        Allowed words.
    when : (str, value)
        The setting has an effect only while another one has this value, e.g. ``("automatic", False)``.
    ends : (str, str)
        What the lowest and the highest number lead to, in words: a panel offers the setting between them, and
        those without as details.
    """
    metadata = {"help": help, "low": low, "high": high, "log": log, "choices": choices, "when": when}
    metadata["ends"] = ends
    return field(default=default, metadata=metadata)
