"""Left and right."""

from facepin.core.names import listed
from facepin.core.shapes.mirror import Mirror
from facepin.desk.desk import Desk
from facepin.panels.commands import Command
from facepin.panels.requests import PairShapes, Request
from facepin.session.edit import Edit
from facepin.session.hand.mirroring import Way, flipped_pose, mirrored_weights
from facepin.session.session import Session


def act(request: Request, desk: Desk) -> bool:
    """Carry out what concerns left and right."""
    session = desk.session
    if session is None:
        return False
    match request:
        case Command.SYMMETRY:
            desk.view.symmetric = not desk.view.symmetric
            desk.say(_about(session.mirror) if desk.view.symmetric else "Symmetry is off")
        case Command.FLIP_POSE:
            flipped = flipped_pose(session.mirror, session.pose)
            _put(desk, session, Edit(request.title, True, flipped.pins, weights=flipped.weights))
        case Command.MIRROR_LEFT | Command.MIRROR_RIGHT:
            way: Way = "left to right" if request is Command.MIRROR_LEFT else "right to left"
            weights = mirrored_weights(session.mirror, session.pose.weights, way)
            _put(desk, session, Edit(request.title, True, weights=weights))
        case PairShapes(shape, None):
            session.set_mirror("Part twins", session.mirror.parted(shape))
        case PairShapes(shape, int(twin)):
            session.set_mirror("Pair shapes", session.mirror.paired(shape, twin))
        case _:
            return False
    return True


def _put(desk: Desk, session: Session, edit: Edit) -> None:
    desk.apply(edit)
    if not session.message:
        desk.say(f"{edit.label}: done{_left_out(session)}")


def _left_out(session: Session) -> str:
    """Say which active shapes have no twin, hence stayed."""
    lonely = [
        name
        for name, twin, weight in zip(
            session.rig.shape_names, session.mirror.shapes, session.pose.weights, strict=True
        )
        if twin < 0 and weight
    ]
    return f"; without a twin, so left alone: {listed(lonely)}" if lonely else ""


def _about(mirror: Mirror) -> str:
    """Say how well left and right are known."""
    if not (mirror.vertices >= 0).any():
        return "Symmetry is on, but no point of this face has a twin on the other side"
    lonely = int((mirror.shapes < 0).sum())
    shapes = f"; {lonely} shape{'s have' if lonely != 1 else ' has'} no twin" if lonely else ""
    remarks = f" ({mirror.remarks[0]})" if mirror.remarks else ""
    return f"Symmetry is on: pins and sliders move both sides{shapes}{remarks}"
