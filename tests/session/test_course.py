"""Where a goal is led to by a hand that trembles, or wants to be exact."""

import numpy as np
import pytest

from facepin.core.events import PointerMoved, PointerPressed
from facepin.session.hand.course import Course
from facepin.session.hand.drag import DragTool
from support.seen_sheet import pixel_of, sight


def test_a_tremor_within_the_slack_moves_nothing_and_a_steady_move_lags_by_no_more() -> None:
    course = Course((0.0, 0.0), slack=1.0)
    random = np.random.default_rng(1)
    for angle in random.uniform(0, 2 * np.pi, 100):
        assert course.lead((0.9 * float(np.cos(angle)), 0.9 * float(np.sin(angle)))) == (0.0, 0.0)
    for x in range(1, 200, 7):
        at = course.lead((float(x), 0.0))
        assert at[0] == pytest.approx(x - 1.0)


def test_without_slack_the_goal_is_where_the_mouse_is() -> None:
    course = Course((3.0, 4.0))
    for pixel in ((3.1, 4.0), (50.0, -20.0), (3.0, 4.0)):
        assert course.lead(pixel) == pytest.approx(pixel)


def test_shift_held_since_the_press_selects_and_makes_nothing_finer_before_it_was_let_go() -> None:
    course = Course((0.0, 0.0), coarse=True)
    assert course.lead((10.0, 0.0), fine=True) == (10.0, 0.0)
    assert course.lead((20.0, 0.0), fine=False) == (20.0, 0.0)
    assert course.lead((30.0, 0.0), fine=True) == (22.0, 0.0)


def test_a_steady_hand_is_for_whoever_wants_it() -> None:
    for steady in (False, True):
        tool, seen = DragTool(), sight(steady=steady)
        x, y = pixel_of(40)
        tool.handle(PointerPressed(x, y), seen)
        tool.handle(PointerMoved(x + 20, y), seen)
        first = tool.handle(PointerMoved(x + 20.5, y + 0.5), seen)
        second = tool.handle(PointerMoved(x + 20.1, y + 0.1), seen)
        assert first is not None and second is not None
        assert (first.pins == second.pins) == steady
