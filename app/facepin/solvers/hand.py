"""What the hand means: the point in it follows the mouse, and the rest stays."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from facepin.solvers.forces import Balance, Pulls, Springs, balance
from facepin.solvers.interface import Floats, Grasp, PinSystem, Solution, Solve, SolverKind, setting

SLACK = 1.5e-3
"""δ: within this share of the face height from its goal a pin pulls less and less."""
FAR_SLACK = 5e-4
"""The same for what should not go along."""
REST = 1.0
"""Force of what should not go along."""
HELD = 0.5
"""Force of a pin that is held, next to one in the hand."""
RIDGE = 0.05
"""Spring of every shape: the share of its price's unit that a whole weight adds to the price."""
LEAST = 1 / 3
"""A shape is priced as if it moved the face by at least this share of what shapes usually do."""
BACK = 0.3
"""Price of what a shape pulls against the hand, as a share of it."""
RETURN = 0.3
"""Share of its price at which a shape that is in use goes back."""
OPPOSED, FULLY_USED, OPPOSITION = -0.3, 0.1, 3.0
"""A shape costs up to `OPPOSITION` times more while one with a likeness below `OPPOSED` is in use, fully so
from a weight of `FULLY_USED` on."""
OUTDONE = 1.5
"""How much more a shape costs, next to its price, that another one works against which suits the pull better:
more would make weights jump where the mouse turns."""
ALLOWED = 0.015
"""Far motion that is not minded, as a share of the face height: where all that moves a point moves what is
far still more, the point is stiff, but not dead."""
NEARLY = 2e-4
"""How much more far motion than agreed is taken for none, as a share of the face height."""
MOST_CUTS = 24
TIE = 1e4
"""Force that keeps a tied weight below the other, per unit of weight in units of the rig's scale."""
TIE_SLACK = 1e-2
"""Weight within which that force fades; ten thousand times less is what it takes of it."""
FREE = 3.0
"""The rest of the face may go along as it likes from this setting on."""


@dataclass(frozen=True)
class HandSettings:
    """What the hand is given, and what it may cost."""

    price: float = setting(
        0.09,
        "How well a shape must suit the pull to be used, next to the one that suits it best: more uses fewer "
        "shapes, less follows closer.",
        low=0.0,
        high=1.0,
        ends=("follow closely", "few shapes"),
    )
    along: float = setting(
        0.5,
        "How far the rest of the face may go along, as a share of the way of the pin: less leaves it alone, "
        "more lets the pin follow closer; 3 lets all go along.",
        low=0.0,
        high=FREE,
        ends=("leave the rest alone", "let it go along"),
    )


def prepare(system: PinSystem, settings: HandSettings) -> Solve:
    """w = w0 + x, x = argmin Σ κ ρ(m - J x) + Σ max(c⁺ x, -c⁻ x) + ½ Σ q x², far motion ≤ θ × the pin's.

    θ is the setting `along`.  m is the way of the mouse since the press, 0 for pins that are held.  ρ is a
    distance and not its square: the hand pulls with force 1 however far it is away.  So a shape enters by how
    well it suits the pull and not by the length of the drag; the pin arrives wherever shapes that suit it can
    carry it; and where none can, it goes slack and pulling further changes nothing.

    With s the largest move of a shape and J its row in the hand, `price` is paid per unit of s in relation
    to the best |J| / s there is: no point of the face is too dear to be moved.  The spring q makes the answer
    unique and keeps weights from jumping where the mouse turns.  What pulls against the hand costs more, so
    does what undoes a shape in use; going back costs less.  The pull is cut where shapes that suit it end:
    beyond, only its direction would still change something.

    Far motion is the largest of any place far away (`Grasp.far`), and may exceed its share by 1.5 % of the
    face height.  The places that come to their bound are found one after the other, each as a further row
    that pulls back, one-sided.

    Notes: `steps` of the search for the forces; `gap`, how much is left to gain; `held_back`, the force (0 to
    1) that keeps the pin from moving what is far.
    """
    return _Hand(system, settings).solve


class _Hand:
    """The rows of one drag, the prices at its press, and the forces of the last frame to begin with."""

    def __init__(self, system: PinSystem, settings: HandSettings) -> None:
        count = len(system.rows)
        grasp = system.grasp or _each_row(system)
        self._system, self._settings, self._grasp = system, settings, grasp
        sizes = np.diff(np.append(grasp.starts, count))
        pin = np.repeat(np.arange(len(sizes)), sizes)
        # Rows come times the root of the stiffness; here that is a force.
        self._unscale = 1.0 / np.sqrt(grasp.stiffness)[pin]
        answers = np.ones(system.rows.shape[1], np.bool_) if grasp.answers is None else grasp.answers
        self._answers = answers
        self._rows = np.ascontiguousarray(system.rows * self._unscale[:, None])
        self._pin, self._in_hand = pin, grasp.grabbed[pin]
        self._strengths = grasp.stiffness * np.where(grasp.grabbed, 1.0, HELD)
        self._rest = _Rest(grasp, settings.along)
        self._ties = _tie_rows(system)
        self._start: Floats | None = None
        self._springs: Springs
        self._forces = np.zeros(count) if system.forces is None else system.forces

    def solve(self, displacement: Floats, start: Floats) -> Solution:
        """Return the weights for one frame."""
        if self._start is None or not np.array_equal(start, self._start):
            self._start, self._springs = start, self._priced(start)
        wanted = (displacement - self._system.rows @ start) * self._unscale
        pull = self._pull(wanted)
        allowed = self._rest.allowed(wanted, self._in_hand)
        springs, share = self._directed(pull, wanted)
        wanted = np.where(self._in_hand, share * wanted, wanted)
        found, held_back, steps = self._balanced(wanted, springs, pull, start, allowed)
        self._forces = found.forces[: len(wanted)]
        weights = start + found.change
        for _ in self._system.ties:  # to the last digit, also where what is tied ties another
            for tied, other in self._system.ties:
                weights[tied] = min(weights[tied], max(weights[other], start[tied]))
        notes = {"steps": float(steps), "gap": found.gap, "held_back": held_back}
        return Solution(weights, notes, self._forces)

    def _priced(self, start: Floats) -> Springs:
        """Return what it costs to change each weight from `start` (k,), whatever the pull's direction."""
        system, grasp = self._system, self._grasp
        unit = system.scale**0.5
        sizes = np.full(len(start), unit) if system.sizes is None else system.sizes
        sizes = sizes + LEAST * unit
        hand = self._rows[self._in_hand] * self._answers
        suits = np.sqrt(np.einsum("ij,ij->j", hand, hand)) / sizes if unit > 0 else np.zeros(len(start))
        price = self._settings.price * suits.max(initial=0.0) * sizes
        used = start > 0.02
        opposed = (grasp.likeness < OPPOSED) & used[:, None]
        opposition = np.where(opposed, np.minimum(1.0, start / FULLY_USED)[:, None], 0.0).max(
            axis=0, initial=0.0
        )
        low, high = system.limits.T
        moves = self._answers & self._rows.any(axis=0)
        return Springs(
            raising=price * (1.0 + OPPOSITION * opposition) * np.where(start < 0, RETURN, 1.0),
            lowering=price * np.where(start > 0, RETURN, 1.0),
            stiffness=RIDGE * sizes**2 / unit if unit > 0 else np.ones(len(start)),
            low=np.where(moves, np.minimum(low - start, 0.0), 0.0),
            high=np.where(moves, np.maximum(high - start, 0.0), 0.0),
        )

    def _pull(self, wanted: Floats) -> Floats:
        """Return the full forces of the pins in the hand, (r,), as long as they are strong; else 0."""
        lengths = np.sqrt(np.bincount(self._pin, wanted**2, len(self._strengths)))[self._pin]
        full = np.divide(wanted, lengths, out=np.zeros_like(wanted), where=lengths > 0)
        return np.where(self._in_hand, full * self._strengths[self._pin], 0.0)

    def _directed(self, pull: Floats, wanted: Floats) -> tuple[Springs, float]:
        """Return the springs for one direction of the pull, and the share of it that shapes can reach."""
        springs, work = self._springs, pull @ self._rows
        raising = springs.raising * (1.0 + OUTDONE * self._outdone(work, springs.raising))
        springs = Springs(
            raising + BACK * np.maximum(-work, 0.0),
            springs.lowering + BACK * np.maximum(work, 0.0),
            springs.stiffness,
            springs.low,
            springs.high,
        )
        change, _ = springs.answer(work)
        asked, reached = float(pull @ wanted), float(work @ change)
        return springs, min(1.0, reached / asked) if asked > 0 else 1.0

    def _outdone(self, work: Floats, price: Floats) -> Floats:
        """Return how much better (0 to 1) one that works against it suits the pull, for each shape (k,).

        Else two that nearly cancel out would share a pull that is a little beside either.
        """
        suits = np.divide(work, price, out=np.zeros_like(work), where=price > 0)
        suits = np.maximum(suits, 0.0)
        used = np.flatnonzero(suits > 1.0)
        against = self._grasp.likeness[used] < OPPOSED
        better = (
            np.clip(1.0 - suits / suits[used, None], 0.0, 1.0) * np.minimum(suits[used] - 1.0, 1.0)[:, None]
        )
        outdone: Floats = np.where(against, better, 0.0).max(axis=0, initial=0.0)
        return outdone

    def _balanced(
        self, wanted: Floats, springs: Springs, pull: Floats, start: Floats, allowed: float
    ) -> tuple[Balance, float, int]:
        """Find the balance, with what should not go along pulling back where it would."""
        count, slack = len(wanted), SLACK * self._grasp.height
        rest, ties = self._rest, self._ties
        share = rest.share(pull, self._rows)
        rows = np.concatenate([self._rows, ties.rows])
        goals = np.concatenate([wanted, ties.room(start)])
        forces = np.concatenate([self._forces, np.zeros(len(ties.rows))])
        fixed = len(goals)
        steps = 0
        for cut in range(MOST_CUTS + 1):
            cuts = len(goals) - fixed
            pulls = Pulls(
                rows,
                np.concatenate([self._grasp.starts, np.arange(count, len(goals))]),
                np.concatenate([self._strengths, ties.strengths, np.full(cuts, REST)]),
                np.concatenate(
                    [np.full(len(self._strengths), slack), ties.slacks, np.full(cuts, rest.slack)]
                ),
                np.arange(len(self._strengths) + len(goals) - count) >= len(self._strengths),
            )
            found = balance(pulls, springs, goals, forces)
            steps += found.steps
            row = rest.broken(found.change, share, allowed) if cut < MOST_CUTS else None
            if row is None:
                break
            # Rows that no longer pull are dropped; more of them come back if they are needed.
            kept = np.concatenate([np.ones(fixed, np.bool_), found.forces[fixed:] > 0.0])
            if not row.any() or np.any(np.all(np.abs(rows[fixed:] - row) < 1e-9 * rest.slack, axis=1)):
                break
            rows = np.concatenate([rows[kept], row[None]])
            goals = np.append(goals[kept], -allowed)
            forces = np.append(found.forces[kept], 0.0)
        back = float(found.forces[fixed:].sum())
        return found, min(1.0, back), steps


class _Rest:
    """What should not go along with the hand."""

    def __init__(self, grasp: Grasp, along: float) -> None:
        self._places = grasp.far if along < FREE else grasp.far[:0]
        self._along, self._hands = along, max(1, int(np.count_nonzero(grasp.grabbed)))
        self._flat = self._places.reshape(3 * len(self._places), grasp.far.shape[2])
        self._height = grasp.height
        self.slack = FAR_SLACK * grasp.height

    def share(self, pull: Floats, rows: Floats) -> Floats:
        """Return how much further the rest may go per weight (k,): its share of what the pins gain."""
        share: Floats = self._along / self._hands * (pull @ rows)
        return share

    def allowed(self, wanted: Floats, in_hand: NDArray[np.bool_]) -> float:
        """Return the far motion that is not minded, for a pull (r,): nearly none for a nudge."""
        way = float(np.linalg.norm(wanted[in_hand])) / self._hands**0.5
        share: float = min(1.0, way / (2 * ALLOWED * self._height))
        return ALLOWED * float(self._height) * share * share

    def broken(self, change: Floats, share: Floats, allowed: float) -> Floats | None:
        """Return the row (k,) that pulls back the place that goes furthest too far, if one does."""
        if not len(self._places):
            return None
        moves = (self._flat @ change).reshape(-1, 3)
        lengths = np.sqrt(np.einsum("ij,ij->i", moves, moves))
        worst = int(np.argmax(lengths))
        excess = lengths[worst] - max(float(share @ change), 0.0) - allowed
        if excess <= NEARLY * self._height:
            return None
        row: Floats = share - (moves[worst] / lengths[worst]) @ self._places[worst]
        return row


@dataclass(frozen=True, eq=False)
class _Ties:
    """Rows that keep tied weights below others."""

    rows: Floats
    strengths: Floats
    slacks: Floats
    tied: NDArray[np.intp]
    other: NDArray[np.intp]

    def room(self, start: Floats) -> Floats:
        """Return b (t,): how far a tied weight may come nearer to the other, negative."""
        return -np.maximum(start[self.other] - start[self.tied], 0.0)


def _tie_rows(system: PinSystem) -> _Ties:
    """Return w_other - w_tied as one-sided rows, in lengths of the rig's unit."""
    count, (tied, other) = len(system.ties), np.array(system.ties, np.intp).reshape(-1, 2).T
    rows = np.zeros((count, system.rows.shape[1]))
    rows[np.arange(count), other] += 1.0
    rows[np.arange(count), tied] -= 1.0
    unit = system.scale**0.5 or 1.0
    return _Ties(rows, np.full(count, TIE * unit), np.full(count, TIE_SLACK), tied, other)


def _each_row(system: PinSystem) -> Grasp:
    """Return the grasp of a hand that holds every row on its own, with nothing far away."""
    count, shapes = system.rows.shape
    height = 25.0 * system.scale**0.5 or 1.0
    return Grasp(
        np.arange(count),
        np.ones(count, np.bool_),
        np.ones(count),
        height,
        np.zeros((0, 3, shapes)),
        np.eye(shapes),
    )


KIND = SolverKind(
    key="hand",
    title="Follow the mouse (hand)",
    summary="The point in the hand follows the mouse, the rest of the face stays, and few shapes are used.",
    settings=HandSettings,
    prepare=prepare,
    obeys_limits=True,
    grasps=True,
)
