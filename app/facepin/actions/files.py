"""Opening, saving and leaving."""

from collections.abc import Callable
from pathlib import Path

from facepin.core.quality import LEVELS, level
from facepin.desk.desk import Desk
from facepin.desk.papers import picture_of
from facepin.files.formats import write_model
from facepin.files.work.pose_file import read_pose, write_pose
from facepin.panels.commands import Command
from facepin.panels.file_dialog import Kind
from facepin.panels.requests import CancelLoading, OpenPath, Request, UseNeutral
from facepin.session.edit import Edit
from facepin.session.session import Session

POSES = ("Poses", "*.json *.csv")
FACES = ("Faces", "*.glb *.gltf *.vrm *.npz *.obj", "All files", "*")
ALL = ("Faces and scenes", "*.facepin *.glb *.gltf *.vrm *.npz *.obj", "All files", "*")
MODELS = ("Models", "*.glb *.obj *.ply *.stl")


def act(request: Request, desk: Desk) -> bool:
    """Carry out what concerns files."""
    session = desk.session
    match request:
        case OpenPath(path) if path.suffix.lower() in (".json", ".csv") and session is not None:
            load_pose(desk, session, path)
        case OpenPath(path):
            desk.opener.open(path)
        case CancelLoading():
            desk.opener.cancel()
        case UseNeutral(name):
            desk.opener.use_neutral(name)
        case Command.OPEN_FILE | Command.OPEN_FOLDER:
            kind: Kind = "open file" if request is Command.OPEN_FILE else "open folder"
            desk.ask(kind, request, desk.folder, ALL if kind == "open file" else (), desk.opener.open)
        case Command.LOAD_POSE | Command.SAVE_POSE | Command.EXPORT if session is not None:
            desk.say("")
            _ask_for(request, desk, session)
        case Command.SCREENSHOT | Command.SCREENSHOT_PINS if desk.stage is not None and session is not None:
            shown = desk.view.panes[session.active]
            tool = desk.tool if request is Command.SCREENSHOT_PINS else None
            samples = max(
                level(desk.view.quality, software=False, moving=False).samples, LEVELS["good"].samples
            )
            write = picture_of(desk.stage, shown, desk.camera, desk.viewport, desk.pictures, tool, samples)
            desk.errands.start(request.title, write)
        case _:
            return False
    return True


def load_pose(desk: Desk, session: Session, path: Path) -> None:
    """Put a pose file on the face, and say what of it did not fit."""
    loaded, report = read_pose(path, session.rig)
    desk.apply(Edit(f"Load {path.name}", True, loaded.pins, weights=loaded.weights))
    report = "; ".join(line for line in (report, session.message) if line)
    where = " into the selected pane" if len(session.panes) > 1 else ""
    desk.say(f"{path.name}: {report}" if report else f"Loaded {path.name}{where}")


def _ask_for(command: Command, desk: Desk, session: Session) -> None:
    """Ask which file to load or write, then do so with what is open by then."""
    folder = desk.folder

    def answered(do: Callable[[Desk, Session, Path], None]) -> Callable[[Path], None]:
        def then(path: Path) -> None:
            if desk.session is not None:
                do(desk, desk.session, path)

        return then

    match command:
        case Command.LOAD_POSE:
            desk.ask("open file", command, folder, POSES, answered(load_pose))
        case Command.SAVE_POSE:
            desk.ask("save file", command, folder / f"{session.rig.name}.json", POSES, answered(_save_pose))
        case Command.EXPORT:
            desk.ask("save file", command, folder / f"{session.rig.name}.glb", MODELS, answered(_export))


def _save_pose(desk: Desk, session: Session, path: Path) -> None:
    write_pose(path, session.rig, session.pose)
    desk.say(f"Saved {path}")


def _export(desk: Desk, session: Session, path: Path) -> None:
    write_model(session.rig, session.control.heard(session.pose.weights), path)
    desk.say(f"Exported {path}")
