"""Imports point down only: the folder tree is the architecture."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[1] / "app/facepin"

LAYERS: list[set[str]] = [
    {"__main__"},
    {"commands"},
    {"solve_commands"},
    {"main_loop", "figures"},
    {"options", "frame"},
    {"actions"},
    {"desk", "sheets"},
    {"window", "gpu", "panels"},
    {"session", "files"},
    {"system_fonts"},
    {"solvers", "core", "resources", "platforms"},
]
"""From the top down.  A module may import from lower lines, and from its own folder."""

BENEATH = {"panels": {"session", "core", "solvers", "resources", "platforms", "system_fonts"}}
"""Panels draw what a session holds and return its edits; they read no files and touch no GL."""

PURE = ("core", "solvers", "files", "session")
HEAVY = {"moderngl", "glfw", "imgui_bundle", "matplotlib", "PIL", "rich", "trimesh"}


def _modules() -> list[Path]:
    return sorted(PACKAGE.rglob("*.py"))


def _unit(path: Path) -> str:
    """The folder or top-level module that a file belongs to."""
    relative = path.relative_to(PACKAGE)
    return relative.parts[0] if len(relative.parts) > 1 else relative.stem


def _name(path: Path) -> str:
    """What others import a module as."""
    parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
    return ".".join(part for part in parts if part != "__init__")


def _imports(path: Path, *, nested: bool = True) -> set[str]:
    """What a module imports; without those `nested` in functions, what it imports when it is imported."""
    found: set[str] = set()
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for node in ast.walk(tree) if nested else tree.body:
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            assert node.level == 0, f"{path}: relative import"
            found.add(node.module)
            if node.module.split(".")[0] == "facepin":
                found |= {f"{node.module}.{alias.name}" for alias in node.names}
    return found


def _level(unit: str) -> int:
    return next(number for number, line in enumerate(LAYERS) if unit in line)


@pytest.mark.parametrize("path", _modules(), ids=lambda path: str(path.relative_to(PACKAGE)))
def test_imports_point_down(path: Path) -> None:
    unit = _unit(path)
    if unit == "__init__":
        assert not _imports(path)
        return
    for name in _imports(path):
        if not name.startswith("facepin."):
            continue
        other = name.split(".")[1]
        if other in (unit, "__version__"):
            continue
        assert _level(other) > _level(unit), f"{unit} imports {other}"
        if unit in BENEATH:
            assert other in BENEATH[unit], f"{unit} imports {other}"


def test_no_module_needs_itself() -> None:
    """Within a folder too, imports point one way: a circle of modules is one module in pieces."""
    names = {_name(path): path for path in _modules()}
    needs = {name: _imports(path, nested=False) & set(names) - {name} for name, path in names.items()}
    while free := {name for name, others in needs.items() if not others}:
        needs = {name: others - free for name, others in needs.items() if name not in free}
    assert not needs


@pytest.mark.parametrize(
    "path",
    [path for path in _modules() if _unit(path) in PURE],
    ids=lambda path: str(path.relative_to(PACKAGE)),
)
def test_the_pure_part_knows_no_window_and_no_gl(path: Path) -> None:
    roots = {name.split(".")[0] for name in _imports(path)}
    assert not roots & {"moderngl", "glfw", "imgui_bundle"}


def test_the_window_starts_without_what_it_does_not_need_yet() -> None:
    """The first picture is a promise of one second: heavy libraries are imported where they are used."""
    code = "import sys, facepin.main_loop; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    heavy = set(loaded.split()) & (
        HEAVY | {"scipy.optimize", "scipy.spatial", "scipy.linalg", "scipy.sparse.csgraph"}
    )
    assert heavy <= {"moderngl", "glfw", "imgui_bundle"}
