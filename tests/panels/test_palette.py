"""The command palette, typed into."""

from pathlib import Path

import numpy as np
import pytest
from imgui_bundle import imgui

from facepin.actions import carry_out
from facepin.core.events import KeyPressed, Modifiers, PointerMoved
from facepin.panels.availability import why_not
from facepin.panels.commands import Command
from facepin.panels.help.palette import entries, ranked
from facepin.panels.library.requests import SavePose
from facepin.panels.requests import Choose, Request
from facepin.panels.view import CHOICES, View
from facepin.session.edit import Edit
from support.driver import App, running

CALL = KeyPressed("p", Modifiers(control=True))


def typed(app: App, text: str) -> None:
    imgui.get_io().add_input_characters_utf8(text)
    app.step(PointerMoved(5, 5), frames=3)


def key(app: App, key: imgui.Key) -> None:
    imgui.get_io().add_key_event(key, True)
    app.step(PointerMoved(5, 5), frames=2)
    imgui.get_io().add_key_event(key, False)
    app.step(PointerMoved(6, 5), frames=2)


def called(app: App, text: str = "") -> None:
    app.step(CALL, frames=4)
    assert app.desk.view.palette is not None
    if text:
        typed(app, text)


def test_type_some_letters_and_press_enter() -> None:
    with running() as app:
        called(app, "wf")
        key(app, imgui.Key.enter)
        assert app.desk.view.palette is None
        assert app.desk.view.panes[0].wireframe
        # What was done lately comes first.
        called(app)
        key(app, imgui.Key.enter)
        assert not app.desk.view.panes[0].wireframe
        assert app.desk.view.lately == ("Wireframe",)


@pytest.mark.parametrize("call", [CALL, KeyPressed("f3")])
def test_the_key_that_opens_it_closes_it(call: KeyPressed) -> None:
    with running() as app:
        app.desk.view.habit = "blender"
        app.step(call, frames=4)
        assert app.desk.view.palette is not None
        app.step(KeyPressed("w"), KeyPressed("delete"), call, frames=4)
        assert app.desk.view.palette is None
        assert not app.desk.view.panes[0].wireframe, "keys write while it is open"


def test_arrows_choose_and_escape_leaves() -> None:
    with running() as app:
        called(app, "theme")
        key(app, imgui.Key.down_arrow)
        key(app, imgui.Key.up_arrow)
        key(app, imgui.Key.up_arrow)  # round to the last
        key(app, imgui.Key.down_arrow)
        key(app, imgui.Key.escape)
        assert app.desk.view.palette is None
        assert app.desk.view.theme_name == "dark"
        called(app, "theme light")
        key(app, imgui.Key.enter)
        assert app.desk.view.theme_name == "light"


def test_letters_typed_into_it_are_no_shortcuts_and_a_click_beside_it_closes_it() -> None:
    with running() as app:
        called(app)
        app.step(KeyPressed("h"), frames=2)
        assert app.desk.view.panes[0].shading == "studio"
        app.press(100, 600)
        app.release(100, 600)
        assert app.desk.view.palette is None


def test_it_is_called_out_of_a_text_field_too() -> None:
    with running() as app:
        y = imgui.internal.find_window_by_name("Weights").pos.y + 45
        app.press(1010, y)  # the search for shapes
        app.release(1010, y)
        app.step(PointerMoved(1010, y + 1), frames=3)
        assert imgui.get_io().want_text_input
        app.step(KeyPressed("w"), frames=2)
        assert not app.desk.view.panes[0].wireframe
        called(app, "wire")
        key(app, imgui.Key.enter)
        assert app.desk.view.panes[0].wireframe


def test_what_can_not_be_done_says_why_and_is_not_done() -> None:
    with running() as app:
        called(app, "undo")
        key(app, imgui.Key.enter)
        assert app.desk.view.palette is not None  # it stays, and shows the reason
        assert app.desk.message == ""
        assert why_not(Command.UNDO, app.session) == "nothing to undo"
        assert why_not(Command.UNDO, None) == "no face is open"
        assert why_not(Command.OPEN_FILE, None) == ""


def test_a_click_chooses() -> None:
    with running() as app:
        called(app, "chart")
        app.press(640, 109)
        app.release(640, 109)
        app.step(frames=2)
        assert app.desk.view.chart
        (entry,) = (e for e in entries(app.desk.view, app.session, []) if e.request is Command.CHART)
        assert entry.on


def test_everything_is_in_it_and_can_be_carried_out(tmp_path: Path) -> None:
    with running(pictures=tmp_path) as app:
        found = entries(app.desk.view, app.session, [tmp_path / "face.npz"])
        requests = [entry.request for entry in found]
        assert {command for command in Command if command not in requests} == {Command.PALETTE}
        assert all(Choose(name, value) in requests for name in CHOICES for value in CHOICES[name].values)
        assert any(entry.title == "Open face.npz" for entry in found)
        harmless: list[Request] = [one for one in requests if isinstance(one, Choose)]
        for request in [*harmless, Command.ABOUT, Command.KEYBOARD, Command.GUIDE]:
            carry_out(request, app.desk)
        app.step(PointerMoved(5, 5), frames=3)
        assert app.desk.message == ""


@pytest.mark.parametrize(
    ("query", "first"),
    [
        ("wire", "Wireframe"),
        ("light", "Theme: Light"),
        ("dark mode", "Theme: Dark"),
        ("blender", "Mouse and keys: Blender"),
        ("pose save", "Save pose…"),
        ("png", "Save picture"),
        ("unwanted motion", "Heat map of the move"),
        ("maya", "Mouse and keys: Maya"),
        ("mouse keys", "Mouse and keys: Facepin"),  # of those that fit alike, the first of the table
    ],
)
def test_what_is_meant_comes_first(query: str, first: str) -> None:
    assert ranked(entries(View(), None, []), query, ())[0][0].title == first


def test_a_pose_of_the_library_is_found_by_name_and_tag_and_put_on_the_face(tmp_path: Path) -> None:
    with running(settings_folder=tmp_path) as app:
        for title, jaw in (("Shout", 0.8), ("Whisper", 0.1)):
            weights = np.zeros(app.session.rig.shape_count)
            weights[app.session.rig.shape_names.index("jawOpen")] = jaw
            app.desk.apply(Edit("Set jawOpen", True, weights=weights))
            app.ask(SavePose(title, ("mouth",)))
        app.desk.apply(Edit("Reset all weights", True, weights=np.zeros(app.session.rig.shape_count)))
        app.step(PointerMoved(5, 5), frames=3)
        found = entries(app.desk.view, app.session, [], app.desk.library.poses)
        assert {entry.title for entry, _ in ranked(found, "pose mouth", ())} >= {
            "Pose: Shout",
            "Pose: Whisper",
        }
        called(app, "shout")
        key(app, imgui.Key.enter)
        assert app.session.pose.weights.max() == pytest.approx(0.8)


def test_a_shading_is_chosen_by_its_name() -> None:
    with running() as app:
        called(app, "shading clay")
        key(app, imgui.Key.enter)
        assert app.desk.view.panes[0].mode == "clay"


def test_nothing_fits_nonsense() -> None:
    assert ranked(entries(View(), None, []), "qqq", ()) == []


def test_of_two_that_fit_alike_the_one_used_lately_comes_first() -> None:
    found = entries(View(), None, [])
    plain = [entry.title for entry, _ in ranked(found, "theme", ())]
    used = [entry.title for entry, _ in ranked(found, "theme", ("Theme: Light",))]
    assert plain[:2] == ["Theme: Dark", "Theme: Light"]
    assert used[:2] == ["Theme: Light", "Theme: Dark"]


def test_what_was_used_lately_leads_the_whole_list() -> None:
    lately = ("Wireframe", "Theme: Light")
    titles = [entry.title for entry, _ in ranked(entries(View(), None, []), "", lately)]
    assert titles[:3] == [*lately, "Open file…"]
