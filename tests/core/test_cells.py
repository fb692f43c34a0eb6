"""How faces are cut into cells; what the cells are for is tested with the normals."""

from collections.abc import Sequence

import numpy as np
import pytest

from facepin.core.arrays import Floats
from facepin.core.mesh import area_vectors
from facepin.core.mesh.area_vectors import AreaVectors
from facepin.core.mesh.cells import Cells, make_cells
from facepin.core.rig_builder import build_rig

SQUARES = np.array([[x, y, 0] for y in range(3) for x in range(4)], np.float64)


def cells_of(points: Floats, faces: Sequence[Sequence[int]]) -> Cells:
    corners = [vertex for face in faces for vertex in face]
    return make_cells(build_rig("cells", points, corners, [len(f) for f in faces], [("up", points + 1)]))


def diagonals(cells: Cells) -> list[list[list[int]]]:
    return np.moveaxis(cells.diagonals, 2, 0).tolist()


def test_area_vectors_of_a_square_and_of_its_half() -> None:
    points = np.array([[0, 0, 1], [2, 0, 1], [2, 2, 1], [0, 2, 1]], np.float32)
    both = np.array([[[0, 0], [2, 1]], [[1, 0], [3, 2]]])
    np.testing.assert_array_equal(AreaVectors(4, both).of(points)[:, :3], [[0, 0, 8], [0, 0, 4]])


@pytest.mark.parametrize("block", [1, 2, 7, 1000])
def test_area_vectors_of_many_cells_again_and_again(block: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(area_vectors, "BLOCK", block)
    random = np.random.default_rng(block)
    diagonals = random.integers(30, size=(2, 2, 50))
    computed = AreaVectors(30, diagonals)
    for _ in range(3):
        points = random.normal(size=(30, 3)).astype(np.float32)
        (a, b), (c, d) = points[diagonals]
        np.testing.assert_array_equal(computed.of(points)[:, :3], np.cross(b - a, d - c))


@pytest.mark.parametrize(
    ("corners", "quads", "triangles"), [(3, 0, 1), (4, 1, 0), (5, 1, 1), (6, 2, 0), (9, 3, 1)]
)
def test_a_face_is_cut_into_as_few_cells_as_possible(corners: int, quads: int, triangles: int) -> None:
    turn = 2 * np.pi * np.arange(corners) / corners
    points = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    cells = cells_of(points, [range(corners)])
    assert cells.diagonals.shape[2] == quads + triangles
    areas = AreaVectors(corners, cells.diagonals).of(points.astype(np.float32))[:, :3]
    np.testing.assert_allclose(areas.sum(axis=0), [0, 0, corners * np.sin(2 * np.pi / corners)], atol=1e-6)


def test_a_quad_that_a_file_holds_as_two_triangles_is_one_cell() -> None:
    assert diagonals(cells_of(SQUARES, [[0, 1, 5], [0, 5, 4]])) == [[[1, 4], [5, 0]]]
    assert diagonals(cells_of(SQUARES, [[1, 5, 0], [4, 0, 5]])) == [[[1, 4], [5, 0]]], "wherever they begin"


def test_a_run_of_triangles_is_paired_two_by_two() -> None:
    row = [[0, 1, 5], [0, 5, 4], [1, 2, 6], [1, 6, 5], [2, 3, 7], [2, 7, 6]]
    assert cells_of(SQUARES, row).diagonals.shape[2] == 3
    assert cells_of(SQUARES, row[:5]).diagonals.shape[2] == 3
    assert cells_of(SQUARES, row[1:]).diagonals.shape[2] == 3


@pytest.mark.parametrize(
    ("why", "points", "faces"),
    [
        ("apart", SQUARES, [[0, 1, 4], [2, 3, 7]]),
        ("one corner in common", SQUARES, [[0, 1, 5], [5, 6, 10]]),
        ("wound against each other", SQUARES, [[0, 1, 5], [0, 4, 5]]),
        ("the same twice", SQUARES, [[0, 1, 5], [0, 1, 5]]),
        ("folded", SQUARES + [[0, 0, x == 4] for x in range(12)], [[0, 1, 5], [0, 5, 4]]),
        ("not convex", SQUARES, [[0, 3, 5], [0, 5, 8]]),
        ("without area", SQUARES, [[0, 1, 2], [0, 2, 3]]),
    ],
)
def test_other_neighbours_stay_triangles(why: str, points: Floats, faces: list[list[int]]) -> None:
    assert cells_of(points, faces).diagonals.shape[2] == 2, why
