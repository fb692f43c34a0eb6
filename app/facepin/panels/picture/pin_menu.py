"""The menu of a pin, or of all that are selected with it."""

from collections.abc import Collection

from imgui_bundle import imgui

from facepin.core.pose import Pin
from facepin.panels.commands import Command, key_of
from facepin.panels.picture.overlays import close_on_escape
from facepin.panels.pins import FREEDOMS, SOFTEST, STIFFEST
from facepin.panels.requests import NamePin, RemovePins, Request, SetPins
from facepin.session.navigation import Habit


def pin_menu(pin: Pin, pins: Collection[Pin], title: str, habit: Habit) -> Request | None:
    """Draw the inside of the menu of a pin; return what the user changes, or None.

    Parameters
    ----------
    pin : Pin
        The one that was clicked.
    pins : Pins
        Those that change with it, it among them.
    title : str
        What it is called.
    habit : str
        Whose keys are named.
    """
    request: Request | None = None
    close_on_escape()
    vertices = frozenset(other.vertex for other in pins)
    if len(pins) > 1:
        imgui.text_disabled(f"{len(pins)} pins")
    else:
        imgui.text_disabled(title)
        imgui.set_item_tooltip(f"Vertex {pin.vertex}")
        imgui.set_next_item_width(12 * imgui.get_font_size())
        flags = imgui.InputTextFlags_.enter_returns_true
        entered, name = imgui.input_text_with_hint("##name", "name", pin.name, flags)
        if entered:
            request = NamePin(pin.vertex, name)
            imgui.close_current_popup()
    imgui.separator()
    for freedom, title in FREEDOMS.items():
        same = all(other.freedom == freedom for other in pins)
        if imgui.menu_item_simple(title, selected=same) and not same:
            request = SetPins(vertices, freedom=freedom)
    imgui.set_next_item_width(9 * imgui.get_font_size())
    log = imgui.SliderFlags_.logarithmic | imgui.SliderFlags_.always_clamp
    changed, stiffness = imgui.slider_float("stiffness", pin.stiffness, SOFTEST, STIFFEST, "%.2f", log)
    finished = imgui.is_item_deactivated_after_edit()
    if changed or finished:
        request = SetPins(vertices, stiffness=stiffness, final=finished)
    imgui.separator()
    locked = all(other.locked for other in pins)
    if imgui.menu_item_simple("Unlock" if locked else "Lock", key_of(Command.LOCK_PINS, habit)):
        request = SetPins(vertices, locked=not locked)
    imgui.set_item_tooltip("A locked pin still holds, but can't be dragged or removed")
    if imgui.menu_item_simple("Hide", key_of(Command.HIDE_PINS, habit)):
        request = SetPins(vertices, hidden=True)
    imgui.set_item_tooltip(f"A hidden pin still holds; {key_of(Command.SHOW_PINS, habit)} brings all back")
    if imgui.menu_item_simple("Remove", key_of(Command.DELETE_PINS, habit), enabled=not locked):
        request = RemovePins(vertices)
    return request
