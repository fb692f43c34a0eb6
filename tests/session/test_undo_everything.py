"""Whatever is asked for, in whatever order: undo leads back to the very start, redo to the very end."""

import dataclasses
from collections.abc import Callable
from pathlib import Path
from typing import get_args

import numpy as np
import pytest

from facepin.actions import carry_out, copying
from facepin.core.arrays import Points
from facepin.core.control import ShapeControl
from facepin.core.look.shading import MODES
from facepin.core.pose import Pin, as_vector
from facepin.core.shapes.places import find_places
from facepin.desk.desk import Desk
from facepin.desk.library import Library
from facepin.files.work.pose_file import write_pose
from facepin.panels import requests
from facepin.panels.commands import FACE_TURNS, PICTURES, Command
from facepin.panels.library import requests as shelf
from facepin.panels.requests import Request
from facepin.panels.view import View
from facepin.session.edit import Edit
from facepin.session.session import Session
from facepin.session.solving.solving import choose
from facepin.session.work import Work
from facepin.solvers import SOLVERS
from support.small_rigs import sheet

RIG = sheet()
SEQUENCES, LENGTH = 300, 25

ASK_FOR_A_FILE = {
    Command.OPEN_FILE,
    Command.OPEN_FOLDER,
    Command.LOAD_POSE,
    Command.LOAD_LANDMARKS,
    Command.SAVE_LANDMARKS,
    Command.SAVE,
    Command.SAVE_AS,
    Command.SAVE_POSE,
    Command.EXPORT,
    Command.TAKE_POSES,
    Command.REFERENCE_FROM_FILE,
}
NOT_HERE = {
    *PICTURES,  # draw
    *FACE_TURNS,  # begin anew
    Command.SAVE_CHART,
    Command.CONTACT_SHEET,
    Command.POSE_PICTURES,
    Command.TURNTABLE,
    Command.SAVE_FILMSTRIP,
    Command.QUIT,
}


class BareStage:
    """A stage without graphics."""

    refined = True

    def __init__(self, session: Session) -> None:
        self.session = session

    places = find_places(RIG)

    def update(self) -> bool:
        return False

    def positions(self, pane: int) -> Points:
        return RIG.evaluate(self.session.panes[pane].pose.weights)


class Clipboard:
    """Stands in for that of the system, which needs a window."""

    def __init__(self) -> None:
        self._text = ""

    def set_clipboard_text(self, text: str) -> None:
        self._text = text

    def get_clipboard_text(self) -> str:
        return self._text


@pytest.fixture
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Desk:
    monkeypatch.setattr(copying, "imgui", Clipboard())
    """A desk with the sheet on it, without a window."""
    desk = Desk(None, View(), [], native_dialogs=False, pictures=Path(), drafts=None, chart_writer=None)
    desk.stage = BareStage(Session(RIG, [choose("transpose")]))
    desk.library = Library(desk.stage.session, tmp_path / "poses", "")
    return desk


def random_pins(random: np.random.Generator) -> tuple[Pin, ...]:
    vertices = random.choice(RIG.vertex_count, random.integers(0, 5), replace=False).tolist()
    freedoms = random.choice(["space", "screen"], len(vertices)).tolist()
    goals = RIG.neutral[vertices] + random.uniform(-0.3, 0.3, (len(vertices), 3))
    return tuple(
        Pin(vertex, as_vector(goal), freedom)
        for vertex, goal, freedom in zip(vertices, goals, freedoms, strict=True)
    )


def some_pins(random: np.random.Generator, session: Session) -> frozenset[int]:
    """Vertices of some of the pins."""
    return frozenset(pin.vertex for pin in session.pose.pins if random.integers(2))


def random_choice(random: np.random.Generator) -> object:
    return choose(str(random.choice(list(SOLVERS))), keep_limits=bool(random.integers(2)))


POSES = ("smile", "frown", "gone")
"""Keys of poses in the library, and one that is not there."""


def key(random: np.random.Generator) -> str:
    return POSES[random.integers(len(POSES))]


Maker = Callable[[np.random.Generator, Session], Request]

MAKERS: dict[type, Maker] = {
    requests.UseSolver: lambda random, session: requests.UseSolver(
        int(random.integers(len(session.panes))), random_choice(random), final=bool(random.integers(2))
    ),
    requests.AddPane: lambda random, _: requests.AddPane(random_choice(random)),
    requests.ClosePane: lambda random, session: requests.ClosePane(int(random.integers(len(session.panes)))),
    requests.KeepPane: lambda random, session: requests.KeepPane(int(random.integers(len(session.panes)))),
    requests.RandomReference: lambda random, _: requests.RandomReference(int(random.integers(1, 4))),
    requests.SetPins: lambda random, session: requests.SetPins(
        some_pins(random, session),
        freedom=[None, "space", "screen"][random.integers(3)],
        stiffness=[None, float(random.uniform(0.1, 10))][random.integers(2)],
        locked=[None, True, False][random.integers(3)],
        hidden=[None, True, False][random.integers(3)],
        final=bool(random.integers(2)),
    ),
    requests.NamePin: lambda random, session: requests.NamePin(
        max(some_pins(random, session), default=0), str(random.choice(["", "chin", "lip"]))
    ),
    requests.RemovePins: lambda random, session: requests.RemovePins(some_pins(random, session)),
    requests.SelectPins: lambda random, session: requests.SelectPins(some_pins(random, session)),
    requests.PairShapes: lambda random, _: requests.PairShapes(
        int(random.integers(RIG.shape_count)), [None, *range(RIG.shape_count)][random.integers(5)]
    ),
    shelf.SavePose: lambda random, _: shelf.SavePose("Another", ("new",)),
    shelf.ApplyPose: lambda random, _: shelf.ApplyPose(key(random), bool(random.integers(2))),
    shelf.LabelPose: lambda random, _: shelf.LabelPose(key(random), f"Pose {random.integers(3)}", ()),
    shelf.MovePose: lambda random, _: shelf.MovePose(key(random), random.choice([None, *POSES])),
    shelf.ReplacePose: lambda random, _: shelf.ReplacePose(key(random)),
    shelf.RemovePoses: lambda random, _: shelf.RemovePoses((key(random),)),
    shelf.ComparePoses: lambda random, _: shelf.ComparePoses(key(random), key(random)),
    shelf.StopBlending: lambda *_: shelf.StopBlending(),
    requests.SetControl: lambda random, session: requests.SetControl(
        "Control", random_control(random, session)
    ),
    requests.Tidy: lambda random, _: requests.Tidy(float(random.uniform(0.1, 5))),
    requests.TakeTidy: lambda *_: requests.TakeTidy(),
    requests.LeaveTidy: lambda *_: requests.LeaveTidy(),
    requests.CancelEdit: lambda *_: requests.CancelEdit(),
    requests.ShadeAs: lambda random, _: requests.ShadeAs(list(MODES)[random.integers(len(MODES))]),
    requests.CopyShapes: lambda random, _: requests.CopyShapes("all", tuple(range(random.integers(1, 5)))),
    requests.PasteShapes: lambda random, _: requests.PasteShapes("all", tuple(range(random.integers(1, 5)))),
    requests.GoToStep: lambda random, session: requests.GoToStep(int(random.integers(-1, session.step + 2))),
}
"""How a request with something to say is made up."""

ELSEWHERE = {
    requests.ShowParts,  # what is drawn
    requests.OpenPath,
    requests.CancelLoading,
    requests.RestoreWork,
    requests.DiscardWork,
    requests.Choose,
    requests.CancelJob,
    requests.UseNeutral,
    requests.Refused,
}
"""Requests about files and settings, which leave the session alone or begin another.  (A pose that is opened
is an edit.)
"""


def test_every_request_is_tried_here() -> None:
    assert set(get_args(Request)) == {Command, *MAKERS, *ELSEWHERE}


def random_control(random: np.random.Generator, session: Session) -> ShapeControl:
    control = session.control
    locked, muted, solo = (random.integers(0, 4, RIG.shape_count) == 0 for _ in range(3))
    limits = control.limits + random.uniform(-0.1, 0.1, (RIG.shape_count, 1))
    return dataclasses.replace(control, limits=limits, locked=locked, muted=muted, solo=solo)


def random_edit(random: np.random.Generator, session: Session) -> None:
    """What hands and sliders do: a gesture of some steps, which ends, is given up, or goes on."""
    if random.integers(5) == 0:
        session.set_control("Control", random_control(random, session))
        return
    for final in (*[False] * random.integers(0, 3), bool(random.integers(4))):
        match random.integers(4):
            case 0:
                session.apply(Edit("Set", final, weights=random.uniform(-0.5, 1.5, RIG.shape_count)))
            case 1:
                session.apply(Edit("Place", final, random_pins(random)))
            case 2:
                session.apply(
                    Edit("Load", final, random_pins(random), weights=random.random(RIG.shape_count))
                )
            case _:
                session.apply(Edit("Drag", final, random_pins(random), solve=True))
    if random.integers(4) == 0:
        session.cancel()


def titles(library: Library) -> list[tuple[str, str]]:
    """What the library holds, in order; poses that were saved meanwhile are no part of what is undone."""
    return [(pose.key, pose.title) for pose in library.poses if pose.key in POSES]


def state(work: Work) -> tuple[Work, list[object]]:
    """The work, and everything in it by value: nothing may change behind a snapshot either."""
    control = work.control
    values: list[object] = [None if work.reference is None else work.reference.tobytes()]
    values += [flags.tobytes() for flags in (control.limits, control.locked, control.muted, control.solo)]
    values.append(None if work.mirror is None else work.mirror.shapes.tobytes())
    values.append(dict(work.shelf))
    for pane in work.panes:
        began = None if pane.began is None else (pane.began.weights.tobytes(), pane.began.pins)
        values += [pane.choice, pane.pose.weights.tobytes(), pane.pose.pins, pane.hand.tobytes(), began]
    return work, values


@pytest.mark.parametrize("part", range(6))
def test_undo_leads_to_the_start_and_redo_to_the_end(desk: Desk, tmp_path: Path, part: int) -> None:
    session = desk.session
    assert session is not None
    commands = [command for command in Command if command not in ASK_FOR_A_FILE | NOT_HERE]
    pose = tmp_path / "pose.json"
    write_pose(pose, RIG, dataclasses.replace(session.pose, weights=np.array([0.1, 0.9, 0.3, 0.5])))
    poses = tmp_path / "poses"
    for title in POSES[:2]:
        desk.library.save(session.pose, title, ())
    makers = [*MAKERS.values(), lambda *_: requests.OpenPath(pose)]
    steps = 0
    for seed in range(part, SEQUENCES, 6):
        random = np.random.default_rng(seed)
        desk.stage = BareStage(session := Session(RIG, [random_choice(random)]))
        library = desk.library = Library(session, poses, "")
        library.read_all()
        seen, at_first = [state(session.committed)], titles(library)
        for _ in range(random.integers(1, LENGTH)):
            match random.integers(3):
                case 0:
                    random_edit(random, session)
                case 1:
                    carry_out(commands[random.integers(len(commands))], desk)
                case _:
                    carry_out(makers[random.integers(len(makers))](random, session), desk)
            # A gesture in progress may have become a step before that of the request.
            steps_now = [step.value for step in session.steps[: session.step + 1]]
            known = sum(old[0] is new for old, new in zip(seen, steps_now, strict=False))
            if known < len(steps_now):
                seen[known:] = [state(work) for work in steps_now[known:]]
        session.cancel()
        steps += len(session.steps) - 1
        while session.step > 0:
            assert session.undo()
            assert state(session.committed) == seen[session.step]
        assert not session.undo()
        assert titles(library) == at_first
        assert session.committed is seen[0][0]
        while session.redo():
            assert state(session.committed) == seen[session.step]
        assert session.committed is seen[-1][0]
        session.go_to(0)
        desk.sync()
        assert {path.stem for path in poses.glob("*.json")} >= {key for key, _ in at_first}
    assert steps > 2 * SEQUENCES / 6


@pytest.mark.parametrize("command", sorted(ASK_FOR_A_FILE, key=lambda command: command.name))
def test_what_asks_for_a_file_changes_nothing_by_asking(desk: Desk, command: Command) -> None:
    before = state(desk.session.committed)
    carry_out(command, desk)
    assert desk.dialog is not None
    assert state(desk.session.committed) == before
    assert desk.session.step == 0
