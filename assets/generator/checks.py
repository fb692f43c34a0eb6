"""Measures a finished face: what an animator would reject, as numbers.

Lengths are in centimetres, clearances positive where things do not touch.
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from scipy.spatial import cKDTree

from generator.assembly import FaceModel
from generator.character import MATERIALS, swapped
from generator.landmarks import FaceMap
from generator.meshes import face_normals, vertex_normals
from generator.topology import EYE_LINING, EYE_LOOP, LIP_RINGS, MOUTH_BAG, MOUTH_LOOP
from generator.vectors import MIRROR, Array, Ints, Mask, unit

BARYCENTRIC: Array = np.array(
    [(1, 0, 0), (0, 1, 0), (0, 0, 1), (0.5, 0.5, 0), (0, 0.5, 0.5), (0.5, 0, 0.5), (1 / 3, 1 / 3, 1 / 3)]
)
"""Where triangles are probed: corners, edges, centre."""

CHEEK: Array = np.array([3.7, -2.7, 6.4])
"""On the reference face: what a smile lifts."""


def asymmetry(model: FaceModel) -> tuple[float, float]:
    """Return the largest mirror error of the neutral and of the shape pairs, with the products of shapes."""
    mirror, names = model.character.mirror(), model.names
    neutral = model.character.vertices
    of_neutral = np.abs(neutral[mirror] * MIRROR - neutral).max()
    of_shapes = max(
        np.abs(model.deltas[names.index(swapped(name))][mirror] * MIRROR - model.deltas[k]).max()
        for k, name in enumerate(names)
        if swapped(name) in names
    )
    pairs = [tuple(names[k] for k in pair) for pair in model.combo_pairs]
    opposite = [pairs.index(tuple(swapped(name) for name in pair)) for pair in pairs]
    of_products = np.abs(model.combo_deltas[opposite][:, mirror] * MIRROR - model.combo_deltas).max()
    return float(of_neutral), float(max(of_shapes, of_products))


def edges_of(triangles: Ints) -> Ints:
    """Return the (e, 2) edges of triangles, each once."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    edges: Ints = np.unique(np.sort(sides, axis=1), axis=0)
    return edges


def triangle_quality(vertices: Array, triangles: Ints) -> Array:
    """Return (m,) 4 sqrt(3) area / (sum of squared edges): 1 equilateral, 0 without area."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    edges = ((a - b) ** 2).sum(1) + ((b - c) ** 2).sum(1) + ((c - a) ** 2).sum(1)
    area = np.linalg.norm(face_normals(vertices, triangles), axis=1) / 2
    result: Array = 4 * np.sqrt(3) * area / np.maximum(edges, 1e-12)
    return result


def visible_skin(model: FaceModel) -> Mask:
    """Return (m,) which triangles are skin outside the mouth bag and the lining of the lids."""
    skin = model.character.skin
    hidden = [skin.both_sides(skin.mouth_rings[k]) for k in range(-MOUTH_BAG, 0)]
    hidden += [skin.both_sides(skin.eye_rings[k]) for k in range(-EYE_LINING, 0)]
    inner = np.concatenate([*hidden, [skin.bag_centre]])
    triangles = model.character.triangles
    on_skin: Mask = np.all(triangles < len(skin.vertices), axis=1)
    hidden_corner: Mask = np.any(np.isin(triangles, inner), axis=1)
    return on_skin & ~hidden_corner


def flipped(neutral: Array, posed: Array, triangles: Ints) -> int:
    """Return how many triangles a pose turns by more than 100 degrees."""
    before, after = face_normals(neutral, triangles), face_normals(posed, triangles)
    cosine = (before * after).sum(1)
    size = np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
    return int((cosine < -0.17 * size).sum())


def stretch(neutral: Array, posed: Array, edges: Ints) -> Array:
    """Return (e,) how many times as long as in the neutral each edge is."""
    before, after = (np.linalg.norm(v[edges[:, 0]] - v[edges[:, 1]], axis=1) for v in (neutral, posed))
    result: Array = after / before
    return result


def brow_slip(model: FaceModel, posed: Array) -> float:
    """Return the largest change of height of the left brow over the skin under it: floating or sinking."""
    character = model.character
    brow = character.at("browL")
    _, under = cKDTree(character.skin.vertices).query(character.vertices[brow])
    height = [
        ((v[brow] - v[under]) * vertex_normals(v, character.triangles)[under]).sum(1)
        for v in (character.vertices, posed)
    ]
    return float(np.abs(height[1] - height[0]).max())


def lid_clearance(model: FaceModel, posed: Array) -> float:
    """Return the smallest distance of the left lids from the eyeball; negative: it pokes through."""
    character = model.character
    centre = np.array(character.anatomy.eye.centre)
    from_centre = posed[character.at("eyeL")] - centre
    radius = np.linalg.norm(from_centre, axis=1)
    lids = np.concatenate([character.skin.eye_rings[k] for k in range(8)])
    triangles = character.triangles[np.isin(character.triangles, lids).all(1)]
    probes = np.einsum("wk,tkc->twc", BARYCENTRIC, posed[triangles]).reshape(-1, 3) - centre
    distance = np.linalg.norm(probes, axis=1)
    _, nearest = cKDTree(from_centre / radius[:, None]).query(probes / distance[:, None])
    return float((distance - radius[nearest]).min())


def lid_gap(model: FaceModel, posed: Array) -> float:
    """Return the largest distance between the margins of the left upper and lower lid."""
    margin = posed[model.character.skin.eye_rings[0]]
    opposite = margin[(EYE_LOOP - np.arange(EYE_LOOP)) % EYE_LOOP]
    return float(np.linalg.norm(margin - opposite, axis=1).max())


def lip_gap(model: FaceModel, posed: Array) -> tuple[float, float]:
    """Return the smallest and largest height of upper over lower contact line; negative: they cross."""
    skin = model.character.skin
    gaps = []
    for ring in (skin.mouth_rings[0], skin.mirror[skin.mouth_rings[0]]):
        height = posed[ring, 1]
        gaps.append((height - height[::-1])[: MOUTH_LOOP // 2])
    gap = np.concatenate(gaps)
    return float(gap.min()), float(gap.max())


def uncovered(model: FaceModel, posed: Array) -> float:
    """Return how far teeth, gums and tongue stand out of the skin that covers them (negative: behind it)."""
    character = model.character
    inside = np.concatenate([character.at(part) for part in ("teethUpper", "teethLower", "gums", "tongue")])
    skin = character.skin
    outer = [skin.both_sides(skin.mouth_rings[k]) for k in range(1, LIP_RINGS + 4)]
    triangles = character.triangles[np.isin(character.triangles, np.concatenate(outer)).all(1)]
    points, corners = posed[inside], posed[triangles]
    worst = -np.inf
    for k in range(0, len(points), 100):
        worst = max(worst, _depth_over(points[k : k + 100], corners))
    return float(worst)


def _depth_over(points: Array, corners: Array) -> float:
    """Return the largest z of points above the frontmost triangle that covers them in x and y."""
    a, b, c = (corners[None, :, k] for k in range(3))
    p = points[:, None]
    twice = (b - a)[..., 0] * (c - a)[..., 1] - (c - a)[..., 0] * (b - a)[..., 1]
    twice = np.where(np.abs(twice) < 1e-9, np.nan, twice)
    u = ((p - a)[..., 0] * (c - a)[..., 1] - (c - a)[..., 0] * (p - a)[..., 1]) / twice
    v = ((b - a)[..., 0] * (p - a)[..., 1] - (p - a)[..., 0] * (b - a)[..., 1]) / twice
    inside = (u >= 0) & (v >= 0) & (u + v <= 1)
    depth = np.where(inside, a[..., 2] + u * (b - a)[..., 2] + v * (c - a)[..., 2], -np.inf).max(1)
    covered = np.isfinite(depth)
    return float((points[covered, 2] - depth[covered]).max(initial=-np.inf))


def corner_lift(model: FaceModel) -> float:
    """Return how much higher the corners of the closed mouth are than its middle."""
    contact = model.character.vertices[model.character.skin.mouth_rings[0], 1]
    return float(contact[MOUTH_LOOP // 2] - contact[[0, -1]].mean())


def eye_corner_facing(model: FaceModel) -> float:
    """Return how far the skin between brow, nose and eye faces the front at least: 1 flat, 0 a wall.

    A pit there lies in shadow, and a face with one frowns.
    """
    skin, place = model.character.skin, _on_reference(model)
    x, y, z = place.T
    region = (x > 0.9) & (x < 2.4) & (y > 0) & (y < 2.4) & (z > 4)
    region[np.concatenate([skin.eye_rings[k] for k in range(-EYE_LINING, 7)])] = False
    facing = vertex_normals(model.character.vertices, model.character.triangles)[: len(place), 2]
    return float(facing[region].min())


def cheek_move(model: FaceModel, posed: Array) -> Array:
    """Return the (3,) mean motion of the left cheek."""
    place = _on_reference(model)
    cheek = np.linalg.norm(place - CHEEK, axis=1) < 0.9
    result: Array = (posed - model.character.vertices)[: len(place)][cheek].mean(0)
    return result


def fold_angles(model: FaceModel, posed: Array, line: Sequence[Sequence[float]]) -> Array:
    """Return (k - 1,) degrees by which skin turns towards itself across each piece of a line of k points."""
    place, normals = _on_reference(model), vertex_normals(posed, model.character.triangles)
    angles = []
    for start, end in pairwise(np.array(line, float)):
        along = unit(end - start)
        beside = [(start + end) / 2 + side * np.array([-along[1], along[0]]) for side in (-0.4, 0.4)]
        near, far = (np.linalg.norm(place[:, :2] - at, axis=1) + 99 * (place[:, 2] < 2) for at in beside)
        a, b = near.argmin(), far.argmin()
        over = unit(posed[b] - posed[a])
        angles.append(np.degrees(np.arcsin(normals[a] @ over) - np.arcsin(normals[b] @ over)))
    return np.array(angles)


def teeth_gap(model: FaceModel, posed: Array) -> float:
    """Return how far the middle upper teeth end above the lower ones; negative: they overlap."""
    upper, lower = (posed[model.character.at(part)] for part in ("teethUpper", "teethLower"))
    ends = [teeth[np.abs(teeth[:, 0]) < 0.5, 1] for teeth in (upper, lower)]
    return float(ends[0].min() - ends[1].max())


def lash_tail(model: FaceModel, posed: Array) -> float:
    """Return how far the left lashes stand out beyond the outer corner of the eye."""
    corner = posed[model.character.skin.eye_rings[0], 0].max()
    return float(posed[model.character.at("lashL"), 0].max() - corner)


def far_share(model: FaceModel, shape: int) -> float:
    """Return how far skin moves, of the largest move, that is 25 % of the height away from what moves most.

    What moves most is the skin that moves at least half as far as any.  0 for shapes that move no skin.
    """
    place = model.character.skin.vertices
    moves = np.linalg.norm(model.deltas[shape, : len(place)], axis=1)
    if moves.max() == 0:
        return 0.0
    away, _ = cKDTree(place[moves > moves.max() / 2]).query(place)
    far = np.asarray(away) > 0.25 * np.ptp(place[:, 1])
    return float(moves[far].max(initial=0) / moves.max())


def _on_reference(model: FaceModel) -> Array:
    """Return where the (n, 3) vertices of the skin lie on the reference face."""
    return FaceMap(model.character.anatomy).to_reference(model.character.skin.vertices)


def lips(model: FaceModel) -> tuple[Ints, Ints]:
    """Return the (m, 3) triangles of the upper and of the lower lip, with the skin next to the red."""
    skin, half = model.character.skin, MOUTH_LOOP // 2
    found: list[Ints] = []
    for part in (slice(0, half + 1), slice(half, None)):
        rings = [skin.both_sides(skin.mouth_rings[k][part]) for k in range(LIP_RINGS + 4)]
        triangles = model.character.triangles
        found.append(triangles[np.isin(triangles, np.concatenate(rings)).all(1)])
    return found[0], found[1]


def crossings(posed: Array, triangles: Ints, others: Ints) -> int:
    """Return how many edges of two surfaces go through the other one."""
    return _cut(posed, edges_of(triangles), others) + _cut(posed, edges_of(others), triangles)


def _cut(posed: Array, edges: Ints, triangles: Ints) -> int:
    """Return how many (edge, triangle) pairs without a common vertex intersect (Moller and Trumbore 1997)."""
    ends, corners = posed[edges], posed[triangles]
    middles = ends.mean(1), corners.mean(1)
    reach = [
        np.linalg.norm(points - middle[:, None], axis=2).max()
        for points, middle in zip((ends, corners), middles, strict=True)
    ]
    pairs = cKDTree(middles[0]).sparse_distance_matrix(
        cKDTree(middles[1]), sum(reach), output_type="coo_matrix"
    )
    edge, triangle = pairs.row, pairs.col
    apart = ~(edges[edge][:, :, None] == triangles[triangle][:, None]).any((1, 2))
    edge, triangle = edge[apart], triangle[apart]
    start, along = ends[edge, 0], ends[edge, 1] - ends[edge, 0]
    corner = corners[triangle, 0]
    u, v = corners[triangle, 1] - corner, corners[triangle, 2] - corner
    across = np.cross(along, v)
    size = (u * across).sum(1)
    size = np.where(np.abs(size) < 1e-12, np.inf, size)
    at_u = ((start - corner) * across).sum(1) / size
    normal = np.cross(start - corner, u)
    at_v, share = (along * normal).sum(1) / size, (v * normal).sum(1) / size
    return int(((at_u >= 0) & (at_v >= 0) & (at_u + at_v <= 1) & (share > 0) & (share < 1)).sum())


def moved_share(model: FaceModel, shape: int) -> float:
    """Return the share of vertices that a shape moves by more than 0.1 millimetres."""
    return float((np.linalg.norm(model.deltas[shape], axis=1) > 0.01).mean())


def part_triangles(model: FaceModel, part: str) -> Ints:
    """Return the (m, 3) triangles of a part."""
    first = model.character.part[model.character.triangles[:, 0]]
    triangles: Ints = model.character.triangles[first == list(MATERIALS).index(part)]
    return triangles
