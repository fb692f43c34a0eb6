"""Heat map, wireframe and ghost: what they show, where, and that nothing else changes."""

from collections.abc import Iterator
from dataclasses import dataclass

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray

from facepin.core.look.camera import Camera
from facepin.core.look.heat import BEYOND, STOPS, hex_colours, oklab
from facepin.core.rig import Rig
from facepin.gpu import pane, picture
from facepin.gpu.canvas import Canvas
from facepin.gpu.framing import frame
from facepin.gpu.pane import BARE, Overlays, draw_pane
from facepin.gpu.picture import draw_picture, render_picture
from facepin.gpu.scene import PaneMesh
from support.gpu_help import SIZE, WHOLE, ball, bowl, camera, drawn
from support.small_rigs import sheet

MIDDLE = SIZE // 2


@dataclass
class Easel:
    """A ball to draw, and a bigger one."""

    rig: Rig
    mesh: PaneMesh
    other: PaneMesh
    canvas: Canvas

    def draw(self, overlays: Overlays = BARE, *, fine: bool = True, scale: float = 1.0) -> NDArray[np.int64]:
        """Return a picture on transparent ground, (h, w, 4)."""
        self.canvas.clear()
        framing = frame(camera(self.rig), WHOLE)
        draw_pane(self.canvas, framing, self.mesh, overlays, fine=fine, scale=scale)
        return self.canvas.read().astype(np.int64)

    def heat(self, value: float) -> NDArray[np.float32]:
        return np.full(self.rig.vertex_count, value, np.float32)

    def blow_up(self, factor: float) -> None:
        self.other.upload((factor * self.rig.neutral).astype(np.float32), self.rig.neutral)


@pytest.fixture(params=[0, 4], ids=["plain", "smooth"])
def easel(gl: moderngl.Context, request: pytest.FixtureRequest) -> Iterator[Easel]:
    rig = ball(32)
    with drawn(gl, rig, rig.neutral, samples=request.param) as (mesh, canvas):
        other = PaneMesh(mesh.scene)
        yield Easel(rig, mesh, other, canvas)
        other.release()


def hue(pixel: NDArray[np.int64]) -> NDArray[np.float64]:
    """Direction of a colour in the plane of OKLab, or nearly nothing for a grey."""
    chroma: NDArray[np.float64] = oklab(pixel[None, :3] / 255)[0, 1:]
    return chroma


def test_what_rests_is_grey_and_what_moves_has_the_colour_of_its_move(easel: Easel) -> None:
    for value, code in ((0.0, STOPS[0]), (1.0, STOPS[-1]), (1.5, BEYOND)):
        seen = easel.draw(Overlays(heat=easel.heat(value)))[MIDDLE, MIDDLE]
        wanted = hex_colours((code,))
        assert np.linalg.norm(hue(seen) - oklab(wanted)[0, 1:]) < 0.02
        assert abs(oklab(seen[None, :3] / 255) - oklab(wanted))[0, 0] < 0.06, "where light falls straight"


def test_heat_is_where_the_moved_vertices_are(easel: Easel) -> None:
    heat = easel.heat(0)
    heat[easel.rig.neutral[:, 0] > 0.4] = 0.9
    seen, rest = (easel.draw(Overlays(heat=values)) for values in (heat, easel.heat(0)))
    left, right = seen[MIDDLE, : MIDDLE + 10], seen[MIDDLE, MIDDLE + 30 : MIDDLE + 45]
    np.testing.assert_array_equal(left, rest[MIDDLE, : MIDDLE + 10])
    assert all(np.hypot(*hue(pixel)) > 0.1 for pixel in right)


def test_heat_keeps_the_form_in_every_quality(easel: Easel) -> None:
    heat = Overlays(heat=easel.heat(0.3))
    fine, fast = easel.draw(heat), easel.draw(heat, fine=False)
    np.testing.assert_array_equal(fine, fast)
    assert fine[MIDDLE - 20, MIDDLE - 20, :3].sum() > 1.2 * fine[MIDDLE + 35, MIDDLE + 35, :3].sum()
    np.testing.assert_array_equal(fine[..., 3], easel.draw()[..., 3])


@pytest.mark.parametrize("fine", [True, False])
def test_a_tint_colours_what_moves_and_leaves_the_rest_and_the_form(easel: Easel, fine: bool) -> None:
    tint = easel.heat(0)
    tint[easel.rig.neutral[:, 0] > 0.4] = 1.0
    bare, seen = (easel.draw(overlays, fine=fine) for overlays in (BARE, Overlays(tint=tint)))
    np.testing.assert_array_equal(seen[:, : MIDDLE + 10], bare[:, : MIDDLE + 10])
    np.testing.assert_array_equal(seen[..., 3], bare[..., 3])
    tinted = seen[MIDDLE - 25 : MIDDLE + 26, MIDDLE + 30]
    assert (tinted[:, 2] - tinted[:, 0] > 40).all(), "blue, and without a gap"
    assert tinted[0, :3].sum() > 1.1 * tinted[-1, :3].sum(), "light still falls from above"


def test_a_sheet_is_lit_on_both_sides(gl: moderngl.Context) -> None:
    rig = bowl()
    with drawn(gl, rig, rig.neutral) as (mesh, canvas):
        canvas.clear()
        inside = frame(camera(rig).orbited(np.pi, 0.0), WHOLE)
        draw_pane(canvas, inside, mesh, Overlays(heat=np.zeros(rig.vertex_count, np.float32)), fine=True)
        assert canvas.read()[MIDDLE, MIDDLE, :3].min() > 60


@dataclass
class Grid:
    """A flat sheet of 8 x 8 quads that stands before the camera, 12 pixels each."""

    rig: Rig
    mesh: PaneMesh
    canvas: Canvas

    def darker(self, view: Camera, scale: float = 1.0) -> NDArray[np.int64]:
        """Draw it with lines; return how much darker than without."""
        bare, wired = (self._draw(view, Overlays(wireframe=wireframe), scale) for wireframe in (False, True))
        return (bare - wired)[..., :3].sum(axis=2)

    def at(self, view: Camera, points: NDArray[np.float64]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Row and column of the pixel that each point (m, 3) is in."""
        x, y, _ = view.project(points, WHOLE).T
        return np.floor(y).astype(np.intp), np.floor(x).astype(np.intp)

    def _draw(self, view: Camera, overlays: Overlays, scale: float) -> NDArray[np.int64]:
        self.canvas.clear()
        draw_pane(self.canvas, frame(view, WHOLE), self.mesh, overlays, fine=True, scale=scale)
        return self.canvas.read().astype(np.int64)


@pytest.fixture(params=[0, 4], ids=["plain", "smooth"])
def grid(gl: moderngl.Context, request: pytest.FixtureRequest) -> Iterator[Grid]:
    rig = sheet()
    with drawn(gl, rig, np.tile(np.float32([0, 0, 1]), (81, 1)), samples=request.param) as (mesh, canvas):
        yield Grid(rig, mesh, canvas)


@pytest.mark.parametrize("turn", [0.0, 0.9, np.pi])
def test_lines_are_on_the_edges_and_not_on_the_diagonals(grid: Grid, turn: float) -> None:
    view = camera(grid.rig).orbited(turn, 0.0)
    dark = grid.darker(view)
    middles = np.array([[(i + 0.5) / 4 - 1, (j + 0.5) / 4 - 1, 0] for i in range(1, 7) for j in range(1, 7)])
    for aside in ([0.125, 0, 0], [0, 0.125, 0]):
        y, x = grid.at(view, middles + aside)
        near = np.max([dark[y + dy, x + dx] for dy in (-1, 0, 1) for dx in (-1, 0, 1)], axis=0)
        assert (near > 40).all()
    y, x = grid.at(view, middles)
    np.testing.assert_array_equal(dark[y, x], 0)


def test_lines_keep_their_width(grid: Grid) -> None:
    """However near: along a row across them, each line takes away as much light."""
    taken = []
    for zoom in (2.2, 6.0):
        view = camera(grid.rig).zoomed(zoom)
        y, x = grid.at(view, np.array([[i / 4 - 1, 0.125, 0] for i in range(9)]))
        lines = np.count_nonzero((x >= 0) & (x < SIZE))
        assert lines >= 1
        taken.append(grid.darker(view)[y[0]].sum() / lines)
    assert 0.5 < taken[0] / taken[1] < 2.0, "but for how it falls on the pixels"


def test_what_is_in_front_hides_lines(gl: moderngl.Context) -> None:
    rig = bowl()
    view = camera(rig)
    with drawn(gl, rig, rig.neutral) as (mesh, canvas):
        front = _lines_of(mesh, canvas, view)
        lonely = rig.neutral.copy()
        lonely[:, 2] *= -1  # the other half, whose lines are as many
        mesh.upload(lonely, -rig.neutral)
        assert _lines_of(mesh, canvas, view).any()
    whole = ball()
    with drawn(gl, whole, whole.neutral) as (mesh, canvas):
        closed = _lines_of(mesh, canvas, view)
    # Only at the outline may lines of the back come through.
    y, x = np.mgrid[:SIZE, :SIZE] + 0.5 - MIDDLE
    inner = np.hypot(x, y) < 0.8 * MIDDLE
    np.testing.assert_array_equal(closed[inner], front[inner])


def _lines_of(mesh: PaneMesh, canvas: Canvas, view: Camera) -> NDArray[np.bool_]:
    pictures = []
    for overlays in (BARE, Overlays(wireframe=True)):
        canvas.clear()
        draw_pane(canvas, frame(view, WHOLE), mesh, overlays, fine=True)
        pictures.append(canvas.read().astype(int))
    changed: NDArray[np.bool_] = np.abs(pictures[0] - pictures[1]).max(axis=2) > 8
    return changed


def test_lines_are_stronger_where_pixels_are_smaller(grid: Grid) -> None:
    view = camera(grid.rig).zoomed(2.5)
    once, twice = (grid.darker(view, scale).sum() for scale in (1.0, 2.0))
    assert 1.6 * once < twice < 2.1 * once


def test_no_ghost_where_the_face_is_the_same(easel: Easel) -> None:
    easel.blow_up(1.0)
    difference = np.abs(easel.draw(Overlays(ghost=easel.other)) - easel.draw()).max(axis=2)
    assert difference.max() <= 10
    assert np.count_nonzero(difference) <= (5 if easel.canvas.samples else 0), "samples at the outline"


def test_a_ghost_is_seen_in_front_behind_and_beside_the_face(easel: Easel) -> None:
    bare = easel.draw()
    easel.blow_up(1.1)
    larger = easel.draw(Overlays(ghost=easel.other))
    beside = (larger[..., 3] > 0) & (bare[..., 3] == 0)
    assert beside.sum() > 300
    assert 50 < np.median(larger[beside, 3]) < 250, "translucent"
    bluer = (larger - bare)[MIDDLE, MIDDLE]
    assert bluer[2] - bluer[0] > 30, "a veil in front"
    easel.blow_up(0.95)
    smaller = easel.draw(Overlays(ghost=easel.other))
    assert 8 < (smaller - bare)[MIDDLE, MIDDLE, 2] - (smaller - bare)[MIDDLE, MIDDLE, 0] < bluer[2] - bluer[0]
    np.testing.assert_array_equal(smaller[..., 3], bare[..., 3])
    easel.blow_up(0.6)
    assert np.abs(easel.draw(Overlays(ghost=easel.other)) - bare).max() <= 1, "far behind, it is hidden"


def test_a_ghost_leaves_the_depth_for_the_pins(easel: Easel) -> None:
    easel.draw()
    before = np.frombuffer(easel.canvas.depth.read(), np.float32) if not easel.canvas.samples else None
    easel.blow_up(1.2)
    easel.draw(Overlays(ghost=easel.other))
    if before is not None:
        np.testing.assert_array_equal(np.frombuffer(easel.canvas.depth.read(), np.float32), before)


def test_overlays_leave_no_state_behind(easel: Easel) -> None:
    easel.blow_up(1.1)
    bare = easel.draw()
    everything = Overlays(easel.heat(0.4), True, easel.other, tint=easel.heat(0.5))
    first = easel.draw(everything)
    np.testing.assert_array_equal(easel.draw(), bare)
    np.testing.assert_array_equal(easel.draw(everything), first)
    easel.canvas.resize(SIZE // 2, SIZE)
    easel.canvas.resize(SIZE, SIZE)
    np.testing.assert_array_equal(easel.draw(everything), first)


def test_nothing_is_made_for_what_is_off(easel: Easel, monkeypatch: pytest.MonkeyPatch) -> None:
    for layer in ("HeatLayer", "WireLayer", "GhostLayer", "TintLayer"):
        monkeypatch.setattr(pane, layer, None)
    easel.draw()


def test_pictures_show_what_panes_show(easel: Easel, monkeypatch: pytest.MonkeyPatch) -> None:
    easel.blow_up(1.1)
    rig = easel.rig
    for overlays in (
        Overlays(heat=easel.heat(0.6)),
        Overlays(wireframe=True),
        Overlays(ghost=easel.other),
        Overlays(tint=easel.heat(0.7)),
        Overlays(easel.heat(0.6), True, easel.other),
    ):
        seen = easel.draw(overlays)
        options = {"samples": easel.canvas.samples, "transparent": True}
        image = draw_picture(easel.mesh, camera(rig), (SIZE, SIZE), overlays=overlays, **options)
        opaque = seen[..., 3] == 255
        np.testing.assert_array_equal(image[opaque], seen[opaque])
        np.testing.assert_array_equal(image[..., 3], seen[..., 3])
    monkeypatch.setattr(picture, "TILE", 50)
    tiled = draw_picture(easel.mesh, camera(rig), (SIZE, SIZE), overlays=overlays, **options).astype(int)
    assert np.mean(np.abs(tiled - image).max(axis=2) > 8) < 0.03, "but for rounding at lines and outline"


def test_render_picture_takes_overlays(gl: moderngl.Context) -> None:
    rig = ball()
    heat, larger = np.full(rig.vertex_count, 0.5, np.float32), (1.1 * rig.neutral).astype(np.float32)
    bare, hot, wired, haunted = (
        render_picture(gl, rig, rig.neutral, rig.neutral, camera(rig), (64, 64), samples=0, **options).astype(
            int
        )
        for options in ({}, {"heat": heat}, {"wireframe": True}, {"ghost": (larger, rig.neutral)})
    )
    assert all(np.abs(image - bare).max() > 20 for image in (hot, wired, haunted))
