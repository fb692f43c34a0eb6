"""Faces with their pins, drawn without a window, and sheets of several of them with titles."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Floats, Points
from facepin.core.camera import Camera, View, frame_points
from facepin.core.heat import heat_colours, heat_scale
from facepin.core.measures import REST, moves, percent
from facepin.core.normals import NormalField
from facepin.core.pose import Pin
from facepin.core.rig import Rig
from facepin.files.atomic import atomic_write
from facepin.resources import resource

if TYPE_CHECKING:
    import moderngl
    from PIL.ImageFont import FreeTypeFont

Image = NDArray[np.uint8]

TITLE_INK, TEXT_INK, DIM_INK, FOOTER_INK = "#16181d", "#33363c", "#5f6368", "#80868b"

SUPERSAMPLING = 2
LEGEND_WIDTH = 20.0
"""In letter heights."""
MARGIN = 0.14
"""Share of a pane left free on each side of the face at rest, for it to move into."""
STIRRED = 0.02
"""A pane shows the part of the face that shapes move by more than this share of its height."""


class Painter:
    """Draws poses of one rig, all seen by one camera.  Give it back with `release`."""

    def __init__(
        self, ctx: "moderngl.Context", rig: Rig, size: tuple[int, int], view: View = "front"
    ) -> None:
        """Look at a rig in pictures of `size` (width, height)."""
        from facepin.gpu.markers import MarkerLayer
        from facepin.gpu.scene import PaneMesh, Scene

        self.size = size
        self.camera = face_camera(rig, size, view)
        self._rig = rig
        self._scene = Scene(ctx, rig)
        self._mesh = PaneMesh(self._scene)
        self._markers = MarkerLayer(ctx)
        self._normals = NormalField(rig)
        while not self._scene.refined:
            self._scene.refine()

    def paint(self, positions: Points, pins: tuple[Pin, ...] = (), moved: Floats | None = None) -> Image:
        """Return a picture of a posed face, (h, w, 4) uint8, with a marker per pin and a line to its goal.

        With `moved` (n,), lengths in the rig's unit, colours show how far each vertex moved (`heat_legend`).
        """
        from facepin.gpu.markers import Markers, MarkerState
        from facepin.gpu.pane import Overlays
        from facepin.gpu.picture import draw_picture

        self._mesh.upload(positions, self._normals.normals(positions))
        markers = Markers(
            positions[[pin.vertex for pin in pins]],
            np.array([pin.goal for pin in pins], np.float32).reshape(-1, 3),
            np.full(len(pins), MarkerState.SELECTED, np.uint8),
        )
        heat = None
        if moved is not None:
            heat = (moved / heat_scale(self._rig.height).top).astype(np.float32)
        scale = SUPERSAMPLING * max(self.size[1] / 600, 0.5)
        return draw_picture(
            self._mesh,
            self.camera,
            self.size,
            samples=0,
            supersampling=SUPERSAMPLING,
            overlays=Overlays(heat=heat),
            overlay=lambda canvas, framing, _: self._markers.draw_framed(
                canvas, framing, markers, scale=scale
            ),
        )

    def release(self) -> None:
        """Give the graphics memory back."""
        self._markers.release()
        self._mesh.release()
        self._scene.release()


def face_camera(rig: Rig, size: tuple[int, int], view: View) -> Camera:
    """Return a camera that sees the part of the neutral that shapes move.

    Shapes that move more than half of all vertices (to another build, say) count only if there are no others.
    """
    camera = frame_points(rig.neutral, size[0] / size[1], Camera(radius=0.0).looking(view))
    local, anywhere = np.zeros((2, rig.vertex_count), np.bool_)
    for j in range(rig.shape_count):
        delta = rig.deltas[:, [j]].toarray().reshape(-1, 3)
        lengths = moves(delta, np.zeros_like(delta))
        anywhere |= lengths > STIRRED * rig.height
        if np.count_nonzero(lengths > REST * rig.height) <= rig.vertex_count / 2:
            local |= lengths > STIRRED * rig.height
    for stirred in (local, anywhere):
        if np.count_nonzero(stirred) > 2:
            return frame_points(rig.neutral[stirred], size[0] / size[1], camera, MARGIN)
    return camera


@dataclass(frozen=True, eq=False)
class Pane:
    """One picture of a sheet, with what stands over and under it."""

    image: Image
    title: str
    subtitle: str = ""
    lines: tuple[str, ...] = ()
    """What was measured, under the picture."""
    colour: str = ""
    """Of the mark before the title, #rrggbb."""


@dataclass(frozen=True, eq=False)
class Legend:
    """A bar of colours."""

    colours: Floats
    """(m, 3) sRGB 0..1 from left to right."""
    labels: tuple[str, ...]
    """Evenly spaced below it."""


def heat_legend(rig: Rig) -> Legend:
    """Return the legend of `Painter.paint` with `moved`, in per cent of the face height."""
    ticks = heat_scale(rig.height).ticks
    return Legend(heat_colours(), tuple(f"{percent(tick, rig.height):.2g} %" for tick in ticks))


def sheet(panes: Sequence[Pane], columns: int = 0, footer: str = "", legend: Legend | None = None) -> Image:
    """Return panes side by side on white paper, (h, w, 3) uint8.

    Parameters
    ----------
    panes : sequence of Pane
        Pictures of one size.
    columns : int
        Panes in a row; 0 for as many as look well.
    footer : str
        What made the sheet, in small letters at the bottom.
    legend : Legend
        Of the colours in the panes, at the bottom on the right.
    """
    from PIL import Image as Pillow
    from PIL import ImageDraw

    columns = min(columns or _columns(len(panes)), len(panes))
    rows = [panes[at : at + columns] for at in range(0, len(panes), columns)]
    height, width = panes[0].image.shape[:2]
    em = max(width / 24, columns * width / 110, 9.0)  # readable where many panes share the width of a page
    gap, line, inch = round(0.8 * em), 1.22 * em, round(0.5 * em)
    bold, plain, small = _font("Bold", 1.1 * em), _font("Regular", 0.86 * em), _font("Regular", 0.72 * em)
    tops = [_head_height(row, em) for row in rows]
    bottoms = [round(line * max(len(pane.lines) for pane in row) + 0.5 * em) for row in rows]
    foot = round((2.6 if legend else 1.4 if footer else 0) * em)
    whole = sum(tops) + sum(bottoms) + len(rows) * height + gap + foot
    paper = Pillow.new("RGB", (columns * width + (columns + 1) * gap, whole), "white")
    draw = ImageDraw.Draw(paper)
    y = inch
    for row, top, bottom in zip(rows, tops, bottoms, strict=True):
        for place, pane in enumerate(row):
            x = gap + place * (width + gap)
            left: float = x
            if pane.colour:
                draw.rounded_rectangle((x, y + 0.2 * em, x + 0.8 * em, y + 1.0 * em), 0.18 * em, pane.colour)
                left += 1.25 * em
            draw.text((left, y), pane.title, TITLE_INK, bold)
            draw.text((x, y + 1.5 * em), _shortened(pane.subtitle, plain, width), DIM_INK, plain)
            paper.paste(Pillow.fromarray(pane.image[..., :3]), (x, y + top - inch))
            for number, text in enumerate(pane.lines):
                below = y + top - inch + height + 0.35 * em + number * line
                draw.text((x, below), _shortened(text, plain, width), TEXT_INK, plain)
        y += top + height + bottom
    if footer:
        room = paper.width - 2 * gap - (0 if legend is None else LEGEND_WIDTH * em)
        words = _shortened(footer, small, room)
        draw.text((gap, paper.height - gap - 0.7 * em), words, FOOTER_INK, small)
    if legend is not None:
        bar = np.rint(255 * legend.colours).astype(np.uint8)[None]
        wide, high = round((LEGEND_WIDTH - 4) * em), round(0.7 * em)
        left, y = paper.width - gap - wide - round(1.4 * em), paper.height - gap - round(2.0 * em)
        paper.paste(Pillow.fromarray(bar).resize((wide, high), Pillow.Resampling.BILINEAR), (round(left), y))
        for at, label in enumerate(legend.labels):
            x = left + wide * at / (len(legend.labels) - 1)
            draw.text((x, y + high + 0.25 * em), label, TEXT_INK, small, anchor="ma")
    return np.asarray(paper)


def _head_height(row: Sequence[Pane], em: float) -> int:
    """Return the room for titles over a row of panes."""
    if any(pane.subtitle for pane in row):
        return round(3.4 * em)
    return round((2.2 if any(pane.title for pane in row) else 0.5) * em)


def write_sheet(
    path: Path, panes: Sequence[Pane], footer: str = "", columns: int = 0, legend: Legend | None = None
) -> Path:
    """Write a sheet as .png and return its path.

    Raises
    ------
    FacepinError
        If it cannot be written.
    """
    from facepin.gpu.picture import png_bytes

    atomic_write(path, png_bytes(sheet(panes, columns, footer, legend)))
    return path


def _columns(count: int) -> int:
    """Return into how many columns panes go: one row up to five, then rows as even as can be."""
    rows = -(-count // 5)
    return -(-count // rows)


def _font(weight: str, size: float) -> "FreeTypeFont":
    from PIL import ImageFont

    return ImageFont.truetype(str(resource("assets", f"fonts/Roboto-{weight}.ttf")), size)


def _shortened(text: str, font: "FreeTypeFont", width: float) -> str:
    """Cut a text that is too long for its place."""
    if font.getlength(text) <= width:
        return text
    while text and font.getlength(text + "…") > width:
        text = text[:-1]
    return text.rstrip(" ,") + "…"
