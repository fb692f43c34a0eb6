"""The rig: a neutral face and the deltas of its shapes, as one immutable value."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from hashlib import sha256
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from facepin.core.arrays import Floats, Indices, Points, frozen
from facepin.core.columns import Columns
from facepin.core.extent import face_height, head_vertices
from facepin.core.names import shown_name
from facepin.core.sentinels import Sentinels, find_sentinels
from facepin.core.turn import AS_IN_FILE, Turn, after, back, turn_deltas, turn_points


@dataclass(frozen=True, eq=False)
class Texture:
    """A picture that colours a surface."""

    pixels: NDArray[np.uint8]
    """(h, w, 4) sRGB and alpha, first row on top."""
    repeats: tuple[bool, bool] = (True, True)
    """Whether it goes on beyond its edges, along rows and columns; otherwise its edge does."""


@dataclass(frozen=True)
class Part:
    """A named piece of the mesh (skin, left eye, teeth): one run of faces, hence of triangles."""

    name: str
    faces: range
    triangles: range
    colour: tuple[float, float, float] | None = None
    """Base colour, sRGB 0..1, or None where the file gives none."""
    roughness: float = 0.55
    """0 (mirror) .. 1 (chalk)."""
    texture: Texture | None = None
    """Multiplies the base colour, where `Rig.texture_places` says."""
    cutout: float | None = None
    """Alpha of the texture times `opacity` below which there is nothing; None for what is solid."""
    opacity: float = 1.0
    """Alpha of the whole part, 0 nothing is there .. 1; multiplies that of the texture."""
    blends: bool = False
    """What is behind it shows through it by its alpha; `cutout` is then where to cut it instead."""
    transmission: float = 0.0
    """Share of the light that goes straight through its surface, as through glass, 0 .. 1."""
    double_sided: bool = True
    """Whether the file lets it be seen from behind too."""


@dataclass(frozen=True, eq=False)
class Rig:
    """A blendshape face: f = neutral + B w (Eq. 1 and 2 of the paper in delta form).

    Combinations add what two shapes do together: f = neutral + B w + Σ wₐ w_b c_ab.  Their deltas c_ab are
    further columns beside B, and `amounts` says how much of each column a pose has.

    Build one with `facepin.core.rig_builder.build_rig`, which checks everything stated here.
    """

    name: str
    neutral: Points
    """(n, 3) float32, rest positions f0."""
    deltas: csc_array
    """(3n, k + c) float32.  The first k columns are the paper's B: column j is shape j minus neutral, row
    3 v + c its coordinate c at vertex v.  Then one column for each combination.  Indices sorted, exact zeros
    dropped."""
    shape_names: tuple[str, ...]
    """k names, unique and printable: what shapes are called here."""
    corners: Indices
    """(sum of face_sizes,) int32, vertex index of every face corner, face after face."""
    face_sizes: Indices
    """(m,) int32, corners per face (3 or more)."""
    triangles: Indices
    """(t, 3) int32, the faces cut into fans, in face order."""
    parts: tuple[Part, ...]
    """One or more, covering all faces in order."""
    limits: Floats
    """(k, 2) lowest and highest weight of each shape, 0..1 unless the file says otherwise."""
    rest_weights: Floats
    """(k,) weights the file itself asks for, mostly zeros."""
    combinations: Indices = field(default_factory=lambda: frozen(np.zeros((0, 2)), np.int32))
    """(c, 2) int32, the two shapes a and b, a < b, of each combination."""
    file_names: tuple[str, ...] = ()
    """k names as the file has them, which may be empty, repeat, or hold what cannot be shown."""
    ties: tuple[tuple[int, int], ...] = ()
    """Pairs (a, b) of shapes: a is made to be used with at most as much of it as of b."""
    colours: Points | None = None
    """(n, 3) float32 sRGB 0..1 vertex colours, or None."""
    texture_places: Points | None = None
    """(n, 2) float32, where each vertex is in the textures: 0, 0 first corner of the first row, 1, 1 last of
    the last; or None."""
    up: tuple[float, float, float] | None = None
    """Unit vector towards the top of the head, where the file says; None where it does not."""
    front: tuple[float, float, float] | None = None
    """Unit vector from the face towards whom it looks at, where the file says; None where it does not."""
    poses: tuple[tuple[str, Floats], ...] = ()
    """Poses that the file brings: titles, each once, and weights (k,), read-only."""
    turn: Turn = AS_IN_FILE
    """How the face lies here, compared with its file."""
    warnings: tuple[str, ...] = ()
    """What the reader had to mend or leave out, one line each."""
    source: Path | None = None

    @property
    def vertex_count(self) -> int:
        """Number of vertices n."""
        return len(self.neutral)

    @property
    def shape_count(self) -> int:
        """Number of shapes k."""
        return len(self.shape_names)

    @cached_property
    def names_outside(self) -> tuple[str, ...]:
        """k names that other programs know the shapes by: those of the file where they tell shapes apart."""
        counts = Counter(self.file_names)
        pairs = zip(self.file_names or self.shape_names, self.shape_names, strict=True)
        return tuple(outside if counts[outside] == 1 and outside else name for outside, name in pairs)

    def names_here(self, names: Sequence[str]) -> list[str]:
        """Return `names`, but as `shape_names` has them those that only `names_outside` knows."""
        here = dict(zip(self.names_outside, self.shape_names, strict=True))
        return [here.get(name, name) for name in names]

    @property
    def combination_names(self) -> tuple[str, ...]:
        """c names, "a*b" for the combination of a and b."""
        return tuple(f"{self.shape_names[a]}*{self.shape_names[b]}" for a, b in self.combinations.tolist())

    @cached_property
    def shown_names(self) -> tuple[str, ...]:
        """k names as charts and tables for people show them: a line of up to 64 characters each."""
        return tuple(map(shown_name, self.shape_names))

    @cached_property
    def drawn(self) -> NDArray[np.bool_]:
        """(n,) which vertices a triangle has; the others are nowhere to be seen and count for no extent."""
        drawn = np.zeros(self.vertex_count, np.bool_)
        drawn[self.triangles] = True
        return drawn

    @cached_property
    def height(self) -> float:
        """Extent of the head along y (the face height that percentages refer to), never zero.

        That of all that is drawn, unless shapes move a small part of it only: the face of a body.
        """
        return face_height(self.neutral, self.deltas, self.drawn)

    @cached_property
    def head(self) -> NDArray[np.bool_]:
        """(n,) which vertices are the head: all that triangles have, unless the mesh is a whole body."""
        return head_vertices(self.neutral, self.deltas, self.drawn, self.height)

    @cached_property
    def columns(self) -> Columns:
        """The deltas once more, stored for fast products; made when first needed."""
        return Columns(self.deltas)

    @cached_property
    def reaches(self) -> Floats:
        """(k + c,) length of the largest vertex move of each column at amount 1."""
        return self.columns.largest_moves()

    @property
    def largest_moves(self) -> Floats:
        """(k,) length of the largest vertex move of each shape at weight 1."""
        return self.reaches[: self.shape_count]

    @cached_property
    def scale(self) -> float:
        """Mean over shapes of the squared largest vertex move: the unit of relative solver settings."""
        return float(np.mean(self.largest_moves**2)) if self.shape_count else 0.0

    @cached_property
    def sentinels(self) -> Sentinels:
        """Places that stand for the whole face; found when first needed."""
        return find_sentinels(self.deltas, self.columns, self.neutral, self.shape_count, self.height)

    @cached_property
    def fingerprint(self) -> str:
        """Hex digits that are the same as long as mesh and shapes are, whatever they are called."""
        if self.turn != AS_IN_FILE:
            return self.turned(back(self.turn)).fingerprint
        found = sha256()
        for array, kind in (
            (self.neutral, "<f4"),
            (self.corners, "<i4"),
            (self.face_sizes, "<i4"),
            (self.deltas.data, "<f4"),
            (self.deltas.indices, "<i8"),
            (self.deltas.indptr, "<i8"),
            (self.combinations, "<i4"),
        ):
            found.update(np.ascontiguousarray(array, dtype=kind).data)
        return found.hexdigest()[:32]

    def turned(self, turn: Turn, warning: str = "") -> "Rig":
        """Return the rig after a turn, maybe with a warning that says so."""
        return replace(
            self,
            neutral=turn_points(self.neutral, turn),
            deltas=turn_deltas(self.deltas, turn),
            turn=after(self.turn, turn),
            up=None,
            front=None,
            warnings=(warning, *self.warnings) if warning else self.warnings,
        )

    def amounts(self, weights: Floats) -> Floats:
        """How much of each column of `deltas` a pose has, (k + c,): its weights (k,), then their products.

        The weights themselves on a rig without combinations.
        """
        if not len(self.combinations):
            return weights
        return np.concatenate([weights, weights[self.combinations].prod(axis=1)])

    def slopes(self, rows: Floats, weights: Floats) -> Floats:
        """How rows of the face change with each weight at a pose (k,), (r, k): the J that solvers use.

        `rows` (r, k + c) are rows of `deltas`, or sums of such.  On a rig without combinations they are the
        answer, for any pose; else it is column a plus w_b times column ab for every b.
        """
        if not len(self.combinations):
            return rows
        slopes: Floats = rows @ self._amount_slopes(weights)
        return slopes

    def slope_deltas(self, weights: Floats) -> csc_array:
        """How all vertices move with each weight at a pose (k,), (3n, k): the `slopes` of the whole face."""
        if not len(self.combinations):
            return self.deltas
        return csc_array(self.deltas @ csc_array(self._amount_slopes(weights).astype(np.float32)))

    def _amount_slopes(self, weights: Floats) -> Floats:
        """How each amount changes with each weight at a pose, (k + c, k)."""
        count, (first, second) = self.shape_count, self.combinations.T
        slopes = np.eye(count + len(first), count)
        at = np.arange(count, len(slopes))
        slopes[at, first], slopes[at, second] = weights[second], weights[first]
        return slopes

    def evaluate(self, weights: Floats) -> Points:
        """Posed positions (n, 3) float32, computed from scratch; drags use `deform.Deformer`."""
        moved = self.columns.product(self.amounts(np.asarray(weights, np.float64)))
        positions: Points = self.neutral + moved.reshape(-1, 3)
        return positions

    def rows_at(self, vertices: Sequence[int]) -> Floats:
        """Rows of `deltas` at `vertices`, (3p, k + c) float64: x, y, z of the first vertex, then of the next.

        Times `amounts` they are the moves of these vertices; the first k columns are the paper's (Eq. 7).
        """
        return self.columns.rows((3 * np.asarray(vertices, np.intp)[:, None] + np.arange(3)).ravel())
