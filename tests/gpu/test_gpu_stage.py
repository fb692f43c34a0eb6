"""Overlays of the panes of a session: measured and made only when asked for, and once."""

from collections.abc import Iterator
from dataclasses import replace

import moderngl
import numpy as np
import pytest

from facepin.core.look.camera import Viewport
from facepin.core.look.heat import heat_scale
from facepin.core.pose import Pose
from facepin.core.rig import Rig
from facepin.desk.stage import Stage
from facepin.gpu.canvas import Canvas
from facepin.gpu.picture import draw_picture
from facepin.panels.view import Ghost, PaneView
from facepin.session.edit import Edit
from facepin.session.hand.drag import DragTool
from facepin.session.session import Session
from facepin.session.solving.solving import choose
from support.gpu_help import SIZE, ball, camera

PANES = [Viewport(0, 0, SIZE / 2, SIZE), Viewport(SIZE / 2, 0, SIZE / 2, SIZE)]


class Shown:
    """Two panes with a stretched ball."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self.rig: Rig = ball()
        pose = Pose(np.full(1, 0.3))
        self.session = Session(self.rig, [choose("transpose"), choose("tikhonov")], pose)
        self.stage = Stage(ctx, self.session)
        self.canvas = Canvas(ctx, 0)
        self.canvas.resize(SIZE, SIZE)

    def draw(self, *views: PaneView, fine: bool = True) -> np.ndarray:
        sights = [(pane, camera(self.rig)) for pane in PANES]
        self.stage.draw(self.canvas, sights, views, 1.0, fine=fine, beside=(0.0, 0.0, 0.0, 1.0))
        self.stage.draw_pins(self.canvas, sights, DragTool(), 1.0)
        return self.canvas.read().astype(int)

    def stretch(self, weight: float) -> None:
        self.session.apply(Edit("Set weight", True, weights=np.full(1, weight)))
        self.stage.update()

    def release(self) -> None:
        self.stage.release()
        self.canvas.release()


@pytest.fixture
def shown(gl: moderngl.Context) -> Iterator[Shown]:
    shown = Shown(gl)
    yield shown
    shown.release()


def test_each_pane_has_its_own_overlays(shown: Shown) -> None:
    bare = shown.draw(PaneView(), PaneView())
    for view in (PaneView(shading="heat"), PaneView(wireframe=True), PaneView(ghost="neutral")):
        seen = shown.draw(PaneView(), view)
        np.testing.assert_array_equal(seen[:, : SIZE // 2], bare[:, : SIZE // 2])
        assert np.abs(seen - bare)[:, SIZE // 2 :].max() > 20
    np.testing.assert_array_equal(shown.draw(PaneView(), PaneView()), bare)


def test_what_is_off_is_not_measured(shown: Shown, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("facepin.session.heat.moves", None)
    over = shown.stage.overlays(0, PaneView())
    assert (over.heat, over.wireframe, over.ghost) == (None, False, None)
    assert shown.stage.overlays(0, PaneView(ghost="reference")).ghost is None, "there is none"


def test_heat_is_in_shares_of_the_top(shown: Shown) -> None:
    heat = shown.stage.overlays(1, PaneView(shading="heat")).heat
    assert heat is not None
    up = np.maximum(shown.rig.neutral[:, 1], 0)
    np.testing.assert_allclose(heat, 0.3 * up / heat_scale(shown.rig.height).top, atol=1e-5)
    assert shown.stage.overlays(1, PaneView(shading="heat")).heat is heat


def test_ghosts_are_made_once_and_shared(shown: Shown) -> None:
    def ghost(pane: int, kind: Ghost) -> object:
        return shown.stage.overlays(pane, PaneView(ghost=kind)).ghost

    neutral = ghost(0, "neutral")
    shown.session.set_reference(np.full(1, 0.8))
    reference = ghost(1, "reference")
    assert neutral is ghost(1, "neutral") is not reference
    first = shown.draw(PaneView(ghost="reference"), PaneView())
    shown.session.set_reference(np.full(1, 0.1))
    assert ghost(0, "reference") is reference, "with another pose"
    assert np.abs(shown.draw(PaneView(ghost="reference"), PaneView()) - first).max() > 20


def test_the_saved_picture_is_the_pane_without_its_pins(shown: Shown) -> None:
    view = PaneView(shading="heat", wireframe=True, ghost="neutral")
    seen = shown.draw(view, PaneView())[:, : SIZE // 2]
    stage, size = shown.stage, (SIZE // 2, SIZE)
    image = draw_picture(stage.mesh(0), camera(shown.rig), size, samples=0, overlays=stage.overlays(0, view))
    assert np.mean(np.abs(image.astype(int) - seen).max(axis=2) > 8) < 0.01


def test_a_drag_over_still_parts_looks_like_the_pose_alone(gl: moderngl.Context) -> None:
    shadings = ["studio"] * 3 + ["heat"] * 2 + ["clay"] * 3 + ["normals"] * 3 + ["studio"] * 2
    views = [PaneView(shading=shading) for shading in shadings]
    steps = [(0.3 + 0.03 * step, view) for step, view in enumerate(views)]
    dragged, fresh = Shown(gl), []
    for weight, view in steps:
        alone = Shown(gl)
        alone.stretch(weight)
        fresh.append(alone.draw(PaneView(), view, fine=False))
        alone.release()
    for (weight, view), expected in zip(steps, fresh, strict=True):
        dragged.stretch(weight)
        seen = dragged.draw(PaneView(), view, fine=False)
        assert np.count_nonzero(np.abs(seen - expected).max(axis=2) > 12) <= 12
    assert dragged.stage.mesh(0).motion.still, "half of the ball does not move"
    np.testing.assert_array_equal(dragged.draw(PaneView(), PaneView()), final_picture(gl, steps[-1][0]))
    dragged.release()


def final_picture(gl: moderngl.Context, weight: float) -> np.ndarray:
    """A resting picture of a pose that was never dragged."""
    shown = Shown(gl)
    shown.stretch(weight)
    picture = shown.draw(PaneView(), PaneView())
    shown.release()
    return picture


def test_muting_shows_at_once_and_costs_no_upload_where_it_changes_nothing(shown: Shown) -> None:
    free = shown.session.control
    stretched = shown.stage.positions(0)
    shown.session.set_control("Lock", replace(free, locked=np.ones(1, bool)))
    assert not shown.stage.update()
    assert shown.stage.positions(0) is stretched
    shown.session.set_control("Mute", replace(free, muted=np.ones(1, bool)))
    assert shown.stage.update()
    assert not shown.stage.update()
    for pane in (0, 1):
        np.testing.assert_array_equal(shown.stage.positions(pane), shown.rig.neutral)
        assert shown.stage.appraise(pane).far_motion == 0
    assert shown.session.pose.weights[0] == 0.3
    shown.session.undo()
    assert shown.stage.update()
    np.testing.assert_array_equal(shown.stage.positions(0), stretched)
