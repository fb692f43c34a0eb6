"""What places of a face are called: "upper lip, left".

Parts are known by their names, lids and lips by the shapes that are named after them, and everything
between by where it lies in the frame of eyes and mouth.  Where names say nothing, a place is called after its
part.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats
from facepin.core.mesh.topology import connected
from facepin.core.pose import Pin
from facepin.core.rig import Rig
from facepin.core.shapes.motion import shape_moves
from facepin.core.shapes.regions import SIDES, named_region, words_of
from facepin.core.shapes.symmetry import middle_of

Flags = NDArray[np.bool_]

_PARTS: dict[str, str] = {
    "eye": "eye eyes eyeball eyeballs cornea iris pupil sclera",
    "lashes": "lash lashes eyelash eyelashes",
    "brow": "brow brows eyebrow eyebrows",
    "teeth": "teeth tooth gums gum denture",
    "tongue": "tongue",
    "ear": "ear ears",
    "hair": "hair scalp beard",
    "skin": "skin face head body default mesh",
}
_PART_OF = {word: part for part, words in _PARTS.items() for word in words.split()}
PLAIN = {"eye": "eyeball", "brow": "brow", "teeth": "teeth", "tongue": "tongue", "ear": "ear", "hair": "hair"}
"""Parts all of which have one name."""

MIDDLE = 0.012
"""Distance from the middle, as a share of the height, within which a place has no side."""
UNMOVED = 1e-4
"""Move along an axis at weight 1, as a share of the height, that counts as none."""

# Shares of how far a shape moves the face at most.
LID, SQUINT, LIP, BROW, LASHES, SUNK = 0.18, 0.3, 0.3, 0.45, 0.05, 0.12
# Lengths in the frame of the face, whose unit is the way from the mouth up to the eyes.
LIP_REACH, CORNER, NOSE_OUT, CHIN_OUT, TOOTH = 0.24, 0.11, 0.33, 0.35, 0.35
LOWEST, JAW_RISE = 0.95, 0.4
"""Where the neck begins below the chin, and how that rises towards the corner of the jaw."""
BENEATH = -0.6
"""Below this, what the jaw does not move is the neck too."""
FACE_DEPTH, HEAD_DEPTH = 0.6, 1.5
"""How far behind the eyes the front of the face reaches, and its sides."""


@dataclass(frozen=True, eq=False)
class Places:
    """The names of all places of a rig; made once, then asked by vertex."""

    names: tuple[str, ...]
    """Each region once."""
    regions: NDArray[np.int16]
    """(n,) which of `names` each vertex belongs to."""
    sides: NDArray[np.int8]
    """(n,) 1 on the character's left, −1 on its right, 0 in the middle."""
    moved: Flags
    """(n,) whether any shape moves it."""

    def region(self, vertex: int) -> str:
        """Return the region of a vertex: "upper lip"."""
        return self.names[int(self.regions[vertex])]

    def title(self, vertex: int) -> str:
        """Return region and side of a vertex: "upper lip, left"."""
        side = self.sides[vertex]
        return self.region(vertex) + (", left" if side > 0 else ", right" if side < 0 else "")

    def unmoved(self, vertex: int) -> str:
        """Return what to say of a vertex that no shape moves; nothing where one does."""
        if self.moved[vertex]:
            return ""
        region = self.region(vertex)
        if self.moved[self.regions == self.regions[vertex]].any():
            return f"No shape moves this part of the {region}"
        return f"No shape moves the {region}"


def titles(places: Places, pins: Sequence[Pin]) -> dict[int, str]:
    """Return what pins are called, by vertex: their names, else their places, numbered where one repeats."""
    plain = [pin.name or places.title(pin.vertex) for pin in pins]
    uses = Counter(plain)
    taken = {pin.name for pin in pins if pin.name}
    numbers: Counter[str] = Counter()
    found = {}
    for pin, title in zip(pins, plain, strict=True):
        if not pin.name and (uses[title] > 1 or title in taken):
            place = title
            while title == place or title in taken:
                numbers[place] += 1
                title = f"{place} {numbers[place]}"
        found[pin.vertex] = title
    return found


def find_places(rig: Rig) -> Places:
    """Name all places of a rig; some hundredths of a second."""
    x = rig.neutral[:, 0].astype(np.float64) - middle_of(rig)
    sides = np.where(np.abs(x) < MIDDLE * rig.height, 0, np.sign(x)).astype(np.int8)
    moves = _Moves(rig)
    of_part, parts = _parts(rig)
    names = np.array([PLAIN.get(part, part) for part in parts], dtype=object)[of_part]
    frame = _frame(rig, moves, x)
    if frame is not None:
        skin = np.isin(of_part, [at for at, part in enumerate(parts) if part == "skin"])
        lashes = np.isin(of_part, [at for at, part in enumerate(parts) if part == "lashes"])
        names[skin] = _skin(rig, moves, frame, skin)[skin]
        names[lashes] = np.where(_sunk(moves)[lashes], "upper lid", "lower lid")
        _islands(rig, moves, frame, names, skin)
    found, regions = np.unique(names.astype(str), return_inverse=True)
    return Places(tuple(found.tolist()), regions.astype(np.int16), sides, _moved(rig))


def _moved(rig: Rig) -> Flags:
    """Return which vertices (n,) any shape moves, or two together."""
    moved = np.zeros(rig.vertex_count, np.bool_)
    moved[rig.deltas.indices[np.abs(rig.deltas.data) > UNMOVED * rig.height] // 3] = True
    return moved


class _Moves:
    """How far the shapes of a kind move each vertex."""

    def __init__(self, rig: Rig) -> None:
        self._rig = rig
        self._words = [words_of(name) for name in rig.shape_names]
        self._regions = [named_region(name) for name in rig.shape_names]
        self._shares: dict[int, Floats] = {}

    def of(self, region: str, *words: str) -> Floats | None:
        """Return the largest share (n,) of its own reach by which a shape of a region moves each vertex.

        Only shapes count whose names have one of the words; None where there are none.
        """
        shares = [self._share(j) for j in self._named(region, *words)]
        return np.max(shares, axis=0) if shares else None

    def _share(self, shape: int) -> Floats:
        if shape not in self._shares:
            self._shares[shape] = shape_moves(self._rig, shape) / self._rig.largest_moves[shape]
        return self._shares[shape]

    def _named(self, region: str, *words: str) -> list[int]:
        """Return the shapes of a region whose names have one of the words."""
        return [
            j
            for j, (found, own) in enumerate(zip(self._regions, self._words, strict=True))
            if found == region
            and (not words or not set(words).isdisjoint(own))
            and self._rig.largest_moves[j] > 0
        ]

    def rise(self, region: str, *words: str) -> Floats:
        """Return how far the shapes of a region whose names have one of the words raise each vertex, (n,)."""
        rise = np.zeros(self._rig.vertex_count)
        for j in self._named(region, *words):
            run = slice(self._rig.deltas.indptr[j], self._rig.deltas.indptr[j + 1])
            rows, values = self._rig.deltas.indices[run], self._rig.deltas.data[run]
            up = rows % 3 == 1
            rise[rows[up] // 3] += values[up]
        return rise


@dataclass(frozen=True, eq=False)
class _Frame:
    """The frame of eyes and mouth: the mouth is at height 0, the eyes are at height 1."""

    x: Floats
    """(n,) distance from the middle."""
    y: Floats
    """(n,) height over the mouth."""
    z: Floats
    """(n,) how far before the lips."""
    eye: tuple[float, float]
    """Place of an eye: distance from the middle, how far before the lips."""
    corner: tuple[float, float]
    """Place of a corner of the mouth: distance from the middle, height."""


def _frame(rig: Rig, moves: _Moves, x: Floats) -> _Frame | None:
    """Find eyes and mouth by the shapes that are named after them; None where there are none."""
    eyes = moves.of("eyes", "blink", "close", "lid", "eyelid")
    mouth = moves.of("mouth", "roll", "press", "pucker", "funnel", "upper", "lower", "lip", "lips")
    if eyes is None or mouth is None:
        return None
    y, z = rig.neutral[:, 1].astype(np.float64), rig.neutral[:, 2].astype(np.float64)
    at_eyes, at_mouth = eyes > 0.5, mouth > 0.5
    low, unit = float(y[at_mouth].mean()), float(y[at_eyes].mean() - y[at_mouth].mean())
    if unit < MIDDLE * rig.height:
        return None  # it lies, or hangs upside down: where it is says nothing
    x, y, z = np.abs(x) / unit, (y - low) / unit, (z - z[at_mouth].mean()) / unit
    eye_out, eye_depth = float(x[at_eyes].mean()), float(z[at_eyes].mean())
    corner = (0.6 * eye_out, 0.0)
    smile = moves.of("mouth", "smile", "corner")
    if smile is not None and (best := (smile > 0.9) & (np.abs(y) < LIP_REACH)).any():
        corner = float(x[best].mean()), float(y[best].mean())
    return _Frame(x, y, z, (eye_out, eye_depth), corner)


def _skin(rig: Rig, moves: _Moves, frame: _Frame, skin: Flags) -> NDArray[np.object_]:
    """Return a region (n,) for every vertex as if all were skin."""
    none = np.zeros(rig.vertex_count)

    def share(region: str, *words: str) -> Floats:
        found = moves.of(region, *words)
        return none if found is None else found

    x, y, z = frame.x, frame.y, frame.z
    eye_out, eye_depth = frame.eye
    front, is_face = z > eye_depth - FACE_DEPTH, z > eye_depth - HEAD_DEPTH
    lids = np.maximum(share("eyes", "blink", "close") / LID, share("eyes", "squint") / SQUINT) > 1
    lids &= np.hypot(x - eye_out, y - 1.0) < 0.75 * eye_out
    upper, lower = share("mouth", "upper"), share("mouth", "lower")
    corner = np.hypot(x - frame.corner[0], y - frame.corner[1]) < CORNER
    lips = (np.maximum(upper, lower) > LIP) & (np.abs(y) < LIP_REACH) & (x < frame.corner[0])
    brows = (share("brows") > BROW) & (y > 1.0)
    top = float(np.quantile(y[skin & brows], 0.75)) if (skin & brows).any() else 1.6
    # From below the chin up to the corner of the jaw.
    neck = y < -LOWEST + JAW_RISE * np.maximum(-z - 0.4, 0.0)
    rules = [
        (_ears(frame, skin), "ear"),
        (lids & _sunk(moves), "upper lid"),
        (lids, "lower lid"),
        (corner & front, "mouth corner"),
        (lips & np.where(upper == lower, y > 0, upper > lower), "upper lip"),
        (lips, "lower lip"),
        (front & (x < 0.95 * frame.corner[0]) & (np.abs(y) < 0.3) & (z < -0.12), "inside of the mouth"),
        (is_face & (y > top), "forehead"),
        (brows, "brow"),
        (front & (x < NOSE_OUT) & (y > 1.2), "forehead"),
        (front & (x < NOSE_OUT) & (y > 0.8 * LIP_REACH), "nose"),
        (neck, "neck"),
        (front & (share("jaw", "open", "drop") > 0.5) & (x < CHIN_OUT) & (y < 0), "chin"),
        ((share("jaw") > 0.12) & (y < -0.05), "jaw"),
        (y < BENEATH, "neck"),
        (is_face & (y < 1.0), "cheek"),
        (is_face, "temple"),
    ]
    return np.select([flags for flags, _ in rules], [np.array(name, object) for _, name in rules], "head")


def _sunk(moves: _Moves) -> Flags:
    """Return which vertices (n,) a blink moves down: the upper lids and their lashes."""
    sinking = -moves.rise("eyes", "blink", "close")
    sunk: Flags = sinking > SUNK * sinking.max(initial=0.0)
    return sunk


def _ears(frame: _Frame, skin: Flags) -> Flags:
    """Return which vertices stand out from the sides of the head, with what lies between them."""
    x, y, z = frame.x, frame.y, frame.z
    above = skin & (y > 1.2) & (y < 1.8)
    width = float(x[above].max(initial=0.0))
    out = skin & (x > 1.02 * width) & (y > -0.4) & (y < 1.2) if width else np.zeros(len(x), np.bool_)
    if not out.any():
        return out
    within = [(at >= at[out].min()) & (at <= at[out].max()) for at in (y, z)]
    ears: Flags = (x > 0.85 * width) & within[0] & within[1]
    return ears


def _islands(rig: Rig, moves: _Moves, frame: _Frame, names: NDArray[np.object_], skin: Flags) -> None:
    """Name what does not hang together with the rest of the skin: eyes, lashes and teeth without a name."""
    a, b, c = rig.triangles.T.astype(np.intp)
    label = connected(rig.vertex_count, np.stack([a, b], axis=1), np.stack([b, c], axis=1))
    _, island, sizes = np.unique(label, return_inverse=True, return_counts=True)
    blink, sunk = moves.of("eyes", "blink", "close"), _sunk(moves)
    for at in np.flatnonzero((sizes > 1) & (sizes < 0.2 * rig.vertex_count)):
        own = island == at
        if not skin[own].all():
            continue
        x, y, z = (float(c[own].mean()) for c in (frame.x, frame.y, frame.z))
        if abs(x - frame.eye[0]) < 0.35 and abs(y - 1.0) < 0.35:
            lashes = blink is not None and float(blink[own].mean()) > LASHES
            lid = "upper lid" if sunk[own].mean() > 0.5 else "lower lid"
            names[own] = lid if lashes else "eyeball"
        elif abs(y) < 0.7 and x < 0.8 and z < 0:
            small = max(float(np.ptp(c[own])) for c in (frame.x, frame.y)) < TOOTH
            names[own] = "teeth" if small else "inside of the mouth"


def _parts(rig: Rig) -> tuple[NDArray[np.intp], list[str]]:
    """Return for each vertex its part (n,), and what each part is called."""
    of_part = np.zeros(rig.vertex_count, np.intp)
    called = []
    for at, part in enumerate(rig.parts):
        of_part[rig.triangles[part.triangles.start : part.triangles.stop]] = at
        words = [word for word in words_of(part.name) if len(word) > 1 and word not in SIDES]
        pairs = [first + second for first, second in pairwise(words)]
        known = next((_PART_OF[word] for word in (*pairs, *words) if word in _PART_OF), None)
        called.append(known or ("skin" if len(rig.parts) == 1 else " ".join(words) or "skin"))
    return of_part, called
