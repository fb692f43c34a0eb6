"""Limits, locks, mutes and solos as values."""

from dataclasses import replace

import numpy as np
import pytest

from facepin.core.control import ShapeControl
from facepin.core.errors import FacepinError
from support.small_rigs import sheet

RIG = sheet()
FREE = ShapeControl.of(RIG)
WEIGHTS = np.array([0.5, 0.0, 1.5, -0.2])


def flags(*shapes: int) -> np.ndarray:
    return np.isin(np.arange(4), shapes)


def test_a_rig_comes_with_its_own_limits_and_nothing_restrained() -> None:
    assert FREE.limits is RIG.limits
    assert not FREE.held.any()
    assert FREE.heard(WEIGHTS) is WEIGHTS
    assert FREE.keeping_locked(WEIGHTS, np.zeros(4)) is WEIGHTS


def test_muted_shapes_are_not_heard() -> None:
    control = replace(FREE, muted=flags(0, 1))
    assert control.heard(WEIGHTS).tolist() == [0, 0, 1.5, -0.2]
    quiet = np.array([0, 0, 1.0, 0])
    assert control.heard(quiet) is quiet
    assert WEIGHTS[0] == 0.5


def test_solo_silences_all_others_but_not_a_muted_one() -> None:
    control = replace(FREE, solo=flags(2, 3), muted=flags(3))
    assert control.heard(WEIGHTS).tolist() == [0, 0, 1.5, 0]
    assert control.silent.tolist() == [True, True, False, True]


def test_solvers_get_what_is_neither_locked_nor_silent() -> None:
    control = replace(FREE, locked=flags(0), muted=flags(3))
    assert control.free.tolist() == [1, 2]


def test_locked_weights_stay() -> None:
    control = replace(FREE, locked=flags(1, 2))
    new = np.array([1.0, 0.0, 0.0, 1.0])
    assert control.keeping_locked(new, WEIGHTS).tolist() == [1, 0, 1.5, 1]
    assert control.breaks_lock(new, WEIGHTS).tolist() == [False, False, True, False]


def test_clipping_leaves_what_began_outside() -> None:
    control = replace(FREE, limits=np.array([[0, 1], [0, 0.5], [-1, 1], [0, 1.0]]))
    found = control.clipped(np.array([3.0, 3, -3, -3]), WEIGHTS)
    np.testing.assert_array_equal(found, [1, 0.5, -1, -0.2])
    np.testing.assert_array_equal(control.clipped(np.array([0, 0, 3.0, 0]), WEIGHTS), [0, 0, 1.5, 0])


def test_nothing_in_it_can_be_changed_and_nothing_outside_is_frozen() -> None:
    limits, locked = np.tile([0.0, 1.0], (4, 1)), flags()
    control = replace(FREE, limits=limits, locked=locked)
    limits[0] = locked[0] = 1
    assert not control.locked.any()
    for array in (control.limits, control.locked, control.muted, control.solo):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1


@pytest.mark.parametrize("pair", [[1, 0], [0, np.nan], [-np.inf, 1]])
def test_limits_out_of_order_are_refused(pair: list[float]) -> None:
    limits = np.tile([0.0, 1.0], (4, 1))
    limits[2] = pair
    with pytest.raises(FacepinError, match="lowest first"):
        replace(FREE, limits=limits)
