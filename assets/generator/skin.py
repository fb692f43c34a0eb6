"""Lays the grid on the head: eye and mouth rings, relaxation on the surface, lips and mouth bag, mirror."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.interpolate import PchipInterpolator

from generator.anatomy import Anatomy
from generator.field import HeadField
from generator.landmarks import FaceMap
from generator.lids import ease_lids, fold_upper_lid, place_eye_rings
from generator.openings import LipCurves, lip_curves
from generator.topology import (
    COLUMNS,
    EYE_RINGS,
    LIP_RINGS,
    MOUTH_BAG,
    MOUTH_LOOP,
    MOUTH_RINGS,
    MOUTH_ROWS,
    ROWS,
    HalfGrid,
    half_grid,
    triangulated,
)
from generator.vectors import MIRROR, Array, Ints, Mask, beside_line, blob, curve, mix, smoothstep, unit

LIP_PROFILE = (0, 0.10, 0.28, 0.54, 0.80, 1)
"""Place of the lip rings between the contact line (0) and the border of the red (1)."""
UPPER_FULLNESS = (-0.75, 0.46, 0.95, 1.0, 0.58, 0.06)
LOWER_FULLNESS = (-0.70, 0.48, 0.96, 1.0, 0.60, 0.04)
RELAXATIONS = 24
NASOLABIAL = ((1.65, -2.75), (2.35, -3.6), (2.95, -4.7), (3.2, -5.9))
"""Where a smile folds, from the wing of the nose to beside the mouth; x and y on the reference face."""
LIP_ROLL = {4: 0.6, 5: 1.0, 6: 0.72, 7: 0.40, 8: 0.15}
"""How far the mouth rings come forward with a full lip."""


@dataclass(frozen=True, eq=False)
class Skin:
    """The skin of both sides, with the rings of the left half (`mirror` finds those of the right)."""

    vertices: Array
    triangles: Ints
    mirror: Ints
    """(n,) the vertex at the mirrored place; those in the middle are their own."""
    eye_rings: dict[int, Ints]
    mouth_rings: dict[int, Ints]
    bag_centre: int

    def both_sides(self, ring: Ints) -> Ints:
        """Return a ring of the left half together with its mirror image."""
        return np.unique(np.r_[ring, self.mirror[ring]])


def build_skin(field: HeadField) -> Skin:
    """Return the skin of a character."""
    half, anatomy = half_grid(), field.anatomy
    curves = lip_curves(anatomy.mouth)
    vertices = np.zeros((half.count, 3))
    _place_grid(vertices, half, field)
    place_eye_rings(vertices, half, anatomy)
    _place_mouth_rings(vertices, half, field, curves)
    middle = _middle(half)
    _relax(vertices, half, field, middle)
    ease_lids(vertices, half, anatomy)
    fold_upper_lid(vertices, half, anatomy)
    _place_lips(vertices, half, field, curves)
    _roll_lips(vertices, half, anatomy, curves)
    _place_bag(vertices, half, anatomy, curves)
    for ring in half.mouth_rings.values():
        vertices[ring[[0, -1]], 0] = 0
    vertices[middle, 0] = 0
    return _mirrored(vertices, half, middle)


def _place_grid(vertices: Array, half: HalfGrid, field: HeadField) -> None:
    """Cast one ray per grid vertex from the axis of the head."""
    i, j = half.places.T
    skull, eye, mouth = field.anatomy.skull, field.anatomy.eye, field.anatomy.mouth
    eye_x = np.arctan2(eye.centre[0], eye.centre[2] - skull.axis_z) / 0.57535
    eye_y, chin_y = eye.centre[1], skull.chin.centre[1]
    columns = (
        (0, 0),
        (6, 0.15 * eye_x),
        (11, 0.43 * eye_x),
        (16, 0.96 * eye_x),
        (22, 1.42),
        (COLUMNS, np.pi),
    )
    azimuth = curve(columns, j)
    beside_mouth = smoothstep(30, MOUTH_ROWS[0], i) * smoothstep(56, MOUTH_ROWS[1], i) * smoothstep(22, 12, j)
    azimuth *= 1 + (mouth.half_width / 2.20 - 1) * beside_mouth
    even = smoothstep(MOUTH_ROWS[1] + 3, ROWS - 3, i) + smoothstep(10, 0, i)
    azimuth = mix(azimuth, np.pi * j / COLUMNS, even)
    rows = np.array(
        [
            (0, 5, 90),
            (11, 5, 0),
            (17, eye_y + 1.195 * eye.radius, 0),
            (27, eye_y - 1.024 * eye.radius, 0),
            (39, mouth.height + 1.60 + 0.4 * mouth.corner_lift, 0),
            (47, mouth.height - 1.65 + 0.4 * mouth.corner_lift, 0),
            (53, chin_y + 0.05, -14),
            (58, chin_y + 0.55, -34),
            (62, chin_y - 0.75, -46),
            (66, -11.0, -40),
            (ROWS, -14.9, 0),
        ]
    )
    height, pitch = curve(rows[:, :2], i), np.radians(curve(rows[:, ::2], i))
    pitch = pitch * mix(
        1, 0.5, smoothstep(1.2, 2.4, azimuth)
    )  # steep rays would leave the back of a thick neck
    origins = np.stack([0 * height, height, 0 * height + field.anatomy.skull.axis_z], 1)
    directions = np.stack(
        [np.cos(pitch) * np.sin(azimuth), np.sin(pitch), np.cos(pitch) * np.cos(azimuth)], 1
    )
    vertices[: len(origins)] = field.raycast(origins, directions, 15)


def _place_mouth_rings(vertices: Array, half: HalfGrid, field: HeadField, curves: LipCurves) -> None:
    """Put the border of the red on the face and spread the rings outside it evenly."""
    x, y = curves.border_x, curves.border_y
    border = np.stack([x, y, field.front(x, y)], 1)
    outside = border + np.outer(0.16 * curves.across**6, (1, 0, 0))
    for k in range(LIP_RINGS - 1, MOUTH_RINGS):
        share = (k - LIP_RINGS + 1) / (MOUTH_RINGS - LIP_RINGS + 1)
        start = border if k < LIP_RINGS else outside
        vertices[half.mouth_rings[k]] = mix(start, vertices[half.mouth_rings[MOUTH_RINGS]], share)


def _middle(half: HalfGrid) -> Mask:
    """Return which vertices lie on the mid-line."""
    ends = [ring[[0, -1]] for ring in half.mouth_rings.values()]
    first = half.grid[:, 0]
    middle = np.zeros(half.count, bool)
    middle[np.concatenate([first[first >= 0], half.grid[:, COLUMNS], *ends, [half.bag_centre]])] = True
    return middle


def _relax(vertices: Array, half: HalfGrid, field: HeadField, middle: Mask) -> None:
    """Even out the free vertices along the surface; edges at nose, fold and chin pull harder, get denser."""
    q = half.quads
    edges = np.concatenate([q[:, [0, 1]], q[:, [1, 2]], q[:, [2, 3]], q[:, [3, 0]]])
    edges = np.unique(np.sort(edges[edges[:, 0] != edges[:, 1]], 1), axis=0)
    centres = vertices[edges].mean(1)
    centres[:, 0] = np.abs(centres[:, 0])
    centres = FaceMap(field.anatomy).to_reference(centres)
    pull = 1 + 4.0 * blob(centres, (0.55, -2.95, 7.6), (1.2, 1.0, 1.6))
    pull += 1.6 * blob(centres, (0, -9.3, 4.8), (2.8, 1.3, 2.8))
    _, across, beyond = beside_line(centres[:, :2], np.array(NASOLABIAL))
    height = centres[:, 1]
    between = smoothstep(-2.9, -3.9, height) * smoothstep(-5.5, -4.3, height)  # nose and corner are dense
    pull += 5.0 * np.exp(-((np.hypot(across, beyond) / 0.6) ** 2)) * between * (centres[:, 2] > 2)
    both = np.r_[edges, edges[:, ::-1]]
    weights = sp.coo_matrix((np.r_[pull, pull], both.T), shape=(half.count, half.count)).tocsr()
    total = np.asarray(weights.sum(1)).ravel()

    free = np.zeros(half.count, bool)
    free[: len(half.places)] = True
    free[half.grid[ROWS]] = free[0] = False
    for k in range(3, EYE_RINGS):
        free[half.eye_rings[k]] = True
    for k in range(LIP_RINGS, MOUTH_RINGS):
        free[half.mouth_rings[k]] = True
    moving = np.flatnonzero(free)
    vertices[moving] = field.project(vertices[moving])
    for round_ in range(RELAXATIONS):
        step = ((weights @ vertices) / total[:, None] - vertices)[moving]
        step[middle[moving], 0] = 0
        normal = unit(field.gradient(vertices[moving]))
        step -= (step * normal).sum(1)[:, None] * normal
        vertices[moving] += 0.55 * step
        vertices[moving] = field.project(vertices[moving], 3 if round_ == RELAXATIONS - 1 else 1)
        vertices[middle, 0] = 0


def _roll_lips(vertices: Array, half: HalfGrid, anatomy: Anatomy, curves: LipCurves) -> None:
    """Bring the skin round the red forward, so that the lips grow out of the face instead of lying on it."""
    mouth = anatomy.mouth
    roll = np.where(
        curves.upper, mouth.upper_fullness * mouth.upper_roll, mouth.lower_fullness * mouth.lower_roll
    )
    roll = roll * np.clip(curves.taper * 1.05 + 0.05, 0, 1)
    for k, share in LIP_ROLL.items():
        vertices[half.mouth_rings[k], 2] += share * roll


def _place_lips(vertices: Array, half: HalfGrid, field: HeadField, curves: LipCurves) -> None:
    """Shape the red of the lips between contact line and border."""
    mouth, w = field.anatomy.mouth, curves.across
    upper_profile = PchipInterpolator(LIP_PROFILE, UPPER_FULLNESS)
    lower_profile = PchipInterpolator(LIP_PROFILE, LOWER_FULLNESS)
    thickness = np.clip(curves.taper * 1.05 + 0.05, 0, 1)
    corner = np.exp(-(((1 - w) / 0.13) ** 2))
    border_z = vertices[half.mouth_rings[LIP_RINGS - 1], 2].copy()
    contact_z = field.front(curves.contact_x, curves.contact_y)
    for k, t in enumerate(LIP_PROFILE):
        full = np.where(
            curves.upper, mouth.upper_fullness * upper_profile(t), mouth.lower_fullness * lower_profile(t)
        )
        z = mix(contact_z, border_z, t**1.2) + full * thickness - 0.24 * corner * (1 - t)
        x = mix(curves.contact_x, curves.border_x, t)
        y = mix(curves.contact_y, curves.border_y, t)
        vertices[half.mouth_rings[k]] = np.stack([x, y, z], 1)
    inner, outer = (vertices[half.mouth_rings[LIP_RINGS + k]] for k in (-1, 1))
    between = 0.45 + 0.25 * smoothstep(0.90, 1, w)  # farther out at the corners, which it would touch
    vertices[half.mouth_rings[LIP_RINGS]] = mix(inner, outer, between[:, None])
    vertices[half.mouth_rings[0], 1] += np.where(curves.upper, 0.0006, -0.0006) * (curves.along < 1)


def _place_bag(vertices: Array, half: HalfGrid, anatomy: Anatomy, curves: LipCurves) -> None:
    """Line the inside: back of the lips, fold behind them, and a bag that closes at the throat."""
    mouth, w = anatomy.mouth, curves.across
    contact = vertices[half.mouth_rings[0]].copy()
    up = np.where(curves.upper, 1.0, -1.0)
    corner = np.exp(-(((1 - w) / 0.13) ** 2))
    opening = 1 - 0.9 * corner
    lining = {-1: (-0.22, 0.05, 1), -2: (-0.55, 0.22, 1), -3: (-0.95, 0.65, 1), -4: (-1.25, 1.15, 1.02)}
    for k, (depth, height, widen) in lining.items():
        part = -k / 4
        offset = np.stack(
            [
                contact[:, 0] * (widen - 1) + 0.25 * corner * part,
                up * height * np.maximum(opening, 0.225 * part) * (1 - 0.3 * w),
                depth * (1 + 0.1 * w) - 0.25 * w * w * part,
            ],
            1,
        )
        vertices[half.mouth_rings[k]] = contact + offset
    fold = vertices[half.mouth_rings[-4]].copy()
    phi = np.linspace(np.pi / 2, -np.pi / 2, MOUTH_LOOP)
    for k in range(-5, -MOUTH_BAG - 1, -1):
        f = (-k - 4) / 6
        size = np.sqrt(max(1 - f**2.5, 0.02))
        hollow = 1.4 * (1 - np.sqrt(1 - 0.9 * np.cos(phi) ** 2)) * (1 - f)
        ring = np.stack(
            [
                2.75 * size * np.cos(phi),
                mouth.height - 0.35 * f + 1.55 * size * np.sin(phi),
                mix(fold[0, 2], 1.2, f) - hollow,
            ],
            1,
        )
        vertices[half.mouth_rings[k]] = mix(fold, ring, min(1, 0.55 + 0.2 * (-k - 5)))
    vertices[half.bag_centre] = (0, mouth.height - 0.35, 0.9)


def _mirrored(vertices: Array, half: HalfGrid, middle: Mask) -> Skin:
    """Add the right half."""
    n, sided = half.count, np.flatnonzero(~middle)
    to_right = np.arange(n)
    to_right[sided] = n + np.arange(len(sided))
    mirror = np.arange(n + len(sided))
    mirror[sided] = to_right[sided]
    mirror[n:] = sided
    triangles = triangulated(half.quads, vertices)
    return Skin(
        vertices=np.concatenate([vertices, vertices[sided] * MIRROR]),
        triangles=np.concatenate([triangles, to_right[triangles[:, [0, 2, 1]]]]),
        mirror=mirror,
        eye_rings=half.eye_rings,
        mouth_rings=half.mouth_rings,
        bag_centre=half.bag_centre,
    )
