"""Eyes that a file does not name: a pair of balls in the front of a face, and clear shells before them."""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from facepin.core.arrays import Floats, Indices
from facepin.core.mesh.topology import Labels, connected, weld_map
from facepin.core.rig import Part, Rig
from facepin.gpu.materials import CLAY, SKIN, WHITE, by_name

EYEBALL_NAME, SHELL_NAME = "eyeball", "clear shell of an eye"
"""Names that `materials.BY_NAME` knows; shells are left out."""

ROUND = 0.08
"""Largest deviation of a ball's vertices from its sphere, in radii: corneas stand out."""
WHOLE = 0.75
"""Least width, height and depth of a ball, in its diameters."""
FEWEST = 40
"""Vertices that a ball or a shell has at least."""
SIZES = 0.004, 0.15
"""Radii of eyes, in heights of the rig."""
ALIKE = 0.2
"""How far a pair may differ in height, depth and size, in radii."""
APART = 2.0, 8.0
"""How far the middles of a pair are from each other, in radii."""
HUGGING = 0.9, 1.3
"""Distances of the vertices of a clear shell from the middle of the eye, in radii."""


@dataclass(frozen=True)
class Ball:
    """A surface that is nearly a sphere."""

    vertices: Labels
    middle: Floats
    radius: float


def eyes_apart(rig: Rig) -> Rig:
    """Return the rig with its eyeballs, and what is clear before them, as parts of their own.

    Only parts without colours and texture are searched, in rigs whose names say nothing of eyes.  An eye is
    one of two balls beside each other in the front; a ball within it belongs to it.  What hugs such a ball
    and covers its pupil can only be clear.
    """
    looks = [by_name(part) for part in rig.parts]
    plain = [
        part.colour in (None, WHITE) and part.texture is None and look in (CLAY, SKIN)
        for part, look in zip(rig.parts, looks, strict=True)
    ]
    named = any(look is None or look.wet for look in looks)
    if rig.colours is not None or named or not any(plain):
        return rig
    balls = [
        ball
        for vertices in _hanging_together(rig, weld_map(rig))
        if (ball := _ball(rig.neutral[vertices].astype(np.float64), vertices)) is not None
    ]
    eyes = _pair(rig, balls)
    if not eyes:
        return rig
    found = np.zeros(rig.vertex_count, np.int32)
    names = [""]
    for eye in eyes:
        away = (rig.neutral.astype(np.float64) - eye.middle) / eye.radius
        distance = np.linalg.norm(away, axis=1)
        for ball in balls:
            if distance[ball.vertices].max() < HUGGING[1]:
                found[ball.vertices] = len(names)
                names.append(EYEBALL_NAME)
        # Shells often share the rim of the lids, so what counts are the vertices as the file has them.
        for vertices in _hanging_together(rig, np.arange(rig.vertex_count, dtype=np.int32)):
            near, far = distance[vertices].min(), distance[vertices].max()
            if HUGGING[0] < near and far < HUGGING[1] and not found[vertices].any():
                triangles = rig.triangles[np.isin(rig.triangles[:, 0], vertices)]
                if _covers_pupil(away[triangles]):
                    found[vertices] = len(names)
                    names.append(SHELL_NAME)
    searched = np.repeat(plain, [len(part.triangles) for part in rig.parts])
    return replace(rig, parts=_split(rig, np.where(searched, found[rig.triangles[:, 0]], 0), names))


def _hanging_together(rig: Rig, same: Indices) -> list[Labels]:
    """Return the (m,) vertices of each larger surface; `same` (n,) says which vertices are one."""
    triangles = same[rig.triangles].astype(np.intp)
    label = connected(rig.vertex_count, triangles[:, :2], triangles[:, 1:])[same]
    order = np.argsort(label, kind="stable")
    surfaces = np.split(order, np.flatnonzero(np.diff(label[order])) + 1)
    return [surface for surface in surfaces if len(surface) >= FEWEST]


def _ball(points: Floats, vertices: Labels) -> Ball | None:
    """Return the sphere that (m, 3) points lie on, or None if they are no ball."""
    size = np.ptp(points, axis=0)
    if size.min() < WHOLE * size.max():
        return None
    # |p|² = 2 p·c + (r² − |c|²) is linear in the middle c; from near it, nothing is lost to rounding.
    near = points - points.mean(axis=0)
    system = np.concatenate([2 * near, np.ones((len(near), 1))], axis=1)
    solution, _, rank, _ = np.linalg.lstsq(system, (near**2).sum(axis=1), rcond=None)
    if rank < 4:
        return None
    radius = float(np.sqrt(solution[3] + solution[:3] @ solution[:3]))
    misses = np.abs(np.linalg.norm(near - solution[:3], axis=1) - radius)
    if np.sqrt((misses**2).mean()) > ROUND * radius or size.min() < 2 * WHOLE * radius:
        return None
    return Ball(vertices, points.mean(axis=0) + solution[:3], radius)


def _pair(rig: Rig, balls: list[Ball]) -> tuple[Ball, ...]:
    """Return the two largest balls that are alike, beside each other and in the front, or none."""
    low, high = rig.neutral[:, 2].min(initial=0), rig.neutral[:, 2].max(initial=0)
    sized = [
        ball
        for ball in sorted(balls, key=lambda ball: -ball.radius)
        if SIZES[0] * rig.height < ball.radius < SIZES[1] * rig.height and ball.middle[2] > (low + high) / 2
    ]
    for at, one in enumerate(sized):
        for other in sized[at + 1 :]:
            across, *along = (np.abs(one.middle - other.middle) / one.radius).tolist()
            differ = max(*along, abs(one.radius - other.radius) / one.radius)
            if differ < ALIKE and APART[0] < across < APART[1]:
                return one, other
    return ()


def _covers_pupil(away: Floats) -> bool:
    """Say whether one of (t, 3, 3) triangles about the middle of an eye hides it, as seen from the front."""
    a, b, c = (away[away[:, :, 2].min(axis=1) > 0, k, :2] for k in range(3))
    sides = np.stack([p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0] for p, q in ((a, b), (b, c), (c, a))])
    return bool(((sides >= 0).all(axis=0) | (sides <= 0).all(axis=0)).any())


def _split(rig: Rig, found: Indices, names: list[str]) -> tuple[Part, ...]:
    """Cut parts where what is found begins and ends; `found` (t,) is the place of a name in `names`, or 0."""
    face = np.repeat(np.arange(len(rig.face_sizes)), rig.face_sizes - 2)
    parts: list[Part] = []
    for part in rig.parts:
        if not part.triangles:
            parts.append(part)
            continue
        start, stop = part.triangles.start, part.triangles.stop
        cuts = (start + 1 + np.flatnonzero(np.diff(found[start:stop]))).tolist()
        for first, end in pairwise([start, *cuts, stop]):
            faces = range(int(face[first]), int(face[end - 1]) + 1)
            cut = replace(part, faces=faces, triangles=range(first, end))
            parts.append(replace(cut, name=names[found[first]], colour=None) if found[first] else cut)
    return tuple(parts)
