from dataclasses import replace

import numpy as np
import pytest

from facepin.core.events import KeyPressed, KeyReleased, Modifiers, PointerMoved, PointerPressed, Scrolled
from facepin.session.hand import nudge
from facepin.session.hand.drag import DragTool
from facepin.session.hand.nudge import PAUSE, goes_on
from support.seen_sheet import CAMERA, VIEWPORT, pinned, sight

POSE = pinned(20, 40)


def moved(key: str, tool: DragTool | None = None, pose: object = POSE, **held: bool) -> np.ndarray:
    """Way of each goal after one press."""
    tool = tool or DragTool(selected=frozenset({40}))
    edit = tool.handle(KeyPressed(key, Modifiers(**held)), sight(pose))
    assert edit is not None
    assert edit.solve
    assert not edit.final
    return np.subtract([pin.goal for pin in edit.pins], [pin.goal for pin in pose.pins])


@pytest.mark.parametrize(
    ("key", "pixels"), [("left", (-1, 0)), ("right", (1, 0)), ("up", (0, -1)), ("down", (0, 1))]
)
@pytest.mark.parametrize("shift", [False, True])
def test_an_arrow_key_moves_the_selected_pins_by_a_pixel_and_with_shift_by_ten(
    key: str, pixels: tuple[int, int], shift: bool
) -> None:
    way = moved(key, shift=shift)
    np.testing.assert_array_equal(way[0], 0)
    goal = np.array(POSE.pins[1].goal)
    before, after = CAMERA.project([goal, goal + way[1]], VIEWPORT)[:, :2]
    np.testing.assert_allclose(after - before, np.multiply(pixels, 10 if shift else 1), atol=1e-6)
    assert abs(way[1] @ CAMERA.axes[2]) < 1e-12


@pytest.mark.parametrize(
    ("key", "alt", "away"),
    [("up", True, 1), ("down", True, -1), ("page up", False, 1), ("page down", False, -1)],
)
def test_pins_in_space_move_along_the_view(key: str, alt: bool, away: int) -> None:
    way = moved(key, alt=alt)[1]
    across = moved("right")[1]
    np.testing.assert_allclose(way, -away * np.linalg.norm(across) * CAMERA.axes[2], atol=1e-12)


def test_pins_on_screen_do_not_move_along_the_view() -> None:
    mixed = POSE.with_pins((replace(POSE.pins[0], freedom="screen"), POSE.pins[1]))
    tool = DragTool(selected=frozenset({20, 40}))
    way = moved("page up", tool, mixed)
    np.testing.assert_array_equal(way[0], 0)
    assert way[1].any()
    alone = DragTool(selected=frozenset({20}))
    assert alone.handle(KeyPressed("page up"), sight(mixed)) is None
    assert "on screen" in alone.remark
    assert not alone.nudging


def test_presses_add_up_to_one_step_that_ends_after_a_pause() -> None:
    tool = DragTool(selected=frozenset({20, 40}))
    one = moved("right", tool)
    for _ in range(4):
        last = moved("right", tool)
    np.testing.assert_allclose(last, 5 * one, atol=1e-12)
    # However long the key is held.
    assert tool.settle(100.0) is None
    moved("right", tool)
    assert tool.settle(101.0) is None
    tool.handle(KeyReleased("right"), sight(POSE))
    assert tool.settle(102.0) is None
    assert tool.settle(102.0 + 0.9 * PAUSE) is None
    done = tool.settle(102.0 + PAUSE)
    assert done is not None
    assert done.final
    assert done.label == "Nudge 2 pins"
    np.testing.assert_allclose(
        np.subtract([pin.goal for pin in done.pins], [pin.goal for pin in POSE.pins]), 6 * one, atol=1e-12
    )
    assert not tool.nudging
    assert tool.settle(200.0) is None


def test_a_key_whose_release_was_lost_does_not_hold_for_ever() -> None:
    tool = DragTool(selected=frozenset({40}))
    moved("right", tool)
    assert tool.settle(10.0) is None
    assert tool.settle(10.0 + nudge._STUCK) is not None


def test_escape_drops_it() -> None:
    tool = DragTool(selected=frozenset({40}))
    moved("up", tool)
    tool.handle(KeyPressed("escape"), sight(POSE))
    assert not tool.nudging
    assert tool.finish() is None
    assert tool.selected == {40}


def test_locked_pins_stay() -> None:
    locked = POSE.with_pins((replace(POSE.pins[0], locked=True), POSE.pins[1]))
    way = moved("up", DragTool(selected=frozenset({20, 40})), locked)
    np.testing.assert_array_equal(way[0], 0)
    assert way[1].any()
    tool = DragTool(selected=frozenset({20}))
    assert tool.handle(KeyPressed("up"), sight(locked)) is None
    assert "locked" in tool.remark


def test_without_a_selection_and_during_a_gesture_arrows_do_nothing() -> None:
    tool = DragTool()
    assert tool.handle(KeyPressed("up"), sight(POSE)) is None
    assert not tool.remark
    tool = DragTool(selected=frozenset({40}))
    x, y = 2 + VIEWPORT.x, 2 + VIEWPORT.y
    tool.handle(PointerPressed(x, y, "left", Modifiers(control=True)), sight(POSE))
    assert tool.handle(KeyPressed("up"), sight(POSE)) is None


def test_a_pixel_is_one_of_a_plain_screen() -> None:
    tool = DragTool(selected=frozenset({40}))
    edit = tool.handle(KeyPressed("right"), sight(POSE, scale=2.0))
    way = np.subtract(edit.pins[1].goal, POSE.pins[1].goal)
    np.testing.assert_allclose(way, 2 * moved("right")[1], atol=1e-12)


def test_what_it_goes_on_over() -> None:
    assert goes_on(PointerMoved(1, 2))
    assert goes_on(KeyPressed("up", Modifiers(shift=True)))
    for event in (KeyPressed("z", Modifiers(control=True)), PointerPressed(1, 2), Scrolled(1, 2, 1)):
        assert not goes_on(event)
    assert not goes_on(KeyPressed("up", Modifiers(control=True)))
