"""Which vertices a press would take: the nearest one first, then what else is there and moves differently."""

from dataclasses import dataclass

import numpy as np

from facepin.core.arrays import Floats
from facepin.session.hand.sight import Pixel, Sight

RADIUS = 8.0
"""How far from the mouse other vertices are looked for, in pixels at 1x scale."""
GAP = 3.0
"""The same where what is under the mouse does not move: between the lips, say."""
DEPTH = 0.012
"""How far behind or before the first one, as a share of the face height."""
ALIKE = 0.5
"""Cosine of the moves of two vertices, all shapes taken together, from which on they move alike."""
MOST = 3
"""Vertices to choose from."""


@dataclass(frozen=True)
class Aim:
    """What is under the mouse."""

    vertices: tuple[int, ...]
    """Those to choose from, each of another region; a press takes the first."""


def aim_at(sight: Sight, pixel: Pixel, preferred: str = "") -> Aim | None:
    """Return what a press at a pixel takes, or None where no shape moves what is there.

    At closed lips upper and lower lip are in the same place: both are found.

    Parameters
    ----------
    sight : Sight
        What is seen.
    pixel : (x, y)
        Where the mouse is.
    preferred : str
        The region that is taken if it is there.
    """
    hit = sight.hit(pixel)
    if hit is None:
        return None
    near = _near(sight, pixel, np.array(hit.point))
    if sight.places.moved[hit.vertex]:
        first = hit.vertex
    elif near and near[0][1] <= GAP * sight.scale:
        first = near[0][0]  # between the lips
    else:
        return None
    chosen, rows = [first], [_row(sight, first)]
    regions = {sight.places.region(first)}
    for vertex, _ in near:
        if len(chosen) == MOST:
            break
        region = sight.places.region(vertex)
        if region in regions:
            continue
        row = _row(sight, vertex)
        if all(float(row @ other) < ALIKE for other in rows):
            chosen.append(vertex)
            rows.append(row)
            regions.add(region)
    first = next((v for v in chosen if sight.places.region(v) == preferred), chosen[0])
    at = chosen.index(first)
    return Aim((*chosen[at:], *chosen[:at]))


def _near(sight: Sight, pixel: Pixel, point: Floats) -> list[tuple[int, float]]:
    """Return the vertices that shapes move near a pixel and a point there, with their pixels from it."""
    positions, camera, viewport = sight.positions, sight.camera, sight.viewport
    depth = float((camera.eye - point) @ camera.axes[2])
    reach = RADIUS * sight.scale * camera.pixel_size(viewport) * depth / camera.distance
    radius = np.float32(np.hypot(reach, DEPTH * sight.rig.height))
    away = positions - point.astype(np.float32)
    close = np.einsum("ij,ij->i", away, away) < radius * radius
    found = np.flatnonzero(close & sight.places.moved)
    x, y, z = camera.project(positions[found], viewport).T
    gaps = np.hypot(x - pixel[0], y - pixel[1])
    gaps[np.abs(z - camera.project(point[None], viewport)[0, 2]) > DEPTH * sight.rig.height] = np.inf
    order = np.argsort(gaps, kind="stable")
    within = order[: np.count_nonzero(gaps <= RADIUS * sight.scale)]
    return list(zip(found[within].tolist(), gaps[within].tolist(), strict=True))


def _row(sight: Sight, vertex: int) -> Floats:
    """Return how all shapes move a vertex, as one unit vector (3 (k + c),)."""
    row: Floats = sight.rig.rows_at([vertex]).ravel()
    return row / max(float(np.linalg.norm(row)), 1e-30)
