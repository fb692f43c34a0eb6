"""The weights panel under a real mouse's habits: a button stays down for several frames."""

from collections.abc import Iterator
from dataclasses import replace
from time import sleep

import numpy as np
import pytest
from imgui_bundle import imgui

from facepin.core.events import PointerMoved, PointerPressed, PointerReleased, Scrolled, Stirred
from facepin.panels.commands import Command
from facepin.panels.requests import SetControl
from facepin.panels.weights import hand
from facepin.panels.weights.columns import Zone
from facepin.panels.weights.listing import Group
from facepin.session.edit import Edit
from support.driver import App, running


@pytest.fixture(scope="module")
def shared_app() -> Iterator[App]:
    with running(size=(720, 720)) as app:
        imgui.get_io().mouse_single_click_delay = 11
        imgui.get_io().mouse_double_click_time = 10  # a slow machine is not a slow hand
        yield app


@pytest.fixture
def app(shared_app: App) -> Iterator[App]:
    """The application with the pose at rest and the panel as it is at first."""
    app, view = shared_app, shared_app.desk.view.weights
    while app.session.undo():
        pass
    imgui.get_io().key_repeat_delay = 60.0
    view.search, view.arrangement, view.folded, view.focus = "", "rig order", frozenset(), None
    app.step(PointerMoved(200, 100), frames=3)
    click(app, (20.0, 60.0))  # beside everything: takes the keyboard away
    yield app
    for key in (imgui.Key.mod_ctrl, imgui.Key.mod_shift, imgui.Key.mod_alt):
        imgui.get_io().add_key_event(key, False)
    app.step(PointerMoved(200, 100), frames=3)
    assert view.gesture is None
    assert not app.session.in_gesture


def place(app: App, shape: str | int, zone: Zone | float = "name") -> tuple[float, float]:
    """Where on the screen a part of a line is; a number is a share of the slider."""
    view = app.desk.view.weights
    columns = view.columns
    assert columns is not None
    lines = view.listing(app.session.rig).lines(
        view.arrangement, view.search, view.folded, app.session.pose.weights, in_gesture=False
    )
    if isinstance(shape, str) and shape in app.session.rig.shape_names:
        shape = app.session.rig.shape_names.index(shape)
    number = next(at for at, line in enumerate(lines) if shape in (line, getattr(line, "name", None)))
    begin, end = columns.slider
    x = (
        {
            "name": columns.name + 5,
            "solo": columns.icon(0),
            "mute": columns.icon(1),
            "lock": columns.icon(2),
            "slider": (begin + end) / 2,
            "number": columns.right - 8,
        }.get(zone)
        if isinstance(zone, str)
        else begin + zone * (end - begin)
    )
    assert x is not None
    return x, columns.y(number) + columns.row / 2


def click(app: App, at: tuple[float, float], button: str = "left") -> None:
    app.step(PointerMoved(*at), frames=2)
    app.step(PointerPressed(*at, button))
    app.step(PointerMoved(*at), frames=2)
    app.step(PointerReleased(*at, button), frames=2)


def key(app: App, *keys: imgui.Key) -> None:
    for one in keys:
        imgui.get_io().add_key_event(one, True)
        app.step(Stirred(), frames=2)
        imgui.get_io().add_key_event(one, False)
        app.step(Stirred(), frames=2)


def weight(app: App, shape: str) -> float:
    return float(app.session.pose.weights[app.session.rig.shape_names.index(shape)])


def pose(app: App, **weights: float) -> None:
    values = np.zeros(app.session.rig.shape_count)
    for name, value in weights.items():
        values[app.session.rig.shape_names.index(name)] = value
    app.session.apply(Edit("Pose", True, weights=values))
    app.step(Stirred(), frames=3)


def restrain(app: App, **changes: object) -> None:
    app.ask(SetControl("Restrain", replace(app.session.control, **changes)))  # type: ignore[arg-type]
    app.step(Stirred(), frames=3)


@pytest.mark.parametrize("zone", [0.3, "name"])
def test_a_double_click_on_a_slider_or_on_its_name_resets_it_in_one_step(
    app: App, zone: Zone | float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("facepin.panels.weights.hand.CLICK", 10.0)
    pose(app, browInnerUp=0.6, cheekPuff=0.4)
    at = place(app, "browInnerUp", zone)
    click(app, at)
    click(app, at)
    assert weight(app, "browInnerUp") == 0
    assert weight(app, "cheekPuff") == 0.4
    assert app.session.undo_label == "Reset browInnerUp"
    assert app.session.undo()
    assert weight(app, "browInnerUp") == 0.6


def test_a_click_on_a_slider_moves_it_there_at_once_and_for_good(app: App) -> None:
    click(app, place(app, "browInnerUp", 0.3))
    assert weight(app, "browInnerUp") == pytest.approx(0.3, abs=0.02)
    sleep(0.2)
    app.step(Stirred(), frames=2)
    assert app.session.undo_label == "Set browInnerUp"
    assert not app.session.in_gesture


def test_a_slider_follows_the_mouse_and_stops_at_its_limits_as_one_undo_step(app: App) -> None:
    pose(app, cheekPuff=0.4)
    before = app.session.committed
    app.press(*place(app, "browInnerUp", 0.25))
    assert weight(app, "browInnerUp") == 0.25
    for share in (0.5, 0.9, 1.6):
        app.move(*place(app, "browInnerUp", share))
    assert weight(app, "browInnerUp") == 1
    app.move(*place(app, "browInnerUp", 0.7))
    assert weight(app, "browInnerUp") == pytest.approx(0.7, abs=0.011)
    assert app.session.in_gesture
    app.release(*place(app, "browInnerUp", 0.7))
    assert app.session.undo_label == "Set browInnerUp"
    assert app.session.undo()
    assert app.session.committed is before


def test_shift_makes_a_drag_ten_times_finer(app: App) -> None:
    app.press(*place(app, "browInnerUp", 0.5))
    start = weight(app, "browInnerUp")
    imgui.get_io().add_key_event(imgui.Key.mod_shift, True)
    app.step(Stirred(), frames=2)
    app.move(*place(app, "browInnerUp", 1.0))
    assert weight(app, "browInnerUp") == pytest.approx(start + 0.05, abs=0.006)
    app.release(*place(app, "browInnerUp", 1.0))


def test_escape_gives_a_drag_up_exactly(app: App) -> None:
    pose(app, browInnerUp=0.123456789)
    before = app.session.work
    app.press(*place(app, "browInnerUp", 0.8))
    app.move(*place(app, "browInnerUp", 0.9))
    assert app.session.work is not before
    key(app, imgui.Key.escape)
    assert app.session.work is before
    app.move(*place(app, "browInnerUp", 0.5))
    app.release(*place(app, "browInnerUp", 0.5))
    assert app.session.work is before


@pytest.mark.parametrize("zone, presses, control", [("number", 2, False), ("slider", 1, True)])
def test_a_number_is_typed_beyond_the_limits_and_escape_takes_it_back(
    app: App, zone: Zone, presses: int, control: bool
) -> None:
    pose(app, browInnerUp=0.5)
    at = place(app, "browInnerUp", zone)
    for _ in range(presses):
        app.step(PointerMoved(*at), frames=3)
        imgui.get_io().add_key_event(imgui.Key.mod_ctrl, control)
        imgui.get_io().add_mouse_button_event(0, True)
        app.step(Stirred(), frames=3)
        imgui.get_io().add_key_event(imgui.Key.mod_ctrl, False)
        app.step(PointerReleased(*at), frames=3)
    assert app.desk.view.weights.gesture is not None
    imgui.get_io().add_input_characters_utf8("1.25")
    app.step(Stirred(), frames=5)
    key(app, imgui.Key.enter)
    assert weight(app, "browInnerUp") == 1.25
    assert not app.session.in_gesture
    assert app.session.undo_label == "Set browInnerUp"

    for _ in range(2):
        click(app, place(app, "browInnerUp", "number"))
    imgui.get_io().add_input_characters_utf8("9")
    app.step(Stirred(), frames=5)
    key(app, imgui.Key.escape)
    assert weight(app, "browInnerUp") == 1.25


def typed(app: App, shape: str, text: str) -> None:
    """Double click on a number, type over it, press Enter."""
    click(app, (20.0, 60.0))  # else it would be the third click of a former double click
    for _ in range(2):
        click(app, place(app, shape, "number"))
    imgui.get_io().add_input_characters_utf8(text)
    app.step(Stirred(), frames=3)
    key(app, imgui.Key.enter)


def test_a_number_that_is_opened_and_left_keeps_all_its_digits(app: App) -> None:
    typed(app, "browInnerUp", "0.123456789")
    assert weight(app, "browInnerUp") == 0.123456789
    work = app.session.work
    typed(app, "browInnerUp", "")
    assert app.session.work is work


def test_a_typed_share_means_what_it_says_and_nonsense_is_refused_in_a_line(app: App) -> None:
    for text, value in (("50%", 0.5), ("1/4", 0.25), ("0,75", 0.75)):
        typed(app, "browInnerUp", text)
        assert weight(app, "browInnerUp") == value
    work = app.session.work
    typed(app, "browInnerUp", "12 px")
    assert app.session.work is work
    assert app.desk.is_error and "12 px" in app.desk.message


def test_a_press_on_another_slider_ends_the_typing_and_moves_that_one(app: App) -> None:
    for _ in range(2):
        click(app, place(app, "browInnerUp", "number"))
    imgui.get_io().add_input_characters_utf8("0.7")
    app.step(Stirred(), frames=3)
    app.drag(place(app, "cheekPuff", 0.2), place(app, "cheekPuff", 0.5), moves=3)
    assert weight(app, "browInnerUp") == 0.7
    assert weight(app, "cheekPuff") == pytest.approx(0.5, abs=0.02)
    assert app.session.undo_label == "Set cheekPuff" and app.session.undo()
    assert app.session.undo_label == "Set browInnerUp"


def test_arrow_keys_walk_and_move_the_slider_and_a_held_key_is_one_step(
    app: App, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(hand, "PAUSE", 0.05)
    click(app, place(app, "browInnerUp"))
    key(app, imgui.Key.down_arrow, imgui.Key.right_arrow)
    assert weight(app, "browOuterUpLeft") == 0.01
    assert app.session.undo_label == "Set browOuterUpLeft"
    rest(app)
    imgui.get_io().add_key_event(imgui.Key.mod_shift, True)
    imgui.get_io().key_repeat_delay, imgui.get_io().key_repeat_rate = 0.0, 1e-4
    imgui.get_io().add_key_event(imgui.Key.right_arrow, True)
    for _ in range(3):
        app.step(Stirred())
    assert app.session.in_gesture
    assert weight(app, "browOuterUpLeft") >= 0.21
    imgui.get_io().add_key_event(imgui.Key.right_arrow, False)
    app.step(Stirred(), frames=3)
    rest(app)
    assert app.session.undo()
    assert weight(app, "browOuterUpLeft") == 0.01


def rest(app: App) -> None:
    """Let no key be pressed for as long as it takes for another step."""
    app.until(lambda: not app.session.in_gesture)


def test_quick_taps_of_an_arrow_key_are_one_step_that_can_be_redone(
    app: App, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(hand, "PAUSE", 60.0)  # a slow machine is not a slow hand
    before = app.session.work
    click(app, place(app, "browInnerUp"))
    key(app, *[imgui.Key.right_arrow] * 6)
    assert weight(app, "browInnerUp") == pytest.approx(0.06)
    app.ask(Command.UNDO)
    app.step(Stirred())
    assert app.session.work is before
    app.ask(Command.REDO)
    app.step(Stirred())
    assert weight(app, "browInnerUp") == pytest.approx(0.06)


def test_what_follows_taps_elsewhere_is_another_step_and_is_not_lost(
    app: App, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(hand, "PAUSE", 60.0)
    steps = app.session.step
    click(app, place(app, "browInnerUp"))
    key(app, imgui.Key.right_arrow, imgui.Key.right_arrow, imgui.Key.down_arrow, imgui.Key.right_arrow)
    assert weight(app, "browInnerUp") == pytest.approx(0.02)
    assert weight(app, "browOuterUpLeft") == pytest.approx(0.01)
    app.drag(place(app, "cheekPuff", 0.2), place(app, "cheekPuff", 0.5), moves=3)
    assert weight(app, "cheekPuff") == pytest.approx(0.5, abs=0.02)
    assert app.session.step == steps + 3


def test_arrow_keys_are_left_alone_while_the_picture_has_the_keyboard(app: App) -> None:
    click(app, place(app, "browInnerUp"))
    click(app, (20.0, 60.0))
    key(app, imgui.Key.right_arrow)
    assert not app.session.pose.weights.any()


def test_the_wheel_scrolls_and_with_ctrl_turns_the_slider_as_one_step(app: App) -> None:
    at = place(app, "browInnerUp", 0.5)
    app.step(PointerMoved(*at), frames=3)
    imgui.get_io().add_key_event(imgui.Key.mod_ctrl, True)
    for _ in range(3):
        app.step(Scrolled(*at, 1.0), frames=2)
    assert weight(app, "browInnerUp") == pytest.approx(0.03)
    assert app.session.in_gesture
    assert place(app, "browInnerUp", 0.5) == at, "the list stays"
    imgui.get_io().add_key_event(imgui.Key.mod_ctrl, False)
    app.step(Stirred(), frames=3)
    assert app.session.undo_label == "Set browInnerUp"
    app.step(Scrolled(*at, -1.0), frames=4)
    assert place(app, "browInnerUp", 0.5)[1] < at[1], "the list is scrolled"
    assert weight(app, "browInnerUp") == pytest.approx(0.03)
    app.step(Scrolled(*at, 5.0), frames=4)


def test_a_locked_slider_stays_and_says_so(app: App) -> None:
    pose(app, browInnerUp=0.3)
    click(app, place(app, "browInnerUp", "lock"))
    assert app.session.undo_label == "Lock browInnerUp"
    app.drag(place(app, "browInnerUp", 0.5), place(app, "browInnerUp", 0.9), moves=3)
    assert weight(app, "browInnerUp") == 0.3
    assert app.desk.message == "browInnerUp is locked"
    assert app.session.undo_label == "Lock browInnerUp"
    click(app, place(app, "browInnerUp", "lock"))
    assert app.session.undo_label == "Unlock browInnerUp"


def test_mute_and_solo_are_set_by_their_icons(app: App) -> None:
    pose(app, browInnerUp=0.8, browDownLeft=0.5)
    still = app.desk.stage
    assert still is not None
    shown = still.positions(0)
    click(app, place(app, "browInnerUp", "mute"))
    assert app.session.control.muted.sum() == 1
    assert not np.array_equal(still.positions(0), shown)
    assert weight(app, "browInnerUp") == 0.8
    click(app, place(app, "browInnerUp", "mute"))
    assert np.allclose(still.positions(0), shown, atol=1e-5)
    click(app, place(app, "browDownLeft", "solo"))
    assert app.session.control.silent.sum() == app.session.rig.shape_count - 1
    assert app.session.undo() and not app.session.control.silent.any()


def test_groups_fold_lock_and_reset(app: App) -> None:
    pose(app, browInnerUp=0.5, browDownLeft=0.4, jawOpen=0.2)
    app.desk.view.weights.arrangement = "by region"
    app.step(Stirred(), frames=3)
    assert app.desk.view.weights.listing(app.session.rig).active("by region", app.session.pose.weights) == {
        "brows": 2, "eyes": 0, "cheeks": 0, "nose": 0, "mouth": 0, "jaw": 1, "tongue": 0,
    }  # fmt: skip
    click(app, place(app, "browInnerUp", "lock"))
    click(app, place(app, "brows", "solo"))
    assert weight(app, "browInnerUp") == 0.5 and weight(app, "browDownLeft") == 0
    assert app.session.undo_label == "Reset brows"
    assert app.desk.message == ""
    click(app, place(app, "brows", "lock"))
    assert app.session.control.locked.sum() == 5
    click(app, place(app, "brows"))
    assert app.desk.view.weights.folded == {"brows"}
    eyes = place(app, "eyes")
    assert eyes[1] - place(app, "brows")[1] == pytest.approx(24)
    app.desk.view.weights.search = "brow"
    app.step(Stirred(), frames=3)
    assert place(app, "browDownLeft")[1] < eyes[1] + 1, "what is found is shown"


def test_limits_are_obeyed_by_the_mouse_and_a_weight_beyond_may_only_come_back(app: App) -> None:
    pose(app, browInnerUp=1.5)
    limits = app.session.control.limits.copy()
    limits[app.session.rig.shape_names.index("browInnerUp")] = 0.1, 0.6
    restrain(app, limits=limits)
    app.press(*place(app, "browInnerUp", 0.8))
    assert weight(app, "browInnerUp") == pytest.approx(1.2, abs=0.02), "1.5 is the end of the slider"
    app.move(*place(app, "browInnerUp", 2.0))
    assert weight(app, "browInnerUp") == 1.5
    app.move(*place(app, "browInnerUp", 0.0))
    assert weight(app, "browInnerUp") == 0.1
    app.release(*place(app, "browInnerUp", 0.0))
    app.drag(place(app, "browInnerUp", 0.2), place(app, "browInnerUp", 2.0), moves=3)
    assert weight(app, "browInnerUp") == 0.6


def test_a_hand_stops_at_the_tie_and_a_weight_beyond_it_stays(app: App) -> None:
    pose(app, jawOpen=0.4)
    app.desk.view.weights.search = "mouthclose"
    app.step(Stirred(), frames=2)
    app.drag(place(app, "mouthClose", 0.05), place(app, "mouthClose", 0.9), moves=3)
    assert weight(app, "mouthClose") == pytest.approx(0.4)
    assert app.session.undo_label == "Set mouthClose"
    pose(app, jawOpen=0.4, mouthClose=0.9)
    app.step(PointerMoved(*place(app, "mouthClose", 0.5)), frames=3)
    assert weight(app, "mouthClose") == 0.9


def test_the_gain_scales_all_that_is_not_locked_as_one_step(app: App) -> None:
    pose(app, browInnerUp=0.5, browDownLeft=0.4, cheekPuff=0.2)
    click(app, place(app, "cheekPuff", "lock"))
    columns = app.desk.view.weights.columns
    assert columns is not None
    start = (columns.right - 30, columns.top - 16)
    app.drag(start, (start[0] - 100, start[1]), moves=5)
    assert weight(app, "browInnerUp") == pytest.approx(0.25, abs=0.01)
    assert weight(app, "browDownLeft") / weight(app, "browInnerUp") == pytest.approx(0.8)
    assert weight(app, "cheekPuff") == 0.2
    assert app.session.undo_label == "Scale the pose"
    app.drag((start[0] - 20, start[1]), (start[0] + 400, start[1]), moves=5)
    assert weight(app, "browInnerUp") == pytest.approx(0.5, abs=0.01), "twice at most"
    assert app.session.undo() and app.session.undo()
    assert weight(app, "browInnerUp") == 0.5


def test_a_name_shows_on_the_face_what_its_shape_moves_after_a_rest(app: App) -> None:
    at = place(app, "browInnerUp")
    before = app.screenshot()[:, :380].copy()
    app.step(PointerMoved(*at), frames=3)
    sleep(0.2)
    app.step(Stirred(), frames=3)
    assert app.desk.view.panes[0].shape == app.session.rig.shape_names.index("browInnerUp")
    after = app.screenshot()[:, :380]
    changed = (after != before).any(axis=2)
    assert changed.mean() > 0.01
    assert after[changed].std() > 20, "the shaded skin stays to be seen"
    app.press(*place(app, "browInnerUp", 0.0))
    assert app.desk.view.panes[0].shape is None
    app.release(*place(app, "browInnerUp", 0.0))
    app.step(frames=3)
    assert np.array_equal(app.screenshot()[:, :380], before)


def test_menus_open_for_shapes_and_groups_and_set_limits(app: App) -> None:
    j = app.session.rig.shape_names.index("browInnerUp")
    at = place(app, "browInnerUp")
    click(app, at, "right")
    assert app.desk.view.weights.menu == j
    click(app, (at[0] + 30, at[1] + 124))  # the field for the lowest weight
    imgui.get_io().add_input_characters_utf8("-0.5")
    app.step(Stirred(), frames=3)
    key(app, imgui.Key.enter)
    assert app.session.control.limits[j].tolist() == [-0.5, 1]
    assert app.session.undo_label == "Limit browInnerUp"
    key(app, imgui.Key.escape)
    assert app.desk.view.weights.menu is None
    app.desk.view.weights.arrangement = "by side"
    app.step(Stirred(), frames=3)
    click(app, place(app, "left"), "right")
    assert isinstance(app.desk.view.weights.menu, Group)
    key(app, imgui.Key.escape)


def test_undo_in_the_middle_of_a_drag_ends_it(app: App) -> None:
    pose(app, browInnerUp=0.4)
    before = app.session.work
    app.press(*place(app, "browInnerUp", 0.8))
    app.key("z", control=True)
    assert app.session.work is before
    app.move(*place(app, "browInnerUp", 0.2))
    app.release(*place(app, "browInnerUp", 0.2))
    assert app.session.work is before


def test_a_press_in_the_picture_makes_a_step_of_what_the_wheel_began(app: App) -> None:
    at = place(app, "browInnerUp", 0.5)
    app.step(PointerMoved(*at), frames=2)
    imgui.get_io().add_key_event(imgui.Key.mod_ctrl, True)
    app.step(Scrolled(*at, 1.0), frames=2)
    assert app.session.in_gesture
    app.step(PointerMoved(20, 60), PointerPressed(20, 60))
    app.step(PointerReleased(20, 60), frames=3)
    assert app.session.undo_label == "Set browInnerUp"
    assert weight(app, "browInnerUp") == 0.01
    assert app.session.undo() and app.session.undo_label is None


def test_ctrl_over_the_face_lists_the_shapes_that_move_it(app: App) -> None:
    app.step(PointerMoved(*app.pixel_of(1441)), frames=2)
    assert not app.desk.view.weights.marked
    imgui.get_io().add_key_event(imgui.Key.mod_ctrl, True)
    app.step(Stirred(), frames=3)
    names = {app.session.rig.shape_names[j] for j in app.desk.view.weights.marked}
    assert app.desk.view.panes[0].shape in app.desk.view.weights.marked, "and one tints the face"
    assert {"mouthSmileLeft", "jawOpen"} <= names
    assert "browInnerUp" not in names
    imgui.get_io().add_key_event(imgui.Key.mod_ctrl, False)
    app.step(Stirred(), frames=3)
    assert not app.desk.view.weights.marked
