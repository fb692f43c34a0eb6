"""Pins, other than by dragging them."""

from collections.abc import Collection
from dataclasses import replace

from facepin.core.errors import FacepinError
from facepin.core.pose import Pin, with_changed
from facepin.core.shapes.places import titles
from facepin.desk.desk import Desk
from facepin.panels.commands import Command
from facepin.panels.requests import NamePin, RemovePins, Request, SelectPins, SetPins
from facepin.session.edit import Edit
from facepin.session.hand.mirroring import twins_of
from facepin.session.hand.moving import amount
from facepin.session.session import Session


def act(request: Request, desk: Desk) -> bool:
    """Carry out what concerns pins."""
    session = desk.session
    if session is None:
        return False
    pins, selected = session.pose.pins, desk.tool.selected

    def meant(vertices: Collection[int]) -> Collection[int]:
        """Return vertices, with their twins where these do the same."""
        return twins_of(session.mirror, vertices) if desk.view.symmetric else vertices

    match request:
        case SelectPins(vertices):
            desk.tool.selected = vertices
        case Command.SELECT_PINS:
            desk.tool.selected = frozenset(pin.vertex for pin in pins if not pin.hidden)
        case Command.SKETCH_PINS:
            desk.view.pins.sketching = not desk.view.pins.sketching
        case SetPins(vertices):
            _set(desk, session, replace(request, vertices=frozenset(meant(vertices))))
        case NamePin(vertex, name):
            _name(desk, pins, vertex, " ".join(name.split()))
        case RemovePins(vertices):
            _remove(desk, pins, meant(vertices))
        case Command.DELETE_PINS if selected:
            _remove(desk, pins, meant(selected))
        case Command.CLEAR_PINS:
            _remove(desk, pins, {pin.vertex for pin in pins})
        case Command.LOCK_PINS if selected:
            locked = all(pin.locked for pin in pins if pin.vertex in selected)
            _set(desk, session, SetPins(selected, locked=not locked))
        case Command.HIDE_PINS if selected:
            _set(desk, session, SetPins(selected, hidden=True))
        case Command.DELETE_PINS | Command.LOCK_PINS | Command.HIDE_PINS:
            desk.say("No pin is selected")
        case Command.SHOW_PINS:
            hidden = frozenset(pin.vertex for pin in pins if pin.hidden)
            _set(desk, session, SetPins(hidden, hidden=False))
            desk.tool.selected = hidden or selected
        case _:
            return False
    return True


def _set(desk: Desk, session: Session, request: SetPins) -> None:
    """Change what pins hold, which is solved at once, or how they are at hand, which moves nothing."""
    changes = {
        name: value
        for name in ("freedom", "stiffness", "locked", "hidden")
        if (value := getattr(request, name)) is not None
    }
    pins = session.pose.pins
    changed = with_changed(pins, request.vertices, lambda pin: replace(pin, **changes))
    desk.say("")
    if changed == pins and not session.in_gesture:
        return
    verb = "Change"
    if request.locked is not None:
        verb = "Lock" if request.locked else "Unlock"
    elif request.hidden is not None:
        verb = "Hide" if request.hidden else "Show"
    solve = request.freedom is not None or request.stiffness is not None
    count = sum(pin.vertex in request.vertices for pin in pins)
    desk.apply(Edit(f"{verb} {amount(count)}", request.final, changed, solve=solve))
    if request.hidden:
        desk.tool.selected -= request.vertices


def _name(desk: Desk, pins: tuple[Pin, ...], vertex: int, name: str) -> None:
    """Give a pin a name that no other one has.

    Raises
    ------
    FacepinError
        If another one has.
    """
    namesake = next((pin for pin in pins if name and pin.name == name and pin.vertex != vertex), None)
    if namesake is not None:
        place = desk.stage.places.title(namesake.vertex) if desk.stage is not None else "another place"
        raise FacepinError(f"the pin on {place} is called {name!r} already")
    named = with_changed(pins, {vertex}, lambda pin: replace(pin, name=name))
    desk.say("")
    if named != pins:
        desk.apply(Edit("Name pin", True, named))


def _remove(desk: Desk, pins: tuple[Pin, ...], vertices: Collection[int]) -> None:
    """Remove pins, but for those that are locked."""
    wanted = [pin for pin in pins if pin.vertex in vertices]
    locked = [pin for pin in wanted if pin.locked]
    gone = {pin.vertex for pin in wanted if not pin.locked}
    desk.say("")
    if gone:
        kept = tuple(pin for pin in pins if pin.vertex not in gone)
        desk.apply(Edit(f"Remove {amount(len(gone))}" if kept else "Remove all pins", True, kept))
    if locked:
        several = f"{len(locked)} pins are locked and stay"
        desk.say(
            several if len(locked) > 1 else f"The pin is locked and stays{_called(desk, pins, locked[0])}"
        )


def _called(desk: Desk, pins: tuple[Pin, ...], pin: Pin) -> str:
    return "" if desk.stage is None else f" ({titles(desk.stage.places, pins)[pin.vertex]})"
