"""Where shapes move a face, and which shapes move a vertex."""

import numpy as np

from facepin.core.shapes.motion import NOTABLE, movers, shape_moves, shape_places
from support.small_rigs import sheet


def test_moves_of_a_shape_are_those_of_the_posed_face() -> None:
    rig = sheet()
    for j, weights in enumerate(np.eye(rig.shape_count)):
        expected = np.linalg.norm(rig.evaluate(weights) - rig.neutral, axis=1)
        assert np.allclose(shape_moves(rig, j), expected, atol=1e-6)


def test_movers_of_a_vertex_are_the_shapes_that_move_it_strongest_first() -> None:
    rig = sheet(shapes=12)
    all_moves = np.array([shape_moves(rig, j) for j in range(rig.shape_count)])
    for vertex in (0, 20, 40):
        found = movers(rig, vertex)
        lengths = [length for _, length in found]
        assert lengths == sorted(lengths, reverse=True)
        assert np.allclose(lengths, [all_moves[j, vertex] for j, _ in found], rtol=1e-5)
        notable = all_moves[:, vertex] >= NOTABLE * max(all_moves[:, vertex].max(), 1e-9)
        assert {j for j, _ in found} == set(np.flatnonzero(notable & (all_moves[:, vertex] > 0)).tolist())


def test_places_are_means_over_the_motion() -> None:
    rig = sheet(shapes=6)
    places = shape_places(rig)
    for j in range(rig.shape_count):
        weight = shape_moves(rig, j) ** 2
        x, y, _ = rig.neutral.T
        assert np.isclose(places.height[j], np.average(y, weights=weight), atol=1e-6)
        assert np.isclose(places.out[j], np.average(abs(x), weights=weight), atol=1e-6)
        assert np.isclose(places.left[j], np.average(x > 0, weights=weight), atol=1e-6)
