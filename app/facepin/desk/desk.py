"""What lies on the desk: the open rig, cameras on it, files being opened or asked for."""

from collections.abc import Callable, Sequence
from pathlib import Path

import moderngl
import numpy as np

from facepin.core.errors import FacepinError
from facepin.core.look.camera import Camera, Viewport, frame_points
from facepin.core.names import readable
from facepin.core.rig import Rig
from facepin.core.turn import Turn
from facepin.desk.errands import Errands
from facepin.desk.faults import Faults, Within
from facepin.desk.keeping import Keeper
from facepin.desk.library import Library, library_of
from facepin.desk.opening import Begun, Opener, Opening, SceneOpening
from facepin.desk.portraits import Portraits
from facepin.desk.questions import Question, Questions
from facepin.desk.scenes import Snapshot, shown_over, turned_scene
from facepin.desk.stage import Stage
from facepin.files.work.turns import write_turn
from facepin.panels.commands import Command
from facepin.panels.file_dialog import FileDialog, Kind
from facepin.panels.view import PaneView, View
from facepin.session.edit import Edit
from facepin.session.filmstrip import Filmstrip
from facepin.session.hand.drag import DragTool
from facepin.session.job import Job
from facepin.session.loading import Loading
from facepin.session.session import Session
from facepin.session.solving.solving import SolverChoice

ChartWriter = Callable[[Session, Path], None]


FAR_OFF = 0.005
"""Mean distance of pins from their goals, in heights of the face, above which it is told that goals move."""


class Desk:
    """Holds what requests act on; `facepin.actions` carries them out."""

    def __init__(
        self,
        ctx: moderngl.Context,
        view: View,
        choices: Sequence[SolverChoice],
        *,
        native_dialogs: bool,
        pictures: Path,
        drafts: Path | None,
        settings: Path | None = None,
        chart_writer: ChartWriter | None,
        caught: bool = False,
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
        drafts : Path
            Folder where unsaved work is kept; None keeps nothing.
        settings : Path
            Folder for poses of rigs that they can't be kept beside; None for nowhere.
        chart_writer : callable
            Writes the charts of a session into a folder.
        caught : bool
            Whether bugs are told and written down instead of raised.
        """
        self.view = view
        self.faults = Faults(
            self.say, lambda: self.graphics, settings / "reports" if settings else None, caught=caught
        )
        self.tool = DragTool()
        self.cameras: list[Camera] = [Camera()]
        """One per pane."""
        self.stage: Stage | None = None
        self.library: Library | None = None
        self.portraits: Portraits | None = None
        self.filmstrip = Filmstrip()
        self.job: Job | None = None
        """What is being made beside the work."""
        self.errands = Errands()
        """What is written beside the work."""
        self.opener = Opener(settings)
        self.message = ""
        self.is_error = False
        self.opened: Path | None = None
        """The last rig or scene that was opened from a file, for the list of recent ones."""
        self.keeper = Keeper(drafts)
        self.closing = False
        self.viewport = Viewport(0, 0, 1, 1)
        """Of the first pane, as last drawn."""
        self.pixel_scale = 1.0
        """Pixels per pixel of a 1x screen, as last drawn."""
        self.pictures = pictures
        self.chart_writer = chart_writer
        self._ctx = ctx
        self._choices = choices
        self._questions = Questions(native=native_dialogs)
        self._settings = settings
        self._open: Opening | None = None
        """How what is open was opened."""
        self._numbers = [0]
        """Of the panes that `cameras` and `view.panes` are for."""
        self._given_up: tuple[object, ...] = ()
        """What failed when it was to be refined."""
        self._looks: dict[int, tuple[Camera, PaneView]] = {}
        """How panes were looked at, by their numbers."""

    @property
    def graphics(self) -> str:
        """The graphics driver, in words."""
        return f"{self._ctx.info['GL_RENDERER']}, OpenGL {self._ctx.info['GL_VERSION']}"

    @property
    def session(self) -> Session | None:
        """The open session, if any."""
        return self.stage.session if self.stage else None

    @property
    def loading(self) -> Loading | None:
        """The rig that is being opened, if any."""
        return self.opener.loading

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
        """What the title bar says: the scene's file, a star while unsaved, the rig, the program.

        Before it, while a path is being typed, what that is for.
        """
        asked = f"{self.dialog.title} - " if self.dialog is not None and self.dialog.listens else ""
        if self.session is None:
            return f"{asked}Facepin"
        star = "" if self.keeper.is_saved(self.session) else "*"
        if self.keeper.file is None:
            return f"{asked}{self.session.rig.name}{star} - Facepin"
        return f"{asked}{readable(self.keeper.file.name)}{star} - {self.session.rig.name} - Facepin"

    @property
    def dialog(self) -> FileDialog | None:
        """The dialog that waits for an answer, if any."""
        return self._questions.dialog

    @property
    def folder(self) -> Path:
        """Where to look for files first: beside what was opened last."""
        return Path.home() if self.opened is None else self.opened.parent

    def say(self, message: str, *, error: bool = False) -> None:
        """Show a message in the status line until the next one."""
        self.message, self.is_error = readable(message), error

    def poll(self) -> None:
        """Take over what was finished meanwhile: a rig that was being opened, a dialog that was answered."""
        with self.reporting("Opening"):
            if (found := self.opener.take()) is not None:
                self._show(*found)
        if (question := self._questions.take()) is not None and question.dialog.path is not None:
            self._answer(question, question.dialog.path)
        if (errand := self.errands.take()) is not None:
            with self.reporting(errand.title):
                self.say(errand.outcome.result())
        if (job := self.job) is not None:
            self.job = None  # unless it goes on
            with self.reporting(job.title):
                came_of_it = job.advance()
                if came_of_it is None:
                    self.job = job
                else:
                    self.say(came_of_it)

    def _answer(self, question: Question, path: Path) -> None:
        """Do what the question was asked for; ask once more for a path that is no good."""
        if question.saves and self.session is not question.session:
            self.say("Another face was opened meanwhile, so nothing was saved: save it anew", error=True)
            return
        self.say("")
        with self.reporting(question.dialog.title):
            question.then(path)
        # Of a scene whose rig is missing a card tells, which asks for the rig.
        if self.is_error and self.opener.lost is None:
            self._questions.ask_again(question, self.message)

    def start(self, job: Job) -> None:
        """Begin something long; `poll` takes its steps.

        Raises
        ------
        FacepinError
            While another one goes on.
        """
        if self.job is not None:
            raise FacepinError(f"'{self.job.title}' is still being made")
        self.job = job

    @property
    def refined(self) -> bool:
        """Whether `refine` has nothing to do."""
        return all(each.refined for each in self._unrefined())

    def refine(self) -> bool:
        """Do some milliseconds of what can wait for an idle moment; return whether anything looks new."""
        for each in self._unrefined():
            if not each.refined:
                with self.reporting("What is drawn in idle moments"):
                    return each.refine()
                self._given_up = (*self._given_up, each)  # it would fail in every idle moment
                return True
        return False

    def _unrefined(self) -> list[Stage | Library | Portraits]:
        parts = (self.stage, self.library, self.portraits)
        return [each for each in parts if each is not None and not any(each is one for one in self._given_up)]

    def apply(self, edit: Edit) -> None:
        """Apply an edit to the session, and pass on what it has to say."""
        if self.session is None:
            return
        solved = self.session.committed.panes[self.session.active].solved
        self.session.apply(edit)
        if self.session.message:
            self.say(self.session.message, error=True)
        elif edit.final:
            by_hand = edit.weights is not None and edit.pins is None
            let_go = by_hand and solved is not None and solved.pin_error > FAR_OFF * self.session.rig.height
            self.say("The goals of the pins are on the face again; undo brings them back" if let_go else "")

    def drop_gesture(self) -> None:
        """Let go of whatever is in the hand, as if it had not been taken."""
        self.tool = DragTool()
        if self.session is not None:
            self.session.cancel()

    def snapshot(self) -> Snapshot:
        """Return all that a scene is made of, as it is at the last undo step."""
        session, opening = self.session, self._open
        assert session is not None and opening is not None, "there is something to keep"
        self.sync()
        return Snapshot(
            session.rig,
            opening.source,
            session.committed,
            session.active,
            tuple(self.cameras),
            tuple(shown_over(view) for view in self.view.panes),
            self.view.linked,
            self.keeper.file,
            opening.scene.sections if isinstance(opening, SceneOpening) else {},
            self.view.reference_shown,
            self.keeper.digest,
        )

    def keep(self) -> None:
        """Have a draft written if there is a new undo step; costs nothing if there is not."""
        if self.session is not None:
            self.keeper.follow(self.session, self.snapshot)

    def release(self) -> None:
        """Give everything back."""
        self.opener.cancel()
        self._questions.close()
        self._put_away()

    def _put_away(self) -> None:
        """Give back what the open rig needs."""
        if self.job is not None:
            self.job.cancel()
            self.job = None
        self._given_up = ()
        if self.portraits is not None:
            self.portraits.release()
        if self.stage is not None:
            self.stage.release()

    def _show(self, rig: Rig, opening: Opening) -> None:
        """Put an opened rig on the desk.

        Raises
        ------
        FacepinError, moderngl.Error
            When that is impossible; what was open stays so.
        """
        choices = [pane.choice for pane in self.session.panes] if self.session else self._choices
        begun = opening.begin(rig, choices)
        stage = Stage(self._ctx, begun.session)
        before = self.session
        try:
            left = self.keeper.let_go(before, self.snapshot) if before else None
        except FacepinError:
            stage.release()
            raise
        self._put_away()
        self.stage, self.tool, self._open = stage, DragTool(), opening
        self.library = library_of(begun.session, self._settings, own=not opening.source.asset)
        self.portraits = Portraits(self._ctx, stage)
        file = leftover = None
        moved, digest = False, ""
        if isinstance(opening, SceneOpening):
            file, leftover, moved = opening.file, opening.leftover, opening.lost is not None or opening.turned
            digest = opening.scene.digest
        self.keeper.begin(begun.session, file, leftover, saved=not moved, digest=digest)
        self._look_at(begun, stage)
        if leftover is None and (file or not opening.source.asset):
            self.opened = file or opening.source.path
        if begun.complaint:
            self.say(f"{file.name}: {begun.complaint}" if file else begun.complaint, error=True)
        elif left is not None and before is not None:
            self.say(f"The unsaved work on {before.rig.name} is kept: see File, {Command.UNSAVED_WORK.title}")
        elif leftover is not None:
            self.say(f"The unsaved work on {rig.name} is back, as it was at {leftover.time:%H:%M}")
        elif rig.warnings:
            more = f" (and {len(rig.warnings) - 1} more)" if len(rig.warnings) > 1 else ""
            self.say(f"Opened with a warning: {rig.warnings[0]}{more}")
        elif before is not None:  # what was wrong with the start stays to be read
            self.say("")

    def _look_at(self, begun: Begun, stage: Stage) -> None:
        """Give each pane the camera that it comes with, or one that frames the face."""
        session = begun.session
        head = session.rig.head
        width, height, _ = np.ptp(session.rig.neutral[head], axis=0).tolist()
        camera = Camera(radius=0.0, least_aspect=min(1.15 * width / max(height, 1e-9), 2.0))
        framed = frame_points(stage.positions(session.active)[head], self.viewport.aspect, camera)
        self.cameras = [own or framed for own in begun.cameras]
        self.view.panes, self.view.hidden_parts = list(begun.views), frozenset()
        if begun.linked is not None:
            self.view.linked = begun.linked
        self.view.reference_shown = begun.reference_shown
        self._numbers, self._looks = [pane.number for pane in session.panes], {}

    def turn(self, turn: Turn) -> None:
        """Turn the face, with all the work on it, and remember that; undo begins anew.

        Raises
        ------
        FacepinError
            When that is impossible, or can't be kept.
        """
        snapshot, opening = self.snapshot(), self._open
        assert opening is not None, "there is something to turn"
        scene = turned_scene(snapshot, turn)
        file = opening.file if isinstance(opening, SceneOpening) else self.keeper.file
        self._show(snapshot.rig.turned(turn), SceneOpening(scene, file, opening.source, turned=True))
        self.say("The face is turned, and will be when it is opened again")
        write_turn(self._settings, opening.source.path, scene.rig.turn)

    def ask(
        self,
        kind: Kind,
        command: Command,
        start: Path,
        filters: tuple[str, ...],
        then: Callable[[Path], None],
    ) -> None:
        """Ask the user for a path; `then` is called with the answer, some frames later.

        Parameters
        ----------
        kind : str
            What may be chosen.
        command : Command
            What it is for.
        start : Path
            Folder to begin in, or the suggested file when saving.
        filters : tuple of str
            Pairs of a name and patterns.
        then : callable
            Not called when the user gives up.

        Raises
        ------
        FacepinError
            When another question is still open.
        """
        self._questions.ask(kind, command, start, filters, then, self.session)

    def sync(self) -> None:
        """Let what depends on the work follow it: selected pins, the library's files, the panes' looks.

        No pin is selected that is gone.  A pane keeps its camera and view when others are closed, and finds
        them after undo.
        """
        if self.session is not None:
            self.tool.forget_gone(self.session.pose.pins)
        if self.library is not None:
            with self.reporting("The library of poses"):
                self.library.follow()
        numbers = [pane.number for pane in self.session.panes] if self.session else [0]
        if numbers == self._numbers:
            return
        self._looks |= zip(self._numbers, zip(self.cameras, self.view.panes, strict=True), strict=True)
        camera = self.cameras[-1]
        looks = [self._looks.get(number, (camera, PaneView())) for number in numbers]
        self.cameras = [camera if self.view.linked else own for own, _ in looks]
        self.view.panes = [view for _, view in looks]
        self._numbers = numbers
        if self.stage is not None:
            self.stage.update()  # panels may ask where a new pane's vertices are before it is drawn

    def reporting(self, where: str) -> Within:
        """Show what goes wrong inside a `with` block in the status line; `where` says what it is about."""
        return self.faults.within(where)
