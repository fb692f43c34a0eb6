"""The solver panel: any solver's settings, first what they trade, then their numbers."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, fields, replace

import numpy as np
import pytest
from imgui_bundle import imgui

from facepin.core.events import PointerMoved
from facepin.core.names import brief, without_author
from facepin.panels.solving.trade import share_of, value_at
from facepin.session.solving.solving import SolverChoice
from facepin.solvers import SOLVERS, bounded
from facepin.solvers.interface import setting
from support.driver import App, running

TRADES = [
    (kind.key, field)
    for kind in SOLVERS.values()
    for field in fields(kind.settings)
    if field.metadata["ends"]
]


@pytest.mark.parametrize(("key", "field"), TRADES)
def test_a_trade_reaches_both_ends_and_its_default(key: str, field: object) -> None:
    about, usual = field.metadata, field.default
    assert value_at(0.0, about, usual) == about["low"]
    assert value_at(1.0, about, usual) == about["high"]
    assert value_at(share_of(usual, about, usual), about, usual) == pytest.approx(usual, rel=0.01)
    values = [value_at(share, about, usual) for share in np.linspace(0, 1, 50)]
    assert values == sorted(values) and len(set(values)) > 40
    shares = [share_of(value, about, usual) for value in values]
    np.testing.assert_allclose(shares, np.linspace(0, 1, 50), atol=0.02)


def test_titles_say_what_a_solver_does_before_what_it_is_called() -> None:
    for kind in SOLVERS.values():
        assert brief(kind.title) != kind.title and len(brief(kind.title)) < 20
        assert without_author(kind.title).endswith(")") and "," not in without_author(kind.title)
        assert kind.key.split("_")[0] not in brief(kind.title).lower()
    assert len({brief(kind.title) for kind in SOLVERS.values()}) == len(SOLVERS)


@contextmanager
def panel_of(
    choice: SolverChoice | None = None, solver: str = "sparse"
) -> Iterator[tuple[App, float, float]]:
    """The program, and where the first line below the name of the solver is."""
    with running(solver=solver) as app:
        if choice is not None:
            app.session.choose_solver(0, choice)
        io = imgui.get_io()
        io.mouse_double_click_time, io.mouse_single_click_delay = 10, 20  # a slow machine is not a slow hand
        app.step(PointerMoved(5, 5), frames=4)
        window = imgui.internal.find_window_by_name("Solver")
        top = window.pos.y + imgui.get_frame_height() + imgui.get_style().window_padding.y
        yield app, window.pos.x, top + imgui.get_frame_height_with_spacing() + 0.5 * imgui.get_frame_height()


def test_a_drag_between_the_words_is_one_step_and_a_double_click_goes_back() -> None:
    with panel_of() as (app, x, y):
        app.drag((x + 200, y), (x + 40, y))
        price = app.session.pane.choice.settings.price
        assert 0 < price < 0.01
        assert app.session.undo_label == "Solve with Few shapes (sparse)"
        assert len(app.session.steps) == 2
        for _ in range(2):
            app.press(x + 100, y)
            app.release(x + 100, y)
        app.step(frames=2)
        assert app.session.pane.choice.settings.price == 0.1


def test_a_solver_that_nobody_has_seen_yet_is_offered_whole() -> None:
    @dataclass(frozen=True)
    class Settings:
        reach: float = setting(0.5, "How far it goes.", low=0.0, high=1.0, ends=("stay", "follow"))
        times: int = setting(3, "How often.", low=1, high=9)
        way: str = setting("a", "Which way.", choices=("a", "b"))
        twice: bool = setting(False, "Again.")

    kind = replace(bounded.KIND, title="New (nobody 2030)", settings=Settings)
    with panel_of(SolverChoice(kind, Settings())) as (app, x, y):
        app.drag((x + 100, y), (x + 260, y))
        assert app.session.pane.choice.settings.reach > 0.7
        window = imgui.internal.find_window_by_name("Solver")
        before = window.size.y
        app.press(x + 20, window.pos.y + before - 14)
        app.release(x + 20, window.pos.y + before - 14)
        app.step(frames=4)
        assert window.size.y >= before + 4 * imgui.get_frame_height()
        assert window.scroll_max.y == 0
