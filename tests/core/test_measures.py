"""The measures, on figures that can be checked by hand."""

import math

import numpy as np
import pytest

from facepin.core.pose import Pin
from facepin.core.shapes import measures

SQUARE = np.array([[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], np.float32)


def moved(*changes: tuple[int, float, float, float]) -> np.ndarray:
    positions = SQUARE.copy()
    for vertex, *change in changes:
        positions[vertex] += change
    return positions


def test_e_rms_is_equation_9() -> None:
    weights, reference = np.array([0.1, 0.5, 0.0, 1.0]), np.array([0.1, 0.2, 0.4, 1.0])
    assert measures.e_rms(weights, reference) == pytest.approx(math.sqrt((0.3**2 + 0.4**2) / 4))
    np.testing.assert_allclose(measures.weight_errors(weights, reference), [0, 0.3, 0.4, 0], atol=1e-15)
    assert measures.e_rms(np.zeros(0), np.zeros(0)) == 0.0


def test_pin_error_counts_what_the_pin_constrains() -> None:
    positions = moved((1, 0, 0, 2))
    space = Pin(1, (4.0, 3.0, 6.0), stiffness=9.0)
    screen = Pin(1, (4.0, 3.0, 6.0), "screen")
    side = Pin(1, (4.0, 3.0, 6.0), "screen", axes=((0.0, 0.0, -1.0), (0.0, 1.0, 0.0)))
    np.testing.assert_allclose(measures.pin_errors(positions, (space, screen, side)), [5.0, 3.0, 5.0])
    assert measures.pin_error(positions, (space, screen, side)) == pytest.approx(13 / 3)
    assert measures.pin_error(positions, ()) == 0.0


def test_far_motion_looks_only_where_the_reference_rests() -> None:
    reference = moved((0, 0, 1, 0), (1, 0, 0, 0.002))
    at_rest = measures.resting(reference, SQUARE, height=4.0)
    np.testing.assert_array_equal(at_rest, [False, True, True, True])
    positions = moved((0, 0, 3, 0), (2, 0.3, 0.4, 0), (3, 0.1, 0, 0))
    assert measures.far_motion(positions, SQUARE, at_rest) == pytest.approx(0.5)
    assert measures.far_motion(positions, SQUARE, np.zeros(4, bool)) == 0.0
    assert measures.percent(0.5, 4.0) == 12.5


def test_far_from_pins_is_measured_on_the_neutral() -> None:
    pins = (Pin(0, (9.0, 9.0, 9.0)), Pin(1, (4.0, 0.0, 0.0)))
    np.testing.assert_array_equal(measures.far_from_pins(SQUARE, pins, 3.0), [False, False, True, True])
    assert measures.far_from_pins(SQUARE, (), 3.0).all()


def test_vertex_error_is_a_mean_distance() -> None:
    assert measures.vertex_error(moved((0, 3, 4, 0)), moved((2, 0, 0, 3))) == pytest.approx((5 + 3) / 4)
    assert measures.vertex_error(SQUARE[:0], SQUARE[:0]) == 0.0
    np.testing.assert_allclose(measures.moves(moved((0, 3, 4, 0)), SQUARE), [5, 0, 0, 0])


def test_counts_of_weights() -> None:
    limits = np.array([[0, 1], [0, 1], [-1, 1], [0, 2], [0, 1]])
    weights = np.array([1.2, -0.01, -0.8, 1.9, 1 + 1e-9])
    assert measures.out_of_range(weights, limits) == 2
    assert measures.active(np.array([0.05, 0.051, -0.3, 0.0])) == 2


def test_travel_adds_every_change() -> None:
    path = np.array([[0.0, 0.0], [1.0, 0.5], [0.5, 0.5], [1.0, 0.5]])
    assert measures.travel(path) == pytest.approx(2.5)
    assert measures.travel(path[:1]) == 0.0
