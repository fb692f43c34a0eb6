"""The scale and the colours of the heat map, and what is measured for it."""

from dataclasses import replace

import numpy as np
import pytest

from facepin.core.control import ShapeControl
from facepin.core.look.heat import FULL, STOPS, from_oklab, heat_colours, heat_scale, hex_colours, oklab
from facepin.core.pose import rest_pose
from facepin.session.heat import HeatGauge
from facepin.session.solving.solving import choose
from facepin.session.work import Pane
from support.small_rigs import sheet

# Machado, Oliveira and Fernandes (2009), severity 1, on linear light.
BLINDNESS = {
    "protanopia": [
        [0.152286, 1.052583, -0.204868],
        [0.114503, 0.786281, 0.099216],
        [-0.003882, -0.048116, 1.051998],
    ],
    "deuteranopia": [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ],
    "tritanopia": [
        [1.255528, -0.076749, -0.178779],
        [-0.078411, 0.930809, 0.147602],
        [0.004733, 0.691367, 0.303900],
    ],
}


@pytest.mark.parametrize("height", [0.00123, 0.3, 1.0, 17.0, 27.78, 33.8, 2e5])
def test_the_scale_is_round_and_fits_the_face(height: float) -> None:
    scale = heat_scale(height)
    assert scale.top == pytest.approx(FULL * height, rel=0.16)
    assert [f"{tick / scale.step:.6g}" for tick in scale.ticks] == ["0", "1", "2", "3"]
    assert len(f"{scale.step:.10e}".split("e")[0].rstrip("0").replace(".", "")) <= 2, "two digits say it"


def test_lightness_grows_in_equal_steps() -> None:
    colours = oklab(heat_colours(64))
    assert (np.diff(colours[:, 0]) > 0).all()
    steps = np.linalg.norm(np.diff(colours, axis=0), axis=1)
    assert steps.max() < 1.1 * np.median(steps)
    assert steps.min() > 0.75 * np.median(steps), "corners are cut a little"
    assert np.hypot(*colours[0, 1:]) < 0.015, "nothing is grey"
    np.testing.assert_allclose(heat_colours()[[0, -1]], hex_colours((STOPS[0], STOPS[-1])), atol=1e-6)


@pytest.mark.parametrize("kind", BLINDNESS)
def test_colour_blind_people_tell_the_ticks(kind: str) -> None:
    colours = heat_colours(7)
    light = np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)
    seen = np.clip(light @ np.array(BLINDNESS[kind]).T, 0, 1)
    lab = oklab(np.where(seen <= 0.0031308, 12.92 * seen, 1.055 * seen ** (1 / 2.4) - 0.055))
    apart = np.linalg.norm(lab[:, None] - lab, axis=2)[np.triu_indices(7, 1)]
    assert apart.min() > 0.04, "twice what can just be told"


def test_oklab_is_undone() -> None:
    colours = np.random.default_rng(1).uniform(0, 1, (50, 3))
    np.testing.assert_allclose(from_oklab(oklab(colours)), colours, atol=1e-6)
    np.testing.assert_allclose(oklab(np.ones((1, 3))), [[1, 0, 0]], atol=1e-6)


def test_moves_are_measured_from_where_the_drag_began() -> None:
    rig = sheet()
    gauge, control = HeatGauge(rig), ShapeControl.of(rig)
    start, now = np.array([0.5, 0, 0, 0]), np.array([0.5, 0.7, 0, 0])
    rest = rest_pose(rig)
    positions = rig.evaluate(now)
    pane = Pane(choose("transpose"), rest.with_weights(now), now)

    free = gauge.heat(pane, control, positions)
    dragged = gauge.heat(replace(pane, began=rest.with_weights(start)), control, positions)
    top = heat_scale(rig.height).top
    for heat, origin in ((free, rig.neutral), (dragged, rig.evaluate(start))):
        expected = np.sqrt(((positions - origin).astype(np.float64) ** 2).sum(axis=1)) / top
        np.testing.assert_allclose(heat, expected, atol=1e-6)
    assert free.max() > dragged.max() > 0


def test_the_same_moves_are_measured_once() -> None:
    rig = sheet()
    gauge, rest, control = HeatGauge(rig), rest_pose(rig), ShapeControl.of(rig)
    pane = replace(Pane(choose("transpose"), rest, rest.weights), began=rest)
    first = gauge.heat(pane, control, rig.neutral)
    assert gauge.heat(pane, control, rig.neutral) is first
    assert gauge.heat(replace(pane), control, rig.neutral) is first, "the drag goes on"
    assert not gauge.heat(pane, control, rig.neutral.copy()).any()
