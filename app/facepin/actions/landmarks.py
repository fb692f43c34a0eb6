"""Landmarks: the names of pins kept beside the rig, and pins put back on them."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from facepin.core.pose import Pin, as_vector
from facepin.desk.desk import Desk
from facepin.files.work.landmarks_file import SUFFIX, read_landmarks, write_landmarks
from facepin.panels.commands import Command
from facepin.panels.requests import OpenPath, Request
from facepin.session.edit import Edit

LANDMARKS = ("Landmarks", f"*{SUFFIX} *.json")


def act(request: Request, desk: Desk) -> bool:
    """Carry out what concerns landmarks."""
    session = desk.session
    if session is None:
        return False
    file = desk.folder / f"{session.rig.name}{SUFFIX}"
    match request:
        case OpenPath(path) if path.name.lower().endswith(SUFFIX):
            _load(desk, path)
        case Command.SAVE_LANDMARKS:
            desk.ask("save file", request, file, LANDMARKS, lambda path: _save(desk, path))
        case Command.LOAD_LANDMARKS:
            desk.ask("open file", request, file, LANDMARKS, lambda path: _load(desk, path))
        case _:
            return False
    return True


def _save(desk: Desk, path: Path) -> None:
    if desk.session is not None:
        pins = desk.session.pose.pins
        count = write_landmarks(path, desk.session.rig, pins)
        unnamed = f"; {len(pins) - count} pins without a name are left out" if count < len(pins) else ""
        desk.say(f"Saved {count} landmark{'s' if count > 1 else ''} as {path}{unnamed}")


def _load(desk: Desk, path: Path) -> None:
    """Put a pin on each landmark, where its vertex is now; one that is there takes the name."""
    if desk.session is None or desk.stage is None:
        return
    session, freedom = desk.session, desk.view.freedom
    landmarks = read_landmarks(path, session.rig)
    names = {vertex: name for name, vertex in landmarks.items()}
    # A name belongs to its landmark: whatever else was called so before is not any more.
    pins = tuple(
        replace(pin, name=names.get(pin.vertex, "" if pin.name in landmarks else pin.name))
        for pin in session.pose.pins
    )
    there = {pin.vertex for pin in pins}
    positions = desk.stage.positions(session.active).astype(np.float64)
    right, up, _ = desk.camera.axes
    axes = as_vector(right), as_vector(up)
    new = tuple(
        Pin(vertex, as_vector(positions[vertex]), freedom, axes, name=name)
        for vertex, name in names.items()
        if vertex not in there
    )
    if new or pins != session.pose.pins:
        desk.apply(Edit(f"Load {path.name}", True, (*pins, *new)))
    desk.tool.selected = frozenset(names) - {pin.vertex for pin in pins if pin.hidden}
    there_already = f", {len(names) - len(new)} were pinned already" if len(new) < len(names) else ""
    desk.say(f"{path.name}: {len(names)} landmarks{there_already}")
