"""Which shapes answer a hand: those of eyes and tongue are none of the skin's business."""

import re
from collections.abc import Collection
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats
from facepin.core.control import Flags
from facepin.core.mesh.pieces import Eyeball, eyeballs, pieces, turn_of
from facepin.core.rig import Rig
from facepin.core.shapes.motion import shape_moves
from facepin.core.shapes.regions import words_of

GAZE = re.compile(r"(eyes?)?(look|gaze)s?(in|out|up|down|left|right|l|r)*|eyeballs?|pupils?")
TONGUE = re.compile(r"tongue.*")
"""Words in the names of such shapes; some write all in small letters, as eyelookinleft."""
EYES_GO = {"eyes", "up", "down", "left", "right"}
"""Words of names like eyesUp, which are of the gaze without a word of it."""
MAINLY = 0.25
"""A shape is also of a point's part if it moves the point by this share of what it moves most."""
TURN, MISFIT = 0.05, 0.3
"""Least angle by which a shape turns an eyeball where names don't tell, and how much of it may be no turn."""
OWNED, ONLY = 0.9, 4.0
"""A loose surface is the tongue's if its shapes move it by this share of what others move it; the gaze has to
move it by so much more: sockets, which hang on the lids, are none of its."""
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
    of_eyes = sorted(
        {int(j) for eye in eyes for j in np.unique(numbers[eye.vertices])} - _sewn(rig, numbers, skin)
    )

    gaze = (_named(rig, GAZE) | np.array([_eyes_go(name) for name in rig.shape_names], np.bool_)) & about
    names_tell = bool(gaze.any())
    if not names_tell:
        gaze = np.array([any(_turns(rig, eye, j) for eye in eyes) for j in range(rig.shape_count)], np.bool_)
    tongue = _named(rig, TONGUE)
    if not (tongue.any() or names_tell):  # else a tongue without a name is one without shapes
        loose = [piece for piece in _loose(rig, numbers, skin) if piece not in of_eyes]
        rest = np.delete(peaks, loose, axis=0).max(axis=0, initial=0.0)
        tongue = ~gaze & (peaks[loose].max(axis=0, initial=0.0) > LOOSE * rest)
    on_eye = np.isin(numbers, [*of_eyes, *_owned(peaks, gaze, skin, ONLY)])
    return Kinds(gaze, tongue, on_eye, np.isin(numbers, _owned(peaks, tongue, skin, OWNED)) & ~on_eye)


def _named(rig: Rig, word: re.Pattern[str]) -> Flags:
    return np.array([any(map(word.fullmatch, words_of(name))) for name in rig.shape_names], np.bool_)


def _eyes_go(name: str) -> bool:
    words = words_of(name)
    return "eyes" in words and len(words) > 1 and EYES_GO.issuperset(words)


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


def _sewn(rig: Rig, numbers: NDArray[np.intp], skin: int) -> set[int]:
    """Return the pieces that share vertices with the skin, though parts of their own, as sockets are."""
    corners = numbers[rig.triangles]
    on_skin = corners == skin
    return set(np.unique(corners[on_skin.any(axis=1) & ~on_skin.all(axis=1)]).tolist())


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


def _owned(peaks: Floats, shapes: Flags, skin: int, share: float) -> list[int]:
    """Return the pieces but the skin that some shapes move by at least a share of what any other does."""
    own = np.where(shapes, peaks, 0.0).max(axis=1, initial=0.0)
    other = np.where(shapes, 0.0, peaks).max(axis=1, initial=0.0)
    owned = (own > 0) & (own >= share * other)
    owned[skin] = False
    return np.flatnonzero(owned).tolist()
