"""What the parts of a face look like: as the file says, otherwise by their names, otherwise clay."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

import moderngl
import numpy as np
from numpy.typing import NDArray

from facepin.core.arrays import Points
from facepin.core.look.alpha import SOLID, is_blended, is_clear, opacity
from facepin.core.mesh.topology import DrawRun
from facepin.core.rig import Part, Rig, Texture
from facepin.gpu.eyes import paint_iris

Colour = tuple[float, float, float]

WHITE: Colour = (1.0, 1.0, 1.0)


@dataclass(frozen=True)
class Material:
    """What a surface is made of."""

    colour: Colour
    """Base colour, sRGB 0..1."""
    roughness: float
    """0 mirror .. 1 chalk."""
    scatter: Colour = (0.10, 0.08, 0.07)
    """How far light spreads beneath the surface before it comes out, colour by colour, 0 not at all."""
    reflects: float = 0.04
    """Share of the light that is reflected straight ahead; most things that are not metal are alike."""
    wet: bool = False
    """The lamps themselves are seen in it: an eye."""


CLAY = Material((0.47, 0.45, 0.435), Part.roughness, (0.20, 0.17, 0.15))
"""What says nothing about itself."""

SMOOTHEST = 0.2
"""Least roughness of what is not an eye: a highlight stays larger than a pixel."""
FLESH: Colour = (0.36, 0.19, 0.125)
"""Scatter of skin, and of what is softer still."""
SKIN = replace(CLAY, scatter=FLESH, reflects=0.028)

EYEBALL = Material((0.72, 0.70, 0.68), 0.08, wet=True)
"""The white of an eye; its iris is painted on."""

BY_NAME: tuple[tuple[str, Material | None], ...] = (
    ("occlusion|lacrimal|tear|eyeblend|eyewet|clearshell|lash", None),
    ("brow", Material((0.25, 0.20, 0.17), 0.6)),
    ("iris", Material((0.24, 0.36, 0.42), 0.08, wet=True)),
    ("pupil", Material((0.02, 0.02, 0.02), 0.08, wet=True)),
    ("sclera|eyeball|eyewhite", EYEBALL),
    ("teeth|tooth", Material((0.83, 0.81, 0.77), 0.25)),
    ("gum|tongue|mouthsocket", Material((0.54, 0.36, 0.34), 0.35, FLESH)),
    ("hair|beard|moustache", Material((0.26, 0.20, 0.17), 0.45)),
    ("^(left|right)?eyes?(l|r|left|right)?$", EYEBALL),
    ("skin|face|head|^ears?(l|r)?$", SKIN),
)
"""Pattern in a part's name (small letters only) and its material; the first that fits counts.  None: clear
shells in front of the eye and cards that only a texture turns into lashes; they are left out."""


@dataclass(frozen=True)
class Run:
    """Neighbouring triangles that look the same and are drawn in one call."""

    first: int
    """Index of the first corner in the index buffer."""
    count: int
    tint: Colour
    """Linear colour that multiplies the vertex colours."""
    roughness: float
    scatter: Colour
    reflects: float
    wet: bool
    hidden: Literal["back", "front"] | None
    """The side that is never seen, so that triangles showing it are left out."""
    texture: Texture | None = None
    cutout: float | None = None
    """Alpha, `opacity` times that of the texture, below which there is nothing."""
    opacity: float = 1.0
    middle: tuple[float, float, float] | None = None
    """Of what is blended with what is behind it: where it is, to be drawn after what is farther."""

    def batches(self, most: int) -> Iterator[range]:
        """Cut the corners of the run into ranges of at most so many, a multiple of 3."""
        end = self.first + self.count
        for first in range(self.first, end, most):
            yield range(first, min(first + most, end))

    @property
    def sides(self) -> tuple["Run", ...]:
        """The same triangles as runs of which one side each is drawn."""
        if self.hidden is not None:
            return (self,)
        return replace(self, hidden="back"), replace(self, hidden="front")


def by_name(part: Part) -> Material | None:
    """Return the material of the first pattern that fits a part's name, otherwise clay."""
    name = re.sub("[^a-z]", "", part.name.lower())
    return next((look for pattern, look in BY_NAME if re.search(pattern, name)), CLAY)


def material(part: Part, coloured: bool) -> Material | None:
    """Return what a part looks like, or None if it is better not seen.

    Parameters
    ----------
    part : Part
        What the file says about it counts first.  What is clear is not seen.
    coloured : bool
        The rig has vertex colours: the part's own colour is then not used.
    """
    if is_clear(part):
        return None
    named = by_name(part)
    # White is what a file says whose colours are in a texture, or that does not care.
    own = part.colour if part.colour != WHITE else None
    if named is None:
        if own is None and not coloured and part.texture is None:
            return None
        named = CLAY
    painted = coloured or part.texture is not None
    colour = WHITE if coloured else own or (WHITE if painted else named.colour)
    roughness = named.roughness if part.roughness == Part.roughness else part.roughness
    # A face without colours is clay through and through.
    inside = CLAY if named is SKIN and own is None and not painted else named
    if not named.wet:
        roughness = max(roughness, SMOOTHEST)
    return Material(colour, roughness, inside.scatter, inside.reflects, named.wet)


def material_runs(
    rig: Rig, order: tuple[DrawRun, ...], left_out: frozenset[str] = frozenset()
) -> tuple[Run, ...]:
    """Join the runs of a draw order that look the same, so that a face of many parts needs few calls.

    What is blended stays apart.  Parts whose names are `left_out` are not drawn.
    """
    runs: list[Run] = []
    for piece in order:
        part = rig.parts[piece.part]
        look = material(part, rig.colours is not None)
        if look is None or part.name in left_out:
            continue
        r, g, b = linear(np.array(look.colour)).tolist()
        first, count = 3 * piece.triangles.start, 3 * len(piece.triangles)
        card = (None, None) if rig.texture_places is None else (part.texture, part.cutout)
        if part.blends:
            card = card[0], None
        inside = (look.roughness, look.scatter, look.reflects, look.wet)
        run = Run(first, count, (r, g, b), *inside, piece.hidden, *card)
        if is_blended(part):
            corners = rig.neutral[rig.triangles[part.triangles.start : part.triangles.stop]]
            x, y, z = corners.reshape(-1, 3).mean(axis=0).tolist()
            runs.append(replace(run, opacity=opacity(part), middle=(x, y, z)))
            continue
        if run.cutout is not None:
            run = replace(run, opacity=part.opacity)
        before = runs[-1] if runs else None
        if before is not None and before.first + before.count == first:
            joined = replace(before, count=before.count + count)
            if joined == replace(run, first=before.first, count=joined.count):
                runs[-1] = joined
                continue
        runs.append(run)
    return tuple(runs)


def in_two_passes(runs: tuple[Run, ...]) -> tuple[tuple[Run, ...], tuple[Run, ...]]:
    """Return what hides what is behind it, and what is then blended over that.

    What is solid in a blended texture, the inside of a lock of hair, comes first with its depth: so that it
    need not be sorted.
    """
    blended = tuple(run for run in runs if run.middle is not None)
    hard = [
        replace(run, middle=None, cutout=SOLID) if run.middle is not None else run
        for run in runs
        if run.middle is None or (run.texture is not None and run.opacity >= SOLID)
    ]
    return tuple(hard), blended


def cull_hidden(ctx: moderngl.Context, run: Run) -> None:
    """Draw with depth from now on, without the side of a run that is never seen."""
    ctx.front_face = "cw"  # canvases are upside down, see `framing.Y_DOWN`
    if run.hidden is None:
        ctx.enable_only(moderngl.DEPTH_TEST)
    else:
        ctx.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        ctx.cull_face = run.hidden


def vertex_albedo(rig: Rig) -> NDArray[np.float16]:
    """Linear colours that a run's tint multiplies, and openness 1: (n, 4) float16.

    White where the rig has no vertex colours, but for the irises.
    """
    albedo = np.ones((rig.vertex_count, 4), np.float16)
    if rig.colours is not None:
        albedo[:, :3] = linear(rig.colours)
        return albedo
    for part in rig.parts:
        if by_name(part) is EYEBALL and part.colour is None:
            vertices = np.unique(rig.triangles[part.triangles.start : part.triangles.stop])
            colours = paint_iris(rig.neutral[vertices], EYEBALL.colour)
            albedo[vertices, :3] = linear(colours) / linear(np.array(EYEBALL.colour))
    return albedo


def linear(srgb: Points) -> Points:
    """Return linear light (..., 3) float32 of sRGB colours 0..1 (IEC 61966-2-1)."""
    srgb = np.clip(np.asarray(srgb, np.float32), 0, 1)
    light: Points = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4).astype(
        np.float32
    )
    return light
