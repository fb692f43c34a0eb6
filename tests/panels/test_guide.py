"""The first steps come, are followed, and never come again."""

from pathlib import Path

import numpy as np
import pytest

from facepin.core.events import KeyPressed, Modifiers, PointerMoved
from facepin.files.work.preferences import read_preferences
from facepin.panels.commands import Command
from facepin.panels.help.guide import BEAT, BEATS, PATIENCE, STEPS, Guide, Hand
from support.driver import App, running

UNDO = KeyPressed("z", Modifiers(control=True))


def hand(**done: object) -> Hand:
    nothing: dict[str, object] = dict.fromkeys(("pins", "posed", "pin_menu", "undone", "searched"), False)
    return Hand(**{"work": None, **nothing, **done})


def skin(app: App, lower: float = 0.0) -> tuple[float, float]:
    """A pixel in the middle of the face, or so much of its height lower."""
    x, y, z = app.session.rig.neutral.T
    at = np.median(y[z > 0.9 * z.max()]) - lower * app.session.rig.height
    return app.pixel_of(int(np.argmin(np.abs(x) + np.abs(y - at) - z)))


def test_from_the_first_click_to_the_end_and_never_again(tmp_path: Path) -> None:
    with running(settings_folder=tmp_path) as app:
        guide = app.desk.view.guide
        assert guide.step == 0
        x, y = skin(app)
        app.press(x, y)
        app.release(x, y)
        assert guide.step == 1
        app.drag((x, y), (x, y + 30))
        assert guide.step == 2
        app.press(*app.pixel_of(app.session.pose.pins[0].vertex), "right")
        app.release(x, y, "right")
        app.step(PointerMoved(5, 5), frames=2)
        assert guide.step == 3
        app.press(20, 600)  # closes the menu
        app.release(20, 600)
        app.step(UNDO, frames=3)
        assert guide.step == 4
        app.step(KeyPressed("p", Modifiers(control=True)), frames=3)
        assert guide.over
        app.step(frames=2)
    assert read_preferences(tmp_path / "preferences.json")[0].guide == len(STEPS)
    with running(settings_folder=tmp_path) as app:
        assert app.desk.view.guide.over
        app.ask(Command.GUIDE)  # unless it is asked for
        app.step(PointerMoved(5, 5), frames=2)
        assert app.desk.view.guide.step == 0


def test_who_knows_already_is_not_held_up() -> None:
    guide = Guide()
    guide.watch(hand(pins=True, posed=True, undone=True, pin_menu=True, searched=True), 1.0)
    assert guide.over
    guide.watch(hand(), 2.0)
    assert guide.over


def test_a_step_that_is_not_followed_gives_up_after_some_work() -> None:
    guide = Guide()
    guide.watch(hand(pins=True, posed=True, work=object()), 1.0)
    assert guide.step == 2
    for _ in range(PATIENCE * (len(STEPS) - 2) + 3):
        guide.watch(hand(pins=True, posed=True, work=object()), 2.0)
    assert guide.over


def test_the_first_drag_is_waited_for_as_long_as_it_takes() -> None:
    guide = Guide()
    for _ in range(10 * PATIENCE):
        guide.watch(hand(work=object()), 1.0)
    assert guide.step == 0


@pytest.mark.parametrize("lively", [False, True])
def test_it_moves_for_a_while_and_then_costs_nothing(lively: bool) -> None:
    guide = Guide(lively=lively)
    guide.watch(hand(), 10.0)
    assert guide.moving(10.1) is lively
    assert not guide.moving(10.0 + BEATS * BEAT + 0.1)
    guide.watch(hand(pins=True), 30.0)
    assert guide.moving(30.1) is lively


def test_nothing_moves_where_nothing_is_remembered() -> None:
    with running() as app:
        assert not app.desk.view.guide.lively
