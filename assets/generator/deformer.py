"""Spreads what is known of a shape (lips, lid margins, a brow) smoothly over the rest of the skin."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import splu

from generator.anatomy import Anatomy
from generator.landmarks import REFERENCE, FaceMap
from generator.lids import crease_heights
from generator.meshes import vertex_normals
from generator.openings import lip_curves
from generator.operators import bilaplacian, mean_of_neighbours
from generator.skin import LIP_PROFILE, Skin
from generator.topology import EYE_LOOP, EYE_RINGS, LIP_RINGS, MOUTH_RINGS
from generator.vectors import MIRROR, Array, Ints, Mask, blob, mix, smoothstep, turn, unit

NO_RING = 99
BAG_FOLLOWS = ((-1, 1.0), (-2, 0.97), (-3, 0.8), (-4, 0.5), (-5, 0.22))
"""(ring, share of the lips' motion that the inside of the mouth follows)"""
LID_FOLLOWS = {-3: 0.8, -2: 1, -1: 1, 0: 1, 1: 0.95, 2: 0.87, 3: 0.76, 4: 0.62, 5: 0.47, 6: 0.32}
"""Share of the margin's turn that each lid ring makes."""
OPENING_FOLLOWS = 0.45
"""Exponent of that share for a lid that opens: it slides under the skin above it, and must not pile up."""
BLINK_BULGE = {-3: 0, -2: 0, -1: 0.04, 0: 0.070, 1: 0.077, 2: 0.073, 3: 0.056, 4: 0.040, 5: 0.020, 6: 0.006}
"""How far a closed lid rises, in eyeball radii: half way, the straight path of a blink would cut the eye."""
LIFT_FOLLOWS = {-1: 0.9, 0: 1.0, 1: 1.0, 2: 1.0, 3: 1.0, 4: 0.9, 5: 0.5, 6: 0.2}
"""Share of a lift that each lid ring makes."""
UNFOLDS = 1.2
"""Share of its crease that the upper lid smooths on the whole way to the other margin."""
JAW_LENGTH = 0.55
"""Share of the way from chin to the angle of the jaw whose skin goes with it."""
JAW_REACH = 2.0
"""How far from the bone that skin lies."""
CANTHUS_HOLD = 0.70
"""Share of its turn that a lid loses at the corners of the eye outside the margin: else skin folds over."""


@dataclass(frozen=True, eq=False)
class Lips:
    """Coordinates of lip vertices, what mouth shapes are functions of."""

    across: Array
    """-1 right corner, 0 middle, 1 left corner."""
    side: Array
    """1 upper lip, -1 lower lip, 0 corner."""
    depth: Array
    """0 contact line .. 1 border of the red."""
    height: Array
    """Height of this lip in that of the reference face, 1 there: what thins a lip must not turn it over."""
    rise: Array
    """Height of the vertex over the contact line, or depth under it, in the scale of the reference face."""


@dataclass(frozen=True, eq=False)
class LidMove:
    """A motion of the left eyelids."""

    skin: Array
    """(n, 3) displacement of the skin."""
    axes: Array
    """(EYE_LOOP, 3) axis about which each margin vertex turns."""
    angles: Array
    """(EYE_LOOP,) by how much, radians."""


class SkinDeformer:
    """The skin with its ring coordinates and the tools that shapes are made with."""

    def __init__(self, skin: Skin, anatomy: Anatomy) -> None:
        self.skin, self.anatomy = skin, anatomy
        self.vertices, self.mirror = skin.vertices, skin.mirror
        self.count = n = len(skin.vertices)
        self.normals = vertex_normals(skin.vertices, skin.triangles)
        self.map = FaceMap(anatomy)
        self.reference = self.map.to_reference(skin.vertices)
        self.off_centre: Array = np.abs(self.reference[:, 0])
        self._operator = bilaplacian(skin.vertices, skin.triangles)
        self._mean_of_neighbours = mean_of_neighbours(n, skin.triangles)
        self.mouth_ring, self.eye_ring = np.full(n, NO_RING), np.full(n, NO_RING)
        self.across, self.side = np.zeros(n), np.zeros(n)
        curves = lip_curves(anatomy.mouth)
        side = np.where(np.abs(curves.along - 1) < 1e-9, 0, np.where(curves.upper, 1, -1))
        for k, ring in skin.mouth_rings.items():
            if k == MOUTH_RINGS:
                continue
            for sign, vertices in ((1, ring), (-1, self.mirror[ring])):
                self.mouth_ring[vertices], self.side[vertices] = k, side
                self.across[vertices] = sign * curves.across
        self.mouth_ring[skin.bag_centre] = min(skin.mouth_rings) - 1
        for k, ring in skin.eye_rings.items():
            if k < EYE_RINGS:
                self.eye_ring[ring] = self.eye_ring[self.mirror[ring]] = k
        self.lip: Mask = (self.mouth_ring >= 0) & (self.mouth_ring < LIP_RINGS)
        self.around_lip: Mask = (self.mouth_ring >= 0) & (self.mouth_ring <= LIP_RINGS)
        """The lips and the ring outside them, which goes with their border: else the corners fold over it."""
        self.inside: Mask = self.mouth_ring < 0
        self.depth = np.zeros(n)
        self.depth[self.around_lip] = np.array((*LIP_PROFILE, 1))[self.mouth_ring[self.around_lip]]

    def averaged(self, values: Array) -> Array:
        """Return (n,) values half way to the mean of their neighbours."""
        result: Array = (values + self._mean_of_neighbours @ values) / 2
        return result

    def brush(self, centre: Sequence[float], radii: Sequence[float], left_only: bool = False) -> Array:
        """Return an (n,) bell about a point of the reference face, and about its image unless `left_only`."""
        left = blob(self.reference, centre, radii)
        return left if left_only else np.maximum(left, blob(self.reference, MIRROR * np.array(centre), radii))

    def spread(self, handles: Ints, values: Array, fixed: Mask) -> Array:
        """Return (n, ...) values: given at `handles`, 0 at `fixed`, the smoothest (biharmonic) elsewhere."""
        result = np.zeros((self.count, *values.shape[1:]))
        result[handles] = values
        unknown = ~fixed
        unknown[handles] = False
        free = np.flatnonzero(unknown)
        rows = self._operator[free]
        solver = splu(
            rows[:, free].tocsc(),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
        result[free] = solver.solve(np.ascontiguousarray(-(rows @ result)))
        return result

    def follow_inside(self, moved: Array) -> Array:
        """Let the inside of the mouth follow the contact line; changes and returns `moved`."""
        contact = self.skin.mouth_rings[0]
        for k, share in BAG_FOLLOWS:
            ring = self.skin.mouth_rings[k]
            moved[ring] = moved[contact] * share
            moved[self.mirror[ring]] = moved[self.mirror[contact]] * share
        return moved

    def _rise(self) -> Array:
        """Return (n,) how far each lip vertex lies above or below the contact line."""
        rise = np.zeros(self.count)
        for right in (False, True):
            contact = self.vertices[self.lip_ring(0, right), 1]
            for k in range(LIP_RINGS + 1):
                place = self.vertices[self.lip_ring(min(k, LIP_RINGS - 1), right), 1]
                rise[self.lip_ring(k, right)] = np.abs(place - contact)
        return rise

    def mouth(self, motion: Callable[[Lips], Array], reach: Sequence[float] = (5.4, 4.4, 6.0)) -> Array:
        """Return the (n, 3) displacement of the skin when the lips move by `motion`.

        `reach` are the half axes of the region about the mouth that gives way.
        """
        handles = np.flatnonzero(self.around_lip)
        lips = Lips(
            self.across[handles],
            self.side[handles],
            self.depth[handles],
            np.where(self.side[handles] > 0, self.map.upper_lip_scale, self.map.lower_lip_scale),
            self._rise()[handles] / self.map.mouth_scale,
        )
        values = motion(lips) * self.map.mouth_scale
        q = (self.reference - np.array([0, -5.8, 5.5])) / np.array(reach)
        still = ((q**2).sum(1) > 1) | (self.reference[:, 1] > -1.6) | (self.eye_ring < 8) | self.inside
        nose = self.brush((0, -2.3, 8.2), (0.9, 0.9, 0.9)) > 0.35
        return self.follow_inside(self.spread(handles, values, (still | nose) & ~self.around_lip))

    def lids(
        self,
        upper: float,
        lower: float,
        blink: float = 0.0,
        shift: tuple[float, float] = (0, 0),
        lift: float = 0.0,
    ) -> LidMove:
        """Return the motion of the left lids: each margin turns about the eyeball towards the other.

        Parameters
        ----------
        upper, lower : float
            Share of the way to the other margin; negative opens.
        blink : float
            How far the lids rise off the eyeball on the way (BLINK_BULGE).
        shift : (float, float)
            Extra motion in x and y, for lids that follow the gaze.
        lift : float
            Further rise of both lids off the eyeball, in eyeball radii.
        """
        skin, centre = self.skin, np.array(self.anatomy.eye.centre)
        radius = self.anatomy.eye.radius
        margin = unit(self.vertices[skin.eye_rings[0]] - centre)
        index = np.arange(EYE_LOOP)
        opposite = margin[(EYE_LOOP - index) % EYE_LOOP]
        is_upper = index <= EYE_LOOP // 2
        s = np.abs(np.linspace(-1, 1, EYE_LOOP // 2 + 1))
        s = np.concatenate([s, s[::-1][1:-1]])
        axes = np.cross(margin, opposite)
        sine = np.linalg.norm(axes, axis=1)
        axes = axes / np.maximum(sine, 1e-9)[:, None]
        axes[sine < 1e-6] = 0
        angles = np.where(is_upper, upper, lower) * np.arctan2(sine, (margin * opposite).sum(1))

        folds = crease_heights(self.anatomy.eye)
        moved = np.zeros_like(self.vertices)
        for k, share in LID_FOLLOWS.items():
            ring = skin.eye_rings[k]
            start = self.vertices[ring] - centre
            rise = (blink * BLINK_BULGE[k] + lift * LIFT_FOLLOWS.get(k, 0)) * (1 - s**4) * radius
            if k >= 0:
                rise = rise + np.where(is_upper, 0.006, 0) * blink
            if k in folds:
                rise[: len(folds[k])] -= UNFOLDS * max(upper, 0) * folds[k]
            length = np.linalg.norm(start, axis=1) + rise
            held = 1 - CANTHUS_HOLD * s**4 if k > 0 else 1.0
            turned = np.where(angles < 0, share**OPENING_FOLLOWS, share) * held
            end = unit(turn(start, axes, angles * turned)) * length[:, None]
            end = end + np.array([*shift, 0]) * share * (1 - s**3)[:, None]
            moved[ring] = end - start
        left = self.vertices[:, 0] > 0
        handles = (self.eye_ring <= max(LID_FOLLOWS)) & left
        q = (self.vertices - centre) / np.array([3.6, 2.9, 4.5])
        fixed = (((q**2).sum(1) > 1) | (self.vertices[:, 0] < 0.35)) & ~handles
        return LidMove(self.spread(np.flatnonzero(handles), moved[handles], fixed), axes, angles)

    def slide_on_eyes(self, moved: Array) -> Array:
        """Let skin about the eyes slide over the eyeballs, not into them; changes and returns `moved`."""
        for side in (1.0, -1.0):
            centre = np.array(self.anatomy.eye.centre) * np.array([side, 1, 1])
            lids = (self.eye_ring >= 0) & (self.eye_ring < EYE_RINGS)
            near = np.flatnonzero(lids & (self.vertices[:, 0] * side > 0))
            start = self.vertices[near] - centre
            end = start + moved[near]
            length = np.linalg.norm(end, axis=1)
            rest = np.linalg.norm(start, axis=1)
            on_lid = smoothstep(1.55, 1.15, rest / self.anatomy.eye.radius)
            wanted = mix(length, np.maximum(length, rest), on_lid)
            moved[near] = end * (wanted / length)[:, None] - start
        return moved

    def mirrored(self, moved: Array) -> Array:
        """Return a displacement of the skin carried over to the other side."""
        result: Array = moved[self.mirror] * MIRROR
        return result

    def lip_ring(self, k: int, right: bool = False) -> Ints:
        """Return mouth ring `k` of the left or right half."""
        ring = self.skin.mouth_rings[k]
        return self.mirror[ring] if right else ring

    def _along_jaw(self) -> tuple[Array, Mask]:
        """Return (n,) the share of the way back along the jaw, and which skin lies under its front part."""
        bone = REFERENCE.skull.jaw
        start, along = np.array(bone.start), np.array(bone.end) - np.array(bone.start)
        from_start = np.c_[self.off_centre, self.reference[:, 1:]] - start
        back = from_start @ along / (along @ along)
        away = from_start - np.clip(back, 0, 1)[:, None] * along
        below = (np.linalg.norm(away, axis=1) < JAW_REACH) & (away[:, 1] < 0)
        return back, below & (back > 0) & (back < JAW_LENGTH)

    def jaw_weights(self) -> Array:
        """Return (n,) how far each skin vertex goes with the jaw."""
        v, across = self.reference, np.abs(self.across)
        y, z = v[:, 1], v[:, 2]
        lower, upper = 0.40 + 0.60 * (1 - across**3.2) ** 0.9, 0.40 * across**2.6
        weights = np.zeros(self.count)
        weights[self.lip] = np.where(self.side == 0, 0.40, np.where(self.side < 0, lower, upper))[self.lip]
        chin = (y < -7.6) & (y > -10.4) & (z > 3.6) & (self.off_centre < 2.8)
        chin &= ~self.lip & ~self.inside & (self.mouth_ring > LIP_RINGS + 2)
        weights[chin] = 1
        back, below = self._along_jaw()
        edge = below & (self.mouth_ring > LIP_RINGS + 2) & ~self.lip & ~self.inside & ~chin
        weights[edge] = mix(1, 0.75, back[edge] / JAW_LENGTH)
        handles = self.lip | chin | edge
        still = (y > -2.2) | (y < -12.8) | (z < -1.2) | ((z < 1.6) & (y < -11))
        still |= (self.eye_ring < 8) | self.inside | (self.brush((0, -2.6, 8.1), (1.0, 1.0, 1.5)) > 0.4)
        weights = np.clip(
            self.spread(np.flatnonzero(handles), weights[handles], still & ~handles), -0.02, 1.06
        )
        for k in range(min(self.mouth_ring), 0):
            ring = self.mouth_ring == k
            fade = max(0.0, 1 - (-k - 4) * 0.09) if k < -4 else 1.0
            upper_side = upper * np.clip(1 + k * 0.2, 0, 1)
            inner = np.where(self.side < 0, lower, np.where(self.side == 0, 0.40, upper_side))
            weights[ring] = inner[ring] * fade
        weights[self.skin.bag_centre] = 0.35
        return weights
