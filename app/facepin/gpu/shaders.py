"""How runs of triangles are shaded: by which program, and what it is told."""

from typing import Literal

import moderngl
import numpy as np

from facepin.core.shading import Shading
from facepin.gpu.framing import Framing
from facepin.gpu.lamps import Sight, sight
from facepin.gpu.materials import CLAY, Run, linear
from facepin.gpu.programs import load_program

ProgramName = Literal["fast", "fine", "wet", "normals"]

SHADERS: dict[ProgramName, tuple[str, ...]] = {
    "fast": ("mesh_fast",),
    "fine": ("mesh",),
    "wet": ("mesh", "WET"),
    "normals": ("normals",),
}
"""Name and definitions of the shader pair of each program."""

GLOSSY = 0.3
"""Roughness below which a highlight is too small to be computed at vertices."""
WET = 0.15
"""Roughness below which the lamps themselves are seen in a surface."""
EYES_OF_CLAY = 1.35
"""How much lighter eyes are than other clay; their irises stay darker, to tell where they look."""


class Shaders:
    """The programs that draw the face of a scene; each is made when it is first needed."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._programs: dict[ProgramName, moderngl.Program] = {}
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
        material = run if shading == "studio" or run.roughness < WET else CLAY
        scatter = run.scatter if shading == "studio" else CLAY.scatter
        paint = (*run.tint, 1.0) if shading == "studio" else (*self._clay, 0.0)
        if shading == "clay" and run.roughness < WET:
            paint = (*(EYES_OF_CLAY * part for part in self._clay), -1.0)
        program["paint"] = paint
        program["roughness"] = material.roughness
        program["scatter"] = scatter
        program["gather"] = tuple(1 / (1 + part) for part in scatter)
        return name

    def release(self) -> None:
        """Give the graphics memory back."""
        for program in self._programs.values():
            program.release()


def _program_of(run: Run, shading: Shading, *, fine: bool) -> ProgramName:
    if shading == "normals":
        return "normals"
    if run.roughness < WET:
        return "wet"
    if fine or (run.roughness < GLOSSY and shading == "studio"):
        return "fine"
    return "fast"
