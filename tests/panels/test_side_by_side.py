"""A comparison in the window: the reference beside the panes, heat on one scale, windows beside the faces."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from imgui_bundle import imgui

from facepin.core.events import KeyPressed, PointerMoved, Stirred
from facepin.core.look.camera import Viewport
from facepin.frame import docks, over_picture
from facepin.panels import layout
from facepin.panels.chart import names_that_fit
from facepin.panels.commands import Command
from facepin.panels.requests import AddPane, Choose
from facepin.session.edit import Edit
from facepin.session.solving.solving import choose
from support.driver import App, running

SMILE = "mouthSmileLeft"


@pytest.fixture
def app() -> Iterator[App]:
    with running(solver="transpose,sparse", size=(1280, 720)) as app:
        reference = np.zeros(app.session.rig.shape_count)
        reference[app.session.rig.shape_names.index(SMILE)] = 1.0
        app.session.set_reference(reference)
        yield app


def settled(app: App) -> None:
    app.step(PointerMoved(5, 500), frames=5)


def picture(app: App, viewport: Viewport) -> np.ndarray:
    """The middle of a pane, without title and hints."""
    x, y, w, h = (round(side) for side in (viewport.x, viewport.y, viewport.width, viewport.height))
    return app.screenshot()[y + h // 5 : y + 4 * h // 5, x + 4 : x + w - 4].astype(int)


def test_the_reference_has_a_pane_that_shows_it_and_nothing_moves_it(app: App) -> None:
    settled(app)
    assert len(app.frame.viewports) == 2
    app.ask(Command.SHOW_REFERENCE)
    settled(app)
    assert len(app.frame.viewports) == 3 and len(app.session.panes) == 2
    place = app.frame.viewports[2]
    meant = app.session.rig.evaluate(app.session.work.reference)
    assert app.desk.stage is not None
    np.testing.assert_allclose(app.desk.stage.positions(2), meant, atol=1e-4)
    before, steps, camera = app.session.work, len(app.session.steps), app.desk.camera
    x, y = place.x + place.width / 2, place.y + 0.6 * place.height
    app.drag((x, y), (x, y + 40))
    assert app.session.work is before and len(app.session.steps) == steps, "it is not for pins"
    assert app.session.active == 0
    app.drag((x, place.y + 0.97 * place.height), (x + 40, place.y + 0.97 * place.height), button="middle")
    assert app.desk.camera is not camera and app.desk.cameras[0] is app.desk.cameras[1] is app.desk.camera


def test_it_is_closed_from_its_title_and_opened_from_that_of_a_pane(app: App) -> None:
    app.ask(Command.SHOW_REFERENCE)
    settled(app)
    for name, item in (("reference", "Close"), ("0", Command.SHOW_REFERENCE.title)):
        before = app.desk.view.reference_shown
        window = imgui.internal.find_window_by_name(f"##pane {name}")
        x, y = window.pos.x + 20, window.pos.y + imgui.get_style().window_padding.y + 6
        app.press(x, y)
        app.release(x, y)
        app.step(frames=3)
        rect = place_of_item(app, item)
        app.press(*rect)
        app.release(*rect)
        settled(app)
        assert app.desk.view.reference_shown is not before


def place_of_item(app: App, title: str) -> tuple[float, float]:
    """Where an item of the open menu is, as it is drawn in the next frame."""
    found: list[tuple[float, float]] = []
    real = imgui.menu_item_simple

    def watched(label: str, *rest: object, **more: object) -> bool:
        chosen = real(label, *rest, **more)
        if label == title:
            low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
            found.append(((low.x + high.x) / 2, (low.y + high.y) / 2))
        return chosen

    imgui.menu_item_simple = watched
    try:
        app.step(Stirred(), frames=2)
    finally:
        imgui.menu_item_simple = real
    return found[-1]


def test_without_a_reference_there_is_nothing_to_show(app: App) -> None:
    app.ask(Command.SHOW_REFERENCE)
    settled(app)
    app.ask(Command.FORGET_REFERENCE)
    settled(app)
    assert len(app.frame.viewports) == 2
    app.session.undo()
    settled(app)
    assert len(app.frame.viewports) == 3
    for key in ("tikhonov", "hybrid"):
        app.ask(AddPane(choose(key)))
    settled(app)
    assert len(app.frame.viewports) == 5
    rest = layout.unused(app.frame.viewport, app.frame.viewports)
    assert rest is not None and rest.width > 200
    assert app.screenshot()[round(rest.y) + 60, round(rest.x) + 60].max() < 60, "dark in every theme"


def test_weights_of_the_reference_are_bars_like_the_others(app: App, monkeypatch: pytest.MonkeyPatch) -> None:
    sets: list[int] = []
    real = docks.weights_panel

    def watched(*given: object, **more: object) -> object:
        sets.append(0 if more["reference"] is None else 1)
        return real(*given, **more)

    monkeypatch.setattr(docks, "weights_panel", watched)
    row = app.session.rig.shape_names.index(SMILE)
    app.desk.view.weights.search = SMILE

    def bar() -> np.ndarray:
        settled(app)
        columns = app.desk.view.weights.columns
        assert columns is not None
        begin, end = columns.slider
        y = round(columns.y(0))
        return app.screenshot()[y : y + round(columns.row), round(begin) + 4 : round(end) - 4].astype(int)

    bare = bar()
    assert sets[-1] == 0
    app.ask(Command.SHOW_REFERENCE)
    assert app.session.work.reference[row] == 1.0
    shown = bar()
    changed = np.abs(shown - bare).max(axis=2) > 30
    assert changed.any(axis=0).mean() > 0.9, "as long as the slider"
    assert 0.15 < changed.mean() < 0.5, "one bar of three"


def test_heat_is_switched_for_all_panes_and_has_one_legend(app: App, monkeypatch: pytest.MonkeyPatch) -> None:
    legends: list[Viewport] = []
    real = over_picture.heat_legend

    def watched(height: float, place: Viewport, *rest: float) -> None:
        legends.append(place)
        real(height, place, *rest)

    monkeypatch.setattr(over_picture, "heat_legend", watched)
    app.ask(Command.SHOW_REFERENCE)
    app.session.apply(Edit("Set", True, weights=app.session.work.reference))
    app.step(KeyPressed("h"))
    settled(app)
    assert [view.shading for view in (*app.desk.view.panes, app.desk.view.reference)] == ["heat"] * 3
    legends.clear()
    app.step(PointerMoved(6, 500))
    assert legends == [app.frame.viewports[2]]
    one, other = (picture(app, app.frame.viewports[at]) for at in (0, 2))
    width = min(one.shape[1], other.shape[1]) - 100
    assert np.abs(one[:, :width] - other[:, :width]).mean() < 1.0, "the same moves have the same colours"
    app.step(KeyPressed("h"))
    settled(app)
    assert [view.shading for view in (*app.desk.view.panes, app.desk.view.reference)] == ["studio"] * 3


def test_windows_open_where_they_cover_no_face(app: App) -> None:
    settled(app)
    faces = app.frame.viewport
    app.ask(Command.CHART)
    app.ask(Command.HISTORY)
    settled(app)
    app.ask(Command.FILMSTRIP)
    settled(app)
    for name in ("Chart", "History", "Filmstrip"):
        window = imgui.internal.find_window_by_name(name)
        seen, pos, size = app.frame.viewport, window.pos, window.size
        apart = (
            pos.x + size.x <= seen.x + 1
            or pos.x >= seen.x + seen.width - 1
            or pos.y >= seen.y + seen.height - 1
        )
        assert apart and window.dock_node is not None, name
    app.desk.view.chart = app.desk.view.history = app.desk.view.filmstrip = False
    settled(app)
    assert app.frame.viewport == faces, "closed, they take no room"


def test_a_chart_stands_beside_a_face_that_loses_nothing_and_where_the_user_puts_it(tmp_path: Path) -> None:
    for start in range(2):
        with running(size=(1600, 800), settings_folder=tmp_path) as app:
            settled(app)
            before = app.frame.viewport
            app.desk.view.chart = True
            settled(app)
            window = imgui.internal.find_window_by_name("Chart")
            assert window.pos.x < 2 and app.frame.viewport.height == before.height
            if start == 0:
                assert window.size.x == pytest.approx(400, abs=4)
                x = window.size.x + 1
                app.drag((x, 400), (x + 100, 400))
                settled(app)
            assert app.frame.viewport.x == pytest.approx(502 if start == 0 else app.frame.viewport.x, abs=4)
            assert window.size.x == pytest.approx(500, abs=4), "kept from run to run"
            app.step(frames=2)


def test_names_fit_and_the_largest_have_them_first() -> None:
    sizes = np.abs(np.random.default_rng(1).normal(size=153))
    assert names_that_fit(sizes, 0.9) == list(range(153))
    named = names_that_fit(sizes, 3.4)
    assert np.diff(named).min() >= 4 and 153 / 8 < len(named) <= 153 / 4 + 1
    assert int(np.argmax(sizes)) in named
    for row in set(range(153)) - set(named):
        near = [other for other in named if abs(other - row) < 4]
        assert sizes[near].max() >= sizes[row], "what has no name gave way to something larger"
    assert names_that_fit(np.zeros(0), 2.0) == []


@pytest.mark.parametrize("key", ["tikhonov", "hybrid"])
def test_between_panes_it_is_dark_in_the_light_theme(key: str, app: App) -> None:
    app.ask(Choose("theme_name", "light"))
    app.ask(AddPane(choose(key)))
    app.ask(Command.SHOW_REFERENCE)
    settled(app)
    whole = app.frame.viewport
    row = app.screenshot()[round(whole.y + whole.height / 3), : round(whole.x + whole.width), :].max(axis=1)
    gaps = {round(place.x) - step for place in app.frame.viewports if place.x > whole.x for step in (1, 2)}
    assert gaps and row[sorted(gaps)].max() < 40


@pytest.mark.parametrize("theme", ["dark", "light"])
def test_many_shapes_and_long_names_make_a_chart(theme: str, app: App) -> None:
    app.ask(Choose("theme_name", theme))
    app.ask(Command.SHOW_REFERENCE)
    app.ask(Command.CHART)
    settled(app)
    window = imgui.internal.find_window_by_name("Chart")
    x, y, w, h = (round(side) for side in (window.pos.x, window.pos.y, window.size.x, window.size.y))
    names = app.screenshot()[y + h // 3 : y + h - 60, x + 20 : x + w // 3].astype(int)
    lines = np.ptp(names.max(axis=2), axis=1) > 100
    assert np.count_nonzero(np.diff(lines.astype(int)) == 1) > 5, "names stand along the axis"
