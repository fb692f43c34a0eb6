"""Compiles the shader pairs of shaders/, with their shared code, and says where a mistake is."""

import re

import moderngl

from facepin.resources import resource

_INCLUDE = re.compile(r'^[ \t]*#include[ \t]+"([^"]+)"[ \t]*$', re.MULTILINE)
_PLACE = re.compile(r"^(?:ERROR: )?(\d+)[:(](\d+)(?:\(\d+\))?\)?\s*:\s*(.*)$", re.MULTILINE)


class ShaderError(Exception):
    """A shader does not compile or link: file, line and the words of the driver."""


def load_program(ctx: moderngl.Context, name: str, *defined: str) -> moderngl.Program:
    """Compile `shaders/<name>.vert` with `shaders/<name>.frag`.

    A line `#include "file"` puts in another file of shaders/, which may not include more.  What is `defined`
    can be asked for with #ifdef.

    Raises
    ------
    ShaderError
        One line per complaint of the driver: file:line and what it says.
    FileNotFoundError
        No such shader.
    """
    files = [f"{name}.vert", f"{name}.frag"]
    sources = [resource("shaders", file).read_text(encoding="utf-8") for file in files]
    # The number of an included file tells the driver's complaints apart; 0 is the including file itself.
    included = list(dict.fromkeys(found for source in sources for found in _INCLUDE.findall(source)))
    for number, file in enumerate(included, start=1):
        ctx.includes[file] = f"#line 1 {number}\n" + resource("shaders", file).read_text(encoding="utf-8")
    vertex, fragment = (_prepared(source, defined) for source in sources)
    try:
        return ctx.program(vertex_shader=vertex, fragment_shader=fragment)
    except moderngl.Error as error:
        raise ShaderError(explain(str(error), files, included)) from None


def _prepared(source: str, defined: tuple[str, ...]) -> str:
    """Add definitions after the first line, and keep the count of lines right across them and includes."""
    lines = source.splitlines()
    for at, line in enumerate(lines):
        if _INCLUDE.match(line):
            lines[at] = f"{line}\n#line {at + 2} 0"
    definitions = [f"#define {word}" for word in defined]
    return "\n".join([lines[0], *definitions, "#line 2 0", *lines[1:]]) + "\n"


def explain(log: str, files: list[str], included: list[str]) -> str:
    """Turn the log of moderngl and the driver into lines "file:line: complaint".

    Parameters
    ----------
    log : str
        The text of `moderngl.Error`.
    files : list of str
        Names of the vertex and of the fragment shader.
    included : list of str
        Included files, numbered from 1.
    """
    main = files[1] if "fragment_shader" in log else files[0]
    complaints = [
        f"shaders/{included[int(source) - 1] if 0 < int(source) <= len(included) else main}:{line}: {text}"
        for source, line, text in _PLACE.findall(log)
    ]
    return "\n".join(complaints) or f"shaders/{', '.join(files)}: {' '.join(log.split())}"
