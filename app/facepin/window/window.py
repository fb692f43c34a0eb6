"""The one window: glfw, its OpenGL context and imgui, with the user's input as event values.

Without a display the same class opens on glfw's null platform: a real context, real panels, no screen.
"""

import ctypes
import os
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import glfw
import moderngl
import numpy as np
from imgui_bundle import imgui, implot
from numpy.typing import NDArray

from facepin import platforms
from facepin.core.errors import FacepinError
from facepin.core.events import (
    CloseRequested,
    Event,
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
from facepin.core.names import readable
from facepin.window.context import Complaints, Loader, Screen, create
from facepin.window.keys import BUTTONS, HELD, KEYS, REPEATED


class NoDisplay(FacepinError):
    """There is no screen to open a window on."""


class Window:
    """A window with a current OpenGL 3.3 core context and an imgui context; a context manager."""

    def __init__(
        self, title: str, size: tuple[int, int], *, windowless: bool = False, scale: float | None = None
    ) -> None:
        """Open the window.

        Parameters
        ----------
        title : str
            What the title bar says.
        size : (width, height)
            In screen units; the framebuffer may be larger.
        windowless : bool
            Use no display: the null platform and EGL; where there is no such thing, a window that is hidden.
        scale : float
            Pixels per pixel of a 1x screen; taken from the monitor when None.

        Raises
        ------
        NoDisplay
            When there is no screen.
        FacepinError
            When there is no OpenGL 3.3 on it.
        """
        self._events: list[Event] = []
        platforms.spare_a_full_disk(os.environ)
        if windowless and platforms.has_windowless_contexts():
            glfw.init_hint(glfw.PLATFORM, glfw.PLATFORM_NULL)
        with Complaints() as complaints:
            if not glfw.init():
                raise NoDisplay(f"no display was found ({complaints})")
            self._handle: Any = create(title, size, windowless)
            if not self._handle:
                glfw.terminate()
                raise FacepinError(f"no window with OpenGL 3.3 could be opened ({complaints})")
        glfw.make_context_current(self._handle)
        self.ctx = moderngl.create_context(context=Loader())  # type: ignore[arg-type]  # its stub wants a dict
        self._gl = Screen()
        glfw.swap_interval(0 if windowless else 1)
        self._forced_scale = scale
        # Where the last event left the mouse.  Asking in a callback would tell where it is by now: after a
        # slow frame, far from where the button went down.
        x, y = glfw.get_cursor_pos(self._handle)
        self._cursor = (x * self.pixel_ratio, y * self.pixel_ratio)
        self._windowless = windowless
        if not windowless:  # there, events come from `inject` alone
            self._listen()
        imgui.create_context()
        implot.create_context()
        # imgui chains to the callbacks above, so both hear everything.
        self._address = ctypes.cast(self._handle, ctypes.c_void_p).value or 0
        imgui.backends.glfw_init_for_opengl(self._address, True)
        imgui.backends.opengl3_init("#version 330")

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        imgui.backends.opengl3_shutdown()
        imgui.backends.glfw_shutdown()
        implot.destroy_context()
        imgui.destroy_context()
        self.ctx.release()
        glfw.destroy_window(self._handle)
        glfw.terminate()
        glfw.init_hint(glfw.PLATFORM, glfw.ANY_PLATFORM)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the framebuffer in pixels."""
        width, height = glfw.get_framebuffer_size(self._handle)
        return int(width), int(height)

    @property
    def pixel_ratio(self) -> float:
        """Framebuffer pixels per screen unit (imgui's unit): 2 on a Retina display, 1 elsewhere."""
        pixels, units = self.size[0], glfw.get_window_size(self._handle)[0]
        return pixels / units if pixels and units else 1.0  # a minimised window may have neither

    @property
    def scale(self) -> float:
        """Framebuffer pixels per pixel of a 1x screen: how large text and markers should be drawn."""
        if self._forced_scale is not None:
            return self._forced_scale
        return float(max(glfw.get_window_content_scale(self._handle)[0], 0.5))

    def resize(self, size: tuple[int, int]) -> None:
        """Ask for another size, in screen units."""
        glfw.set_window_size(self._handle, *size)

    def set_title(self, title: str) -> None:
        """Say `title` in the title bar."""
        glfw.set_window_title(self._handle, readable(title))

    def set_icons(self, paths: Sequence[Path]) -> None:
        """Show the picture of a fitting size in the task bar, where the system has a place for it.

        Parameters
        ----------
        paths : sequence of Path
            PNG files of several sizes.
        """
        from PIL import Image

        pictures = [Image.open(path).convert("RGBA") for path in paths]
        with Complaints():
            glfw.set_window_icon(self._handle, len(pictures), pictures)

    def poll(self, wait: float | None = None) -> list[Event]:
        """Return what happened since the last call, oldest first.

        Parameters
        ----------
        wait : float
            Sleep until something happens, at most this many seconds; None returns at once.
        """
        if wait is None or self._events or self._windowless:
            glfw.poll_events()
        else:
            glfw.wait_events_timeout(wait)
        events, self._events = self._events, []
        return events

    def inject(self, *events: Event) -> None:
        """Make events happen in a windowless window as if the user had caused them, for imgui too."""
        address = self._address
        # Unless the mouse is known to be inside, the backend asks the null platform where it is: at (0, 0).
        imgui.backends.glfw_cursor_enter_callback(address, 1)
        for event in events:
            match event:
                case PointerMoved(x, y):
                    imgui.backends.glfw_cursor_pos_callback(
                        address, x / self.pixel_ratio, y / self.pixel_ratio
                    )
                case PointerPressed(button=button) | PointerReleased(button=button):
                    code = next(code for code, name in BUTTONS.items() if name == button)
                    action = glfw.PRESS if isinstance(event, PointerPressed) else glfw.RELEASE
                    imgui.backends.glfw_mouse_button_callback(address, code, action, 0)
                case Scrolled(steps=steps):
                    imgui.backends.glfw_scroll_callback(address, 0.0, steps)
                case _:
                    pass
            self._events.append(event)

    def begin_frame(self) -> None:
        """Start imgui's frame."""
        imgui.backends.opengl3_new_frame()
        imgui.backends.glfw_new_frame()
        imgui.new_frame()

    def end_frame(self) -> None:
        """Draw imgui over what is in the framebuffer, and show it."""
        imgui.render()
        imgui.backends.opengl3_render_draw_data(imgui.get_draw_data())
        glfw.swap_buffers(self._handle)

    def clear(self, colour: tuple[float, float, float, float]) -> None:
        """Fill the window."""
        self._gl.fill(colour)

    def texture(self, size: tuple[int, int]) -> moderngl.Texture:
        """Return a texture (RGBA) with its bytes in the order of screens: showing it is a plain copy."""
        texture = self.ctx.texture(size, 4)
        self._gl.store_as_screens_do(texture.glo, size)
        return texture

    def show(self, picture: moderngl.Framebuffer) -> None:
        """Fill the window with a picture as large as it is, stored with its first row first."""
        self._gl.copy_to_screen(picture.glo, picture.size)

    def read(self) -> NDArray[np.uint8]:
        """Return what a windowless window shows, (h, w, 3) uint8, first row on top.

        On a screen, what has been shown need not be there any more.
        """
        width, height = self.size
        return self._gl.read_screen(width, height)

    def _listen(self) -> None:
        glfw.set_cursor_pos_callback(self._handle, self._on_cursor)
        glfw.set_mouse_button_callback(self._handle, self._on_button)
        glfw.set_scroll_callback(self._handle, self._on_scroll)
        glfw.set_key_callback(self._handle, self._on_key)
        glfw.set_drop_callback(self._handle, self._on_drop)
        glfw.set_window_close_callback(self._handle, self._on_close)
        # Where frames are drawn only when something happens, these have to be heard too.
        glfw.set_window_refresh_callback(self._handle, self._on_stir)
        glfw.set_window_focus_callback(self._handle, self._on_stir)
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
        self._cursor = (x * self.pixel_ratio, y * self.pixel_ratio)
        self._events.append(PointerMoved(*self._cursor, self._modifiers()))

    def _on_button(self, _: object, button: int, action: int, __: int) -> None:
        if button not in BUTTONS:
            return
        x, y = self._cursor
        if action == glfw.PRESS:
            self._events.append(PointerPressed(x, y, BUTTONS[button], self._modifiers()))
        else:
            self._events.append(PointerReleased(x, y, BUTTONS[button]))

    def _on_scroll(self, _: object, __: float, steps: float) -> None:
        x, y = self._cursor
        self._events.append(Scrolled(x, y, steps))

    def _on_key(self, _: object, key: int, scancode: int, action: int, __: int) -> None:
        # A panel may wait for any key to go down, to repeat or to go up: imgui knows which.
        self._events.append(Stirred())
        name = KEYS.get(key)
        if glfw.KEY_A <= key <= glfw.KEY_Z:
            # What the keyboard's own layout writes there: Ctrl+Z is where the user's Z is.
            written = glfw.get_key_name(key, scancode)
            name = written.lower() if written and written.isascii() and written.isalpha() else name
        if action == glfw.RELEASE:
            if name in HELD:
                self._events.append(KeyReleased(name))
            return
        if action == glfw.REPEAT and name not in REPEATED:
            return  # a picture is not saved thirty times a second because F12 was held
        if name is not None:
            self._events.append(KeyPressed(name, self._modifiers()))

    def _on_drop(self, _: object, paths: list[str]) -> None:
        self._events.append(FilesDropped(tuple(Path(path) for path in paths)))

    def _on_char(self, _: object, code: int) -> None:
        # Where this key is, and whether it needs Shift, is the keyboard's own affair.
        self._events.append(KeyPressed("?") if chr(code) == "?" else Stirred())

    def _on_stir(self, *_: object) -> None:
        self._events.append(Stirred())

    def _on_close(self, handle: Any) -> None:
        # Whether the window really closes is decided by who reads the event.
        glfw.set_window_should_close(handle, False)
        self._events.append(CloseRequested())
