"""The levels of quality: which one is drawn when, and that what earlier versions remembered counts."""

import json
from pathlib import Path

import moderngl
import numpy as np
import pytest

from facepin.core.events import PointerMoved
from facepin.core.quality import LEVELS, Level, level
from facepin.desk.stage import Stage
from facepin.files.work.preferences import read_preferences
from facepin.gpu.canvas import Canvas, Canvases
from facepin.panels.requests import Choose
from support.driver import running


def test_automatic_is_fast_only_in_motion_without_a_graphics_card() -> None:
    for software in (True, False):
        for moving in (True, False):
            found = level("auto", software=software, moving=moving)
            assert found == LEVELS["fast" if software and moving else "good"]
            assert level("best", software=software, moving=moving) == Level(8, fine=True)
            assert level("fast", software=software, moving=moving) == Level(0, fine=False)


def test_there_is_one_canvas_for_each_number_of_samples(gl: moderngl.Context) -> None:
    canvases, size = Canvases(gl), (60, 40)
    plain = canvases.of(0, size)
    assert plain.samples == 0
    assert canvases.of(4, size) is canvases.of(4, size)
    assert canvases.of(10_000, size) is canvases.of(int(gl.max_samples), size), "as far as the machine goes"
    assert canvases.of(4, (50, 30)).size == (50, 30)
    with pytest.raises(RuntimeError, match="size"):
        _ = plain.size  # nothing of another size is kept
    canvases.release()


def test_without_room_for_samples_the_face_is_there_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    plain = Canvas.resize

    def full(canvas: Canvas, width: int, height: int) -> None:
        if canvas.samples:
            raise moderngl.Error("out of memory")
        plain(canvas, width, height)

    monkeypatch.setattr(Canvas, "resize", full)
    with running(size=(400, 300)) as app:
        assert app.desk.message == "Edges are not smoothed: out of memory"
        assert app.screenshot().std() > 10
        app.ask(Choose("quality", "best"))
        app.step(PointerMoved(5, 5), frames=4)
        assert app.screenshot().std() > 10


def test_without_room_to_keep_faces_they_are_drawn_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    plain = Canvas.twin

    def full(canvas: Canvas) -> Canvas:
        made = plain(canvas)
        if canvas.samples:
            monkeypatch.setattr(made, "resize", fail)
        return made

    def fail(*_: object) -> None:
        raise moderngl.Error("out of memory")

    monkeypatch.setattr(Canvas, "twin", full)
    with running(size=(500, 400)) as app:
        x, y = app.pixel_of(2000)
        app.press(x, y)
        app.release(x, y)
        app.step(PointerMoved(5, 395), frames=4)
        app.step(PointerMoved(x, y), frames=4)
        assert app.desk.tool.hovered is not None
        assert app.screenshot().std() > 10


def test_a_frame_in_which_the_face_is_as_before_costs_no_mean(monkeypatch: pytest.MonkeyPatch) -> None:
    copies: list[object] = []
    plain = Canvas.flat

    def noted(canvas: Canvas) -> moderngl.Framebuffer:
        copies.append(canvas)
        return plain(canvas)

    with running(size=(400, 300)) as app:
        monkeypatch.setattr(Canvas, "flat", noted)
        for at in range(5):
            app.step(PointerMoved(390, 100 + at))
        assert not copies


def test_pictures_are_drawn_with_the_level_that_is_chosen(monkeypatch: pytest.MonkeyPatch) -> None:
    drawn: list[tuple[int, bool]] = []
    plain = Stage.draw

    def noted(stage: Stage, canvas: Canvas, *rest: object, fine: bool, **more: object) -> None:
        drawn.append((canvas.samples, fine))
        plain(stage, canvas, *rest, fine=fine, **more)

    monkeypatch.setattr(Stage, "draw", noted)
    rough, smooth = (0, False), (4, True)
    with running(size=(400, 300)) as app:
        for quality, at_rest, in_motion in (
            ("auto", smooth, rough),
            ("fast", rough, rough),
            ("good", smooth, smooth),
        ):
            app.ask(Choose("quality", quality))
            x, y = app.pixel_of(2000)
            app.press(x, y)
            app.move(x, y + 6)
            assert drawn[-1] == in_motion
            app.release(x, y + 6)
            app.step(frames=4)
            assert drawn[-1] == at_rest


@pytest.mark.parametrize(
    ("then", "now"), [("always", "good"), ("off", "fast"), ("auto", "auto"), ("best", "best")]
)
def test_what_earlier_versions_remembered_counts(tmp_path: Path, then: str, now: str) -> None:
    file = tmp_path / "preferences.json"
    file.write_text(json.dumps({"quality": then}))
    found, complaint = read_preferences(file)
    assert (found.quality, complaint) == (now, None)
    file.write_text(json.dumps({"quality": ["always"]}))
    assert "quality" in str(read_preferences(file)[1])


def test_the_mouse_on_a_pin_draws_no_face_again(monkeypatch: pytest.MonkeyPatch) -> None:
    faces: list[Stage] = []
    plain = Stage.draw

    def noted(stage: Stage, *rest: object, **more: object) -> None:
        faces.append(stage)
        plain(stage, *rest, **more)

    with running(size=(500, 400), solver="transpose,tikhonov") as app:
        x, y = app.pixel_of(2000)
        app.press(x, y)
        app.release(x, y)
        app.desk.tool.selected = frozenset()
        app.step(PointerMoved(5, 395), frames=4)
        monkeypatch.setattr(Stage, "draw", noted)

        def seen() -> np.ndarray:
            return app.screenshot()[30:370, :240]  # not the time of the frame

        plain_pin = seen()
        app.step(PointerMoved(x, y), frames=4)
        assert app.desk.tool.hovered == app.session.pose.pins[0].vertex
        assert (seen() != plain_pin).any()
        app.step(PointerMoved(5, 395), frames=4)
        assert not faces, "only pins were drawn"
        np.testing.assert_array_equal(seen(), plain_pin)
        app.window.resize((520, 400))  # the very picture anew
        app.step(PointerMoved(5, 394), frames=4)
        app.window.resize((500, 400))
        app.step(PointerMoved(5, 395), frames=4)
        assert faces
        np.testing.assert_array_equal(seen(), plain_pin)


def test_a_drag_after_one_that_was_given_up_begins_anew_to_tell_what_moves() -> None:
    with running(size=(500, 400)) as app:
        assert app.desk.stage is not None
        motion = app.desk.stage.mesh(0).motion
        moving: list[int] = []
        for shape, way in (("browInnerUp", -10), ("jawOpen", 30), ("browInnerUp", -10)):
            column = app.session.rig.shape_names.index(shape)
            moves = app.session.rig.rows_at(range(app.session.rig.vertex_count))[:, column].reshape(-1, 3)
            x, y = app.pixel_of(int(np.argmax(np.abs(moves[:, 1]) * (app.session.rig.neutral[:, 2] > 0.3))))
            app.press(x, y)
            for step in range(6):
                app.move(x, y + way * (step + 1) / 6)
            moving.append(sum(run.count for run in motion.moving))
            assert motion.still
            app.key("escape")
            app.release(x, y)
            app.step(PointerMoved(5, 395), frames=4)
        assert moving[2] == moving[0] != moving[1]
