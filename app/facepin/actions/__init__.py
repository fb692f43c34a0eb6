"""What menus, keys and panels can ask for, carried out: one module per topic.

Each has `act(request, desk)`, which does what was asked and says whether it was its business.
"""

from collections.abc import Callable

from facepin.actions import (
    comparing,
    copying,
    files,
    helping,
    keeping,
    landmarks,
    library,
    mirroring,
    pinning,
    posing,
    series,
    viewing,
)
from facepin.desk.desk import Desk
from facepin.panels.commands import Command
from facepin.panels.requests import Request

TOPICS: tuple[Callable[[Request, Desk], bool], ...] = (
    keeping.act,
    landmarks.act,
    files.act,
    posing.act,
    copying.act,
    pinning.act,
    mirroring.act,
    comparing.act,
    viewing.act,
    helping.act,
    library.act,
    series.act,
)


def carry_out(request: Request, desk: Desk) -> None:
    """Do what was asked; what can't be done is said in the status line."""
    with desk.reporting(request.title if isinstance(request, Command) else type(request).__name__):
        # What an earlier request of the same frame changed.
        desk.sync()
        if isinstance(request, Command) and desk.session is not None and desk.view.weights.rests:
            desk.session.settle()  # undo takes back what keys or the wheel did, as a step that can be redone
        if desk.stage is not None:
            desk.stage.update()
        if not any(act(request, desk) for act in TOPICS) and desk.stage is not None:
            raise AssertionError(f"nothing carries out {request}")
