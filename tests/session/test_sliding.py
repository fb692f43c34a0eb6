"""What hands on sliders do to the weights."""

from dataclasses import replace

import numpy as np

from facepin.core.control import ShapeControl
from facepin.session.hand.sliding import gained, reset, slid, within
from support.small_rigs import sheet

WEIGHTS = np.array([0.5, -0.2, 1.4, 0.0])


def control(**changes: object) -> ShapeControl:
    return replace(ShapeControl.of(sheet()), **changes)  # type: ignore[arg-type]


def test_sliders_change_what_they_are_told_and_nothing_else() -> None:
    before = WEIGHTS.copy()
    assert slid(WEIGHTS, {3: 0.7, 0: 0.0}).tolist() == [0.0, -0.2, 1.4, 0.7]
    assert np.array_equal(WEIGHTS, before)


def test_a_slider_stops_at_its_limits_and_comes_back_from_beyond() -> None:
    held = control()
    assert within(held, WEIGHTS, 0, 1.7) == 1.0
    assert within(held, WEIGHTS, 0, -3.0) == 0.0
    assert within(held, WEIGHTS, 2, 1.3) == 1.3
    assert within(held, WEIGHTS, 2, 1.6) == 1.4
    assert within(held, WEIGHTS, 1, -0.1) == -0.1


def test_a_tie_stops_a_hand() -> None:
    tied = control(ties=((3, 0), (2, 0)))
    assert within(tied, WEIGHTS, 3, 0.9) == 0.5
    assert within(tied, WEIGHTS, 2, 1.3) == 1.3, "from beyond it comes back"


def test_the_gain_scales_within_limits_and_leaves_locked_weights() -> None:
    held = control(locked=np.array([False, True, False, False]))
    assert gained(held, WEIGHTS, 0.5).tolist() == [0.25, -0.2, 0.7, 0.0]
    assert gained(held, WEIGHTS, 4.0).tolist() == [1.0, -0.2, 1.4, 0.0]
    assert np.array_equal(gained(held, WEIGHTS, 1.0), WEIGHTS)


def test_a_reset_leaves_locked_weights() -> None:
    held = control(locked=np.array([True, False, False, False]))
    assert reset(held, WEIGHTS).tolist() == [0.5, 0.0, 0.0, 0.0]
    assert reset(held, WEIGHTS, np.array([2])).tolist() == [0.5, -0.2, 0.0, 0.0]
