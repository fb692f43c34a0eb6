"""How the program is set up, and what explains it; needs no open face."""

from facepin.desk.desk import Desk
from facepin.panels.commands import Command
from facepin.panels.requests import Choose, Request
from facepin.panels.view import CHOICES, PaletteView


def act(request: Request, desk: Desk) -> bool:
    """Carry out what concerns settings and help."""
    view = desk.view
    match request:
        case Choose(name, value):
            if value not in CHOICES[name].values:
                raise AssertionError(f"{name} can't be {value!r}")
            setattr(view, name, value)
        case Command.PALETTE:
            view.palette = None if view.palette else PaletteView()
        case Command.KEYBOARD:
            view.keyboard = not view.keyboard
        case Command.ABOUT:
            view.about = not view.about
        case Command.GUIDE:
            view.guide.again()
        case _:
            return False
    return True
