"""Every kind of file the program reads: a whole one of each, and what is done with it once it is open."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from imgui_bundle import imgui

from facepin.core.errors import FacepinError
from facepin.core.look.camera import Camera
from facepin.core.pose import Pin, Pose
from facepin.core.rig import Rig
from facepin.desk.scenes import RigSource, Snapshot, resume, scene_of, shown_over
from facepin.figures.study.references import read_references
from facepin.files import open_rig, write_model
from facepin.files.work.drafts import leftovers
from facepin.files.work.landmarks_file import read_landmarks, write_landmarks
from facepin.files.work.pins_file import held_vertices, read_pins, write_pins
from facepin.files.work.pose_file import read_pose, write_pose
from facepin.files.work.pose_library import new_saved, saved_poses, write_saved
from facepin.files.work.preferences import Preferences, read_preferences, write_preferences
from facepin.files.work.scene_file import Scene, read_scene, scene_bytes, write_scene
from facepin.files.work.thumbnails import read_thumbnail, write_thumbnail
from facepin.frame.layout_file import LayoutFile
from facepin.panels.view import PaneView
from facepin.session.edit import Edit
from facepin.session.session import Session
from facepin.session.solving.solving import PinSolver, choose
from fuzz import samples
from fuzz.mutations import BYTES, TEXT, Mutation
from fuzz.structures import GLB, JSON, NPZ, PNG
from support.small_rigs import sheet

RIG = sheet()


@dataclass(frozen=True)
class Kind:
    """One kind of file or folder."""

    name: str
    make: Callable[[Path], None]
    """Writes a whole one into an empty folder."""
    mutations: dict[str, tuple[Mutation, ...]]
    """How each of its files is broken, by suffix."""
    read: Callable[[Path], None]
    """Does with the folder what the program would do; raises `FacepinError` where that is said in words."""


def _use(rig: Rig) -> None:
    """Move the face, write it and read it again: what was opened has to come back."""
    positions = rig.evaluate(np.full(rig.shape_count, 0.5))
    if not np.isfinite(positions).all():
        raise AssertionError("the posed face is not finite")
    with TemporaryDirectory() as folder:
        path = Path(folder) / "again.glb"
        write_model(rig, rig.rest_weights, path)
        again = open_rig(path, cache=False)
        if again.vertex_count != rig.vertex_count:
            raise AssertionError(f"opened {rig.vertex_count} vertices, exported {again.vertex_count}")
        if again.shape_names != rig.shape_names:
            raise AssertionError(f"opened {rig.shape_names!r}, exported {again.shape_names!r}")


def _open(name: str) -> Callable[[Path], None]:
    return lambda folder: _use(open_rig(folder / name, cache=False))


def _pins() -> tuple[Pin, ...]:
    goal = (RIG.neutral[30].astype(float) + 0.1).tolist()
    return (
        Pin(30, tuple(goal), name="lip corner"),
        Pin(41, tuple(goal), "screen", stiffness=2.0, locked=True),
    )


POSE = Pose(np.array([0.25, 1 / 3, 0.0, -1.5]), _pins())


def _read_pose(name: str) -> Callable[[Path], None]:
    def read(folder: Path) -> None:
        pose, _ = read_pose(folder / name, RIG)
        if not np.isfinite(RIG.evaluate(pose.weights)).all():
            raise AssertionError("the pose is not finite")
        _solve(pose.pins, pose.weights)

    return read


def _solve(pins: tuple[Pin, ...], start: np.ndarray[Any, Any]) -> None:
    for key in ("transpose", "sparse", "bounded", "hand"):
        PinSolver(RIG, choose(key)).solve(pins, start)


def _read_pins(folder: Path) -> None:
    pins = read_pins(folder / "pins.json", RIG)
    held_vertices(folder / "pins.json", RIG)
    _solve(pins, np.zeros(RIG.shape_count))


def _landmarks(folder: Path) -> None:
    write_landmarks(folder / "a.landmarks.json", RIG, _pins())


def _scene() -> Scene:
    session = Session(RIG, [choose("tikhonov"), choose("hand")])
    session.apply(Edit("Set", True, weights=POSE.weights))
    session.apply(Edit("Drag", True, _pins(), solve=True))
    session.set_control("Lock", replace(session.control, locked=np.arange(4) == 3))
    session.set_reference(np.array([0, 0.7, 0, 0.1]))
    cameras = tuple(Camera().orbited(0.1, 0.2) for _ in session.panes)
    views = tuple(shown_over(PaneView(wireframe=True)) for _ in session.panes)
    source = RigSource(Path("/faces/sheet.npz"))
    return scene_of(Snapshot(RIG, source, session.committed, 0, cameras, views, False, None, {}), draft=False)


def _resume(scene: Scene) -> None:
    """Put a scene on the face, drag in it, and keep it."""
    found = resume(scene, RIG)
    session = Session.resumed(RIG, found.work, found.active)
    session.apply(Edit("Drag", True, _pins(), solve=True))
    scene_bytes(scene, None)


def _draft(folder: Path) -> None:
    (folder / "work-1.facepin").write_bytes(scene_bytes(_scene(), None))


def _read_drafts(folder: Path) -> None:
    found, _ = leftovers(folder)
    for leftover in found:
        try:
            _resume(leftover.scene)
        finally:
            leftover.draft.release()


def _library(folder: Path) -> None:
    for key, title in (("a", "Smile"), ("b", "Frown ✓")):
        write_saved(folder / "face.poses", new_saved(RIG, POSE, key, title, ("mouth",), 1.5))


def _read_library(folder: Path) -> None:
    for saved in saved_poses(folder / "face.poses", RIG):
        if not isinstance(saved, FacepinError) and not np.isfinite(saved.weights).all():
            raise AssertionError("a pose of the library is not finite")


def _read_preferences(folder: Path) -> None:
    preferences, line = read_preferences(folder / "preferences.json")
    if line is not None and "\n" in line:
        raise AssertionError("the remark has more than one line")
    write_preferences(folder / "preferences.json", preferences.opened(Path("/a")))


def _read_layout(folder: Path) -> None:
    imgui.create_context()
    try:
        imgui.get_io().config_flags |= imgui.ConfigFlags_.docking_enable
        LayoutFile(folder / "layout.ini").scale(1.5)
    finally:
        imgui.destroy_context()


LAYOUT = """[Window][Weights]
Pos=0,20
Size=300,700
Collapsed=0
DockId=0x00000002,0

[Table][0xAF94F05A,2]
RefScale=13
Column 0  Weight=1.0000

[Docking][Data]
DockSpace     ID=0x08BD597D Window=0x1BBC0F80 Pos=0,20 Size=1280,700 Split=X
  DockNode    ID=0x00000001 Parent=0x08BD597D SizeRef=980,700 CentralNode=1
  DockNode    ID=0x00000002 Parent=0x08BD597D SizeRef=300,700 Selected=0x4B2A1C3D
"""


def _thumbnail(folder: Path) -> None:
    image = np.random.default_rng(2).integers(0, 255, (32, 32, 4), np.uint8)
    write_thumbnail(folder / "a.png", image, "mark")


def _table(folder: Path) -> None:
    rows = np.random.default_rng(3).uniform(0, 1, (5, RIG.shape_count))
    lines = [",".join(RIG.shape_names), *(",".join(f"{weight:g}" for weight in row) for row in rows)]
    (folder / "walk.csv").write_text("\n".join(lines) + "\n")


KINDS = (
    Kind("glb", samples.glb, {".glb": GLB}, _open("face.glb")),
    Kind("gltf", samples.gltf_folder, {".gltf": JSON, ".bin": BYTES, ".png": PNG}, _open("face.gltf")),
    Kind("vrm", samples.vrm, {".vrm": GLB}, _open("face.vrm")),
    Kind("npz", samples.npz, {".npz": NPZ}, _open("face.npz")),
    Kind("obj", samples.obj, {".obj": TEXT, ".mtl": TEXT, ".png": PNG}, _open("face")),
    Kind("pose json", lambda at: write_pose(at / "a.json", RIG, POSE), {".json": JSON}, _read_pose("a.json")),
    Kind("pose csv", lambda at: write_pose(at / "a.csv", RIG, POSE), {".csv": TEXT}, _read_pose("a.csv")),
    Kind("pins", lambda at: write_pins(at / "pins.json", _pins()), {".json": JSON}, _read_pins),
    Kind(
        "landmarks",
        _landmarks,
        {".json": JSON},
        lambda at: _nothing(read_landmarks(at / "a.landmarks.json", RIG)),
    ),
    Kind(
        "scene",
        lambda at: write_scene(at / "a.facepin", _scene()),
        {".facepin": JSON},
        lambda at: _resume(read_scene(at / "a.facepin")),
    ),
    Kind("drafts", _draft, {".facepin": JSON}, _read_drafts),
    Kind("library", _library, {".json": JSON}, _read_library),
    Kind(
        "preferences",
        lambda at: _nothing(write_preferences(at / "preferences.json", Preferences())),
        {".json": JSON},
        _read_preferences,
    ),
    Kind("layout", lambda at: _nothing((at / "layout.ini").write_text(LAYOUT)), {".ini": TEXT}, _read_layout),
    Kind(
        "thumbnail",
        _thumbnail,
        {".png": PNG},
        lambda at: _nothing(read_thumbnail(at / "a.png", "mark", 32)),
    ),
    Kind("references", _table, {".csv": TEXT}, lambda at: _nothing(read_references(at / "walk.csv", RIG, 3))),
)


def _nothing(_: object) -> None:
    """Make nothing of an answer."""
