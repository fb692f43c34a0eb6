from dataclasses import replace

import numpy as np
import pytest

from facepin.core.events import (
    NONE,
    KeyPressed,
    Modifiers,
    PointerMoved,
    PointerPressed,
    PointerReleased,
)
from facepin.core.pose import Pin, rest_pose
from facepin.session.hand.drag import DragTool
from support.seen_sheet import CAMERA, RIG, VIEWPORT, pinned, pixel_of, sight

SHIFT = Modifiers(shift=True)


def test_a_click_places_a_pin_on_the_nearest_vertex_of_the_triangle() -> None:
    tool = DragTool()
    x, y = pixel_of(40)
    placed = tool.handle(PointerPressed(x + 3, y + 2), sight())
    assert placed is not None
    assert not placed.final
    assert [pin.vertex for pin in placed.pins] == [40]
    np.testing.assert_allclose(placed.pins[0].goal, RIG.neutral[40], atol=1e-7)
    done = tool.handle(PointerReleased(x + 3, y + 2), sight())
    assert done is not None
    assert done.final
    assert not done.solve
    assert done.pins == placed.pins
    assert tool.selected == {40}


def test_the_goal_moves_with_the_mouse_in_the_plane_that_faces_the_camera() -> None:
    tool = DragTool()
    x, y = pixel_of(40)
    tool.handle(PointerPressed(x + 3, y + 2), sight())
    edit = tool.handle(PointerMoved(x + 43, y - 18), sight())
    assert edit is not None
    assert edit.solve
    (pin,) = edit.pins
    move = np.subtract(pin.goal, RIG.neutral[40])
    right, up, back = CAMERA.axes
    assert abs(move @ back) < 1e-6
    seen = CAMERA.project(np.array([pin.goal]), VIEWPORT)[0, :2]
    np.testing.assert_allclose(seen, [x + 40, y - 20], atol=0.2)
    np.testing.assert_allclose(pin.axes, [right, up])


def test_moving_less_than_the_dead_zone_is_a_click() -> None:
    tool = DragTool()
    x, y = pixel_of(40)
    tool.handle(PointerPressed(x, y), sight())
    assert tool.handle(PointerMoved(x + 2, y + 2), sight()) is None
    assert tool.handle(PointerMoved(x + 2, y + 4), sight()) is not None
    again = DragTool()
    again.handle(PointerPressed(x, y), sight(scale=2.0))
    assert again.handle(PointerMoved(x + 2, y + 4), sight(scale=2.0)) is None


def test_a_press_near_a_marker_takes_that_pin_and_the_others_keep_their_goals() -> None:
    pins = (Pin(40, (0.1, 0.2, 0.3)), Pin(20, (0.5, 0.5, 0.0)))
    pose = rest_pose(RIG).with_pins(pins)
    tool = DragTool()
    x, y = pixel_of(20)
    assert tool.handle(PointerPressed(x + 5, y), sight(pose)) is None
    assert tool.held == {20}
    edit = tool.handle(PointerMoved(x + 25, y), sight(pose))
    assert edit is not None
    assert edit.pins[0] is pins[0]
    # The goal starts from where it was, not from the mouse: nothing jumps.
    moved = CAMERA.project(np.array([edit.pins[1].goal, pins[1].goal]), VIEWPORT)
    np.testing.assert_allclose(moved[0, :2] - moved[1, :2], [20, 0], atol=0.3)


def click(tool: DragTool, vertex: int, held: Modifiers = NONE, **seen: object) -> None:
    x, y = pixel_of(vertex)
    tool.handle(PointerPressed(x, y, "left", held), sight(**seen))
    assert tool.handle(PointerReleased(x, y), sight(**seen)) is None


def test_a_click_selects_a_pin_and_shift_adds_it_or_takes_it_out() -> None:
    tool, pose = DragTool(), pinned(20, 40, 60)
    for vertex, held, selected in (
        (20, Modifiers(), {20}),
        (40, SHIFT, {20, 40}),
        (60, SHIFT, {20, 40, 60}),
        (40, SHIFT, {20, 60}),
        (20, Modifiers(), {20}),
        (60, Modifiers(), {60}),
    ):
        click(tool, vertex, held, pose=pose)
        assert tool.selected == selected


@pytest.mark.parametrize("held", [Modifiers(), SHIFT])
def test_all_selected_pins_move_together_by_the_same_way(held: Modifiers) -> None:
    pose = pinned(20, 40, 60)
    tool = DragTool(selected=frozenset({20, 60}))
    x, y = pixel_of(60)
    tool.handle(PointerPressed(x + 3, y, "left", held), sight(pose))
    assert tool.held == {20, 60}
    tool.handle(PointerMoved(x + 13, y), sight(pose))
    edit = tool.handle(PointerReleased(x + 33, y - 20), sight(pose))
    assert edit is not None
    assert edit.final
    assert edit.solve
    assert edit.label == "Drag 2 pins"
    moves = np.subtract([pin.goal for pin in edit.pins], [pin.goal for pin in pose.pins])
    np.testing.assert_array_equal(moves[1], 0)
    np.testing.assert_allclose(moves[0], moves[2], atol=1e-12)
    assert np.abs(moves[0]).max() > 0.1
    assert abs(moves[0] @ CAMERA.axes[2]) < 1e-12
    seen = CAMERA.project([edit.pins[2].goal], VIEWPORT)[0, :2]
    np.testing.assert_allclose(seen, [x + 30, y - 20], atol=0.2)
    assert tool.selected == {20, 60}
    assert not tool.held


def test_a_pin_that_is_not_selected_is_dragged_alone_and_a_new_one_with_shift_takes_the_others_along() -> (
    None
):
    pose = pinned(20, 40)
    tool = DragTool(selected=frozenset({20}))
    x, y = pixel_of(40)
    tool.handle(PointerPressed(x, y), sight(pose))
    assert tool.held == {40}
    tool.handle(KeyPressed("escape"), sight(pose))
    assert tool.selected == {20}
    x, y = pixel_of(60)
    placed = tool.handle(PointerPressed(x, y, "left", SHIFT), sight(pose))
    assert placed is not None
    edit = tool.handle(PointerMoved(x + 30, y), sight(pose))
    assert edit is not None
    assert tool.held == {20, 60}
    assert [pin.goal == old.goal for pin, old in zip(edit.pins, placed.pins, strict=True)] == [0, 1, 0]


def test_a_locked_pin_is_selected_but_not_dragged_and_says_so_once() -> None:
    pose = pinned(20, 40)
    pose = pose.with_pins((replace(pose.pins[0], locked=True), pose.pins[1]))
    tool = DragTool(selected=frozenset({40}))
    x, y = pixel_of(20)
    tool.handle(PointerPressed(x, y, "left", SHIFT), sight(pose))
    assert tool.selected == {20, 40}
    assert tool.handle(PointerMoved(x + 20, y), sight(pose)) is None
    assert "locked" in tool.remark
    tool.remark = ""
    assert tool.handle(PointerMoved(x + 30, y), sight(pose)) is None
    assert tool.handle(PointerReleased(x + 40, y), sight(pose)) is None
    assert not tool.remark
    # By the other one, all but the locked one are dragged.
    x, y = pixel_of(40)
    tool.handle(PointerPressed(x, y), sight(pose))
    edit = tool.handle(PointerMoved(x + 30, y), sight(pose))
    assert edit is not None
    assert edit.label == "Drag pin"
    assert edit.pins[0] is pose.pins[0]
    assert edit.pins[1].goal != pose.pins[1].goal


def test_a_hidden_pin_is_neither_found_nor_dragged_and_its_vertex_gets_no_second_pin() -> None:
    pose = pinned(20, hidden=True)
    tool = DragTool()
    x, y = pixel_of(20)
    tool.handle(PointerMoved(x, y), sight(pose))
    assert tool.hovered is None
    assert tool.handle(PointerPressed(x, y), sight(pose)) is None
    assert "hidden" in tool.remark
    assert tool.holding  # so that the camera does not turn
    assert tool.handle(PointerMoved(x + 30, y), sight(pose)) is None
    assert tool.handle(PointerReleased(x + 30, y), sight(pose)) is None
    assert not tool.selected


def test_a_press_where_no_shape_moves_anything_makes_no_pin_and_says_so() -> None:
    tool = DragTool()
    still = next(v for v in range(RIG.vertex_count) if not RIG.rows_at([v]).any())
    assert tool.handle(PointerPressed(*pixel_of(still)), sight()) is None
    assert not tool.holding
    assert tool.remark == "No shape moves this part of the skin"


def test_escape_gives_back_what_was_selected_then_takes_it_away() -> None:
    tool = DragTool(selected=frozenset({20}))
    tool.handle(PointerPressed(*pixel_of(40)), sight(pinned(20)))
    assert tool.selected == {40}
    tool.handle(KeyPressed("escape"), sight(pinned(20)))
    assert tool.selected == {20}
    tool.handle(KeyPressed("escape"), sight(pinned(20)))
    assert not tool.selected


def test_no_pin_is_selected_that_is_gone() -> None:
    tool = DragTool(selected=frozenset({20, 40}), hovered=40)
    tool.forget_gone(pinned(20, 60).pins)
    assert tool.selected == {20}
    assert tool.hovered is None


def test_a_press_beside_the_mesh_takes_nothing() -> None:
    tool = DragTool(selected=frozenset({40}))
    assert tool.handle(PointerPressed(VIEWPORT.x + 2, VIEWPORT.y + 2), sight()) is None
    assert not tool.holding
    assert tool.selected == {40}  # the camera may be turned with it


def test_escape_lets_go() -> None:
    tool = DragTool()
    x, y = pixel_of(40)
    tool.handle(PointerPressed(x, y), sight())
    tool.handle(PointerMoved(x + 30, y), sight())
    tool.handle(KeyPressed("escape"), sight())
    assert not tool.holding
    assert tool.handle(PointerReleased(x + 30, y), sight()) is None


def test_the_pin_under_the_mouse_is_hovered() -> None:
    pose = rest_pose(RIG).with_pins((Pin(40, tuple(RIG.neutral[40].tolist())),))
    tool = DragTool()
    x, y = pixel_of(40)
    tool.handle(PointerMoved(x + 4, y), sight(pose))
    assert tool.hovered == 40
    tool.handle(PointerMoved(x + 40, y), sight(pose))
    assert tool.hovered is None


@pytest.mark.parametrize("freedom", ["space", "screen"])
def test_new_pins_have_the_freedom_that_is_set(freedom: str) -> None:
    tool = DragTool()
    edit = tool.handle(PointerPressed(*pixel_of(40)), sight(freedom=freedom))
    assert edit is not None
    assert edit.pins[0].freedom == freedom


def test_a_pin_behind_the_skin_is_not_in_the_way() -> None:
    x, y, z = RIG.neutral[40].astype(float) - CAMERA.axes[2] * RIG.height
    pose = rest_pose(RIG).with_pins((Pin(0, (x, y, z)),))  # its goal lies far behind vertex 40
    edit = DragTool().handle(PointerPressed(*pixel_of(40)), sight(pose))
    assert edit is not None
    assert [pin.vertex for pin in edit.pins] == [0, 40]
