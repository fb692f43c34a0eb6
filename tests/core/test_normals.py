"""Vertex normals against the angle-weighted sum written out, and against themselves computed from scratch."""

from itertools import pairwise

import numpy as np
import pytest

from facepin.core.arrays import Floats, Points
from facepin.core.mesh import area_vectors
from facepin.core.mesh.area_vectors import AreaVectors
from facepin.core.mesh.cells import Cells, make_cells
from facepin.core.mesh.normals import NormalField
from facepin.core.rig import Rig
from facepin.core.rig_builder import build_rig
from facepin.core.shapes.deform import Deformer
from support.small_rigs import sheet


def angle_weighted(rig: Rig, positions: Points) -> Floats:
    """Sum over the faces round each vertex of angle times unit normal, face by face."""
    points = positions.astype(np.float64)
    normals = np.zeros_like(points)
    for face in np.split(rig.corners, np.cumsum(rig.face_sizes)[:-1]):
        loop = points[face]
        area = sum(np.cross(p - loop[0], q - loop[0]) for p, q in pairwise(loop[1:]))
        area = area / np.linalg.norm(area)
        for at, vertex in enumerate(face):
            u, v = loop[at - 1] - loop[at], loop[(at + 1) % len(loop)] - loop[at]
            normals[vertex] += np.arccos(u @ v / np.linalg.norm(u) / np.linalg.norm(v)) * area
    return normals


def unit(vectors: Points | Floats) -> Floats:
    vectors = vectors.astype(np.float64)
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def degrees_apart(one: Points | Floats, other: Points | Floats) -> Floats:
    return np.degrees(2 * np.arcsin(np.clip(np.linalg.norm(unit(one) - unit(other), axis=1) / 2, 0, 1)))


def bowl(shapes: int = 3) -> Rig:
    """A curved sheet of quads."""
    rig = sheet(shapes=shapes)
    x, y, _ = rig.neutral.T
    deltas = rig.deltas.toarray().T.reshape(shapes, -1, 3)
    named = list(zip(rig.shape_names, deltas, strict=True))
    neutral = np.stack([x, y, 0.4 * x * x - 0.3 * y * y], axis=1)
    return build_rig("bowl", neutral, rig.corners, rig.face_sizes, named)


def ball(sides: int = 16, rings: int = 8, polygons: bool = False) -> Rig:
    """A sphere of quads, with fans of triangles (or one polygon) at the poles, that one shape squeezes."""
    turn = np.linspace(0, 2 * np.pi, sides, endpoint=False)
    points = [(0.0, 1.0, 0.0)]
    for tilt in np.linspace(0, np.pi, rings + 1)[1:-1]:
        points += [(np.sin(tilt) * np.sin(a), np.cos(tilt), np.sin(tilt) * np.cos(a)) for a in turn]
    points.append((0.0, -1.0, 0.0))
    last = len(points) - 1
    faces: list[list[int]] = []
    if polygons:
        faces += [list(range(1, sides + 1)), list(range(last - 1, last - sides - 1, -1))]
    for i in range(sides):
        j = (i + 1) % sides
        if not polygons:
            faces += [[0, 1 + i, 1 + j], [last, last - sides + j, last - sides + i]]
        for ring in range(rings - 2):
            top, low = 1 + ring * sides, 1 + (ring + 1) * sides
            faces.append([top + i, low + i, low + j, top + j])
    neutral = np.array(points)
    if polygons:  # the poles are not on any face
        neutral = np.vstack([neutral[1:-1]])
        faces = [[v - 1 for v in face] for face in faces]
    squeeze = neutral * (0.3, -0.4, 0.0)
    flat = [v for face in faces for v in face]
    return build_rig("ball", neutral, flat, [len(face) for face in faces], [("squeeze", squeeze)])


@pytest.mark.parametrize("rig", [bowl(), ball(), ball(polygons=True)], ids=["quads", "triangles", "polygons"])
def test_in_the_neutral_normals_are_angle_weighted(rig: Rig) -> None:
    normals = NormalField(rig).normals(rig.neutral)
    expected = angle_weighted(rig, rig.neutral)
    assert degrees_apart(normals, expected).max() < (0.01 if rig.face_sizes.max() <= 4 else 3)


def test_on_a_ball_normals_point_outwards_and_stay_near_the_truth_when_it_is_squeezed() -> None:
    rig = ball(sides=48, rings=24)
    field = NormalField(rig)
    assert degrees_apart(field.normals(rig.neutral), rig.neutral).max() < 0.5
    squeezed = rig.evaluate(np.ones(1))
    truth = rig.neutral / (1.3, 0.6, 1.0)  # a normal of an ellipsoid is scaled by the inverse
    assert degrees_apart(field.normals(squeezed), truth).max() < 2


def test_a_turned_face_has_turned_normals() -> None:
    rig = bowl()
    turn = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    field = NormalField(rig)
    straight = field.normals(rig.neutral)
    turned = field.normals((rig.neutral @ turn.T + 5).astype(np.float32))
    assert degrees_apart(turned, straight @ turn.T).max() < 0.02


@pytest.mark.parametrize("moving", [1, 3, 12])
def test_what_is_computed_in_part_equals_what_is_computed_whole(moving: int) -> None:
    rig = sheet(columns=30, rows=30, shapes=12)
    deformer, field = Deformer(rig), NormalField(rig)
    random = np.random.default_rng(moving)
    weights = np.zeros(12)
    for frame in range(200):
        if frame % 20 == 0:
            chosen = random.choice(12, moving, replace=False)
        if frame % 50 == 49:
            weights = np.zeros(12)
        weights = weights.copy()
        weights[chosen] = random.uniform(size=moving)
        positions = deformer.deform(weights)
        np.testing.assert_array_equal(field.normals(positions), NormalField(rig).normals(positions))


def computed_whole(cells: Cells, positions: Points) -> Floats:
    """Normals from plain cross products of all cells, in double precision."""
    points = positions.astype(np.float64)
    (a, b), (c, d) = points[cells.diagonals]
    areas = np.pad(np.cross(b - a, d - c), ((0, 0), (0, 1)))
    return (cells.sums.astype(np.float64) @ areas.ravel()).reshape(-1, 3)


def head_with_still_parts(shapes: int = 10) -> Rig:
    """A sheet of which shapes move dots, halves or most, with a seam, beside another that none moves."""
    rig, pairs = split_at_seam(sheet(columns=24, rows=24, shapes=shapes), 11, 24)
    random = np.random.default_rng(4)
    deltas = random.normal(0, 0.2, (shapes, rig.vertex_count, 3))
    x, y, _ = rig.neutral.T
    for j, delta in enumerate(deltas):
        near = np.hypot(x - x[37 * j], y - y[37 * j])
        delta[near > np.quantile(near, (0.01, 0.1, 0.4, 0.9)[j % 4])] = 0
    deltas[:, pairs[:, 1]] = deltas[:, pairs[:, 0]]
    neutral = np.vstack([rig.neutral, rig.neutral - np.array([0, 0, 1])])
    corners = np.concatenate([rig.corners, rig.corners + rig.vertex_count])
    both = np.concatenate([deltas, np.zeros_like(deltas)], axis=1)
    named = list(zip(rig.shape_names, both, strict=True))
    return build_rig("parts", neutral, corners, np.tile(rig.face_sizes, 2), named)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("block", [5, 100, 8192])
def test_normals_of_a_random_walk_are_those_of_the_whole_face(
    seed: int, block: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(area_vectors, "BLOCK", block)
    rig = head_with_still_parts()
    cells = make_cells(rig)
    random = np.random.default_rng(seed)
    fields = [NormalField(rig)]
    fields.append(fields[0].twin())
    deformers = [Deformer(rig), Deformer(rig)]
    weights, gesture = np.zeros(rig.shape_count), [0]
    for _ in range(100):
        kind = random.integers(10)
        weights = weights.copy()
        if kind == 0:
            gesture = random.choice(rig.shape_count, random.integers(1, 5), replace=False)
        elif kind == 1:
            weights[:] = random.uniform(size=rig.shape_count) * (random.uniform() < 0.5)
        else:
            weights[gesture] += random.normal(0, 0.1, len(gesture))
        pane = random.integers(2)
        positions = deformers[pane].deform(weights)
        if kind == 2:  # as no shape does
            moved = positions.copy()
            moved[random.integers(rig.vertex_count, size=random.choice([1, 50]))] += 0.3
            positions = moved
        normals = fields[pane].normals(positions)
        np.testing.assert_array_equal(normals, NormalField(rig).normals(positions))
        np.testing.assert_allclose(normals, computed_whole(cells, positions), atol=2e-4)


def test_a_small_move_costs_only_its_surroundings(monkeypatch: pytest.MonkeyPatch) -> None:
    rig = sheet(columns=60, rows=60, shapes=2)
    deltas = np.zeros((rig.vertex_count, 3))
    deltas[1830] = (0, 0, 0.1)
    rig = build_rig("dot", rig.neutral, rig.corners, rig.face_sizes, [("dot", deltas), ("all", rig.neutral)])
    field = NormalField(rig)
    field.normals(rig.evaluate(np.array([0.1, 0.5])))
    field.normals(rig.evaluate(np.array([0.2, 0.5])))  # from now on only one vertex moves
    cells: list[int] = []
    of = AreaVectors.of
    monkeypatch.setattr(AreaVectors, "of", lambda self, p: cells.append(len(self.values)) or of(self, p))
    for weight in (0.3, 0.4, 0.5):
        field.normals(rig.evaluate(np.array([weight, 0.5])))
    assert cells == [4, 4, 4]


def test_identity_and_policy_of_the_result() -> None:
    rig = bowl()
    field = NormalField(rig)
    first = field.normals(rig.neutral)
    assert field.normals(rig.neutral) is first and not first.flags.writeable
    copy = first.copy()
    second = field.normals(rig.evaluate(np.ones(3)))
    assert second is not first
    np.testing.assert_array_equal(first, copy)
    assert second.dtype == np.float32 and second.shape == rig.neutral.shape


def test_a_twin_is_independent() -> None:
    rig = bowl()
    field = NormalField(rig)
    field.normals(rig.evaluate(np.ones(3)))
    twin = field.twin()
    for weights in (np.zeros(3), np.array([0.2, 0, 0]), np.ones(3)):
        positions = rig.evaluate(weights)
        np.testing.assert_array_equal(twin.normals(positions), NormalField(rig).normals(positions))
    np.testing.assert_array_equal(field.normals(rig.neutral), NormalField(rig).normals(rig.neutral))


def test_degenerate_cells_and_unused_vertices_have_finite_normals_that_can_be_normalised() -> None:
    neutral = np.array(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 2, 2], [2, 2, 2], [2, 2, 2], [9, 9, 9], [1, 1, 0]], np.float64
    )
    corners = [0, 1, 2, 3, 4, 5, 0, 0, 1, 1, 1, 1, 2]
    collapse = -neutral
    rig = build_rig("odd", neutral, corners, [3, 3, 4, 3], [("collapse", collapse)])
    field = NormalField(rig)
    for weight in (0.0, 0.5, 1.0):
        normals = field.normals(rig.evaluate(np.array([weight])))
        assert np.isfinite(normals).all()
        assert (np.linalg.norm(normals.astype(np.float64), axis=1) > 1e-7).all()
    np.testing.assert_allclose(unit(field.normals(rig.neutral))[:3], [[0, 0, 1]] * 3, atol=1e-6)


def test_a_sliver_that_opens_does_not_rule_its_neighbours() -> None:
    # Two large triangles in the plane, and one of no area between them that opens upright.
    neutral = np.array([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, -2, 0], [1, 0, 0]], np.float64)
    opened = np.zeros((5, 3))
    opened[4] = (0, 0, 0.5)
    rig = build_rig("sliver", neutral, [0, 1, 2, 0, 3, 1, 0, 4, 1], [3, 3, 3], [("open", opened)])
    normals = unit(NormalField(rig).normals(rig.evaluate(np.ones(1))))
    assert degrees_apart(normals[2:4], np.array([[0, 0, 1.0]] * 2)).max() < 1
    assert normals[0, 2] > 0.2


def split_at_seam(rig: Rig, column: int, columns: int) -> tuple[Rig, Points]:
    """Cut a sheet along a column of vertices as a texture seam does; returns the pairs too."""
    seam = np.arange(column, rig.vertex_count, columns)
    twins = np.arange(rig.vertex_count, rig.vertex_count + len(seam))
    corners = rig.corners.reshape(-1, 4).copy()
    right = (corners % columns).max(axis=1) > column
    for old, new in zip(seam, twins, strict=True):
        corners[right] = np.where(corners[right] == old, new, corners[right])
    deltas = rig.deltas.toarray().T.reshape(rig.shape_count, -1, 3)
    named = [(name, np.vstack([d, d[seam]])) for name, d in zip(rig.shape_names, deltas, strict=True)]
    cut = build_rig(
        "cut", np.vstack([rig.neutral, rig.neutral[seam]]), corners.ravel(), rig.face_sizes, named
    )
    return cut, np.stack([seam, twins], axis=1)


def test_normals_are_continuous_across_a_texture_seam() -> None:
    rig = bowl()
    cut, pairs = split_at_seam(rig, 4, 9)
    whole, parts = NormalField(rig), NormalField(cut)
    for weights in (np.zeros(3), np.array([1.0, 0.5, 0.2]), np.array([0.9, 0.5, 0.2])):
        normals = parts.normals(cut.evaluate(weights))
        np.testing.assert_allclose(normals[pairs[:, 0]], normals[pairs[:, 1]], rtol=1e-6)
        assert degrees_apart(normals[: rig.vertex_count], whole.normals(rig.evaluate(weights))).max() < 0.01


def test_vertices_that_part_company_and_sharp_corners_are_not_smoothed_into_one() -> None:
    # Two lips that touch in the neutral: the same places, but a shape moves one of them.
    lips = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.3], [0, 0, 0], [1, 0, 0], [0, -1, 0.3]], np.float64)
    corners, sizes = [0, 1, 2, 3, 5, 4], [3, 3]
    apart = np.zeros((6, 3))
    together = np.ones((6, 3))
    apart[3:] = (0, -0.5, 0)
    joined = NormalField(build_rig("joined", lips, corners, sizes, [("t", together)])).normals(
        lips.astype("f4")
    )
    parted = NormalField(build_rig("parted", lips, corners, sizes, [("a", apart)])).normals(lips.astype("f4"))
    np.testing.assert_allclose(joined[0], joined[3], atol=1e-6)
    assert degrees_apart(parted[:1], parted[3:4])[0] > 20
    # Two walls that meet at a right angle, and a card whose back is its own faces: both stay apart.
    for other in ([0, 0, 1], [0, 1, 0]):
        walls = np.vstack([lips[:3] * (1, 1, 0), lips[:3] * (1, 1, 0)])
        walls[5] = other
        field = NormalField(build_rig("walls", walls, [0, 1, 2, 3, 5, 4], sizes, [("t", together)]))
        normals = field.normals(walls.astype(np.float32))
        assert degrees_apart(normals[:1], normals[3:4])[0] > 60
