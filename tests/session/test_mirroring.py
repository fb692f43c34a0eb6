"""Left and right in the whole program."""

from dataclasses import replace

import numpy as np
import pytest

from facepin.core.pose import Pin
from facepin.core.shapes.mirror import find_mirror
from facepin.panels.commands import Command
from facepin.panels.requests import PairShapes
from facepin.session.edit import Edit
from facepin.session.hand.mirroring import linked_weights, mirrored_weights, with_twins
from support.driver import App, running
from support.small_rigs import sheet


def pose(app: App, **weights: float) -> np.ndarray:
    names = app.session.rig.shape_names
    values = np.array([weights.get(name, 0.0) for name in names])
    app.desk.apply(Edit("Pose", True, weights=values))
    return values


def weight(app: App, name: str) -> float:
    return float(app.session.pose.weights[app.session.rig.shape_names.index(name)])


@pytest.fixture(scope="module")
def app() -> App:
    with running() as app:
        yield app


def test_flip_and_mirror_and_back(app: App) -> None:
    before = pose(app, mouthSmileLeft=0.8, eyeBlinkRight=0.3, jawOpen=0.4)
    app.key("m", control=True)
    assert (weight(app, "mouthSmileRight"), weight(app, "mouthSmileLeft")) == (0.8, 0.0)
    assert (weight(app, "eyeBlinkLeft"), weight(app, "jawOpen")) == (0.3, 0.4)
    assert app.session.undo_label == "Flip the pose"
    app.key("z", control=True)
    np.testing.assert_array_equal(app.session.pose.weights, before)
    app.key("m", shift=True)
    assert (weight(app, "mouthSmileRight"), weight(app, "eyeBlinkRight")) == (0.8, 0.0)
    app.key("z", control=True)
    app.ask(Command.MIRROR_RIGHT)
    assert (weight(app, "mouthSmileLeft"), weight(app, "eyeBlinkLeft")) == (0.0, 0.3)


def test_what_has_no_twin_is_left_alone_and_named(app: App) -> None:
    names = app.session.rig.shape_names
    app.ask(PairShapes(names.index("mouthSmileLeft"), None))
    pose(app, mouthSmileLeft=0.8, eyeBlinkLeft=0.5)
    app.ask(Command.FLIP_POSE)
    assert (weight(app, "mouthSmileLeft"), weight(app, "eyeBlinkRight")) == (0.8, 0.5)
    assert "mouthSmileLeft" in app.desk.message
    app.ask(PairShapes(names.index("mouthSmileLeft"), names.index("mouthSmileRight")))
    app.ask(Command.FLIP_POSE)
    assert weight(app, "mouthSmileRight") == 0.8


def test_locked_weights_are_not_mirrored(app: App) -> None:
    pose(app, mouthSmileLeft=0.8)
    control = app.session.control
    locked = np.array([name == "mouthSmileRight" for name in app.session.rig.shape_names])
    app.session.set_control("Lock", replace(control, locked=locked))
    app.ask(Command.MIRROR_LEFT)
    assert weight(app, "mouthSmileRight") == 0.0
    assert "mouthSmileRight" in app.desk.message
    app.session.set_control("Unlock", control)


def test_a_pin_makes_its_twin_and_both_are_dragged_and_removed_as_one(app: App) -> None:
    app.key("home")
    app.ask(Command.CLEAR_PINS)
    rig, mirror = app.session.rig, app.session.mirror
    before = app.session.pose
    app.key("m")
    assert "both sides" in app.desk.message
    smile = rig.rows_at(range(rig.vertex_count))[:, rig.shape_names.index("mouthSmileLeft")]
    corner = int(np.argmax(np.linalg.norm(smile.reshape(-1, 3), axis=1)))
    x, y = app.pixel_of(corner)
    app.drag((x, y), (x + 15, y - 15))
    first, second = app.session.pose.pins
    assert second.vertex == mirror.vertices[first.vertex]
    np.testing.assert_allclose(second.goal, mirror.across(np.array(first.goal)), atol=1e-3)
    weights = app.session.pose.weights
    assert weights[rig.shape_names.index("mouthSmileLeft")] > 0.1
    np.testing.assert_allclose(mirror.flipped(weights), weights, atol=1e-3)

    # Dragging either one drags the other; keys do so too.
    x, y = app.pixel_of(second.vertex)
    app.drag((x, y), (x, y + 10))
    lower = app.session.pose.pins
    assert lower[0].goal[1] == pytest.approx(lower[1].goal[1], abs=1e-3)
    assert lower[0].goal[1] < first.goal[1]
    app.key("up", shift=True)
    app.until(lambda: not app.desk.tool.nudging)
    higher = app.session.pose.pins
    assert higher[0].goal[1] == pytest.approx(higher[1].goal[1], abs=1e-3)
    assert higher[0].goal[1] > lower[0].goal[1]

    app.key("delete")
    assert not app.session.pose.pins
    for _ in range(4):
        app.key("z", control=True)
    assert app.session.pose is before
    app.key("m")
    x, y = app.pixel_of(corner)
    app.drag((x, y), (x + 15, y - 15))
    assert len(app.session.pose.pins) == 1


def test_sliders_of_left_and_right_are_linked_while_symmetry_is_on(app: App) -> None:
    names = app.session.rig.shape_names
    pose(app, mouthSmileLeft=0.2, eyeBlinkRight=0.7)
    before, mirror = app.session.pose.weights, app.session.mirror
    smile = names.index("mouthSmileLeft")
    changed = before.copy()
    changed[smile] = 0.6
    linked = linked_weights(mirror, before, changed)
    assert linked[mirror.shapes[smile]] == linked[smile] == 0.6
    others = np.delete(np.arange(len(names)), [smile, mirror.shapes[smile]])
    np.testing.assert_array_equal(linked[others], before[others])
    # Where both were changed, as by a gain, nothing is exchanged.
    np.testing.assert_array_equal(linked_weights(mirror, before, 0.5 * before), 0.5 * before)


def test_a_pin_on_the_middle_line_holds_it_where_it_is_now() -> None:
    rig = sheet()
    mirror = find_mirror(rig)
    middle = int(np.flatnonzero(mirror.vertices == np.arange(rig.vertex_count))[0])
    positions = rig.neutral + np.float32((0.4, 0.0, 0.0))  # a jaw that went aside
    x, y, z = positions[middle].astype(float).tolist()
    (pin,) = with_twins(mirror, (), (Pin(middle, (x, y, z)),), positions)
    assert pin.goal == pytest.approx((x, y, z))


def test_a_hidden_twin_stays() -> None:
    rig = sheet()
    mirror = find_mirror(rig)
    vertex = int(np.flatnonzero((mirror.vertices >= 0) & (mirror.vertices != np.arange(rig.vertex_count)))[0])
    twin = int(mirror.vertices[vertex])
    pins = tuple(Pin(v, tuple(rig.neutral[v].astype(float).tolist())) for v in (vertex, twin))
    before = (pins[0], replace(pins[1], hidden=True))
    x, y, z = pins[0].goal
    after = (replace(pins[0], goal=(x, y + 0.5, z)), before[1])
    assert with_twins(mirror, before, after, rig.neutral)[1] == before[1]


def test_what_two_sides_have_in_common_is_nothing_where_they_disagree() -> None:
    rig = sheet()
    found = find_mirror(rig)
    mirror = replace(found, shapes=np.array([1, 0, 2, 3]), balance=np.zeros(4))
    for weights, common in (([0.5, -0.3], 0.0), ([-0.4, 0.0], 0.0), ([-0.4, -0.1], -0.1), ([0.3, 0.8], 0.3)):
        result = mirrored_weights(mirror, np.array([*weights, 0.0, 0.0]), "left to right")
        assert result[:2].tolist() == [common, common]
