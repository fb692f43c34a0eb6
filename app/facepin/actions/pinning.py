"""Pins, other than by dragging them."""

from dataclasses import replace

from facepin.core.pose import Pin
from facepin.desk import Desk
from facepin.panels.requests import Command, Request, SetPin
from facepin.session.edit import Edit
from facepin.session.session import Session


def act(request: Request, desk: Desk) -> bool:
    """Carry out what concerns pins."""
    session = desk.session
    if session is None:
        return False
    pins = session.pose.pins
    match request:
        case SetPin():
            desk.say("")
            _set_pin(desk, session, request)
        case Command.DELETE_PINS:
            desk.say("")
            kept = tuple(pin for pin in pins if pin.vertex not in desk.tool.selected)
            if len(kept) < len(pins):
                desk.apply(Edit("Remove pins", True, kept))
        case Command.CLEAR_PINS:
            desk.say("")
            desk.apply(Edit("Remove all pins", True, ()))
        case _:
            return False
    return True


def _set_pin(desk: Desk, session: Session, request: SetPin) -> None:
    pins = session.pose.pins
    if request.remove:
        kept = tuple(pin for pin in pins if pin.vertex != request.vertex)
        desk.apply(Edit("Remove pin", True, kept))
        return

    def changed(pin: Pin) -> Pin:
        if pin.vertex != request.vertex:
            return pin
        return replace(
            pin, freedom=request.freedom or pin.freedom, stiffness=request.stiffness or pin.stiffness
        )

    desk.apply(Edit("Change pin", request.final, tuple(changed(pin) for pin in pins), solve=True))
