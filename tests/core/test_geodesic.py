"""Distances along the surface, against a plain heap search and against what is known of a flat sheet."""

import heapq
from pathlib import Path

import numpy as np
import pytest

from facepin.core.mesh.geodesic import geodesic_distances, shape_locality
from facepin.core.mesh.topology import weld_map
from facepin.core.pose import Pin, pin_displacement, pin_rows
from facepin.core.rig import Rig
from facepin.core.rig_builder import build_rig
from facepin.files import open_rig
from facepin.session.solving.solving import PinSolver, choose
from facepin.solvers.transpose import TransposeSettings
from support.small_rigs import sheet


def by_heap(rig: Rig, sources: list[int], limit: float) -> np.ndarray:
    """Dijkstra's algorithm, written out."""
    weld = weld_map(rig).tolist()
    neighbours: dict[int, set[int]] = {}
    at = 0
    for size in rig.face_sizes.tolist():
        face = [weld[v] for v in rig.corners[at : at + size].tolist()]
        at += size
        for v in face:
            neighbours.setdefault(v, set()).update(face if size == 4 else [])
    for triangle in rig.triangles.tolist():
        face = [weld[v] for v in triangle]
        for v in face:
            neighbours[v].update(face)
    points = rig.neutral.astype(np.float64)
    found = dict.fromkeys(range(rig.vertex_count), np.inf)
    heap = [(0.0, weld[v]) for v in sources]
    while heap:
        distance, v = heapq.heappop(heap)
        if distance >= found[v] or distance > limit:
            continue
        found[v] = distance
        for other in neighbours[v]:
            heapq.heappush(heap, (distance + float(np.linalg.norm(points[v] - points[other])), other))
    return np.array([found[weld[v]] for v in range(rig.vertex_count)])


@pytest.mark.parametrize("limit", [0.3, 1.1, 10.0])
@pytest.mark.parametrize("sources", [[40], [0, 44, 80]])
def test_equals_a_plain_search(sources: list[int], limit: float) -> None:
    rig = sheet()
    distances = geodesic_distances(rig, sources, limit)
    np.testing.assert_allclose(distances, by_heap(rig, sources, limit), rtol=1e-12)
    assert not distances[sources].any()


def test_flat_sheets_are_measured_to_8_per_cent() -> None:
    rig = sheet(21, 21)
    distances = geodesic_distances(rig, [220], 9.0)
    straight = np.linalg.norm(rig.neutral - rig.neutral[220], axis=1)
    assert (distances >= straight * (1 - 1e-6)).all()
    assert (distances <= straight * 1.083 + 1e-6).all()
    np.testing.assert_allclose(distances[[210, 10, 0]], straight[[210, 10, 0]], rtol=1e-6)


def test_without_sources_everything_is_infinitely_far() -> None:
    assert np.isinf(geodesic_distances(sheet(), [], 1.0)).all()


def test_goes_through_seams_and_not_across_gaps() -> None:
    """Two squares that share an edge twice in the file are one; a third that only lies near is another."""
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float64)
    points = np.concatenate([square + offset for offset in np.array([[0, 0, 0], [1, 0, 0], [0, 1.001, 0]])])
    rig = build_rig("squares", points, np.arange(12), np.full(3, 4), [("up", points * [0, 1, 0])])
    distances = geodesic_distances(rig, [0], 5.0)
    assert distances[1] == distances[4] == 1.0
    assert distances[5] == 2.0
    assert np.isinf(distances[8:]).all()


@pytest.fixture(scope="module")
def narrow(shared: Path, tmp_path_factory: pytest.TempPathFactory) -> Rig:
    """A real face: its neutral and the opening of its jaw."""
    import tarfile

    folder = tmp_path_factory.mktemp("narrow")
    with tarfile.open(shared / "models/ict-facekit/ict_narrowface_expressions.tar.xz") as archive:
        names = [name for name in archive.getnames() if "neutral" in name or "jawOpen" in name]
        archive.extractall(folder, members=[archive.getmember(name) for name in names], filter="data")
    return open_rig(next(path for path in folder.rglob("*jawOpen*")).parent)


def test_equals_a_plain_search_on_a_face(narrow: Rig) -> None:
    sources, limit = [100, 3000], 0.25 * narrow.height
    distances = geodesic_distances(narrow, sources, limit)
    assert 50 < np.isfinite(distances).sum() < narrow.vertex_count
    np.testing.assert_allclose(distances, by_heap(narrow, sources, limit), rtol=1e-6)


def test_the_way_from_lip_to_lip_is_around_the_mouth(narrow: Rig) -> None:
    """Where the lips touch, vertices that follow the jaw lie a hair from vertices that do not."""
    x, y, z = narrow.neutral.T
    drop = -narrow.evaluate(np.ones(1)).T[1] + y
    follows = drop > 0.9 * np.quantile(drop, 0.98)
    upper = np.flatnonzero((np.abs(x) < 0.1) & (drop < 0.1 * drop.max()) & (z > np.quantile(z, 0.8)))
    gaps = {v: np.linalg.norm(narrow.neutral[follows] - narrow.neutral[v], axis=1).min() for v in upper}
    lip = min(gaps, key=lambda v: gaps[v])
    other = int(
        np.flatnonzero(follows)[
            np.argmin(np.linalg.norm(narrow.neutral[follows] - narrow.neutral[lip], axis=1))
        ]
    )
    straight = float(np.linalg.norm(narrow.neutral[lip] - narrow.neutral[other]))
    assert straight < 0.02 * narrow.height
    assert geodesic_distances(narrow, [lip], narrow.height)[other] > 5 * straight


def test_locality_is_the_share_of_squared_motion_under_the_kernel() -> None:
    rig = sheet(shapes=5)
    vertices, radius = [30, 50], 0.8
    kernel = np.maximum(1 - by_heap(rig, vertices, radius) / radius, 0)
    squares = [(rig.deltas[:, [j]].toarray().reshape(-1, 3) ** 2).sum(axis=1) for j in range(5)]
    expected = [kernel @ each / each.sum() for each in squares]
    found = shape_locality(rig, vertices, radius, np.zeros(5))
    np.testing.assert_allclose(found, expected, rtol=1e-5)
    assert (found >= 0).all() and found.max() < 1
    np.testing.assert_allclose(shape_locality(rig, list(range(81)), radius, np.zeros(5)), 1.0, rtol=1e-5)


def test_shapes_that_move_nothing_are_nowhere() -> None:
    rig = sheet()
    still = build_rig(
        "still", rig.neutral, rig.corners, rig.face_sizes, [("a", rig.neutral * 0), ("b", rig.neutral * 0)]
    )
    np.testing.assert_array_equal(shape_locality(still, [3], 1.0, np.zeros(2)), [0, 0])


def test_a_radius_reaches_the_solver_in_per_cent_of_the_height() -> None:
    rig = sheet(shapes=5)
    pins = (Pin(30, (0.3, 0.2, 0.1)), Pin(50, (0.1, -0.2, 0.0)))
    rows, displacement = pin_rows(rig, pins), pin_displacement(rig, pins)
    shares = shape_locality(rig, [30, 50], 0.4 * rig.height, np.zeros(5))
    g = shares * (displacement @ rows)
    step = (displacement @ rows @ g) / np.sum((rows @ g) ** 2)
    solved = PinSolver(rig, choose("transpose", TransposeSettings(radius=40.0))).solve(pins, np.zeros(5))
    np.testing.assert_allclose(solved.weights, step * g, rtol=1e-9)
