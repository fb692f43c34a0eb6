"""Series of pictures: from the menu beside the work, and as commands."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facepin.__main__ import main
from facepin.actions import series
from facepin.core.arrays import frozen
from facepin.core.errors import FacepinError
from facepin.core.events import PointerMoved
from facepin.core.pose import Pin, Pose
from facepin.figures.movie import played
from facepin.files import write_model
from facepin.files.animation import Animation
from facepin.files.work.pins_file import write_pins
from facepin.files.work.pose_file import write_pose
from facepin.panels.commands import Command
from facepin.panels.help.guide import STEPS, Guide
from facepin.panels.requests import CancelJob
from facepin.session.edit import Edit
from facepin.session.filmstrip import Filmstrip
from facepin.session.job import Job, Steps, beside
from facepin.session.session import Session
from facepin.session.solving.solving import choose
from support.driver import App, running
from support.small_rigs import sheet

RIG = sheet()


def weights(shape: int) -> np.ndarray:
    found = np.zeros(RIG.shape_count)
    found[shape] = 0.9
    return frozen(found, np.float64)


@pytest.fixture(scope="module")
def rig(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("rig") / "sheet.glb"
    write_model(RIG, np.zeros(4), path)
    return path


@pytest.fixture(scope="module")
def app(rig: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[App]:
    """The application with three poses in its library and a little work done."""
    with running(rig, size=(640, 360), pictures=tmp_path_factory.mktemp("pictures")) as app:
        assert app.desk.library is not None
        for shape, title in enumerate(("One", "Two", "Three")):
            app.desk.library.save(Pose(weights(shape)), title, ())
            app.desk.apply(Edit(f"Apply {title}", True, weights=weights(shape)))
        x, y, z = RIG.neutral[40].astype(float).tolist()
        app.desk.apply(Edit("Place pin", True, (Pin(40, (x, y, z + 0.2)),)))
        app.step(PointerMoved(5, 5), frames=6)
        yield app


def picture_at(path: Path) -> np.ndarray:
    with Image.open(path) as picture:
        return np.asarray(picture)


def done(app: App, command: Command) -> Path:
    """Let a job take its way; return what it says it wrote."""
    app.ask(command)
    assert app.desk.job is not None, app.desk.message
    app.until(lambda: app.desk.job is None)
    assert not app.desk.is_error, app.desk.message
    return Path(app.desk.message[app.desk.message.index("/") :])


def test_a_filmstrip_shows_the_steps_that_changed_the_pose() -> None:
    session = Session(RIG, [choose("transpose")])
    session.apply(Edit("Set one", True, weights=weights(0)))
    session.set_reference(weights(1))
    session.arrange("Remove a pose", {"smile": None})
    pin = Pin(3, (0.0, 0.0, 0.0))
    session.apply(Edit("Place", True, (pin,)))
    session.apply(Edit("Lock", True, (replace(pin, locked=True),)))
    session.apply(Edit("Set two", True, weights=weights(1)))
    session.apply(Edit("Set three", True, weights=weights(2)))
    session.undo()
    session.apply(Edit("Step of a gesture", False, weights=weights(3)))
    strip = Filmstrip()
    stills = strip.stills(session)
    assert [still.label for still in stills] == ["Start", "Set one", "Place", "Set two"]
    assert stills[-1].pose.weights[1] == 0.9
    session.apply(Edit("Step of a gesture", False, weights=weights(2)))
    assert strip.stills(session) is stills
    session.undo()  # the gesture
    session.undo()
    assert len(strip.stills(session)) == 3


def test_a_filmstrip_is_that_of_its_pane() -> None:
    session = Session(RIG, [choose("pseudo_inverse"), choose("transpose")])
    session.active = 1
    goal = tuple((RIG.neutral[30].astype(float) + 0.3).tolist())
    session.apply(Edit("Drag", True, (Pin(30, goal),), solve=True))
    kept = session.pane.pose.weights
    session.close_pane(0)
    stills = Filmstrip().stills(session)
    assert [still.label for still in stills] == ["Start", "Drag"]
    assert stills[1].pose.weights is kept


def test_a_filmstrip_shows_muted_shapes_as_they_were_shown() -> None:
    session = Session(RIG, [choose("transpose")])
    session.apply(Edit("Set", True, weights=frozen([0.5, 0.6, 0.0, 0.0], np.float64)))
    muted = np.array([True, False, False, False])
    session.set_control("Mute shape0", replace(session.control, muted=muted))
    session.set_control("Lock shape1", replace(session.control, locked=~muted))
    stills = Filmstrip().stills(session)
    assert [still.label for still in stills] == ["Start", "Set", "Mute shape0"]
    assert stills[-1].pose.weights.tolist() == [0.0, 0.6, 0.0, 0.0]


def test_a_filmstrip_keeps_the_pixels_of_the_viewport(app: App) -> None:
    app.desk.tool.selected = frozenset()
    app.desk.view.guide = Guide(step=len(STEPS))  # nothing is written over the picture
    app.desk.view.gaze.shown = False
    app.step(PointerMoved(5, 5), frames=6)
    place = app.frame.viewport
    left, top = round(place.x), round(place.y)
    right, bottom = round(place.x + place.width), round(place.y + place.height)
    shown = app.screenshot()[top:bottom, left:right]
    strip = picture_at(done(app, Command.SAVE_FILMSTRIP))
    height, width = shown.shape[:2]
    strip = strip.astype(int)
    corners = np.argwhere((np.abs(strip[: 1 - height, : 1 - width] - shown[0, 0]) <= 1).all(axis=2))
    row = shown[height // 2]
    corners = [(y, x) for y, x in corners if np.abs(strip[y + height // 2, x : x + width] - row).max() <= 1]
    # A grey level apart, where the wall is dithered by the place in the window.
    # The button of symmetry floats over the lowest rows of the window.
    rows = height - 60
    assert any(np.abs(strip[y : y + rows, x : x + width] - shown[:rows]).max() <= 1 for y, x in corners)


def test_a_contact_sheet_has_all_poses(app: App) -> None:
    path = done(app, Command.CONTACT_SHEET)
    sheet_picture = picture_at(path)
    assert sheet_picture.shape[1] > 2 * 320
    assert (sheet_picture == 255).all(axis=2).mean() < 0.4  # not mere paper


def test_every_pose_gets_a_picture_of_the_viewports_size(app: App) -> None:
    folder = done(app, Command.POSE_PICTURES)
    pictures = {path.stem: picture_at(path) for path in folder.iterdir()}
    assert set(pictures) == {"One", "Two", "Three"}
    place = app.frame.viewport
    assert pictures["One"].shape == (round(place.height), round(place.width), 3)
    assert (pictures["One"] != pictures["Two"]).any()


def test_a_turntable_is_a_sequence_and_an_animation(app: App, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(series, "TURN", 8)
    folder = done(app, Command.TURNTABLE)
    frames = sorted(path.name for path in folder.iterdir() if path.stem.isdecimal())
    assert len(frames) == 8
    with Image.open(folder / "turntable.png") as moving:
        assert moving.n_frames == 8
        for number in (0, 3, 7):
            moving.seek(number)
            still = picture_at(folder / f"{number:03}.png")
            np.testing.assert_array_equal(np.asarray(moving.convert("RGB")), still)


def test_one_job_at_a_time_and_it_can_be_given_up(app: App) -> None:
    app.ask(Command.TURNTABLE)
    job = app.desk.job
    app.ask(Command.CONTACT_SHEET)
    assert app.desk.job is job
    assert app.desk.is_error
    app.step(frames=3)
    assert app.frame.drawn  # the window goes on
    app.ask(CancelJob())
    assert app.desk.job is None
    assert "Given up" in app.desk.message


def test_the_filmstrip_window_opens_and_closes(app: App) -> None:
    before = app.screenshot()
    app.ask(Command.FILMSTRIP)
    app.step(PointerMoved(6, 6), frames=4)
    app.until(lambda: app.desk.refined)
    app.step(PointerMoved(5, 5), frames=4)
    shown = app.screenshot()
    assert (shown != before).any(axis=2).mean() > 0.1
    # The newest step is in sight, in its frame, though the strip is longer than the window.
    accent = np.multiply(app.desk.view.theme.accent[:3], 255)
    framed = (np.abs(shown - accent).max(axis=2) < 8).sum(axis=0)
    assert len(Filmstrip().stills(app.session)) * 132 > 0.62 * 640
    assert np.count_nonzero(framed > 40) >= 2
    app.ask(Command.FILMSTRIP)
    app.step(PointerMoved(6, 6), frames=6)


def test_a_job_ends_with_its_line_and_passes_errors_on() -> None:
    def steps() -> Steps:
        yield 0.25
        found = yield from beside(lambda: 7, 0.5)
        return f"made {found}"

    job = Job("Making", steps())
    seen = []
    while (line := job.advance()) is None:
        seen.append(job.fraction)
    assert line == "made 7"
    assert seen[0] == 0.25
    assert set(seen[1:]) <= {0.5}

    def failing(error: Exception) -> Steps:
        def fail() -> None:
            raise error

        yield from beside(fail, 0.0)
        return ""

    for error, told in ((FacepinError("disk full"), "disk full"), (KeyError("bug"), "could not be made")):
        job = Job("Making", failing(error))
        with pytest.raises(FacepinError, match=told):
            while job.advance() is None:
                pass


def test_frames_that_are_alike_are_one_shown_longer(tmp_path: Path) -> None:
    dark, light = (np.full((5, 6, 3), value, np.uint8) for value in (10, 200))
    animation = Animation()
    for frame in (dark, dark.copy(), dark, light):
        animation.add(frame)
    animation.write(tmp_path / "moving.png", 0.1)
    with Image.open(tmp_path / "moving.png") as moving:
        assert moving.n_frames == 2
        durations = []
        for number in range(2):
            moving.seek(number)
            durations.append(moving.info["duration"])
        assert durations == [300, 100]


@pytest.mark.parametrize("channels", [3, 4])
def test_an_animation_holds_the_very_pixels(tmp_path: Path, channels: int) -> None:
    random = np.random.default_rng(1)
    frames = [random.integers(0, 255, (9, 7, channels), np.uint8) for _ in range(4)]
    animation = Animation()
    for frame in frames:
        animation.add(frame)
    animation.write(tmp_path / "moving.png", 0.1)
    with Image.open(tmp_path / "moving.png") as moving:
        assert (moving.n_frames, moving.info["loop"]) == (4, 0)
        for number, frame in enumerate(frames):
            moving.seek(number)
            assert moving.info["duration"] == 100
            shown = np.asarray(moving)
            seen = frame[..., 3:] > 0 if channels == 4 else True
            np.testing.assert_array_equal(np.where(seen, shown, 0), np.where(seen, frame, 0))


@pytest.fixture
def poses(tmp_path: Path) -> Path:
    folder = tmp_path / "sheet.poses"
    folder.mkdir()
    for shape in range(3):
        write_pose(folder / f"pose {shape}.json", RIG, Pose(weights(shape)))
    return folder


def test_the_command_sheet(
    rig: Path, poses: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (poses / "broken.json").write_text("{")
    (poses / "foreign.json").write_text('{"weights": {"nothing": 1}}')
    words = ["sheet", str(rig), "--poses", str(poses), "--size", "90x80", "--columns", "2"]
    words += ["--each", str(tmp_path / "each"), "--transparent", "--out", str(tmp_path / "sheet.png")]
    assert main(words) == 0
    printed = capsys.readouterr()
    assert printed.out.splitlines()[0] == str(tmp_path / "sheet.png")
    assert "left out: broken.json" in printed.err
    assert "foreign: 1 of 1 shapes" in printed.err
    height, width, _ = picture_at(tmp_path / "sheet.png").shape
    assert 2 * 90 < width < 3 * 90
    assert height > 2 * 80
    each = {path.stem: picture_at(path) for path in (tmp_path / "each").iterdir()}
    assert set(each) == {"pose 0", "pose 1", "pose 2", "foreign"}
    assert each["pose 0"].shape == (80, 90, 4)
    assert each["pose 0"][0, 0, 3] == 0


def test_the_command_turntable(rig: Path, poses: Path, tmp_path: Path) -> None:
    words = ["turntable", str(rig), "--pose", str(poses / "pose 1.json"), "--size", "60x50", "--frames", "4"]
    words += ["--transparent"]
    assert main([*words, "--out", str(tmp_path / "turn.png")]) == 0
    assert main([*words, "--out", str(tmp_path / "turn")]) == 0
    with Image.open(tmp_path / "turn.png") as moving:
        assert (moving.n_frames, moving.size) == (4, (60, 50))
    stills = [picture_at(tmp_path / "turn" / f"{number:03}.png") for number in range(4)]
    covered = [(still[..., 3] > 128).mean() for still in stills]
    # A sheet is wide from the front and next to nothing from the side.
    assert min(covered[0], covered[2]) > 3 * max(covered[1], covered[3])


def test_the_command_movie(rig: Path, tmp_path: Path) -> None:
    x, y, z = RIG.neutral[40].astype(float).tolist()
    write_pins(tmp_path / "pins.json", (Pin(40, (x, y + 0.3, z)), Pin(20, (x, y, z + 0.3))))
    words = ["movie", str(rig), "--pins", str(tmp_path / "pins.json"), "--frames", "3", "--size", "120x80"]
    assert main([*words, "--out", str(tmp_path / "movie.png")]) == 0
    assert main([*words[:-1], "300x12", "--out", str(tmp_path / "flat.png")]) == 0
    with Image.open(tmp_path / "movie.png") as moving:
        assert moving.size == (120, 80)
        assert moving.n_frames >= 7  # pictures that are alike are one, shown longer


def test_a_movie_ends_where_a_hand_would() -> None:
    x, y, z = RIG.neutral[40].astype(float).tolist()
    pins = (Pin(40, (x, y + 0.3, z)), Pin(20, (x, y, z + 0.3)))
    *_, last = played(RIG, choose("tikhonov"), pins, 5)
    session = Session(RIG, [choose("tikhonov")])
    session.apply(Edit("Drag pin", True, pins[:1], solve=True))
    session.apply(Edit("Drag pin", True, pins, solve=True))
    np.testing.assert_allclose(last.pose.weights, session.pose.weights, atol=1e-12)
    for pin, other in zip(last.pose.pins, session.pose.pins, strict=True):
        np.testing.assert_allclose(pin.goal, other.goal, atol=1e-6)
    assert last.held is None


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["sheet", "RIG", "--poses", "none", "--out", "x.png"], "no such folder"),
        (["sheet", "RIG", "--poses", "EMPTY", "--out", "x.png"], "no poses"),
        (["sheet", "RIG", "--poses", "EMPTY", "--out", "x.gif"], ".png"),
        (["sheet", "RIG", "--poses", "EMPTY", "--columns", "0", "--out", "x.png"], "--columns"),
        (["turntable", "RIG", "--out", "x.gif"], ".gif"),
        (["turntable", "RIG", "--frames", "many", "--out", "x.png"], "--frames"),
        (["movie", "RIG", "--out", "x.png"], "--pins"),
        (["movie", "RIG", "--solver", "all", "--out", "x.png"], "one solver"),
        (["movie", "RIG", "--pins", "none.json", "--out", "x.png"], "none.json"),
    ],
)
def test_commands_refuse_in_one_line(
    rig: Path, tmp_path: Path, words: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "empty").mkdir()
    places = {"RIG": str(rig), "EMPTY": str(tmp_path / "empty")}
    assert main([places.get(word, word) for word in words]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.count("\n") == 1
    assert told in printed.err
