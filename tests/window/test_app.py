"""The whole application, driven without a screen."""

import json
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facepin.core.events import FilesDropped, PointerMoved, PointerReleased, Scrolled
from facepin.core.look.shading import MODES
from facepin.core.pose import Pin, Pose
from facepin.core.rig import Rig
from facepin.panels.commands import Command
from facepin.panels.requests import AddPane, KeepPane, RemovePins, SetPins
from facepin.session.edit import Edit
from facepin.session.solving.solving import PinSolver, choose
from support.driver import App, running


@pytest.fixture(scope="module")
def narrow(shared: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The narrow ICT face, unpacked."""
    import tarfile

    folder = tmp_path_factory.mktemp("narrow")
    with tarfile.open(shared / "models/ict-facekit/ict_narrowface_expressions.tar.xz") as archive:
        archive.extractall(folder, filter="data")
    return folder / "ict_narrowface_expressions"


def chin(app: App) -> int:
    """Vertex of the skin that jawOpen moves most, seen from the front."""
    rig = app.session.rig
    jaw = rig.shape_names.index("jawOpen")
    moves = rig.deltas[:, [jaw]].toarray().reshape(-1, 3)
    x, _, z = rig.neutral.T
    front = (z > 0.75 * z.max()) & (np.abs(x) < 0.02 * rig.height)
    return int(np.argmin(np.where(front, moves[:, 1], np.inf)))


@pytest.mark.parametrize("solver", ["pseudo_inverse", "tikhonov", "transpose", "hybrid"])
def test_press_on_the_chin_drag_down_release(narrow: Path, solver: str) -> None:
    with running(narrow, solver) as app:
        app.desk.view.freedom = "space"
        before = app.session.pose
        x, y = app.pixel_of(chin(app))
        app.press(x, y)
        (pin,) = app.session.pose.pins
        for step in range(1, 31):
            app.move(x, y + step)
        app.release(x, y + 30)
        rig, pose = app.session.rig, app.session.pose
        jaw = rig.shape_names.index("jawOpen")
        assert pose.weights[jaw] > 0.05

        # The pin's vertex is on its goal up to what the solver itself says is left.
        solved = app.session.pane.solved
        position = rig.evaluate(pose.weights)[pin.vertex].astype(float)
        miss = np.linalg.norm(np.subtract(pose.pins[0].goal, position))
        assert miss == pytest.approx(solved.pin_error, abs=1e-4 * rig.height)
        if solver in ("pseudo_inverse", "tikhonov"):
            assert miss < 0.01 * rig.height

        # Thirty moves and one straight solve give the same weights.
        straight = PinSolver(rig, choose(solver)).solve(pose.pins, before.weights)
        np.testing.assert_allclose(pose.weights, straight.weights, atol=1e-9)

        # The picture shows what the session says.
        np.testing.assert_allclose(app.desk.stage.positions(0)[pin.vertex], position, atol=1e-5)

        app.key("z", control=True)
        assert app.session.pose is before
        app.key("z", control=True, shift=True)
        assert app.session.pose is pose


def test_escape_cancels_a_drag() -> None:
    with running() as app:
        before = app.session.pose
        x, y = app.pixel_of(chin(app))
        app.press(x, y)
        app.move(x, y + 40)
        assert app.session.pose.weights.any()
        app.key("escape")
        assert app.session.pose is before
        app.release(x, y + 40)
        assert app.session.pose is before


def test_pins_hold_while_others_are_dragged_and_delete_removes_the_selected() -> None:
    with running(solver="tikhonov") as app:
        app.desk.view.freedom = "space"
        first = chin(app)
        x, y = app.pixel_of(first)
        app.drag((x, y), (x, y + 30))
        goal = app.session.pose.pins[0].goal
        rig = app.session.rig
        raised = rig.deltas[1::3, [rig.shape_names.index("browInnerUp")]].toarray().ravel()
        brow = int(np.argmax(raised))
        bx, by = app.pixel_of(brow)
        app.drag((bx, by), (bx, by - 15))
        pins = app.session.pose.pins
        assert len(pins) == 2
        # Held where it was when the other one was pressed: Tikhonov had brought it near its goal.
        np.testing.assert_allclose(pins[0].goal, goal, atol=0.01 * app.session.rig.height)
        app.key("delete")
        assert [pin.vertex for pin in app.session.pose.pins] == [pins[0].vertex]
        app.key("z", control=True)
        assert app.session.pose.pins == pins


def test_dragging_a_slider_moves_the_face_at_once_and_is_one_undo_step() -> None:
    with running() as app:
        before = app.session.pose
        rest = app.desk.stage.positions(0)
        x, y = 1110.0, 445.0  # the left end of some row's slider
        app.press(x, y)
        for step in range(1, 11):
            app.move(x + 6 * step, y)
            assert app.session.in_gesture
        app.release(x + 60, y)
        (changed,) = np.flatnonzero(app.session.pose.weights)
        assert 0.2 < app.session.pose.weights[changed] < 0.8
        assert app.session.undo_label == f"Set {app.session.rig.shape_names[changed]}"
        assert not np.array_equal(app.desk.stage.positions(0), rest)
        app.key("z", control=True)
        assert app.session.pose is before


def test_home_resets_the_pose() -> None:
    with running() as app:
        x, y = app.pixel_of(chin(app))
        app.drag((x, y), (x, y + 30))
        app.key("home")
        assert not app.session.pose.weights.any()
        # The pin stays, its goal back on its vertex.
        (pin,) = app.session.pose.pins
        np.testing.assert_allclose(pin.goal, app.session.rig.neutral[pin.vertex], atol=1e-6)


def test_the_wheel_zooms_and_f_frames_again() -> None:
    with running() as app:
        app.key("f")
        framed = app.desk.camera
        app.step(PointerMoved(400, 300), frames=2)
        app.step(Scrolled(400, 300, 3), frames=2)
        assert app.desk.camera.distance < framed.distance
        app.key("f")
        assert app.desk.camera.distance == pytest.approx(framed.distance)


def test_dragging_beside_the_face_turns_the_camera_and_alt_does_so_on_it() -> None:
    with running() as app:
        for at, held in (((60, 120), {}), (app.pixel_of(chin(app)), {"alt": True})):
            before = app.desk.camera
            app.drag(at, (at[0] + 50, at[1] + 20), **held)
            assert app.desk.camera.yaw != before.yaw
        assert not app.session.pose.pins


def test_nothing_is_drawn_when_nothing_happens() -> None:
    with running() as app:
        app.step(frames=8)
        for _ in range(5):
            app.step()
            assert not app.frame.drawn
        app.step(PointerMoved(300, 300))
        assert app.frame.drawn


def test_the_face_is_solved_once_per_frame_however_many_mouse_events_came(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    solved = []
    solve = PinSolver.solve
    monkeypatch.setattr(PinSolver, "solve", lambda *args: solved.append(1) or solve(*args))
    with running() as app:
        x, y = app.pixel_of(chin(app))
        app.press(x, y)
        app.step(*(PointerMoved(x, y + step) for step in range(4, 44)))
        assert len(solved) == 1
        one = app.session.pose.weights
        app.step(PointerMoved(x, y + 43))
        np.testing.assert_array_equal(one, app.session.pose.weights)
        app.step(PointerReleased(x, y + 43), frames=2)


def test_a_dropped_file_is_opened_and_a_bad_one_leaves_everything_in_place(shared: Path) -> None:
    with running() as app:
        x, y = app.pixel_of(chin(app))
        app.drag((x, y), (x, y + 30))
        pose = app.session.pose
        app.step(FilesDropped((shared / "bad/glb_bad_magic.glb",)))
        app.until(lambda: app.desk.loading is None)
        assert app.desk.is_error
        assert "glb_bad_magic.glb" in app.desk.message
        assert app.session.pose is pose
        app.step(FilesDropped((shared / "good/control.glb",)))
        app.until(lambda: app.session.rig.name == "control")
        assert app.desk.title.startswith("control")


def test_opening_can_be_cancelled(narrow: Path) -> None:
    with running(wait=False) as app:
        app.until(lambda: app.desk.stage is not None)
        rig = app.session.rig
        app.desk.opener.open(narrow)
        app.desk.loading.cancel()
        app.until(lambda: app.desk.loading is None)
        assert app.session.rig is rig
        assert not app.desk.is_error


def test_a_pose_is_saved_and_loaded_by_typing_a_path(tmp_path: Path) -> None:
    with running() as app:
        x, y = app.pixel_of(chin(app))
        app.drag((x, y), (x, y + 30))
        assert "*" in app.desk.title
        path = tmp_path / "pose.json"
        _answer(app, Command.SAVE_POSE, path)
        assert "*" in app.desk.title  # a pose is not all that a scene holds
        saved = json.loads(path.read_text())
        weights = app.session.pose.weights
        names = app.session.rig.shape_names
        assert [saved["weights"][name] for name in names] == pytest.approx(weights.tolist())
        app.key("home")
        _answer(app, Command.LOAD_POSE, path)
        np.testing.assert_allclose(app.session.pose.weights, weights)
        assert len(app.session.pose.pins) == 1
        _answer(app, Command.EXPORT, tmp_path / "posed.obj")
        assert (tmp_path / "posed.obj").stat().st_size > 1000
        _answer(app, Command.EXPORT, tmp_path / "posed.docx")
        assert app.desk.is_error
        assert ".docx" in app.desk.message


def _answer(app: App, command: Command, path: Path) -> None:
    """Ask for a command that asks for a path, and answer it."""
    app.ask(command)
    app.step(PointerMoved(5, 5), frames=2)
    assert app.desk.dialog is not None
    app.desk.dialog._finish(path)
    app.step(PointerMoved(6, 6), frames=3)


def test_f12_saves_what_the_viewport_shows(tmp_path: Path) -> None:
    with running(pictures=tmp_path / "shots", scale=1.25, size=(700, 420)) as app:
        app.desk.view.guide.step = 99  # what stands over the picture is not in it
        app.desk.view.gaze.shown = False
        app.press(*app.pixel_of(2000))
        app.release(*app.pixel_of(2000))
        for mode in MODES:
            app.desk.view.panes[0].mode = mode
            app.step(PointerMoved(5, 5), frames=6)
            app.key("f12", shift=True)
            app.until(lambda: not app.desk.errands.busy)
            saved = np.asarray(Image.open(tmp_path / "shots" / f"ada-{list(MODES).index(mode) + 1:03}.png"))
            view = app.frame.viewport
            x, y = round(view.x), round(view.y)
            assert saved.shape[:2] == (round(view.height), round(view.width))
            shown = app.screenshot()[y : y + saved.shape[0], x : x + saved.shape[1]]
            # The legend of the heat map is a panel over the picture, and so is the button of symmetry.
            same = np.abs(shown.astype(int) - saved[..., :3]).max(axis=2)[2:-50] <= 1
            assert same[:, : -saved.shape[1] // 3].mean() > 0.995, (
                "but for lines that round to the next pixel"
            )
        app.key("f12")
        app.until(lambda: not app.desk.errands.busy)
        bare = np.asarray(Image.open(tmp_path / "shots" / f"ada-{len(MODES) + 1:03}.png")).astype(int)
        assert 20 < np.count_nonzero(np.abs(bare - saved).max(axis=2) > 8) < 2000, "the pin alone"


def test_a_pose_with_pins_to_begin_with() -> None:
    def first(rig: Rig) -> Pose:
        x, y, z = rig.neutral[100].tolist()
        return Pose(np.zeros(rig.shape_count), (Pin(100, (x, y - 0.5, z)),))

    with running(first_pose=first) as app:
        assert app.session.pose.pins[0].vertex == 100


def test_preferences_are_kept_and_broken_ones_do_not_stop_the_start(tmp_path: Path, shared: Path) -> None:
    (tmp_path / "preferences.json").write_text("{ broken")
    with running(shared / "good/control.npz", settings_folder=tmp_path) as app:
        assert app.session.rig.name == "control"
        app.step(PointerMoved(3, 3), frames=3)
    kept = json.loads((tmp_path / "preferences.json").read_text())
    assert [Path(path).name for path in kept["recent"]] == ["control.npz"]


@pytest.mark.parametrize(("size", "scale"), [((640, 360), 1.0), ((2560, 1440), 2.0), ((300, 200), 1.0)])
def test_every_size_of_window_draws(size: tuple[int, int], scale: float) -> None:
    with running(size=size, scale=scale) as app:
        assert app.frame.viewport.width >= 1
        assert app.screenshot().std() > 5


def test_the_menu_of_a_pin_opens_once_and_changes_the_pin() -> None:
    with running() as app:
        app.desk.view.freedom = "space"
        x, y = app.pixel_of(chin(app))
        app.drag((x, y), (x, y + 30))
        (pin,) = app.session.pose.pins
        x, y = app.pixel_of(pin.vertex)
        app.press(x, y, "right")
        app.release(x, y, "right")
        assert app.desk.view.pin_menu == pin.vertex
        weights = app.session.pose.weights
        app.ask(SetPins(frozenset({pin.vertex}), freedom="screen"))
        assert app.session.pose.pins[0].freedom == "screen"
        assert app.session.pose.weights is not weights  # solved again at once
        # A click beside it closes it for good.
        app.press(20, 500)
        app.release(20, 500)
        assert app.desk.view.pin_menu is None
        app.ask(RemovePins(frozenset({pin.vertex})))
        assert not app.session.pose.pins


def test_a_pin_that_no_shape_moves_is_pointed_out() -> None:
    with running() as app:
        app.drag((473, 630), (473, 631))  # the shirt
        assert "No shape" in app.desk.message


def test_several_panes_are_dragged_as_one_and_undone_as_one() -> None:
    with running(size=(1600, 900)) as app:
        app.desk.view.freedom = "space"
        for key in ("tikhonov", "sparse", "tikhonov"):
            app.ask(AddPane(choose(key)))
        app.step(PointerMoved(5, 5), frames=3)
        assert len(app.frame.viewports) == 4
        before = app.session.work
        vertex = chin(app)
        viewport = app.frame.viewports[2]
        x, y, _ = app.desk.cameras[2].project(app.desk.stage.positions(2)[vertex][None], viewport)[0]
        app.drag((x, y), (x, y + 25))
        panes = app.session.panes
        assert app.session.active == 2  # where the mouse went down
        assert all(pane.pose.pins == panes[0].pose.pins for pane in panes)
        for pane in panes:  # each from its own weights with its own solver
            alone = PinSolver(app.session.rig, pane.choice).solve(
                pane.pose.pins, before.panes[0].pose.weights
            )
            np.testing.assert_allclose(pane.pose.weights, alone.weights, atol=1e-9)
        assert not np.allclose(panes[0].pose.weights, panes[1].pose.weights, atol=1e-3)
        np.testing.assert_array_equal(panes[1].pose.weights, panes[3].pose.weights)
        app.key("z", control=True)
        assert app.session.work is before
        app.key("z", control=True, shift=True)
        app.ask(KeepPane(2))
        app.step(PointerMoved(6, 6), frames=3)
        assert len(app.frame.viewports) == 1
        assert app.session.pose is panes[2].pose
        app.key("z", control=True)
        assert len(app.frame.viewports) == 4


def test_cameras_can_be_unlinked() -> None:
    with running(size=(1600, 900)) as app:
        app.ask(AddPane(choose("tikhonov")))
        app.step(PointerMoved(5, 5), frames=3)
        corner = app.frame.viewports[1]
        at = (corner.x + corner.width - 30, corner.y + corner.height - 90)  # above what floats there
        app.drag(at, (at[0] - 40, at[1]))
        assert app.desk.cameras[0] == app.desk.cameras[1]
        app.desk.view.linked = False
        app.drag(at, (at[0] - 40, at[1]))
        assert app.desk.cameras[0] != app.desk.cameras[1]


def test_the_reference_is_measured_against_and_undone() -> None:
    with running(size=(1600, 900)) as app:
        app.ask(AddPane(choose("tikhonov")))
        weights = np.zeros(app.session.rig.shape_count)
        weights[[3, 8]] = 0.7, 0.5
        app.session.set_reference(weights)
        app.step(PointerMoved(5, 5), frames=3)
        found = app.desk.stage.appraise(0)
        assert found.e_rms == pytest.approx(np.sqrt((0.7**2 + 0.5**2) / len(weights)))
        assert found.far_motion == 0
        app.key("z", control=True)
        assert app.desk.stage.appraise(0).e_rms is None


def test_a_dropped_pose_is_loaded(tmp_path: Path) -> None:
    (tmp_path / "pose.json").write_text(
        '{"format": "facepin-pose", "version": 1, "weights": {"jawOpen": 0.4}}'
    )
    with running() as app:
        app.step(FilesDropped((tmp_path / "pose.json",)), frames=2)
        assert app.session.pose.weights[app.session.rig.shape_names.index("jawOpen")] == 0.4


def test_warnings_of_a_file_are_shown(shared: Path) -> None:
    with running(shared / "bad/glb_duplicate_target_names.glb") as app:
        assert "warning" in app.desk.message
        assert app.session.rig.warnings


def test_overlays_are_toggled_by_keys_and_change_the_picture() -> None:
    with running() as app:
        pictures = [app.screenshot().astype(int)]
        for key in ("w", "w", "g", "g"):
            app.key(key)
            app.until(lambda: not app.frame.drawn)
            pictures.append(app.screenshot().astype(int))
        viewport = app.frame.viewport
        inside = (slice(100, int(viewport.height)), slice(100, int(viewport.width) - 100))
        changes = [np.abs(a[inside] - b[inside]).mean() for a, b in pairwise(pictures)]
        assert changes[0] > 1
        assert changes[1] > 1
        np.testing.assert_array_equal(pictures[0][inside], pictures[2][inside])
        np.testing.assert_array_equal(pictures[0][inside], pictures[4][inside])


def test_home_resets_all_panes() -> None:
    with running(size=(1600, 900)) as app:
        app.ask(AddPane(choose("tikhonov")))
        app.step(PointerMoved(5, 5), frames=3)
        app.session.apply(Edit("Drag pin", True, (Pin(100, (0.0, 0.0, 9.0)),), solve=True))
        app.key("home")
        assert not any(pane.pose.weights.any() for pane in app.session.panes)
