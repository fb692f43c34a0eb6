"""Series of pictures made beside the work: every pose of the library, the steps of the work, a turntable."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import pi
from pathlib import Path

from facepin.core.errors import FacepinError
from facepin.core.look.face_view import face_camera
from facepin.core.pose import Pose
from facepin.core.saved_pose import SavedPose
from facepin.desk.desk import Desk
from facepin.desk.papers import free_name
from facepin.desk.stage import Stage
from facepin.files.animation import Animation
from facepin.files.safely.atomic import atomic_write
from facepin.gpu.picture import Image, png_bytes
from facepin.panels.commands import Command
from facepin.panels.requests import CancelJob, Request
from facepin.session.filmstrip import Still
from facepin.session.job import Job, Steps, beside
from facepin.sheets import Pane, contact_columns, write_sheet

CONTACT = (320, 360)
"""Width and height of the pictures of a contact sheet."""
MOST_PIXELS = 48_000_000
"""Of a filmstrip: with more, its pictures are drawn smaller."""
TURN = 36
"""Pictures of a turntable."""
TURN_HEIGHT = 480
TURN_SECONDS = 0.06
"""Largest height of its pictures, and how long each is shown."""


def act(request: Request, desk: Desk) -> bool:
    """Carry out what makes many pictures."""
    stage, library = desk.stage, desk.library
    if stage is None or library is None:
        return False
    match request:
        case CancelJob():
            if desk.job is not None:
                desk.job.cancel()
                desk.say(f"Given up: {desk.job.title}")
                desk.job = None
        case Command.FILMSTRIP:
            desk.view.filmstrip = not desk.view.filmstrip
        case Command.SAVE_FILMSTRIP:
            stills = desk.filmstrip.stills(stage.session)
            desk.start(Job("Drawing the filmstrip", _filmstrip(desk, stage, stills)))
        case Command.TURNTABLE:
            desk.start(Job("Drawing the turntable", _turntable(desk, stage)))
        case Command.CONTACT_SHEET | Command.POSE_PICTURES:
            library.read_all()
            if not library.poses:
                raise FacepinError("the library has no poses yet: save one first (Ctrl+B)")
            if request is Command.CONTACT_SHEET:
                desk.start(Job("Drawing the contact sheet", _contact_sheet(desk, stage, library.poses)))
            else:
                desk.start(Job("Drawing every pose", _pose_pictures(desk, stage, library.poses)))
        case _:
            return False
    return True


def _contact_sheet(desk: Desk, stage: Stage, poses: Sequence[SavedPose]) -> Steps:
    """One image with all poses and their names, seen from the front."""
    rig = stage.session.rig
    camera = face_camera(rig, CONTACT)
    panes = []
    for number, pose in enumerate(poses):
        yield number / (len(poses) + 1)
        image = stage.portrait(Pose(pose.weights), camera, CONTACT)
        panes.append(Pane(image, pose.title, ", ".join(pose.tags)))
    path = free_name(desk.pictures, f"{rig.name}-poses", ".png")
    footer = f"{rig.name}: {len(poses)} poses"
    columns = contact_columns(len(panes))
    yield from beside(lambda: write_sheet(path, panes, footer, columns), len(poses) / (len(poses) + 1))
    return f"Saved {path}"


def _pose_pictures(desk: Desk, stage: Stage, poses: Sequence[SavedPose]) -> Steps:
    """A folder with a picture of each pose, seen as the face is seen now."""
    folder = free_name(desk.pictures, f"{stage.session.rig.name}-poses", "")
    folder.mkdir(parents=True)
    camera, size = desk.camera, _size(desk)
    for number, pose in enumerate(poses):
        image = stage.portrait(Pose(pose.weights), camera, size)
        yield from beside(_writing(folder / f"{pose.key}.png", image), number / len(poses))
    return f"Saved {len(poses)} pictures in {folder}"


def _filmstrip(desk: Desk, stage: Stage, stills: Sequence[Still]) -> Steps:
    """One image with every step as the viewport shows it: same camera, same pixels, with its pins."""
    session = stage.session
    camera, (width, height), scale = desk.camera, _size(desk), desk.pixel_scale
    over = replace(desk.view.panes[session.active])
    shrink = min((MOST_PIXELS / (width * height * len(stills))) ** 0.5, 1.0)
    size = (max(round(shrink * width), 1), max(round(shrink * height), 1))
    panes = []
    for number, still in enumerate(stills):
        yield number / (len(stills) + 1)
        image = stage.portrait(still.pose, camera, size, over, pins=True, scale=scale * shrink)
        panes.append(Pane(image, still.label if number == 0 else f"{number}  {still.label}"))
    path = free_name(desk.pictures, f"{session.rig.name}-filmstrip", ".png")
    columns = contact_columns(len(panes), size[0] / size[1])
    yield from beside(lambda: write_sheet(path, panes, columns=columns), len(stills) / (len(stills) + 1))
    return f"Saved {path}"


def _turntable(desk: Desk, stage: Stage) -> Steps:
    """A folder with pictures from all round, and the same as an animated one."""
    session = stage.session
    folder = free_name(desk.pictures, f"{session.rig.name}-turntable", "")
    folder.mkdir(parents=True)
    width, height = _size(desk)
    shrink = min(TURN_HEIGHT / height, 1.0)
    size = (max(round(shrink * width), 1), max(round(shrink * height), 1))
    camera, pose = desk.camera, session.pose.with_weights(session.control.heard(session.pose.weights))
    animation = Animation()
    for number in range(TURN):
        turned = camera.orbited(2 * pi * number / TURN, 0.0)
        image = stage.portrait(pose, turned, size, scale=desk.pixel_scale * shrink)
        yield from beside(_writing(folder / f"{number:03}.png", image, animation), 0.8 * number / TURN)
    path = folder / "turntable.png"
    yield from beside(lambda: animation.write(path, TURN_SECONDS), 0.85)
    return f"Saved {folder}"


def _writing(path: Path, image: Image, animation: Animation | None = None) -> Callable[[], None]:
    """Write one picture of many; take it for an animated one too, if there is one."""

    def write() -> None:
        atomic_write(path, png_bytes(image))
        if animation is not None:
            animation.add(image)

    return write


def _size(desk: Desk) -> tuple[int, int]:
    """Return the size of a pane in pixels."""
    return max(round(desk.viewport.width), 1), max(round(desk.viewport.height), 1)
