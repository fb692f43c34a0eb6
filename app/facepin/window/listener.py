"""Hears a window of glfw: what the user does becomes events, for the program and for imgui."""

from functools import partial
from pathlib import Path
from typing import Any

import glfw
from imgui_bundle import imgui

from facepin.core.events import (
    CloseRequested,
    FilesDropped,
    KeyPressed,
    KeyReleased,
    Modifiers,
    PointerMoved,
    PointerPressed,
    PointerReleased,
    Scrolled,
    Stirred,
)
from facepin.window.incoming import Incoming
from facepin.window.keys import BUTTONS, HELD, KEYS, REPEATED


def size_of(handle: Any) -> tuple[int, int]:
    """Return width and height of a window's framebuffer in pixels."""
    width, height = glfw.get_framebuffer_size(handle)
    return int(width), int(height)


def pixel_ratio_of(handle: Any) -> float:
    """Return the framebuffer pixels per screen unit of a window."""
    pixels, units = size_of(handle)[0], glfw.get_window_size(handle)[0]
    return pixels / units if pixels and units else 1.0  # a minimised window may have neither


class Listener:
    """Puts everything that glfw tells of a window into what is `Incoming`."""

    def __init__(self, handle: Any, address: int, incoming: Incoming) -> None:
        """Begin to listen.

        Parameters
        ----------
        handle : glfw window
            glfw keeps what is set here as long as the window is open.
        address : int
            Of the same window, as imgui's backend wants it.
        incoming : Incoming
            Takes the events.
        """
        self._handle, self._address, self._incoming = handle, address, incoming
        # Where the last event left the mouse.  Asking in a callback would tell where it is by now: after a
        # slow frame, far from where the button went down.
        x, y = glfw.get_cursor_pos(handle)
        self._cursor = (x * pixel_ratio_of(handle), y * pixel_ratio_of(handle))
        glfw.set_cursor_pos_callback(self._handle, self._on_cursor)
        glfw.set_mouse_button_callback(self._handle, self._on_button)
        glfw.set_scroll_callback(self._handle, self._on_scroll)
        glfw.set_key_callback(self._handle, self._on_key)
        glfw.set_drop_callback(self._handle, self._on_drop)
        glfw.set_window_close_callback(self._handle, self._on_close)
        # Where frames are drawn only when something happens, these have to be heard too.
        glfw.set_window_refresh_callback(self._handle, self._on_stir)
        glfw.set_window_focus_callback(self._handle, self._on_focus)
        glfw.set_cursor_enter_callback(self._handle, self._on_enter)
        glfw.set_framebuffer_size_callback(self._handle, self._on_stir)
        glfw.set_window_content_scale_callback(self._handle, self._on_stir)
        glfw.set_char_callback(self._handle, self._on_char)

    def _modifiers(self) -> Modifiers:
        def held(*keys: int) -> bool:
            return any(glfw.get_key(self._handle, key) == glfw.PRESS for key in keys)

        return Modifiers(
            shift=held(glfw.KEY_LEFT_SHIFT, glfw.KEY_RIGHT_SHIFT),
            control=held(
                glfw.KEY_LEFT_CONTROL, glfw.KEY_RIGHT_CONTROL, glfw.KEY_LEFT_SUPER, glfw.KEY_RIGHT_SUPER
            ),
            alt=held(glfw.KEY_LEFT_ALT, glfw.KEY_RIGHT_ALT),
        )

    def _on_cursor(self, _: object, x: float, y: float) -> None:
        self._cursor = (x * pixel_ratio_of(self._handle), y * pixel_ratio_of(self._handle))
        tell = partial(imgui.backends.glfw_cursor_pos_callback, self._address, x, y)
        self._incoming.add(PointerMoved(*self._cursor, self._modifiers()), tell)

    def _on_button(self, _: object, button: int, action: int, mods: int) -> None:
        tell = partial(imgui.backends.glfw_mouse_button_callback, self._address, button, action, mods)
        x, y = self._cursor
        if button not in BUTTONS:
            self._incoming.add(Stirred(), tell)
        elif action == glfw.PRESS:
            self._incoming.add(PointerPressed(x, y, BUTTONS[button], self._modifiers()), tell)
        else:
            self._incoming.add(PointerReleased(x, y, BUTTONS[button]), tell)

    def _on_scroll(self, _: object, across: float, steps: float) -> None:
        tell = partial(imgui.backends.glfw_scroll_callback, self._address, across, steps)
        self._incoming.add(Scrolled(*self._cursor, steps), tell)

    def _on_key(self, _: object, key: int, scancode: int, action: int, mods: int) -> None:
        # A panel may wait for any key to go down, to repeat or to go up: imgui knows which.
        tell = partial(imgui.backends.glfw_key_callback, self._address, key, scancode, action, mods)
        self._incoming.add(Stirred(), tell)
        name = KEYS.get(key)
        if glfw.KEY_A <= key <= glfw.KEY_Z:
            # What the keyboard's own layout writes there: Ctrl+Z is where the user's Z is.
            written = glfw.get_key_name(key, scancode)
            name = written.lower() if written and written.isascii() and written.isalpha() else name
        if action == glfw.RELEASE:
            if name in HELD:
                self._incoming.add(KeyReleased(name))
            return
        if action == glfw.REPEAT and name not in REPEATED:
            return  # a picture is not saved thirty times a second because F12 was held
        if name is not None:
            self._incoming.add(KeyPressed(name, self._modifiers()))

    def _on_drop(self, _: object, paths: list[str]) -> None:
        self._incoming.add(FilesDropped(tuple(Path(path) for path in paths)))

    def _on_char(self, _: object, code: int) -> None:
        # Where this key is, and whether it needs Shift, is the keyboard's own affair.
        tell = partial(imgui.backends.glfw_char_callback, self._address, code)
        self._incoming.add(KeyPressed("?") if chr(code) == "?" else Stirred(), tell)

    def _on_focus(self, _: object, focused: int) -> None:
        self._incoming.add(
            Stirred(), partial(imgui.backends.glfw_window_focus_callback, self._address, focused)
        )

    def _on_enter(self, _: object, entered: int) -> None:
        self._incoming.add(None, partial(imgui.backends.glfw_cursor_enter_callback, self._address, entered))

    def _on_stir(self, *_: object) -> None:
        self._incoming.add(Stirred())

    def _on_close(self, handle: Any) -> None:
        # Whether the window really closes is decided by who reads the event.
        glfw.set_window_should_close(handle, False)
        self._incoming.add(CloseRequested())
