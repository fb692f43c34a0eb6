"""Solvers side by side, and what they are measured against."""

from pathlib import Path

import numpy as np

from facepin.actions.files import POSES
from facepin.core.errors import FacepinError
from facepin.desk.desk import Desk
from facepin.desk.papers import free_name
from facepin.files.work.pose_file import read_pose
from facepin.panels.commands import Command
from facepin.panels.requests import (
    AddPane,
    ClosePane,
    KeepPane,
    RandomReference,
    Request,
    UseSolver,
)
from facepin.session.reference import random_reference
from facepin.session.session import Session


def act(request: Request, desk: Desk) -> bool:
    """Carry out what concerns panes, solvers and the reference."""
    session = desk.session
    if session is None:
        return False
    match request:
        case UseSolver(pane, choice, final):
            if (before := session.panes[pane].choice).kind is not choice.kind:
                desk.view.panes[pane].used[before.kind.key] = before
            session.choose_solver(pane, choice, final=final)
        case AddPane(choice):
            session.add_pane(choice)
        case ClosePane(pane):
            session.close_pane(pane)
        case KeepPane(pane):
            session.keep_pane(pane)
        case Command.REFERENCE_FROM_POSE:
            session.set_reference(session.pose.weights)
        case RandomReference(shapes):
            session.set_reference(random_reference(session.rig, shapes, np.random.default_rng()))
        case Command.FORGET_REFERENCE:
            session.set_reference(None)
        case Command.REFERENCE_FROM_FILE:
            desk.ask("open file", request, desk.folder, POSES, lambda path: _read_reference(desk, path))
        case Command.SAVE_CHART:
            _save_chart(desk, session)
            return True
        case _:
            return False
    desk.say(session.message, error=bool(session.message))
    return True


def _read_reference(desk: Desk, path: Path) -> None:
    if desk.session is not None:
        loaded, report = read_pose(path, desk.session.rig)
        desk.session.set_reference(loaded.weights)
        desk.say(f"{path.name}: {report}" if report else f"{path.name} is the reference")


def _save_chart(desk: Desk, session: Session) -> None:
    """Write the charts of all panes: pictures, drawings and a table."""
    if desk.chart_writer is None:
        raise FacepinError("charts cannot be written here")
    folder = free_name(desk.pictures, f"{session.rig.name}-chart", "")
    desk.chart_writer(session, folder)
    desk.say(f"Saved {folder}")
