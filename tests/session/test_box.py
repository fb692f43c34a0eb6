from dataclasses import replace

from facepin.core.events import KeyPressed, Modifiers, PointerMoved, PointerPressed, PointerReleased
from facepin.session.hand.box import Box
from facepin.session.hand.drag import DragTool
from support.seen_sheet import VIEWPORT, pinned, pixel_of, sight

CONTROL = Modifiers(control=True)
BOTH = Modifiers(control=True, shift=True)
POSE = pinned(20, 22, 60)


def corners(*vertices: int) -> tuple[tuple[float, float], tuple[float, float]]:
    """Corners of a box with some room round vertices."""
    x, y = zip(*(pixel_of(vertex) for vertex in vertices), strict=True)
    return (min(x) - 5, max(y) + 5), (max(x) + 5, min(y) - 5)


def test_a_box_selects_what_is_inside_from_any_corner() -> None:
    for start, end in (corners(20, 22), corners(20, 22)[::-1]):
        tool = DragTool(selected=frozenset({60}))
        assert tool.handle(PointerPressed(*start, "left", CONTROL), sight(POSE)) is None
        assert tool.handle(PointerMoved(*end), sight(POSE)) is None
        assert tool.selected == {20, 22}
        assert isinstance(tool.gesture, Box)
        assert tool.gesture.drawn
        # It follows the mouse back, too.
        tool.handle(PointerMoved(start[0] + 6, start[1] - 6), sight(POSE))
        assert len(tool.selected) <= 1
        tool.handle(PointerReleased(*end), sight(POSE))
        assert tool.selected == {20, 22}
        assert not tool.holding


def test_with_shift_it_adds_and_escape_gives_back_what_was() -> None:
    tool = DragTool(selected=frozenset({60}))
    start, end = corners(20)
    tool.handle(PointerPressed(*start, "left", BOTH), sight(POSE))
    tool.handle(PointerMoved(*end), sight(POSE))
    assert tool.selected == {20, 60}
    tool.handle(KeyPressed("escape"), sight(POSE))
    assert tool.selected == {60}
    assert tool.handle(PointerReleased(*end), sight(POSE)) is None
    assert tool.selected == {60}


def test_shift_beside_the_face_begins_a_box_that_adds() -> None:
    tool = DragTool(selected=frozenset({20}))
    tool.handle(PointerPressed(VIEWPORT.x + 2, VIEWPORT.y + 2, "left", Modifiers(shift=True)), sight(POSE))
    assert isinstance(tool.gesture, Box)
    tool.handle(PointerReleased(VIEWPORT.x + 390, VIEWPORT.y + 390), sight(POSE))
    assert tool.selected == {20, 22, 60}


def test_where_the_camera_has_no_use_for_it_a_drag_beside_the_face_is_a_box() -> None:
    tool = DragTool(selected=frozenset({20}))
    seen = sight(POSE, beside=True)
    corner = VIEWPORT.x + 2, VIEWPORT.y + 2
    tool.handle(PointerPressed(*corner), seen)
    tool.handle(PointerReleased(VIEWPORT.x + 390, VIEWPORT.y + 390), seen)
    assert tool.selected == {20, 22, 60}
    tool.handle(PointerPressed(*corner), seen)
    tool.handle(PointerReleased(*corner), seen)
    assert not tool.selected


def test_a_click_with_control_adds_a_pin_or_takes_it_out() -> None:
    tool = DragTool(selected=frozenset({60}))
    for selected in ({20, 60}, {60}):
        tool.handle(PointerPressed(*pixel_of(20), "left", CONTROL), sight(POSE))
        tool.handle(PointerReleased(*pixel_of(20)), sight(POSE))
        assert tool.selected == selected
    tool.handle(PointerPressed(*pixel_of(5), "left", CONTROL), sight(POSE))
    assert tool.handle(PointerReleased(*pixel_of(5)), sight(POSE)) is None
    assert tool.selected == {60}


def test_hidden_pins_stay_out_and_a_box_round_nothing_selects_nothing() -> None:
    hidden = POSE.with_pins((replace(POSE.pins[0], hidden=True), *POSE.pins[1:]))
    tool = DragTool()
    start, end = corners(20, 22)
    tool.handle(PointerPressed(*start, "left", CONTROL), sight(hidden))
    tool.handle(PointerReleased(*end), sight(hidden))
    assert tool.selected == {22}
    tool.handle(PointerPressed(*start, "left", CONTROL), sight(pinned()))
    tool.handle(PointerReleased(*end), sight(pinned()))
    assert not tool.selected
