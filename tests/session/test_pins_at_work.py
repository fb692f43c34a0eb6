"""Several pins at once, in the whole program."""

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from imgui_bundle import imgui

from facepin.core.events import (
    FilesDropped,
    KeyPressed,
    KeyReleased,
    Modifiers,
    PointerMoved,
    PointerPressed,
    PointerReleased,
)
from facepin.core.pose import Pin
from facepin.panels.commands import Command
from facepin.panels.pins import picked
from facepin.panels.requests import AddPane, NamePin, RemovePins, SelectPins, SetPins
from facepin.session.edit import Edit
from facepin.session.hand import nudge
from facepin.session.solving.solving import choose
from support.driver import App, running

BESIDE = (60.0, 120.0)


@pytest.fixture(scope="module")
def program() -> Iterator[App]:
    """One program for the tests that leave it as they found it."""
    with running(solver="tikhonov") as app:
        yield app


@pytest.fixture
def app(program: App) -> Iterator[App]:
    """A face with four pins round the mouth, none selected; the mouse rests beside it."""
    rig = program.session.rig
    x, _, z = rig.neutral.T
    front = z > 0.6 * z.max()
    jaw = np.abs(rig.deltas[:, [rig.shape_names.index("jawOpen")]].toarray().reshape(-1, 3)[:, 1])
    vertices: list[int] = []
    for place in ((-0.06, 0.9), (-0.02, 1.0), (0.02, 1.0), (0.06, 0.9)):
        wanted = np.where(
            front, np.abs(x - place[0] * rig.height) + 5 * np.abs(jaw - place[1] * jaw.max()), 9e9
        )
        vertices.append(int(np.argmin(wanted)))
    assert len(set(vertices)) == 4
    before = program.session.work
    pins = tuple(Pin(v, tuple(rig.neutral[v].astype(float).tolist())) for v in vertices)
    program.desk.apply(Edit("Place pins", True, pins))
    program.step(PointerMoved(*BESIDE), frames=2)
    yield program
    program.key("escape")
    program.key("escape")
    program.desk.view.pins.sketching = False
    program.desk.tool.selected = frozenset()
    while program.session.work is not before:
        assert program.session.undo()
    program.step(PointerMoved(*BESIDE), frames=3)


def vertices_of(app: App) -> list[int]:
    return [pin.vertex for pin in app.session.pose.pins]


def pins_of(app: App) -> dict[int, Pin]:
    return {pin.vertex: pin for pin in app.session.pose.pins}


def test_dragging_one_of_several_selected_pins_drags_all_as_one_step(app: App) -> None:
    first, second, third, fourth = vertices_of(app)
    before = app.session.work
    for vertex, shift in ((first, False), (third, True)):
        at = app.pixel_of(vertex)
        app.press(*at, shift=shift)
        app.release(*at)
    assert app.desk.tool.selected == {first, third}
    assert app.session.work is before
    x, y = app.pixel_of(third)
    app.drag((x, y), (x + 4, y + 22), moves=6)
    after = pins_of(app)
    moves = {pin.vertex: np.subtract(after[pin.vertex].goal, pin.goal) for pin in before.panes[0].pose.pins}
    assert not moves[second].any()
    assert not moves[fourth].any()
    np.testing.assert_allclose(moves[first], moves[third], atol=1e-9)
    assert moves[first][1] < -0.01 * app.session.rig.height
    assert app.session.pose.weights.any()
    assert app.session.undo_label == "Drag 2 pins"
    app.key("z", control=True)
    assert app.session.work is before
    assert app.desk.tool.selected == {first, third}

    x, y = app.pixel_of(first)
    app.press(x, y)
    app.move(x, y + 20)
    assert app.session.in_gesture
    app.key("escape")
    assert app.session.work is before
    app.release(x, y + 20)
    assert app.session.work is before
    assert app.desk.tool.selected == {first, third}


def test_all_are_selected_by_a_key_and_let_go_by_a_click_beside_but_not_by_turning_the_face(app: App) -> None:
    app.key("a", control=True)
    assert app.desk.tool.selected == set(vertices_of(app))
    camera = app.desk.camera
    app.drag(BESIDE, (BESIDE[0] + 40, BESIDE[1]), moves=6)
    assert app.desk.camera != camera
    assert app.desk.tool.selected
    app.desk.look(camera)
    app.press(*BESIDE)
    app.release(*BESIDE)
    assert not app.desk.tool.selected
    app.key("a", control=True)
    app.key("escape")
    assert not app.desk.tool.selected


def test_a_rubber_band_is_seen_and_selects(app: App) -> None:
    places = np.array([app.pixel_of(vertex) for vertex in vertices_of(app)])
    low, high = places.min(axis=0) - 12, places.max(axis=0) + 12
    plain = app.screenshot().astype(int)
    app.press(*low, control=True)
    app.move(*((low + high) / 2))
    app.move(*high)
    change = np.abs(app.screenshot().astype(int) - plain).max(axis=2)
    top, (left, right) = round(low[1]), (int(low[0]) + 4, int(high[0]) - 4)
    assert change[top - 2 : top + 2, left:right].max(axis=0).min() > 15
    assert 3 < np.median(change[top + 4 : top + 8, left:right]) < 40  # thinly filled
    app.release(*high)
    assert app.desk.tool.selected == set(vertices_of(app))
    app.press(BESIDE[0], BESIDE[1], shift=True)
    app.move(BESIDE[0] + 30, BESIDE[1] + 30)
    app.release(BESIDE[0] + 30, BESIDE[1] + 30)
    assert app.desk.tool.selected == set(vertices_of(app))


def test_locked_pins_stay_whatever_is_removed(app: App) -> None:
    first, second, third, fourth = vertices_of(app)
    app.desk.tool.selected = frozenset({first, second})
    app.key("l")
    assert [pin.locked for pin in app.session.pose.pins] == [True, True, False, False]
    assert app.session.undo_label == "Lock 2 pins"
    weights = app.session.pose.weights
    x, y = app.pixel_of(first)
    app.drag((x, y), (x, y + 20), moves=6)
    assert "locked" in app.desk.message
    assert app.session.pose.weights is weights
    app.desk.tool.selected = frozenset({second, third})
    app.key("delete")
    assert vertices_of(app) == [first, second, fourth]
    assert "is locked and stays" in app.desk.message
    app.ask(Command.CLEAR_PINS)
    assert vertices_of(app) == [first, second]
    assert "2 pins are locked and stay" in app.desk.message
    app.ask(RemovePins(frozenset({first})))
    assert vertices_of(app) == [first, second]
    # Still pulling: another pin's drag leaves them near their goals.
    app.key("l")
    assert any(pin.locked for pin in app.session.pose.pins) is False or app.desk.tool.selected != {
        first,
        second,
    }


def test_locked_and_hidden_pins_still_hold(app: App) -> None:
    first, *others = vertices_of(app)
    drag = pins_of(app)[first].goal

    def dragged() -> np.ndarray:
        pins = tuple(
            Pin(pin.vertex, (drag[0], drag[1] - 0.8, drag[2])) if pin.vertex == first else pin
            for pin in app.session.pose.pins
        )
        app.desk.apply(Edit("Drag pin", True, pins, solve=True))
        weights = app.session.pose.weights
        app.key("z", control=True)
        return weights

    plain = dragged()
    app.ask(SetPins(frozenset(others), locked=True, hidden=True))
    np.testing.assert_array_equal(dragged(), plain)
    assert plain.any()


def test_hidden_pins_are_not_drawn_not_pressed_and_come_back(app: App) -> None:
    with_pins = app.screenshot().astype(int)
    first, *others = vertices_of(app)
    x, y = map(int, app.pixel_of(first))
    app.desk.tool.selected = frozenset({first})
    app.key("h", control=True)
    assert pins_of(app)[first].hidden
    assert not app.desk.tool.selected
    app.step(PointerMoved(*BESIDE), frames=3)
    without = app.screenshot().astype(int)
    assert np.abs(with_pins - without)[y - 4 : y + 5, x - 4 : x + 5].max() > 60
    app.key("a", control=True)
    assert app.desk.tool.selected == set(others)
    app.press(x + 1, y)
    assert not app.desk.tool.held
    app.release(x + 1, y)
    # The corner of the picture says so, and a click there brings them back.
    viewport = app.frame.viewport
    app.press(viewport.x + 116, viewport.y + viewport.height - 27)
    app.release(viewport.x + 116, viewport.y + viewport.height - 27)
    assert not pins_of(app)[first].hidden
    assert app.desk.tool.selected == {first}
    assert app.session.undo_label == "Show pin"


def test_the_menu_of_a_selected_pin_is_for_all_that_are_selected(app: App) -> None:
    first, second, third, _ = vertices_of(app)
    app.desk.tool.selected = frozenset({first, second})
    for vertex, selected in ((second, {first, second}), (third, {third})):
        at = app.pixel_of(vertex)
        app.press(*at, "right")
        app.release(*at, "right")
        assert app.desk.view.pin_menu == vertex
        assert app.desk.tool.selected == selected
        app.press(20, 600)
        app.release(20, 600)
        assert app.desk.view.pin_menu is None


def test_several_pins_change_together_as_one_step(app: App) -> None:
    first, second, *_ = vertices_of(app)
    before = app.session.work
    both = frozenset({first, second})
    for stiffness in (2.0, 4.0):
        app.ask(SetPins(both, stiffness=stiffness, final=False))
        assert app.session.in_gesture
    app.ask(SetPins(both, stiffness=4.0))
    assert [pin.stiffness for pin in app.session.pose.pins] == [4, 4, 1, 1]
    assert app.session.undo_label == "Change 2 pins"
    app.key("z", control=True)
    assert app.session.work is before
    app.ask(SetPins(both, locked=False))  # as it is: no step
    assert app.session.work is before


def test_a_name_or_a_lock_does_not_forget_the_drag_that_another_solver_can_be_asked_for(app: App) -> None:
    first, second, *_ = vertices_of(app)
    x, y = app.pixel_of(first)
    app.drag((x, y), (x, y + 20), moves=6)
    weights = app.session.pose.weights
    app.ask(NamePin(first, "jaw"))
    app.ask(SetPins(frozenset({first, second}), locked=True))
    assert app.session.pose.weights is weights
    assert app.session.pane.solved is not None
    app.ask(AddPane(choose("sparse")))
    assert not np.allclose(app.session.pose.weights, weights)
    assert pins_of(app)[first].locked


def test_where_the_left_button_is_free_a_drag_beside_the_face_selects(app: App) -> None:
    app.desk.view.habit = "maya"
    camera, viewport = app.desk.camera, app.frame.viewport
    app.press(*BESIDE)
    app.move(viewport.x + viewport.width - 40, viewport.y + viewport.height - 60)
    app.release(viewport.x + viewport.width - 40, viewport.y + viewport.height - 60)
    assert app.desk.tool.selected == set(vertices_of(app))
    app.press(*BESIDE)
    app.release(*BESIDE)
    assert not app.desk.tool.selected
    assert app.desk.camera is camera
    app.desk.view.habit = "facepin"


def test_a_name_is_typed_into_the_menu_of_a_pin(app: App) -> None:
    first, *_ = vertices_of(app)
    x, y = app.pixel_of(first)
    app.press(x, y, "right")
    app.release(x, y, "right")
    app.press(x + 60, y + 41)
    app.release(x + 60, y + 41)
    imgui.get_io().add_input_characters_utf8("chin")
    app.step(PointerMoved(x + 61, y + 41), frames=2)
    for down in (True, False):
        imgui.get_io().add_key_event(imgui.Key.enter, down)
        app.step(PointerMoved(x + 60, y + 41), frames=2)
    assert pins_of(app)[first].name == "chin"
    assert app.desk.view.pin_menu is None


def test_a_held_arrow_key_is_one_step(app: App, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(nudge, "PAUSE", 0.02)
    first, second, *_ = vertices_of(app)
    app.desk.tool.selected = frozenset({first, second})
    before = app.session.work
    for _ in range(8):
        app.step(KeyPressed("down"))
    moved = pins_of(app)
    x, y, _ = app.desk.camera.project([moved[first].goal], app.frame.viewport)[0]
    rest = app.desk.camera.project([before.panes[0].pose.pins[0].goal], app.frame.viewport)[0]
    np.testing.assert_allclose([x, y], [rest[0], rest[1] + 8], atol=0.05)
    assert app.session.in_gesture
    assert app.session.pose.weights.any()
    app.step(KeyReleased("down"))
    app.until(lambda: not app.session.in_gesture)
    assert app.session.undo_label == "Nudge 2 pins"
    app.until(lambda: not app.frame.drawn)  # at rest again
    app.key("z", control=True)
    assert app.session.work is before


@pytest.mark.parametrize("way_out", ["undo", "escape", "click"])
def test_a_nudge_ends_before_anything_else_begins(app: App, way_out: str) -> None:
    first, second, *_ = vertices_of(app)
    app.desk.tool.selected = frozenset({first})
    before = app.session.work
    app.step(KeyPressed("down", Modifiers(shift=True)))
    goal = pins_of(app)[first].goal
    assert app.session.in_gesture
    if way_out == "undo":
        app.key("z", control=True)
        assert app.session.work is before
        app.key("y", control=True)
        assert pins_of(app)[first].goal == goal
    elif way_out == "escape":
        app.key("escape")
        assert app.session.work is before
        assert app.desk.tool.selected == {first}
    else:
        at = app.pixel_of(second)
        app.step(PointerMoved(*at), PointerPressed(*at), PointerReleased(*at), frames=2)
        assert app.session.undo_label == "Nudge pin"
        assert pins_of(app)[first].goal == goal
        assert app.desk.tool.selected == {second}
    assert not app.session.in_gesture
    assert not app.desk.tool.nudging


def test_a_stroke_is_sketched_and_dragged(app: App) -> None:
    old = set(vertices_of(app))
    app.key("b")
    assert app.desk.view.pins.sketching
    before = app.session.work
    (x0, y0), (x1, _) = (app.pixel_of(vertices_of(app)[at]) for at in (0, 3))
    plain = app.screenshot().astype(int)
    app.press(x0 - 4, y0 - 60)
    for x in np.linspace(x0 - 4, x1 + 4, 25):
        app.move(x, y0 - 60)
    drawn = np.abs(app.screenshot().astype(int) - plain)[int(y0) - 60, int(x0) : int(x1) - 6]
    assert (drawn.max(axis=1) > 30).mean() > 0.9
    app.release(x1 + 4, y0 - 60)
    new = [vertex for vertex in vertices_of(app) if vertex not in old]
    assert len(new) == 6
    assert app.desk.tool.selected == set(new)
    assert app.session.undo_label == "Sketch 6 pins"
    assert not app.session.pose.weights.any()
    xs = [app.pixel_of(vertex)[0] for vertex in new]
    assert xs == sorted(xs)
    at = app.pixel_of(new[2])
    app.drag(at, (at[0], at[1] + 15), moves=6)
    assert app.session.undo_label == "Drag 6 pins"
    assert app.session.pose.weights.any()
    app.key("z", control=True)
    app.key("z", control=True)
    assert app.session.work is before
    assert not app.desk.tool.selected
    app.key("escape")
    assert not app.desk.view.pins.sketching


def test_nothing_is_selected_that_undo_took_away(app: App) -> None:
    *_, last = vertices_of(app)
    app.ask(SelectPins(frozenset(vertices_of(app))))
    app.key("z", control=True)
    assert not vertices_of(app)
    assert not app.desk.tool.selected
    app.key("y", control=True)
    app.ask(SelectPins(frozenset({last})))
    app.key("delete")
    assert not app.desk.tool.selected
    app.key("down")
    assert not app.session.in_gesture


def test_names_are_unique_and_landmarks_come_back_on_the_vertices(app: App, tmp_path: Path) -> None:
    first, second, third, fourth = vertices_of(app)
    for vertex, name in ((first, "mouth  right "), (second, "chin"), (third, "jaw")):
        app.ask(NamePin(vertex, name))
    assert pins_of(app)[first].name == "mouth right"
    app.ask(NamePin(fourth, "chin"))
    assert app.desk.is_error
    assert "called 'chin' already" in app.desk.message
    path = tmp_path / "ada.landmarks.json"
    answer(app, Command.SAVE_LANDMARKS, path)
    assert "3 landmarks" in app.desk.message
    assert "1 pins without a name" in app.desk.message or "1 pin without" in app.desk.message
    named = json.loads(path.read_text())
    assert named["rig"]["vertices"] == app.session.rig.vertex_count
    assert {mark["name"]: mark["vertex"] for mark in named["landmarks"]} == {
        "mouth right": first,
        "chin": second,
        "jaw": third,
    }

    # On a posed face, without pins but one: they hold what is there.
    app.ask(RemovePins(frozenset({first, second, fourth})))
    weights = np.linspace(0, 0.5, app.session.rig.shape_count)
    app.desk.apply(Edit("Set", True, weights=weights))
    before = app.session.work
    answer(app, Command.LOAD_LANDMARKS, path)
    assert {vertex: pin.name for vertex, pin in pins_of(app).items()} == {
        third: "jaw",
        first: "mouth right",
        second: "chin",
    }
    assert app.desk.tool.selected == {first, second, third}
    np.testing.assert_array_equal(app.session.pose.weights, weights)
    for vertex, pin in pins_of(app).items():
        np.testing.assert_allclose(pin.goal, app.desk.stage.positions(0)[vertex], atol=1e-5)
    app.key("z", control=True)
    assert app.session.work is before
    # The same by dropping the file.
    app.step(FilesDropped((path,)), frames=2)
    assert len(vertices_of(app)) == 3

    named["rig"]["vertices"] += 1
    path.write_text(json.dumps(named))
    loaded = app.session.work
    answer(app, Command.LOAD_LANDMARKS, path)
    assert app.desk.is_error
    assert "vertices" in app.desk.message
    assert app.session.work is loaded
    assert app.desk.dialog is not None  # it asks again
    app.desk.dialog.close()
    app.step(PointerMoved(5, 5), frames=2)
    assert app.desk.dialog is None


def answer(app: App, command: Command, path: Path) -> None:
    """Ask for a command that asks for a path, and answer it."""
    app.ask(command)
    app.step(PointerMoved(5, 5), frames=2)
    assert app.desk.dialog is not None
    app.desk.dialog._finish(path)
    app.step(PointerMoved(6, 6), frames=3)


def test_several_panes_share_selection_strokes_and_nudges(app: App) -> None:
    front, old = app.desk.camera, app.session.pose.pins
    app.ask(AddPane(choose("sparse")))
    app.step(PointerMoved(*BESIDE), frames=3)
    app.desk.view.linked = False
    app.desk.look(front.orbited(0.5, 0.0), 1)
    app.key("b")
    viewport = app.frame.viewports[1]
    x, y = viewport.x + viewport.width / 2, viewport.y + 0.66 * viewport.height
    app.drag((x - 50, y), (x + 50, y), moves=6)
    assert app.session.active == 1
    pins = app.session.pose.pins
    new = {pin.vertex for pin in pins[len(old) :]}
    assert len(new) == 6
    assert app.desk.tool.selected == new
    assert all(pane.pose.pins == pins for pane in app.session.panes)
    # Keys move in the plane of the pane that is worked on, wherever the mouse is.
    app.step(PointerMoved(*BESIDE))
    app.step(KeyPressed("right"), KeyReleased("right"))
    way = np.subtract(app.session.pose.pins[-1].goal, pins[-1].goal)
    right = app.desk.cameras[1].axes[0]
    np.testing.assert_allclose(way / np.linalg.norm(way), right, atol=1e-9)
    assert all(pane.pose.pins == app.session.pose.pins for pane in app.session.panes)
    assert all(pane.pose.weights.any() for pane in app.session.panes)
    app.key("z", control=True)
    app.key("z", control=True)
    assert app.session.pose.pins == old
    assert not app.desk.tool.selected
    app.desk.view.linked = True
    app.desk.look(front)


def test_any_sequence_of_changes_is_undone_to_the_start_and_redone_to_the_end(app: App) -> None:
    random = np.random.default_rng(7)
    start = app.session.work
    for _ in range(25):
        steps = 0
        for _ in range(int(random.integers(1, 9))):
            before, vertices = app.session.work, vertices_of(app)
            some = frozenset(random.permutation(vertices)[: random.integers(1, 4)].tolist())
            app.desk.tool.selected = some
            request = random.choice(
                [
                    SetPins(some, locked=bool(random.integers(2))),
                    SetPins(some, hidden=bool(random.integers(2))),
                    SetPins(some, stiffness=float(random.uniform(0.1, 5))),
                    SetPins(some, freedom=str(random.choice(["space", "screen"]))),
                    NamePin(next(iter(some), 0), f"name {random.integers(99)}"),
                    RemovePins(some),
                    Command.LOCK_PINS,
                    Command.HIDE_PINS,
                    Command.SHOW_PINS,
                    Command.CLEAR_PINS,
                ]
            )
            app.ask(request)
            steps += app.session.work is not before
            assert app.desk.tool.selected <= set(vertices_of(app)) | some
        end = app.session.work
        for _ in range(steps):
            assert app.session.undo()
        assert app.session.work is start
        for _ in range(steps):
            assert app.session.redo()
        assert app.session.work is end
        while app.session.work is not start:
            assert app.session.undo()


def test_keys_in_the_list_select_ranges_and_single_rows() -> None:
    vertices = [30, 10, 20, 40]
    click = {"shift": False, "ctrl": False}
    assert picked(vertices, 1, {30, 40}, None, **click) == {10}
    assert picked(vertices, 3, {10}, 10, **click | {"shift": True}) == {10, 20, 40}
    assert picked(vertices, 0, {10}, 20, **click | {"shift": True}) == {30, 10, 20}
    assert picked(vertices, 2, {10}, 99, **click | {"shift": True}) == {20}  # the anchor is gone
    assert picked(vertices, 2, {10}, 10, **click | {"ctrl": True}) == {10, 20}
    assert picked(vertices, 1, {10, 20}, 10, **click | {"ctrl": True}) == {20}


def open_list(app: App) -> None:
    imgui.set_window_focus("Pins")
    app.step(PointerMoved(*BESIDE), frames=3)


def test_the_list_selects_locks_hides_and_renames(app: App) -> None:
    open_list(app)
    first, second, third, fourth = vertices_of(app)
    rows = {vertex: 130 + 25 * at for at, vertex in enumerate(vertices_of(app))}

    def click(x: float, vertex: int) -> None:
        app.press(x, rows[vertex])
        app.release(x, rows[vertex])

    click(990, second)
    assert app.desk.tool.selected == {second}
    assert app.desk.tool.hovered == second
    app.desk.tool.selected = frozenset({second, fourth})
    click(1193, fourth)  # the lock, for both that are selected
    assert [pin.locked for pin in app.session.pose.pins] == [False, True, False, True]
    click(1219, first)  # the eye, for the one that is not
    assert [pin.hidden for pin in app.session.pose.pins] == [True, False, False, False]
    click(1100, third)
    assert [pin.freedom for pin in app.session.pose.pins] == ["space", "space", "screen", "space"]
    app.press(1155, rows[third])
    for x in range(1155, 1196, 4):
        app.move(x, rows[third])
    app.release(1196, rows[third])
    assert pins_of(app)[third].stiffness > 1.2
    assert app.session.undo_label == "Change pin"

    app.step(PointerMoved(990, rows[first]), frames=2)
    for _ in range(2):
        app.step(PointerPressed(990, rows[first]))
        app.step(PointerReleased(990, rows[first]))
    app.step(frames=3)
    imgui.get_io().add_input_characters_utf8("lip corner")
    app.step(PointerMoved(991, rows[first]), frames=2)
    assert imgui.get_io().want_text_input
    app.key("b")  # a letter typed, not a tool
    assert not app.desk.view.pins.sketching
    for down in (True, False):
        imgui.get_io().add_key_event(imgui.Key.enter, down)
        app.step(PointerMoved(990, rows[first]), frames=2)
    assert pins_of(app)[first].name == "lip corner"


def test_the_list_is_open_while_panes_come_and_go(app: App) -> None:
    open_list(app)
    for kind in ("sparse", "transpose"):
        app.ask(AddPane(choose(kind)))
    app.step(PointerMoved(*BESIDE), frames=3)
    assert app.session.active == 2
    assert len(app.frame.viewports) == 3
    app.key("z", control=True)
    app.key("z", control=True, shift=True)
    app.step(PointerMoved(*BESIDE), frames=3)
    assert len(app.frame.viewports) == 3


def test_the_list_is_there_with_no_pins_and_with_sixty(app: App) -> None:
    open_list(app)
    app.ask(RemovePins(frozenset(vertices_of(app))))
    app.step(PointerMoved(*BESIDE), frames=3)
    panel = (slice(40, 320), slice(955, 1275))
    empty = app.screenshot()[panel].astype(int)
    rest = app.session.rig.neutral
    many = tuple(Pin(v, tuple(rest[v].astype(float).tolist()), name="n" * 60) for v in range(0, 6000, 100))
    app.desk.apply(Edit("Place pins", True, many))
    app.step(PointerMoved(*BESIDE), frames=3)
    full = app.screenshot()[panel].astype(int)
    bright = [(picture.max(axis=2) > 180).sum() for picture in (empty, full)]
    assert bright[1] > bright[0] + 500
    app.until(lambda: not app.frame.drawn)
