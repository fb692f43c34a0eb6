import numpy as np
import pytest

from facepin.core.events import KeyPressed, Modifiers, PointerMoved, PointerPressed, PointerReleased
from facepin.core.pose import Pin, Pose
from facepin.session.edit import Edit
from facepin.session.hand.drag import DragTool
from facepin.session.hand.stroke import Stroke
from support.seen_sheet import RIG, VIEWPORT, pinned, pixel_of, sight


def draw(tool: DragTool, path: np.ndarray, pose: Pose | None = None, count: int = 6) -> Edit | None:
    """Press at the first pixel of a path, move along it, release at its end."""
    seen = sight(pose, stroke=count)
    assert tool.handle(PointerPressed(*path[0]), seen) is None
    assert isinstance(tool.gesture, Stroke)
    for pixel in path[1:]:
        assert tool.handle(PointerMoved(*pixel), seen) is None
    return tool.handle(PointerReleased(*path[-1]), seen)


def line(start: int, end: int, steps: int = 40) -> np.ndarray:
    return np.linspace(pixel_of(start), pixel_of(end), steps)


@pytest.mark.parametrize("steps", [3, 40, 400])
def test_pins_are_laid_evenly_along_the_line_however_the_mouse_got_there(steps: int) -> None:
    tool = DragTool()
    edit = draw(tool, line(37, 43, steps), count=4)
    assert edit is not None
    assert edit.final
    assert not edit.solve
    assert edit.label == "Sketch 4 pins"
    assert [pin.vertex for pin in edit.pins] == [37, 39, 41, 43]
    for pin in edit.pins:
        np.testing.assert_allclose(pin.goal, RIG.neutral[pin.vertex], atol=1e-7)
    assert tool.selected == {37, 39, 41, 43}
    assert not tool.holding


def test_even_means_on_the_skin_not_in_time() -> None:
    slow_then_fast = np.concatenate([line(37, 38, 60), line(38, 43, 4)[1:]])
    edit = draw(DragTool(), slow_then_fast, count=4)
    assert [pin.vertex for pin in edit.pins] == [37, 39, 41, 43]


def test_a_stroke_goes_round_corners() -> None:
    corner = np.concatenate([line(37, 43), line(43, 16)[1:]])
    edit = draw(DragTool(), corner, count=5)
    gaps = np.diff([pin.goal for pin in edit.pins], axis=0)
    lengths = np.linalg.norm(gaps, axis=1)
    assert len(edit.pins) == 5
    assert 43 in {pin.vertex for pin in edit.pins} or lengths.max() < 2.2 * lengths.min()


def test_what_is_pinned_already_is_part_of_the_stroke_and_stays_as_it_is() -> None:
    there = Pin(39, (0.1, 0.2, 0.3), name="kept")
    far = pinned(5).pins[0]
    tool = DragTool()
    edit = draw(tool, line(37, 43), pinned().with_pins((there, far)), count=4)
    assert edit.pins[:2] == (there, far)
    assert {pin.vertex for pin in edit.pins} == {5, 37, 39, 41, 43}
    assert tool.selected == {37, 39, 41, 43}
    assert edit.label == "Sketch 3 pins"


def test_a_press_on_a_pin_takes_it_and_with_it_the_stroke() -> None:
    tool = DragTool()
    edit = draw(tool, line(37, 43), count=4)
    seen = sight(pinned().with_pins(edit.pins), stroke=4)
    x, y = pixel_of(39)
    tool.handle(PointerPressed(x, y), seen)
    assert tool.held == {37, 39, 41, 43}
    dragged = tool.handle(PointerMoved(x, y - 20), seen)
    moves = np.subtract([pin.goal for pin in dragged.pins], [pin.goal for pin in edit.pins])
    np.testing.assert_allclose(moves, [moves[0]] * 4, atol=1e-12)
    assert np.abs(moves).max() > 0.05


def test_a_click_is_a_single_pin_and_a_short_stroke_has_no_pin_twice() -> None:
    edit = draw(DragTool(), np.array([pixel_of(40)] * 2) + 1)
    assert [pin.vertex for pin in edit.pins] == [40]
    tool = DragTool()
    short = draw(tool, line(40, 41), count=15)
    assert [pin.vertex for pin in short.pins] == [40, 41]
    assert tool.remark.startswith("2 pins are laid")


def test_a_stroke_may_leave_the_face_and_come_back() -> None:
    beside = np.array([[VIEWPORT.x + 2, VIEWPORT.y + 2]])
    edit = draw(DragTool(), np.concatenate([line(37, 38), beside, line(42, 43)]), count=4)
    vertices = [pin.vertex for pin in edit.pins]
    assert vertices[0] == 37
    assert vertices[-1] == 43
    off = np.concatenate([line(40, 40, 2)[:1], beside])
    assert [pin.vertex for pin in draw(DragTool(), off).pins] == [40]


def test_shift_adds_to_the_selection_and_escape_leaves_nothing() -> None:
    pose = pinned(5)
    tool = DragTool(selected=frozenset({5}))
    seen = sight(pose, stroke=3)
    tool.handle(PointerPressed(*pixel_of(37), "left", Modifiers(shift=True)), seen)
    tool.handle(PointerMoved(*pixel_of(43)), seen)
    tool.handle(PointerReleased(*pixel_of(43)), seen)
    assert tool.selected == {5, 37, 40, 43}
    tool.handle(PointerPressed(*pixel_of(60)), seen)
    tool.handle(PointerMoved(*pixel_of(62)), seen)
    tool.handle(KeyPressed("escape"), seen)
    assert tool.handle(PointerReleased(*pixel_of(62)), seen) is None
    assert tool.selected == {5, 37, 40, 43}
