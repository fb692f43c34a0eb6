"""How runs of triangles are shaded: by which program, and what it is told."""

from typing import Literal

import moderngl
import numpy as np

from facepin.core.look.alpha import SOLID
from facepin.core.look.shading import Shading
from facepin.core.rig import Texture
from facepin.gpu.framing import Framing
from facepin.gpu.lamps import Sight, sight
from facepin.gpu.materials import CLAY, Run, linear
from facepin.gpu.programs import load_program

ProgramName = Literal[
    "fast", "fine", "wet", "textured", "wet textured", "blended", "blended textured", "normals"
]

SHADERS: dict[ProgramName, tuple[str, ...]] = {
    "fast": ("mesh_fast",),
    "fine": ("mesh",),
    "wet": ("mesh", "WET"),
    "textured": ("mesh", "TEXTURED"),
    "wet textured": ("mesh", "WET", "TEXTURED"),
    "blended": ("mesh", "BLENDED"),
    "blended textured": ("mesh", "BLENDED", "TEXTURED"),
    "normals": ("normals",),
}
"""Name and definitions of the shader pair of each program."""

GLOSSY = 0.3
"""Roughness below which a highlight is too small to be computed at vertices."""
EYES_OF_CLAY = 1.8
"""How much lighter eyes are than other clay; their irises stay darker, to tell where they look."""

_SRGB_ALPHA = 0x8C43
"""GL_SRGB8_ALPHA8: the card turns what it reads into linear light."""


class Shaders:
    """The programs that draw the face of a scene; each is made when it is first needed."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._programs: dict[ProgramName, moderngl.Program] = {}
        self._pictures: dict[Texture, moderngl.Texture] = {}
        self._sight: Sight | None = None
        self._told: dict[ProgramName, Sight] = {}
        self._clay: tuple[float, ...] = tuple(linear(np.array(CLAY.colour)).tolist())

    def program(self, name: ProgramName) -> moderngl.Program:
        """Return a program."""
        if name not in self._programs:
            self._programs[name] = load_program(self._ctx, *SHADERS[name])
        return self._programs[name]

    def see(self, framing: Framing) -> None:
        """Look from here from now on."""
        self._sight = sight(framing)
        self._told.clear()

    def use(self, run: Run, shading: Shading, *, fine: bool) -> ProgramName:
        """Make ready to draw a run; return the name of the program that does."""
        name = _program_of(run, shading, fine=fine)
        program = self.program(name)
        if name not in self._told and self._sight is not None:
            self._sight.tell(program)
            self._told[name] = self._sight
        if shading == "normals":
            return name
        if run.texture is not None and name.endswith("textured"):
            self._picture(run.texture).use(0)
            program["colours"] = 0
            program["cutout"] = run.cutout or 0.0
        if (run.texture is not None and name.endswith("textured")) or name == "blended":
            program["opacity"] = run.opacity
        if name == "blended textured":
            program["solid"] = SOLID if run.opacity >= SOLID else 2.0  # the rest is there already
        material = run if shading == "studio" or run.wet else CLAY
        scatter = run.scatter if shading == "studio" else CLAY.scatter
        paint = (*run.tint, 1.0) if shading == "studio" else (*self._clay, 0.0)
        if shading == "clay" and run.wet:
            paint = (*(EYES_OF_CLAY * part for part in self._clay), -1.0)
        program["paint"] = paint
        program["roughness"] = material.roughness
        program["reflects"] = material.reflects
        program["scatter"] = scatter
        program["gather"] = tuple(1 / (1 + part) for part in scatter)
        return name

    def _picture(self, texture: Texture) -> moderngl.Texture:
        """Return a texture on the graphics card, where it is read as linear light."""
        if texture not in self._pictures:
            height, width, _ = texture.pixels.shape
            made = self._ctx.texture(
                (width, height), 4, np.ascontiguousarray(texture.pixels), internal_format=_SRGB_ALPHA
            )
            made.repeat_x, made.repeat_y = texture.repeats
            made.build_mipmaps()
            made.filter = moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR
            if self._ctx.max_anisotropy > 1:
                made.anisotropy = min(8.0, float(self._ctx.max_anisotropy))
            self._pictures[texture] = made
        return self._pictures[texture]

    def release(self) -> None:
        """Give the graphics memory back."""
        for program in self._programs.values():
            program.release()
        for picture in self._pictures.values():
            picture.release()


def _program_of(run: Run, shading: Shading, *, fine: bool) -> ProgramName:
    if shading == "normals":
        return "normals"
    if run.middle is not None:
        return "blended" if run.texture is None else "blended textured"
    if run.texture is not None and (shading == "studio" or run.cutout is not None):
        return "wet textured" if run.wet else "textured"
    if run.wet:
        return "wet"
    if fine or (run.roughness < GLOSSY and shading == "studio"):
        return "fine"
    return "fast"
