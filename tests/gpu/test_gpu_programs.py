"""Shaders compile, and a mistake in one is found by file and line."""

from pathlib import Path

import moderngl
import pytest

from facepin.gpu import programs
from facepin.gpu.programs import ShaderError, explain, load_program
from facepin.resources import resource

SHADERS = resource("shaders", "mesh.vert").parent


@pytest.mark.parametrize("name", sorted(path.stem for path in SHADERS.glob("*.vert")))
def test_every_pair_compiles(gl: moderngl.Context, name: str) -> None:
    load_program(gl, name).release()


def test_every_shared_file_is_used() -> None:
    sources = "".join(path.read_text() for path in SHADERS.glob("*.*") if path.suffix != ".glsl")
    for path in SHADERS.glob("*.glsl"):
        assert f'#include "{path.name}"' in sources


@pytest.fixture
def broken(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of shaders, of which tests break one."""
    (tmp_path / "a.vert").write_text("#version 330 core\nvoid main()\n{\n    gl_Position = vec4(0.0);\n}\n")
    (tmp_path / "half.glsl").write_text("// half\n\nfloat half_of(float x)\n{\n    return 0.5 * x;\n}\n")
    main = "out vec4 pixel;\nvoid main()\n{\n    pixel = vec4(half_of(1.0));\n}\n"
    (tmp_path / "a.frag").write_text(f'#version 330 core\n#include "half.glsl"\n{main}')
    monkeypatch.setattr(programs, "resource", lambda folder, name: tmp_path / name)
    return tmp_path


def test_a_mistake_is_found_in_its_file(gl: moderngl.Context, broken: Path) -> None:
    load_program(gl, "a").release()
    source = (broken / "a.frag").read_text()
    (broken / "a.frag").write_text(source.replace("half_of(1.0)", "nonsense"))
    with pytest.raises(ShaderError, match=r"^shaders/a\.frag:6: .*nonsense"):
        load_program(gl, "a")


def test_a_mistake_is_found_in_a_shared_file(gl: moderngl.Context, broken: Path) -> None:
    source = (broken / "half.glsl").read_text()
    (broken / "half.glsl").write_text(source.replace("0.5 * x;", "0.5 * x + ;"))
    with pytest.raises(ShaderError, match=r"shaders/half\.glsl:5: "):
        load_program(gl, "a")


@pytest.mark.parametrize(
    "complaint",
    ["1:12(5): error: no", "1(12) : error: no", "ERROR: 1:12: error: no"],
    ids=["Mesa", "NVIDIA", "Apple and Intel"],
)
def test_complaints_of_drivers(complaint: str) -> None:
    log = f"GLSL Compiler failed\n\nfragment_shader\n===============\n{complaint}\n"
    assert explain(log, ["a.vert", "a.frag"], ["b.glsl"]) == "shaders/b.glsl:12: error: no"


def test_a_complaint_nobody_understands_is_shown_as_it_is() -> None:
    said = explain("GLSL Linker failed\n\nvarying x not written", ["a.vert", "a.frag"], [])
    assert said == "shaders/a.vert, a.frag: GLSL Linker failed varying x not written"
