"""What lies on the desk: the open rig, cameras on it, files being opened or saved; carries out requests."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import moderngl
import numpy as np

from facepin.core.camera import Camera, Viewport, frame_points
from facepin.core.errors import FacepinError
from facepin.core.pose import Pin, Pose
from facepin.core.rig import Rig
from facepin.files import open_rig
from facepin.files.formats import write_model
from facepin.files.pose_file import read_pose, write_pose
from facepin.options import BUILTIN
from facepin.panels.file_dialog import FileDialog, Kind
from facepin.panels.requests import (
    VIEW_COMMANDS,
    AddPane,
    CancelLoading,
    ClosePane,
    Command,
    KeepPane,
    OpenPath,
    RandomReference,
    Request,
    SelectPane,
    SetPin,
    UseSolver,
)
from facepin.panels.view import PaneView, View
from facepin.papers import free_name, keep_pose, save_picture
from facepin.resources import resource
from facepin.session.drag import DragTool
from facepin.session.edit import Edit
from facepin.session.loading import Loading
from facepin.session.reference import random_reference
from facepin.session.session import Session, Work
from facepin.session.solving import SolverChoice
from facepin.stage import Stage

ChartWriter = Callable[[Session, Path], None]

_POSES = ("Poses", "*.json *.csv")
_DIALOGS: dict[Command, tuple[Kind, tuple[str, ...]]] = {
    Command.OPEN_FILE: ("open file", ("Faces", "*.glb *.gltf *.vrm *.npz *.obj", "All files", "*")),
    Command.OPEN_FOLDER: ("open folder", ()),
    Command.LOAD_POSE: ("open file", _POSES),
    Command.SAVE_POSE: ("save file", _POSES),
    Command.REFERENCE_FROM_FILE: ("open file", _POSES),
    Command.EXPORT: ("save file", ("Models", "*.glb *.obj *.ply *.stl")),
}


class Desk:
    """Carries out requests; holds what they act on."""

    def __init__(
        self,
        ctx: moderngl.Context,
        view: View,
        choices: Sequence[SolverChoice],
        *,
        native_dialogs: bool,
        pictures: Path,
        unsaved: Path | None,
        chart_writer: ChartWriter | None,
    ) -> None:
        """Start with nothing open.

        Parameters
        ----------
        ctx : moderngl.Context
            Where rigs are drawn.
        view : View
            What is shown and how; changed in place.
        choices : sequence of SolverChoice
            One per pane, for the first rig.
        native_dialogs : bool
            Use the platform's file dialogs.
        pictures : Path
            Folder that saved pictures go to.
        unsaved : Path
            Folder where poses are kept that nobody saved; None keeps nothing.
        chart_writer : callable
            Writes the charts of a session into a folder.
        """
        self.view = view
        self.tool = DragTool()
        self.cameras: list[Camera] = [Camera()]
        """One per pane."""
        self.stage: Stage | None = None
        self.loading: Loading | None = None
        self.dialog: FileDialog | None = None
        self.message = ""
        self.is_error = False
        self.opened: Path | None = None
        """The last rig that was opened from a file, for the list of recent ones."""
        self.closing = False
        self._ctx = ctx
        self._choices = choices
        self._native = native_dialogs
        self._pictures = pictures
        self._unsaved = unsaved
        self._chart_writer = chart_writer
        self._asked: Command | None = None
        self._saved: Work | None = None
        self._first_pose: Callable[[Rig], Pose] | None = None
        self._solve_first = False
        self._numbers = [0]
        """Of the panes that `cameras` and `view.panes` are for."""
        self._looks: dict[int, tuple[Camera, PaneView]] = {}
        """How panes were looked at, by their numbers."""

    @property
    def session(self) -> Session | None:
        """The open session, if any."""
        return self.stage.session if self.stage else None

    @property
    def camera(self) -> Camera:
        """The camera of the active pane."""
        return self.cameras[self.session.active if self.session else 0]

    def look(self, camera: Camera, pane: int | None = None) -> None:
        """Look at a pane (the active one for None) through another camera; at all panes while linked."""
        if self.view.linked or self.session is None:
            self.cameras = [camera] * len(self.cameras)
        else:
            self.cameras[self.session.active if pane is None else pane] = camera

    @property
    def title(self) -> str:
        """What the title bar says: the rig, a star while its pose is unsaved, the program."""
        if self.session is None:
            return "Facepin"
        star = "*" if self.session.committed is not self._saved else ""
        return f"{self.session.rig.name}{star} - Facepin"

    def say(self, message: str, *, error: bool = False) -> None:
        """Show a message in the status line until the next one."""
        self.message, self.is_error = message, error

    def open(
        self,
        path: Path,
        first_pose: Callable[[Rig], Pose] | None = None,
        *,
        solve: bool = False,
        neutral: str | None = None,
    ) -> None:
        """Start opening the rig at `path`; `poll` puts it on the desk when it is there.

        Parameters
        ----------
        path : Path
            File or folder.
        first_pose : callable
            Makes the pose to begin with once the rig is there.
        solve : bool
            Whether the weights then follow the pins of that pose.
        neutral : str
            For a folder: the file with the neutral.
        """
        if self.loading is not None:
            self.loading.cancel()
        self._first_pose, self._solve_first = first_pose, solve
        self.loading = Loading(
            path, lambda path, progress: open_rig(path, neutral=neutral, progress=progress)
        )

    def poll(self, viewport: Viewport) -> None:
        """Take over what was finished meanwhile: a rig that was being opened, a dialog that was answered."""
        if self.loading is not None and self.loading.finished:
            loading, self.loading = self.loading, None
            with self._reporting():
                rig = loading.result()
                if rig is not None:
                    self._show(rig, viewport)
                    if loading.path != resource("assets", BUILTIN):
                        self.opened = loading.path
        if self.dialog is not None and self.dialog.finished:
            dialog, self.dialog = self.dialog, None
            if dialog.path is not None:
                with self._reporting():
                    self._answered(dialog.path)

    def carry_out(self, request: Request, viewport: Viewport) -> None:
        """Do what was asked; what can't be done is said in the status line."""
        with self._reporting():
            match request:
                case OpenPath(path) if path.suffix.lower() in (".json", ".csv") and self.session is not None:
                    self._load_pose(self.session, path)
                case OpenPath(path):
                    self.open(path)
                case CancelLoading() if self.loading is not None:
                    self.loading.cancel()
                case Command.QUIT:
                    self.closing = True
                case Command.OPEN_BUILTIN:
                    self.open(resource("assets", BUILTIN))
                case Command.OPEN_FILE | Command.OPEN_FOLDER:
                    self._ask(request, Path.home() if self.opened is None else self.opened.parent)
                case _ if self.stage is not None:
                    # What an earlier request of the same frame changed.
                    self.sync()
                    self.stage.update()
                    self._act(request, self.stage, viewport)

    def _say_failure(self, session: Session) -> None:
        if session.message:
            self.say(session.message, error=True)

    def apply(self, edit: Edit) -> None:
        """Apply an edit to the session, and pass on what it has to say."""
        if self.session is None:
            return
        self.session.apply(edit)
        if self.session.message:
            self.say(self.session.message, error=True)
        elif edit.final:
            held = [pin.vertex for pin in self.session.pose.pins[-1:]]
            stuck = edit.label == "Place pin" and not self.session.rig.rows_at(held).any()
            self.say("No shape of this rig moves the point under the new pin" if stuck else "")

    def keep_unsaved(self) -> Path | None:
        """Write the pose to a file of its own if nobody saved it; return where."""
        session = self.session
        if session is None or self._unsaved is None or session.committed is self._saved:
            return None
        pose = session.committed.panes[session.active].pose
        self._saved = session.committed
        return keep_pose(session.rig, pose, self._unsaved)

    def release(self) -> None:
        """Give everything back."""
        if self.loading is not None:
            self.loading.cancel()
        if self.dialog is not None:
            self.dialog.close()
        if self.stage is not None:
            self.stage.release()

    def _act(self, request: Request, stage: Stage, viewport: Viewport) -> None:
        """Carry out a request that needs an open rig."""
        session = stage.session
        pose, rig = session.pose, session.rig
        if not isinstance(request, SelectPane):
            self.say("")
        match request:
            case UseSolver(pane, choice, final):
                session.choose_solver(pane, choice, final=final)
                self._say_failure(session)
            case AddPane(choice):
                session.add_pane(choice)
                self._say_failure(session)
            case SelectPane(pane):
                session.active = pane
            case ClosePane(pane):
                session.close_pane(pane)
            case KeepPane(pane):
                session.keep_pane(pane)
            case Command.REFERENCE_FROM_POSE:
                session.set_reference(pose.weights)
            case RandomReference(shapes):
                session.set_reference(random_reference(rig, shapes, np.random.default_rng()))
            case Command.HEAT:
                shown = self.view.panes[session.active]
                shown.heat = not shown.heat
            case Command.WIREFRAME:
                shown = self.view.panes[session.active]
                shown.wireframe = not shown.wireframe
            case Command.GHOST:
                has_reference = session.work.reference is not None
                self.view.panes[session.active].next_ghost(has_reference=has_reference)
            case Command.CHART:
                self.view.chart = not self.view.chart
            case Command.SAVE_CHART:
                self._save_chart(session)
            case Command.FORGET_REFERENCE:
                session.set_reference(None)
            case SetPin():
                self._set_pin(session, request)
            case Command.UNDO:
                label = session.undo_label
                self.say(f"Undone: {label}" if session.undo() else "Nothing to undo")
            case Command.REDO:
                label = session.redo_label
                self.say(f"Redone: {label}" if session.redo() else "Nothing to redo")
            case Command.RESET_POSE:
                session.reset()
            case Command.DELETE_PINS:
                kept = tuple(pin for pin in pose.pins if pin.vertex not in self.tool.selected)
                if len(kept) < len(pose.pins):
                    self.apply(Edit("Remove pins", True, kept))
            case Command.CLEAR_PINS:
                self.apply(Edit("Remove all pins", True, ()))
            case Command.FRAME:
                self.look(frame_points(stage.positions(session.active), viewport.aspect, self.camera))
            case Command.SCREENSHOT:
                shown = self.view.panes[session.active]
                path = save_picture(stage, shown, self.camera, viewport, self._pictures)
                self.say(f"Saved {path}")
            case Command.LOAD_POSE | Command.SAVE_POSE | Command.EXPORT | Command.REFERENCE_FROM_FILE:
                suffix = ".glb" if request is Command.EXPORT else ".json"
                folder = Path.home() if self.opened is None else self.opened.parent
                opens = request in (Command.LOAD_POSE, Command.REFERENCE_FROM_FILE)
                asked = folder if opens else folder / f"{rig.name}{suffix}"
                self._ask(request, asked)
            case Command() if request in VIEW_COMMANDS:
                self.look(self.camera.looking(VIEW_COMMANDS[request]))

    def _set_pin(self, session: Session, request: SetPin) -> None:
        pins = session.pose.pins
        if request.remove:
            kept = tuple(pin for pin in pins if pin.vertex != request.vertex)
            self.apply(Edit("Remove pin", True, kept))
            return

        def changed(pin: Pin) -> Pin:
            if pin.vertex != request.vertex:
                return pin
            return replace(
                pin, freedom=request.freedom or pin.freedom, stiffness=request.stiffness or pin.stiffness
            )

        self.apply(Edit("Change pin", request.final, tuple(changed(pin) for pin in pins), solve=True))

    def _show(self, rig: Rig, viewport: Viewport) -> None:
        """Put an opened rig on the desk."""
        pose, complaint = None, ""
        try:
            pose = self._first_pose(rig) if self._first_pose else None
        except FacepinError as error:
            complaint = str(error)  # the rig is there all the same
        choices = [pane.choice for pane in self.session.panes] if self.session else self._choices
        session = Session(rig, choices, pose)
        if pose is not None and self._solve_first:
            session.apply(Edit("Solve the pins", True, pose.pins, solve=True))
        stage = Stage(self._ctx, session)
        kept = self.keep_unsaved()
        is_first = self.stage is None
        if self.stage is not None:
            self.stage.release()
        self.stage, self.tool = stage, DragTool()
        self._saved = session.committed
        count = len(session.panes)
        width, height, _ = np.ptp(rig.neutral, axis=0).tolist()
        camera = Camera(radius=0.0, least_aspect=min(1.15 * width / max(height, 1e-9), 2.0))
        framed = frame_points(stage.positions(session.active), viewport.aspect, camera)
        self.cameras = [framed] * count
        self.view.panes = [PaneView() for _ in range(count)]  # what was shown over another face is over
        self._numbers, self._looks = [pane.number for pane in session.panes], {}
        if complaint := complaint or session.message:
            self.say(complaint, error=True)
        elif kept is not None:
            self.say(f"Opened {rig.name}; the pose that was not saved is kept in {kept}")
        elif rig.warnings:
            more = f" (and {len(rig.warnings) - 1} more)" if len(rig.warnings) > 1 else ""
            self.say(f"Opened with a warning: {rig.warnings[0]}{more}")
        elif not is_first:  # what was wrong with the start stays to be read
            self.say("")

    def _ask(self, command: Command, start: Path) -> None:
        if self.dialog is not None:
            raise FacepinError("another question for a file waits for its answer")
        kind, filters = _DIALOGS[command]
        self._asked = command
        self.dialog = FileDialog(kind, command.title.rstrip("…"), start, filters, use_native=self._native)

    def _answered(self, path: Path) -> None:
        """Go on with what the dialog was for."""
        if self._asked in (Command.OPEN_FILE, Command.OPEN_FOLDER):
            self.open(path)
            return
        if self.session is None:
            return
        rig, pose = self.session.rig, self.session.pose
        if self._asked is Command.LOAD_POSE:
            self._load_pose(self.session, path)
        elif self._asked is Command.REFERENCE_FROM_FILE:
            loaded, report = read_pose(path, rig)
            self.session.set_reference(loaded.weights)
            self.say(f"{path.name}: {report}" if report else f"{path.name} is the reference")
        elif self._asked is Command.SAVE_POSE:
            write_pose(path, rig, pose)
            self._saved = self.session.committed
            self.say(f"Saved {path}")
        elif self._asked is Command.EXPORT:
            write_model(rig, pose.weights, path)
            self.say(f"Exported {path}")

    def _load_pose(self, session: Session, path: Path) -> None:
        loaded, report = read_pose(path, session.rig)
        self.apply(Edit(f"Load {path.name}", True, loaded.pins, weights=loaded.weights))
        self.say(f"{path.name}: {report}" if report else f"Loaded {path.name}")

    def _save_chart(self, session: Session) -> None:
        """Write the charts of all panes: pictures, drawings and a table."""
        if self._chart_writer is None:
            raise FacepinError("charts cannot be written here")
        folder = free_name(self._pictures, f"{session.rig.name}-chart", "")
        self._chart_writer(session, folder)
        self.say(f"Saved {folder}")

    def sync(self) -> None:
        """Give every pane its camera and view, which it keeps when others are closed and finds after undo."""
        numbers = [pane.number for pane in self.session.panes] if self.session else [0]
        if numbers == self._numbers:
            return
        self._looks |= zip(self._numbers, zip(self.cameras, self.view.panes, strict=True), strict=True)
        camera = self.cameras[-1]
        looks = [self._looks.get(number, (camera, PaneView())) for number in numbers]
        self.cameras = [camera if self.view.linked else own for own, _ in looks]
        self.view.panes = [view for _, view in looks]
        self._numbers = numbers

    def _reporting(self) -> "_Reporting":
        return _Reporting(self)


class _Reporting:
    """Shows what goes wrong inside a `with` block in the status line; bugs pass through."""

    def __init__(self, desk: Desk) -> None:
        self._desk = desk

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> bool:
        # moderngl.Error: a graphics card without memory must not take the pose with it.
        if isinstance(error, FacepinError | OSError | moderngl.Error):
            self._desk.say(str(error), error=True)
            return True
        return False
