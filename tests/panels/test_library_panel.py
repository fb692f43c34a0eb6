"""The library panel, driven as a hand would."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from imgui_bundle import imgui

from facepin.core.arrays import frozen
from facepin.core.errors import FacepinError
from facepin.core.events import PointerMoved, PointerPressed, PointerReleased, Stirred
from facepin.core.pose import Pin, Pose
from facepin.desk import portraits
from facepin.files import write_model
from facepin.panels.commands import Command
from facepin.panels.library.requests import (
    ApplyPose,
    ComparePoses,
    LabelPose,
    MovePose,
    RemovePoses,
    ReplacePose,
    SavePose,
)
from facepin.resources import resource
from facepin.session.edit import Edit
from support.driver import App, running
from support.small_rigs import sheet

KEY = imgui.Key


@pytest.fixture(scope="module")
def rig(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("rig") / "sheet.glb"
    write_model(sheet(shapes=8), np.zeros(8), path)
    return path


@contextmanager
def library(rig: Path, folder: Path, titles: tuple[str, ...] = ("Smile", "Frown", "Blink")) -> Iterator[App]:
    """The application with poses of one shape each in the library of a rig, whose panel is open."""
    own = folder / rig.name
    if not own.exists():
        own.write_bytes(rig.read_bytes())
    with running(own, size=(720, 640)) as app:
        # A click's callback asks the keyboard, where nobody is; what `hold` says has to come in its frame.
        imgui.get_io().config_input_trickle_event_queue = False
        assert app.desk.library is not None
        for at, title in enumerate(titles):
            app.desk.library.save(Pose(weights(app, at % 8)), title, ("mouth",) if at % 2 else ())
        app.desk.view.library_opens = True
        settle(app)
        yield app


def weights(app: App, shape: int) -> np.ndarray:
    found = np.zeros(app.session.rig.shape_count)
    found[shape] = 0.8
    return frozen(found, np.float64)


def settle(app: App) -> None:
    for pixel in (5, 6, 7):  # files are read, then pictures asked for, then shown
        app.step(PointerMoved(pixel, 5), frames=2)
        app.until(lambda: app.desk.refined)


def middle(app: App, key: str) -> tuple[float, float]:
    """A pixel in the middle of a pose's picture."""
    _, left, top, right, _ = next(cell for cell in app.desk.view.library.cells if cell[0] == key)
    return (left + right) / 2, top + (right - left) / 2


def hold(key: imgui.Key, down: bool) -> None:
    """Press a key for imgui; that a mouse button is pressed makes the backend ask the keyboard again."""
    imgui.get_io().add_key_event(key, down)


def tap(app: App, key: imgui.Key) -> None:
    for down in (True, False):
        hold(key, down)
        app.step(Stirred(), frames=2)


def click(app: App, key: str, *held: imgui.Key) -> None:
    app.press(*middle(app, key))
    app.window.inject(PointerReleased(*middle(app, key)))
    for modifier in held:
        app.window._incoming.add(None, partial(hold, modifier, True))
    app.step(frames=1)
    for modifier in held:
        hold(modifier, False)
    app.step(frames=3)


def titles(app: App) -> list[str]:
    assert app.desk.library is not None
    return [pose.title for pose in app.desk.library.poses]


def on_disk(folder: Path) -> set[str]:
    return {path.name for path in (folder / "sheet.poses").iterdir()}


def written_at(folder: Path, name: str) -> int:
    return (folder / "sheet.poses" / name).stat().st_mtime_ns


def test_pictures_are_made_and_kept_beside_the_poses(rig: Path, tmp_path: Path) -> None:
    with library(rig, tmp_path) as app:
        assert on_disk(tmp_path) == {
            f"{name}.{kind}" for name in ("Smile", "Frown", "Blink") for kind in ("json", "png")
        }
        written = {name: written_at(tmp_path, name) for name in on_disk(tmp_path)}
        (tmp_path / "sheet.poses/Frown.png").unlink()
        first = app.screenshot()
    with library(rig, tmp_path, ()) as app:
        assert titles(app) == ["Smile", "Frown", "Blink"]
        np.testing.assert_array_equal(app.screenshot()[:600, 400:], first[:600, 400:])
        for name in on_disk(tmp_path) - {"Frown.png"}:
            assert written_at(tmp_path, name) == written[name]
        assert "Frown.png" in on_disk(tmp_path)


def test_what_is_not_looked_at_is_not_read(rig: Path, tmp_path: Path) -> None:
    with library(rig, tmp_path):
        pass
    with running(tmp_path / rig.name, size=(720, 640)) as app:
        assert app.desk.library is not None
        assert app.desk.library.is_reading
        assert app.desk.library.poses == ()


def test_a_click_applies_a_pose_as_one_step_and_pins_stay(rig: Path, tmp_path: Path) -> None:
    with library(rig, tmp_path) as app:
        x, y, z = app.session.rig.neutral[40].astype(float).tolist()
        app.desk.apply(Edit("Place pin", True, (Pin(40, (x, y, z)),)))
        before = app.session.pose
        click(app, "Frown")
        np.testing.assert_array_equal(app.session.pose.weights, weights(app, 1))
        (pin,) = app.session.pose.pins
        assert app.desk.stage is not None
        np.testing.assert_allclose(pin.goal, app.desk.stage.positions(0)[40], atol=1e-5)
        assert app.session.undo_label == "Apply Frown"
        app.ask(Command.UNDO)
        assert app.session.pose is before


def test_shift_adds_a_pose(rig: Path, tmp_path: Path) -> None:
    with library(rig, tmp_path) as app:
        click(app, "Smile")
        click(app, "Frown", KEY.mod_shift)
        np.testing.assert_array_equal(app.session.pose.weights, weights(app, 0) + weights(app, 1))
        assert app.desk.message == ""
        click(app, "Frown", KEY.mod_shift)
        assert "beyond the limits" in app.desk.message
        assert app.session.pose.weights[1] == 1.6  # seen and told, not clipped


def alt_drag(app: App, key: str, way: float) -> None:
    x, y = middle(app, key)
    app.press(x, y)
    hold(KEY.mod_alt, True)
    app.step(frames=1)
    for part in np.linspace(0, way, 6)[1:]:
        app.move(x + part, y)
    app.step(frames=2)


def test_alt_drag_blends_in_part_live_and_in_one_step(rig: Path, tmp_path: Path) -> None:
    with library(rig, tmp_path) as app:
        click(app, "Smile")
        before = app.session.pose
        steps = len(app.session.steps)
        alt_drag(app, "Frown", 50)
        assert app.session.in_gesture
        expected = 0.75 * weights(app, 0) + 0.25 * weights(app, 1)
        np.testing.assert_allclose(app.session.pose.weights, expected, atol=1e-12)
        app.move(middle(app, "Frown")[0] + 5000, 400)
        app.step(frames=2)
        np.testing.assert_array_equal(app.session.pose.weights, weights(app, 1))
        app.move(middle(app, "Frown")[0] + 100, 400)
        app.step(frames=2)
        app.release(middle(app, "Frown")[0] + 100, 400)
        app.step(frames=2)
        assert not app.session.in_gesture
        assert len(app.session.steps) == steps + 1
        assert app.session.undo_label == "Blend 50% of Frown"
        app.ask(Command.UNDO)
        assert app.session.pose is before


@pytest.mark.parametrize("end", ["escape", "back"])
def test_a_blend_given_up_leaves_the_pose_exactly(rig: Path, tmp_path: Path, end: str) -> None:
    with library(rig, tmp_path) as app:
        click(app, "Smile")
        before, steps = app.session.pose, len(app.session.steps)
        alt_drag(app, "Frown", 90)
        assert app.session.pose is not before
        if end == "escape":
            tap(app, KEY.escape)
            app.step(PointerMoved(*middle(app, "Blink")), frames=2)
            assert app.session.pose is before
        else:
            app.move(*middle(app, "Frown"))
        app.step(frames=2)
        app.release(*middle(app, "Frown"))
        app.step(frames=2)
        assert app.session.pose is before
        assert len(app.session.steps) == steps


def test_save_asks_for_name_and_tags_in_the_panel(rig: Path, tmp_path: Path) -> None:
    with library(rig, tmp_path, ()) as app:
        app.desk.apply(Edit("Set", True, weights=weights(app, 5)))
        app.ask(Command.SAVE_TO_LIBRARY)
        app.step(PointerMoved(5, 5), frames=4)
        assert app.desk.view.library.saving
        assert imgui.get_io().want_text_input
        assert app.desk.view.library.title == "Pose 1"
        for letter in "Grin":  # over the suggested name, which is selected
            imgui.get_io().add_input_character(ord(letter))
        app.step(PointerMoved(7, 7), frames=4)
        tap(app, KEY.enter)
        assert titles(app) == ["Grin"]
        assert not app.desk.view.library.saving
        assert str(tmp_path) in app.desk.message
        # Esc gives up.
        app.ask(Command.SAVE_TO_LIBRARY)
        app.step(PointerMoved(5, 5), frames=4)
        tap(app, KEY.escape)
        assert not app.desk.view.library.saving
        assert titles(app) == ["Grin"]


def test_names_order_and_removal_are_undone_and_redone_with_their_files(rig: Path, tmp_path: Path) -> None:
    with library(rig, tmp_path) as app:
        everything = on_disk(tmp_path)
        app.ask(LabelPose("Smile", " Grin\n", ("happy",)))
        assert titles(app) == ["Grin", "Frown", "Blink"]
        assert app.session.undo_label == "Rename Smile"
        assert app.desk.keeper.is_saved(app.session)  # the pose on the face is none the less saved
        app.ask(MovePose("Blink", "Smile"))
        assert titles(app) == ["Blink", "Grin", "Frown"]
        app.ask(RemovePoses(("Smile", "Frown")))
        assert titles(app) == ["Blink"]
        assert "Smile.json" not in on_disk(tmp_path)
        assert "Smile.png" not in on_disk(tmp_path)
        app.desk.apply(Edit("Set", True, weights=weights(app, 7)))
        app.ask(ReplacePose("Blink"))
        np.testing.assert_array_equal(app.desk.library.pose("Blink").weights, weights(app, 7))
        for _ in range(5):
            app.ask(Command.UNDO)
            settle(app)
        assert titles(app) == ["Smile", "Frown", "Blink"]
        assert on_disk(tmp_path) >= everything - {"Smile.png", "Frown.png"}
        for _ in range(5):
            app.ask(Command.REDO)
            settle(app)
        assert titles(app) == ["Blink"]
    with library(rig, tmp_path, ()) as app:
        assert titles(app) == ["Blink"]
        np.testing.assert_array_equal(app.desk.library.poses[0].weights, weights(app, 7))


def test_a_picture_dragged_between_others_moves_its_pose(rig: Path, tmp_path: Path) -> None:
    with library(rig, tmp_path) as app:
        x, y = middle(app, "Smile")
        app.drag(middle(app, "Blink"), (x - 20, y))
        app.step(frames=3)
        assert titles(app) == ["Blink", "Smile", "Frown"]
        assert app.session.undo_label == "Move Blink"
        assert not app.session.pose.weights.any()
        settle(app)
        x, y = middle(app, "Frown")
        app.drag(middle(app, "Blink"), (x + 20, y))
        app.step(frames=3)
        assert titles(app) == ["Smile", "Frown", "Blink"]
        app.drag(middle(app, "Frown"), (200, 300))  # let go over the face: nothing
        assert titles(app) == ["Smile", "Frown", "Blink"]


def test_a_picture_let_go_after_the_last_in_sight_stays_in_sight(rig: Path, tmp_path: Path) -> None:
    with library(rig, tmp_path, tuple(f"P{number:02}" for number in range(40))) as app:
        last = app.desk.view.library.cells[2][0]  # the end of the first row
        x, y = middle(app, last)
        app.drag(middle(app, "P00"), (x + 20, y))
        app.step(frames=3)
        assert titles(app)[:4] == ["P01", "P02", "P00", "P03"]
        app.drag(middle(app, "P01"), (middle(app, last)[0] - 20, y))
        app.step(frames=3)
        assert titles(app)[:4] == ["P01", "P02", "P00", "P03"]  # before the one that follows it anyway


def test_two_selected_poses_are_compared(rig: Path, tmp_path: Path) -> None:
    with library(rig, tmp_path) as app:
        before = app.session.work
        click(app, "Smile", KEY.mod_ctrl)
        click(app, "Blink", KEY.mod_ctrl)
        assert app.desk.view.library.selected == ("Smile", "Blink")
        app.ask(ComparePoses("Smile", "Blink"))
        np.testing.assert_array_equal(app.session.pose.weights, weights(app, 2))
        np.testing.assert_array_equal(app.session.work.reference, weights(app, 0))
        assert app.desk.view.panes[0].ghost == "reference"
        app.ask(Command.UNDO)
        assert app.session.work is before
        click(app, "Smile", KEY.mod_ctrl)
        assert app.desk.view.library.selected == ("Blink",)


def test_locked_shapes_stay_and_are_told(rig: Path, tmp_path: Path) -> None:
    with library(rig, tmp_path) as app:
        locked = np.arange(8) == 0
        app.session.set_control("Lock shape0", replace(app.session.control, locked=locked))
        app.ask(ApplyPose("Frown"))
        assert app.desk.message == ""
        app.ask(ApplyPose("Smile"))
        assert not app.session.pose.weights.any()
        assert "shape0 is locked" in app.desk.message
        app.ask(ComparePoses("Smile", "Blink"))
        np.testing.assert_array_equal(app.session.pose.weights, weights(app, 2))
        assert "locked" not in app.desk.message


def test_a_pose_of_other_shapes_says_what_does_not_match(rig: Path, tmp_path: Path) -> None:
    with library(rig, tmp_path, ("Smile",)) as app:
        path = tmp_path / "sheet.poses" / "Foreign.json"
        path.write_text('{"weights": {"Shape1": 0.5, "noSuchShape": 0.3}}')
    with library(rig, tmp_path, ()) as app:
        app.ask(ApplyPose("Foreign"))
        assert "noSuchShape" in app.desk.message
        assert app.session.pose.weights.max() == 0.5


def test_what_cannot_be_kept_is_said_in_one_line() -> None:
    with running() as app:  # no settings folder: the built-in face has no place for poses
        app.ask(SavePose("Smile", ()))
        assert app.desk.is_error
        assert "no folder" in app.desk.message
        app.ask(ApplyPose("gone"))
        assert "no pose 'gone'" in app.desk.message


@pytest.mark.parametrize("count", [0, 3, 60])
def test_idle_costs_nothing_with_the_panel_open(rig: Path, tmp_path: Path, count: int) -> None:
    with library(rig, tmp_path, tuple(f"Pose {number}" for number in range(count))) as app:
        app.step(frames=10)
        drawn = 0
        for _ in range(30):
            app.step()
            drawn += app.frame.drawn
        assert drawn <= 3  # a tooltip's second look at most


def test_pictures_of_one_press_are_not_given_to_the_face(rig: Path, tmp_path: Path) -> None:
    with library(rig, tmp_path) as app:
        app.step(PointerMoved(*middle(app, "Smile")), frames=2)
        app.step(PointerPressed(*middle(app, "Smile")), frames=2)
        assert not app.desk.tool.holding
        app.release(*middle(app, "Smile"))
        assert app.session.pose.pins == ()


def test_without_poses_there_is_no_sheet(rig: Path, tmp_path: Path) -> None:
    with library(rig, tmp_path, ()) as app:
        app.ask(Command.CONTACT_SHEET)
        assert app.desk.is_error
        assert "no poses" in app.desk.message
        assert app.desk.job is None


@pytest.mark.parametrize("name", ["ada", "mira"])
def test_poses_of_the_program_s_own_faces_are_kept_among_the_settings(name: str, tmp_path: Path) -> None:
    face = None if name == "ada" else resource("assets", f"faces/{name}.npz")
    with running(face, size=(500, 400), settings_folder=tmp_path) as app:
        assert app.desk.library.folder.is_relative_to(tmp_path)


def test_a_picture_that_cannot_be_stored_is_shown_all_the_same(
    rig: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise FacepinError("smile.png: no space left")

    monkeypatch.setattr(portraits, "write_thumbnail", full)
    with library(rig, tmp_path) as app:
        assert app.desk.library is not None and app.desk.portraits is not None
        app.until(lambda: app.desk.refined)
        assert all(app.desk.portraits.tile(pose.weights) is not None for pose in app.desk.library.poses)
        remarks: list[str] = []
        monkeypatch.setattr(imgui, "set_item_tooltip", remarks.append)
        settle(app)
        assert any("no space left" in remark for remark in remarks)
