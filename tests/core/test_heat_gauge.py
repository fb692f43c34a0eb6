import numpy as np

from facepin.core.pose import Pin, Pose
from facepin.session.heat import HeatGauge
from facepin.session.solving.solving import choose
from facepin.session.work import Pane
from facepin.solvers.transpose import TransposeSettings
from support.small_rigs import sheet


def test_the_reach_of_a_radius_falls_off_along_the_skin() -> None:
    rig = sheet()
    pin = Pin(40, tuple(rig.neutral[40].tolist()))
    gauge = HeatGauge(rig)
    pane = Pane(choose("transpose", TransposeSettings(radius=25.0)), Pose(np.zeros(4), (pin,)), np.zeros(4))
    reach = gauge.reach(pane)
    assert reach is gauge.reach(pane)
    assert reach[40] == 1
    distance = np.linalg.norm(rig.neutral - rig.neutral[40], axis=1)
    assert (reach[distance > 0.25 * rig.height + 1e-6] == 0).all()
    beside = np.flatnonzero(np.isclose(distance, 0.25))  # one edge away: half the radius
    np.testing.assert_allclose(reach[beside], 0.5, atol=1e-5)
    off = Pane(choose("transpose"), Pose(np.zeros(4), (pin,)), np.zeros(4))
    assert not gauge.reach(off).any()


def test_what_a_shape_moves_is_shown_in_shares_of_its_largest_move() -> None:
    rig = sheet()
    gauge = HeatGauge(rig)
    for j in range(rig.shape_count):
        shown = gauge.shape(j)
        assert gauge.shape(j) is shown
        moved = np.linalg.norm(rig.evaluate(np.eye(rig.shape_count)[j]) - rig.neutral, axis=1)
        np.testing.assert_allclose(shown, moved / moved.max(), atol=1e-5)
