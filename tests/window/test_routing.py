"""Who gets which event, when several come within one frame."""

import numpy as np
import pytest
from imgui_bundle import imgui

from facepin.core.events import (
    FilesDropped,
    KeyPressed,
    Modifiers,
    PointerMoved,
    PointerPressed,
    PointerReleased,
)
from facepin.frame.routing import Router
from facepin.panels.commands import Command
from facepin.panels.requests import AddPane
from facepin.session.edit import Edit
from facepin.session.hand import drag
from facepin.session.solving.solving import choose
from support.driver import App, running

UNDO = KeyPressed("z", Modifiers(control=True))


def skin(app: App) -> tuple[float, float]:
    """A pixel in the middle of the face."""
    front = app.session.rig.neutral
    x, y, z = front.T
    middle = np.abs(x) + np.abs(y - np.median(y[z > 0.9 * z.max()])) - z
    return app.pixel_of(int(np.argmin(middle)))


def test_escape_in_the_frame_of_a_move_leaves_nothing_of_the_drag() -> None:
    with running() as app:
        x, y = skin(app)
        before = app.session.pose
        app.press(x, y)
        app.move(x, y + 20)
        assert app.session.pose is not before
        app.step(PointerMoved(x, y + 40), KeyPressed("escape"))
        assert app.session.pose is before
        assert not app.session.in_gesture
        app.release(x, y + 40)
        assert app.session.pose is before


def test_two_clicks_within_one_frame_place_two_pins() -> None:
    with running() as app:
        x, y = skin(app)
        app.step(PointerMoved(x, y), frames=2)
        app.step(
            *(PointerPressed(x, y), PointerReleased(x, y)),
            *(PointerPressed(x, y + 60), PointerReleased(x, y + 60)),
            frames=2,
        )
        first, second = app.session.pose.pins
        assert first.vertex != second.vertex
        app.step(UNDO, frames=2)
        assert app.session.pose.pins == (first,)


def test_a_press_in_the_frame_of_a_release_begins_on_what_the_release_left() -> None:
    with running(solver="tikhonov") as app:
        x, y = skin(app)
        app.press(x, y)
        app.move(x, y + 10)
        app.step(
            *(PointerMoved(x, y + 40), PointerReleased(x, y + 40)),
            *(PointerPressed(x, y + 120), PointerReleased(x, y + 120)),
            frames=2,
        )
        app.step(UNDO, frames=2)
        (dragged,) = app.session.pose.pins
        app.step(KeyPressed("y", Modifiers(control=True)), frames=2)
        kept, placed = app.session.pose.pins
        assert kept == dragged
        # The new pin holds its vertex where the drag left it.
        assert app.desk.stage is not None
        np.testing.assert_allclose(placed.goal, app.desk.stage.positions(0)[placed.vertex], atol=1e-5)


@pytest.mark.parametrize("key", [UNDO, KeyPressed("home"), KeyPressed("delete")])
def test_keys_change_nothing_under_a_drag(key: KeyPressed) -> None:
    with running() as app:
        x, y = skin(app)
        app.drag((x, y), (x, y + 20))
        app.press(x, y + 120)
        app.move(x, y + 140)
        held = app.session.pose
        app.step(key, frames=2)
        assert app.session.pose is held
        app.release(x, y + 140)
        assert len(app.session.pose.pins) == 2


def test_undo_does_not_take_the_pane_from_under_the_camera() -> None:
    with running(size=(1600, 900)) as app:
        app.ask(AddPane(choose("tikhonov")))
        app.step(PointerMoved(5, 5), frames=3)
        corner = app.frame.viewports[1]
        at = (corner.x + corner.width - 30, corner.y + corner.height - 130)
        app.press(*at, "middle")
        app.step(UNDO, frames=2)
        app.move(at[0] - 20, at[1])
        app.release(*at, "middle")
        assert len(app.session.panes) == 2


def test_a_drop_of_nothing_is_no_drop() -> None:
    with running() as app:
        app.step(FilesDropped(()), frames=2)
        assert app.desk.loading is None


@pytest.mark.parametrize("over", ["keyboard", "about", "slider"])
def test_escape_ends_one_thing_at_a_time(over: str) -> None:
    with running() as app:
        app.press(*skin(app))
        app.release(*skin(app))
        app.step(PointerMoved(5, 5), frames=2)
        (selected,) = app.desk.tool.selected
        if over == "slider":
            app.desk.apply(Edit("Set", False, weights=np.full(app.session.rig.shape_count, 0.1)))
        else:
            setattr(app.desk.view, over, True)
            app.step(PointerMoved(6, 5), frames=2)

        def escape() -> None:
            imgui.get_io().add_key_event(imgui.Key.escape, True)
            app.step(KeyPressed("escape"), frames=2)
            imgui.get_io().add_key_event(imgui.Key.escape, False)
            app.step(PointerMoved(5, 5), frames=2)

        escape()
        assert app.desk.tool.selected == {selected}
        if over == "slider":
            app.session.cancel()  # as the panel does that the slider is in
        else:
            assert not getattr(app.desk.view, over)
        escape()
        assert not app.desk.tool.selected


def test_function_keys_are_heard_while_something_is_typed() -> None:
    with running() as app:
        y = imgui.internal.find_window_by_name("Weights").pos.y + 45
        app.press(1012, y)  # the search for a shape
        app.release(1012, y)
        app.step(PointerMoved(5, 5), frames=2)
        assert imgui.get_io().want_text_input
        app.step(KeyPressed("w"), KeyPressed("f4"), frames=2)
        assert app.desk.view.chart
        assert not app.desk.view.panes[0].wireframe


def test_nothing_is_heard_behind_a_question() -> None:
    with running() as app:
        app.press(*skin(app))
        app.release(*skin(app))
        app.ask(Command.SAVE_POSE)
        app.step(PointerMoved(5, 5), frames=4)
        app.press(*skin(app))  # beside the line to type in: it is left
        app.release(*skin(app))
        app.step(PointerMoved(5, 5), frames=2)
        assert len(app.session.pose.pins) == 1
        app.step(KeyPressed("delete"), KeyPressed("f4"), KeyPressed("p", Modifiers(control=True)), frames=3)
        assert len(app.session.pose.pins) == 1
        assert app.desk.dialog is not None
        assert not app.desk.view.chart
        assert app.desk.view.palette is None


def test_delete_says_that_nothing_is_selected() -> None:
    with running() as app:
        app.press(*skin(app))
        app.release(*skin(app))
        app.desk.tool.selected = frozenset()
        app.key("delete")
        assert app.desk.message == "No pin is selected"
        assert len(app.session.pose.pins) == 1


def test_what_the_mouse_passes_is_not_asked_for_only_where_it_comes_to_rest(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with running() as app:
        x, y = app.pixel_of(4000)
        seen: list[tuple[float, float]] = []
        real = drag.aim_at

        def watched(sight: object, pixel: tuple[float, float], *more: object) -> object:
            seen.append(pixel)
            return real(sight, pixel, *more)

        monkeypatch.setattr(drag, "aim_at", watched)
        Router().take([PointerMoved(x - 20 + at, y) for at in range(21)], app.desk, app.frame.viewports, 1.0)
        assert seen == [(x, y)]
