"""Which shapes answer a hand: those of eyes and tongue are none of the skin's business."""

from collections.abc import Collection
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats
from facepin.core.control import Flags
from facepin.core.pieces import Eyeball, eyeballs, pieces, turn_of
from facepin.core.regions import words_of
from facepin.core.rig import Rig
from facepin.core.shape_motion import shape_moves

GAZE = frozenset({"look", "looks", "gaze", "eyelook", "eyeball", "eyeballs", "pupil", "pupils"})
TONGUE = frozenset({"tongue"})
"""Words in the names of such shapes."""
MAINLY = 0.25
"""A shape is also of a point's part if it moves the point by this share of what it moves most."""
TURN, MISFIT = 0.05, 0.3
"""Least angle by which a shape turns an eyeball where names don't tell, and how much of it may be no turn."""
OWNED = 0.9
"""A loose surface is the tongue's if its shapes move it by this share of what others move it."""
LOOSE = 1.25
"""How much farther a shape has to move a loose piece than all else where names don't tell."""
APART = 0.5
"""Least share of the motion of a piece that the skin nearest to it does not share, for it to be loose."""
NEAREST = 0.1
"""Share of a piece's vertices, those nearest to the skin, that show whether it hangs on it."""
EYES = 3.0
"""What moves farther than this many radii from the eyes only is not about them, whatever it is called."""


@dataclass(frozen=True, eq=False)
class Kinds:
    """Whose shapes and whose vertices are whose."""

    gaze: Flags
    """(k,) shapes that turn the eyes."""
    tongue: Flags
    """(k,) shapes that move the tongue."""
    on_eye: Flags
    """(n,) vertices of the eyeballs."""
    on_tongue: Flags
    """(n,) vertices of the tongue."""


def gaze_shapes(rig: Rig) -> Flags:
    """Return which shapes (k,) turn the eyes: by their names, else by the eyeballs that turn with them."""
    return kinds(rig).gaze


def tongue_shapes(rig: Rig) -> Flags:
    """Return which shapes (k,) move the tongue: by their names, else by a loose piece that they move most."""
    return kinds(rig).tongue


def answering(rig: Rig, vertices: Collection[int]) -> Flags:
    """Return which shapes (k,) may follow a hand that holds some vertices.

    Shapes of gaze and tongue move lids, lips and chin along, and skin must not be got by them.  On an eyeball
    or the tongue they answer, and of the others only those that are much of that part too, as the jaw is of
    the tongue.  All shapes answer where else none would move anything.
    """
    known = kinds(rig)
    special = known.gaze | known.tongue
    everything = np.ones(rig.shape_count, np.bool_)
    if not special.any():
        return everything
    answers = np.zeros(rig.shape_count, np.bool_)
    for vertex in vertices:
        moved = np.linalg.norm(rig.rows_at([vertex])[:, : rig.shape_count], axis=0)
        own = known.gaze if known.on_eye[vertex] else known.tongue if known.on_tongue[vertex] else None
        if own is None:
            able = ~special
        else:
            able = own | (~special & (moved >= MAINLY * rig.largest_moves))
        answers |= able if moved[able].any() else moved > 0
    return answers if answers.any() else everything


@lru_cache(maxsize=2)
def kinds(rig: Rig) -> Kinds:
    """Tell gaze, tongue and skin apart; takes tenths of a second, and is remembered for the last few rigs."""
    numbers = pieces(rig)
    eyes = eyeballs(rig, numbers)
    peaks, about = _moves(rig, numbers, eyes)
    skin = int(np.argmax(np.bincount(numbers[numbers >= 0], minlength=1)))
    of_eyes: list[int] = (
        np.unique(np.concatenate([numbers[eye.vertices] for eye in eyes])).tolist() if eyes else []
    )

    gaze = _named(rig, GAZE) & about
    if not gaze.any():
        gaze = np.array([any(_turns(rig, eye, j) for eye in eyes) for j in range(rig.shape_count)], np.bool_)
    tongue = _named(rig, TONGUE)
    if not tongue.any():
        loose = [piece for piece in _loose(rig, numbers, skin) if piece not in of_eyes]
        rest = np.delete(peaks, loose, axis=0).max(axis=0, initial=0.0)
        tongue = ~gaze & (peaks[loose].max(axis=0, initial=0.0) > LOOSE * rest)
    on_eye = np.isin(numbers, [*of_eyes, *_owned(peaks, gaze, skin)])
    return Kinds(gaze, tongue, on_eye, np.isin(numbers, _owned(peaks, tongue, skin)) & ~on_eye)


def _named(rig: Rig, words: frozenset[str]) -> Flags:
    return np.array([not words.isdisjoint(words_of(name)) for name in rig.shape_names], np.bool_)


def _moves(rig: Rig, numbers: NDArray[np.intp], eyes: tuple[Eyeball, ...]) -> tuple[Floats, Flags]:
    """Measure how far each shape moves each of the p pieces, and whether it is about the eyes.

    Returns
    -------
    peaks : (p, k) float64
        Largest move of a vertex of the piece, a length.
    about : (k,) bool
        Which shapes move hardly anything but eyes and what is around them (one that is called look_angry may
        be about the whole face); all on faces without eyeballs, and shapes that move nothing.
    """
    peaks = np.zeros((numbers.max(initial=-1) + 2, rig.shape_count))  # the last row is of no piece
    about = np.ones(rig.shape_count, np.bool_)
    near = np.zeros(rig.vertex_count, np.bool_)
    for eye in eyes:
        near |= np.linalg.norm(rig.neutral - eye.centre, axis=1) <= EYES * eye.radius
    for j in range(rig.shape_count):
        moves = shape_moves(rig, j)
        moved = np.flatnonzero(moves)
        np.maximum.at(peaks[:, j], numbers[moved], moves[moved])
        if eyes:
            about[j] = (moves[near] ** 2).sum() >= 0.5 * (moves**2).sum()
    return peaks[:-1], about


def _turns(rig: Rig, eye: Eyeball, shape: int) -> bool:
    """Say whether a shape turns an eyeball around its middle."""
    rest = rig.neutral[eye.vertices].astype(np.float64)
    delta = rig.deltas[:, [shape]].toarray().reshape(-1, 3)[eye.vertices]
    if not delta.any():
        return False
    rotation, misfit = turn_of(eye, rest, rest + delta)
    return bool(np.linalg.norm(rotation) >= TURN) and misfit <= MISFIT


def _loose(rig: Rig, numbers: NDArray[np.intp], skin: int) -> list[int]:
    """Return the pieces that don't hang on the skin: their nearest vertices go other ways than it does."""
    from scipy.spatial import KDTree  # its import takes long, and rigs with names don't need it

    on_skin = np.flatnonzero(numbers == skin)
    tree = KDTree(rig.neutral[on_skin])
    found = []
    for piece in range(numbers.max(initial=-1) + 1):
        vertices = np.flatnonzero(numbers == piece)
        if piece == skin or not len(vertices):
            continue
        distances, at = map(np.asarray, tree.query(rig.neutral[vertices]))
        nearest = np.argsort(distances, kind="stable")[: max(int(NEAREST * len(vertices)), 1)]
        own, beside = rig.rows_at(vertices[nearest].tolist()), rig.rows_at(on_skin[at[nearest]].tolist())
        if ((own - beside) ** 2).sum() > APART * (own**2).sum() > 0:
            found.append(piece)
    return found


def _owned(peaks: Floats, shapes: Flags, skin: int) -> list[int]:
    """Return the pieces but the skin that some shapes move about as far as any other does, or farther."""
    own = np.where(shapes, peaks, 0.0).max(axis=1, initial=0.0)
    other = np.where(shapes, 0.0, peaks).max(axis=1, initial=0.0)
    owned = (own > 0) & (own >= OWNED * other)
    owned[skin] = False
    return np.flatnonzero(owned).tolist()
