"""The pose library: what its panel and its menu ask for."""

from dataclasses import replace
from pathlib import Path

from facepin.core.errors import FacepinError
from facepin.core.names import clean_name
from facepin.core.saved_pose import SavedPose
from facepin.core.shapes.measures import out_of_range
from facepin.desk.desk import Desk
from facepin.desk.library import Library
from facepin.files.work.pose_library import replaced
from facepin.panels.commands import Command
from facepin.panels.library.requests import (
    ApplyPose,
    ComparePoses,
    LabelPose,
    MovePose,
    RemovePoses,
    ReplacePose,
    SavePose,
    StopBlending,
)
from facepin.panels.requests import Request
from facepin.session.edit import Edit
from facepin.session.session import Session
from facepin.session.shelf import Shelf, moved


def act(request: Request, desk: Desk) -> bool:
    """Carry out what concerns the library."""
    session, library = desk.session, desk.library
    if session is None or library is None:
        return False
    match request:
        case Command.SAVE_TO_LIBRARY if library.folder is None:
            raise FacepinError(library.remark)
        case Command.SAVE_TO_LIBRARY:
            desk.view.library.begin_saving(f"Pose {len(library.poses) + 1}")
            desk.view.library_opens = True
        case SavePose(title, tags):
            saved = library.save(session.pose, clean_name(title) or "Pose", tags)
            desk.say(f"Saved {saved.title} in {library.folder}")
        case ApplyPose(key, add):
            _apply(desk, session, library.pose(key), add=add)
        case StopBlending():
            session.cancel()
        case LabelPose(key, title, tags):
            pose = library.pose(key)
            named = replace(pose, title=clean_name(title) or pose.title, tags=tags)
            word = f"Rename {pose.title}" if named.title != pose.title else f"Tag {pose.title}"
            if (named.title, named.tags) != (pose.title, pose.tags):
                _arrange(desk, session, library, word, {key: named})
        case MovePose(key, before):
            title = library.pose(key).title
            if changes := moved(library.poses, key, before):
                _arrange(desk, session, library, f"Move {title}", changes)
        case ReplacePose(key):
            pose = library.pose(key)
            new = replaced(pose, session.rig, session.pose)
            _arrange(desk, session, library, f"Replace {pose.title}", {key: new})
        case RemovePoses(keys):
            titles = [library.pose(key).title for key in keys]
            what = titles[0] if len(titles) == 1 else f"{len(titles)} poses"
            _arrange(desk, session, library, f"Remove {what}", dict.fromkeys(keys))
            desk.say(f"Removed {what} from the library; undo brings it back")
        case ComparePoses(first, second):
            _compare(desk, session, library.pose(first), library.pose(second))
        case Command.TAKE_POSES:
            desk.ask("open folder", request, desk.folder, (), lambda folder: _take_from(desk, folder))
        case _:
            return False
    return True


def _apply(desk: Desk, session: Session, pose: SavedPose, *, add: bool) -> None:
    """Put a pose on the face, or add it; say what of it this rig lacks, and what goes beyond its limits."""
    weights = session.pose.weights + pose.weights if add else pose.weights
    limits = session.control.limits
    beyond = out_of_range(weights, limits) - out_of_range(session.pose.weights, limits)
    desk.apply(Edit(f"{'Add' if add else 'Apply'} {pose.title}", True, weights=weights))
    remarks = [line for line in (session.message, pose.report) if line]
    if add and beyond > 0:
        remarks.append(f"{beyond} weight{' is' if beyond == 1 else 's are'} beyond the limits now")
    line = f"{pose.title}: {'; '.join(remarks)}" if remarks else ""
    desk.say(line, error=bool(session.message))


def _arrange(desk: Desk, session: Session, library: Library, label: str, changes: Shelf) -> None:
    """Change poses of the library and their files; the pose on the face is as saved or unsaved as before."""
    was_saved = desk.keeper.is_saved(session)
    desk.say("")
    session.arrange(label, changes)
    if was_saved:
        desk.keeper.take_for_saved(session)
    library.follow()


def _compare(desk: Desk, session: Session, first: SavedPose, second: SavedPose) -> None:
    """Show one pose on the face with another one as the reference, its ghost shining through."""
    session.compare(f"Compare {first.title} and {second.title}", second.weights, first.weights)
    desk.view.panes[session.active].ghost = "reference"
    locks = f"; {session.message}" if session.message else ""
    desk.say(f"{second.title} on the face; {first.title} is the reference and shines through{locks}")


def _take_from(desk: Desk, folder: Path) -> None:
    """Copy the poses of another rig's library, and say what of them does not match."""
    if desk.library is None:
        return
    added, complaints = desk.library.take_from(folder)
    if not added:
        raise FacepinError(f"{folder}: there are no poses in this folder")
    reports = [f"{pose.title}: {pose.report}" for pose in added if pose.report]
    line = f"Added {len(added)} poses from {folder.name}"
    if reports:
        line += f"; {len(reports)} of them do not match this rig in all: {reports[0]}"
    if complaints:
        line += f"; {len(complaints)} files are no poses: {complaints[0]}"
    desk.view.library_opens = True
    desk.say(line)
