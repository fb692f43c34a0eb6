"""Edges, welds, closed surfaces and draw order against counting by hand."""

from pathlib import Path

import numpy as np
import pytest

from facepin.core.arrays import Floats, Indices
from facepin.core.mesh.topology import connected, draw_order, edge_count, hidden_sides, morton_codes, weld_map
from facepin.core.rig import Rig
from facepin.core.rig_builder import PartLook, build_rig
from facepin.files.formats import open_rig
from support.small_rigs import sheet

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], np.float64)
CUBE_FACES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]


def rig_of(points: Floats, faces: list[list[int]], move: Floats | None = None, **more: object) -> Rig:
    deltas = np.ones_like(points) if move is None else move
    corners, sizes = [v for face in faces for v in face], [len(face) for face in faces]
    return build_rig("rig", points, corners, sizes, [("move", deltas)], **more)  # type: ignore[arg-type]


def grid(points: Floats, rows: int, columns: int, closed: bool = False) -> tuple[Floats, list[list[int]]]:
    """Quads over a grid of points; `closed` joins the last column to the first."""
    faces = []
    for i in range(rows - 1):
        for j in range(columns - (0 if closed else 1)):
            k = (j + 1) % columns
            faces.append([i * columns + j, (i + 1) * columns + j, (i + 1) * columns + k, i * columns + k])
    return points, faces


def turned(profile: list[tuple[float, float]], sides: int = 24) -> Rig:
    """A surface of revolution about y from (radius, height) pairs, top first, open at both ends."""
    turn = np.linspace(0, 2 * np.pi, sides, endpoint=False)
    points = np.array([(r * np.sin(a), h, r * np.cos(a)) for r, h in profile for a in turn])
    return rig_of(*grid(points, len(profile), sides, closed=True))


def reversed_faces(faces: list[list[int]]) -> list[list[int]]:
    return [face[::-1] for face in faces]


def test_edges_are_those_of_the_faces() -> None:
    assert edge_count(rig_of(CUBE, CUBE_FACES)) == 12
    columns, rows = 9, 7
    assert edge_count(sheet(columns, rows)) == (columns - 1) * rows + columns * (rows - 1)
    assert edge_count(rig_of(CUBE, [[0, 1, 3], [0, 3, 2], [2, 3, 7, 6, 4]])) == 9


def test_edges_of_a_real_face_fit_eulers_formula(shared: Path) -> None:
    rig = open_rig(shared / "models" / "ict-facekit" / "ict_full153.npz")
    edges = set()
    for face in np.split(rig.corners, np.cumsum(rig.face_sizes)[:-1]):
        loop = face.tolist()
        edges |= {frozenset(pair) for pair in zip(loop, loop[1:] + loop[:1], strict=True)}
    assert edge_count(rig) == len(edges) == 53014


def test_welds_join_what_always_coincides() -> None:
    points = np.array(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 0, 0]], np.float64
    )
    move = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 1, 0], [0, 0, 2], [0, 0, 0], [1, 0, 0]], np.float64)
    rig = rig_of(points, [[0, 1, 2], [3, 5, 4]], move)
    assert weld_map(rig).tolist() == [0, 1, 2, 1, 4, 5, 0]


def test_welds_tell_zero_from_nothing_and_leave_whole_meshes_alone() -> None:
    assert weld_map(sheet()).tolist() == list(range(81))
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [-0.0, 0, 0], [0, -1, 0], [1, 0, 0]])
    assert weld_map(rig_of(points, [[0, 1, 2], [3, 4, 5]])).tolist() == [0, 1, 2, 0, 4, 1]


def test_a_closed_box_hides_its_backs_and_an_inside_out_one_its_fronts() -> None:
    assert (hidden_sides(rig_of(CUBE, CUBE_FACES)) == 1).all()
    assert (hidden_sides(rig_of(CUBE, reversed_faces(CUBE_FACES))) == -1).all()
    assert (hidden_sides(rig_of(CUBE * 1e-4 + 100, CUBE_FACES, np.zeros((8, 3)))) != -1).all()


def test_a_box_split_along_its_edges_is_still_closed() -> None:
    points = CUBE[np.array(CUBE_FACES).ravel()]
    rig = rig_of(points, np.arange(24).reshape(6, 4).tolist())
    assert (hidden_sides(rig) == 1).all()


def test_sheets_half_masks_and_open_tubes_show_both_sides() -> None:
    assert (hidden_sides(sheet()) == 0).all()
    half = [(np.sin(t), np.cos(t)) for t in np.linspace(0.05, np.pi / 2, 9)]
    assert (hidden_sides(turned(half)) == 0).all(), "a hemisphere: the hole is half as large as the dome"
    assert (hidden_sides(turned([(1.0, 1.0), (1.0, 0.0), (1.0, -1.0)])) == 0).all(), "a tube"


def test_a_head_with_a_neck_opening_counts_as_closed() -> None:
    head = [(np.sin(t), np.cos(t)) for t in np.linspace(0.02, np.pi - 0.5, 15)]
    assert (hidden_sides(turned(head)) == 1).all()


def test_surfaces_whose_triangles_disagree_show_both_sides() -> None:
    faces = [*CUBE_FACES[:5], CUBE_FACES[5][::-1]]
    assert (hidden_sides(rig_of(CUBE, faces)) == 0).all()


def test_each_surface_of_a_part_is_judged_on_its_own() -> None:
    flap = np.array([[5, 0, 0], [6, 0, 0], [6, 1, 0]], np.float64)
    rig = rig_of(
        np.vstack([CUBE, flap, CUBE + 9]),
        [*CUBE_FACES, [8, 9, 10], *[[v + 11 for v in f[::-1]] for f in CUBE_FACES]],
    )
    assert hidden_sides(rig).tolist() == [1] * 12 + [0] + [-1] * 12


def cache_misses(triangles: Indices, size: int = 32) -> float:
    """Vertices shaded per triangle by a card that remembers the last `size`."""
    cache: list[int] = []
    misses = 0
    for vertex in triangles.ravel().tolist():
        if vertex not in cache:
            misses += 1
            cache = [*cache[-size + 1 :], vertex]
    return misses / len(triangles)


def test_draw_order_keeps_the_triangles_and_sorts_them_by_part_and_side() -> None:
    flap = np.array([[5, 0, 0], [6, 0, 0], [6, 1, 0]], np.float64)
    rig = rig_of(
        np.vstack([flap, CUBE, CUBE + 9]),
        [[0, 1, 2], *[[v + 3 for v in f] for f in CUBE_FACES], *[[v + 11 for v in f] for f in CUBE_FACES]],
        parts=(PartLook("first"), PartLook("second")),
        face_parts=[0] * 7 + [1] * 6,
    )
    order = draw_order(rig)
    np.testing.assert_array_equal(order.triangles, rig.triangles[order.names])
    np.testing.assert_array_equal(np.sort(order.names), np.arange(25))
    assert [(run.part, len(run.triangles), run.hidden) for run in order.runs] == [
        (0, 1, None),
        (0, 12, "back"),
        (1, 12, "back"),
    ]
    assert [run.triangles.start for run in order.runs] == [0, 1, 13]


def test_draw_order_makes_compact_patches() -> None:
    rig = sheet(columns=80, rows=80)
    shuffled = rig.triangles[np.random.default_rng(0).permutation(len(rig.triangles))]
    assert cache_misses(draw_order(rig).triangles) < 0.85
    assert cache_misses(rig.triangles) > 0.95, "row by row a vertex is forgotten before the next row needs it"
    assert cache_misses(shuffled) > 2.5


def test_connected() -> None:
    pairs = np.array([[7, 2], [2, 5], [9, 8], [3, 3]])
    assert connected(10, pairs).tolist() == [0, 1, 2, 3, 4, 2, 6, 2, 8, 8]
    assert connected(3, np.zeros((0, 2), np.intp)).tolist() == [0, 1, 2]


@pytest.mark.parametrize("seed", range(3))
def test_connected_agrees_with_scipy(seed: int) -> None:
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    random = np.random.default_rng(seed)
    chain = np.stack([random.permutation(2000)[:-1]] * 2, axis=1)
    chain[1:, 0] = chain[:-1, 1]
    pairs = np.vstack([chain[: 700 * seed], random.integers(0, 2000, (900, 2))])
    graph = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(2000, 2000))
    count, expected = connected_components(graph, directed=False)
    label = connected(2000, pairs)
    assert len(np.unique(label)) == count == len(np.unique(np.stack([label, expected]), axis=1).T)


def test_morton_codes_interleave_the_bits() -> None:
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]], np.float32)
    full = 2**30 - 1
    x, y, z = (sum(1 << (3 * bit + axis) for bit in range(10)) for axis in range(3))
    assert morton_codes(corners).tolist() == [0, x, y, z, full]
    assert morton_codes(np.zeros((0, 3), np.float32)).shape == (0,)
    assert morton_codes(np.ones((2, 3), np.float32)).tolist() == [0, 0]


def test_a_real_bust_is_culled_but_not_its_lashes(shared: Path) -> None:
    rig = open_rig(shared / "models" / "ict-facekit" / "ict_full153.npz")
    sides = hidden_sides(rig)
    assert (sides >= 0).all()
    assert 0.9 < (sides == 1).mean() < 0.95
