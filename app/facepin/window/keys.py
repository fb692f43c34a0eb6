"""What keys and buttons are called here."""

import glfw

from facepin.core.events import Button

BUTTONS: dict[int, Button] = {
    glfw.MOUSE_BUTTON_LEFT: "left",
    glfw.MOUSE_BUTTON_RIGHT: "right",
    glfw.MOUSE_BUTTON_MIDDLE: "middle",
}
KEYS = {
    glfw.KEY_ESCAPE: "escape",
    glfw.KEY_DELETE: "delete",
    glfw.KEY_BACKSPACE: "backspace",
    glfw.KEY_HOME: "home",
    glfw.KEY_TAB: "tab",
    glfw.KEY_KP_DECIMAL: "numpad .",
    glfw.KEY_LEFT: "left",
    glfw.KEY_RIGHT: "right",
    glfw.KEY_UP: "up",
    glfw.KEY_DOWN: "down",
    glfw.KEY_PAGE_UP: "page up",
    glfw.KEY_PAGE_DOWN: "page down",
    **{glfw.KEY_F1 + i: f"f{i + 1}" for i in range(12)},
    **{glfw.KEY_KP_0 + i: f"numpad {i}" for i in range(10)},
    **{glfw.KEY_0 + i: str(i) for i in range(10)},
    **{glfw.KEY_A + i: chr(ord("a") + i) for i in range(26)},
}
_MOVING = ("left", "right", "up", "down", "page up", "page down")
HELD = ("x", "y", *_MOVING)
"""Keys whose release is told, too: what they do goes on until then."""
REPEATED = ("z", "y", *_MOVING)
"""Keys that go on while they are held: undo and redo, and those that move something."""
