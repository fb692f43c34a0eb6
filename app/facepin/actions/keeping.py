"""Scenes and unsaved work: saving, taking up again, leaving."""

from pathlib import Path

from facepin.actions.files import FACES
from facepin.core.errors import FacepinError
from facepin.desk.desk import Desk
from facepin.desk.keeping import ChangedElsewhere
from facepin.desk.opening import Lost
from facepin.desk.papers import free_name
from facepin.files.work.drafts import Leftover
from facepin.files.work.scene_file import SUFFIX
from facepin.panels.commands import Command
from facepin.panels.requests import DiscardWork, OpenPath, Request, RestoreWork

SCENES = ("Scenes", f"*{SUFFIX}")


def act(request: Request, desk: Desk) -> bool:
    """Carry out what concerns scenes and unsaved work."""
    lost = desk.opener.lost
    match request:
        case OpenPath(path) if lost is not None and path.suffix.lower() not in (SUFFIX, ".json", ".csv"):
            desk.opener.locate(path)
        case Command.LOCATE_RIG if lost is not None:
            was = lost.scene.rig.path
            if was is None or was.suffix:
                desk.ask("open file", request, _rig_folder(lost), FACES, desk.opener.locate)
            else:
                desk.ask("open folder", request, _rig_folder(lost), (), desk.opener.locate)
        case Command.LOCATE_RIG:
            desk.say("No scene waits for its rig")
        case Command.SAVE if desk.session is not None and desk.keeper.file is not None:
            _save_again(desk, desk.keeper.file)
        case Command.SAVE | Command.SAVE_AS if desk.session is not None:
            suggested = desk.keeper.file or desk.folder / f"{desk.session.rig.name}{SUFFIX}"
            desk.ask("save file", request, suggested, SCENES, lambda path: _save_as(desk, path))
        case Command.UNSAVED_WORK:
            desk.view.recovery.shown = not desk.view.recovery.shown
            desk.say("" if desk.keeper.left else "There is no unsaved work but what is open")
        case RestoreWork(draft):
            leftover = desk.keeper.take_up(_leftover(desk, draft))
            desk.opener.open_scene(leftover.scene, leftover.scene.of, leftover)
        case DiscardWork(draft):
            leftover = _leftover(desk, draft)
            desk.keeper.discard(leftover)
            desk.say(
                f"Discarded the unsaved work on {leftover.scene.rig.name} of {leftover.time:%d %b %H:%M}"
            )
        case Command.QUIT:
            doubt = desk.keeper.may_close(desk.session, desk.snapshot)
            desk.closing = not doubt
            if doubt:
                desk.say(doubt, error=True)
        case _:
            return False
    return True


def _save_again(desk: Desk, path: Path) -> None:
    """Save to the scene's own file; ask for another name where somebody else has saved there meanwhile."""
    try:
        _save(desk, path, replace=False)
    except ChangedElsewhere as error:
        mine = free_name(path.parent, path.stem, SUFFIX)
        desk.ask("save file", Command.SAVE_AS, mine, SCENES, lambda answer: _save_as(desk, answer))
        desk.say(f"{error}: choose another name, or {path.name} to replace what is there", error=True)


def _save_as(desk: Desk, path: Path) -> None:
    """Save under a name that the user gave, which may lack its suffix."""
    if not path.suffix:
        path = path.with_suffix(SUFFIX)
        if path.exists():  # a dialog of the system has asked about the other name only
            raise FacepinError(f"{path.name} exists; to replace it, give its full name")
    _save(desk, path)


def _save(desk: Desk, path: Path, *, replace: bool = True) -> None:
    if desk.session is None:
        return
    path = path.absolute()
    desk.session.settle()  # a slider may be on its way by wheel or key
    desk.keeper.save(desk.session, path, desk.snapshot(), replace=replace)
    desk.opened = path
    desk.say(f"Saved {path}")


def _rig_folder(lost: Lost) -> Path:
    """Return where a lost rig is looked for first."""
    near = [path.parent for path in (lost.file, *lost.looked) if path is not None]
    return next((folder.absolute() for folder in near if folder.is_dir()), Path.home())


def _leftover(desk: Desk, draft: Path) -> Leftover:
    for leftover in desk.keeper.left:
        if leftover.draft.path == draft:
            return leftover
    raise FacepinError(f"{draft}: this work was taken up or discarded already")
