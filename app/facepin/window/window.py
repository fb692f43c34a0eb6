"""The one window: glfw, its OpenGL context and imgui, with the user's input as event values.

Without a display the same class opens on glfw's null platform: a real context, real panels, no screen.
"""

import ctypes
import os
from collections.abc import Sequence
from functools import partial
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
    Event,
    PointerMoved,
    PointerPressed,
    PointerReleased,
    Scrolled,
)
from facepin.core.names import readable
from facepin.window.context import Complaints, Loader, Screen, create
from facepin.window.incoming import Incoming
from facepin.window.keys import BUTTONS
from facepin.window.listener import Listener, pixel_ratio_of, size_of


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
        self._incoming = Incoming()
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
        self._windowless = windowless
        imgui.create_context()
        implot.create_context()
        self._address = ctypes.cast(self._handle, ctypes.c_void_p).value or 0
        # Without callbacks of its own: it is told everything in the frame in which the program is.
        imgui.backends.glfw_init_for_opengl(self._address, False)
        if not windowless:  # there, events come from `inject` alone
            Listener(self._handle, self._address, self._incoming)
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
        return size_of(self._handle)

    @property
    def pixel_ratio(self) -> float:
        """Framebuffer pixels per screen unit (imgui's unit): 2 on a Retina display, 1 elsewhere."""
        return pixel_ratio_of(self._handle)

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
        """Return what happened since the last call, oldest first, as far as it belongs to one frame.

        Parameters
        ----------
        wait : float
            Sleep until something happens, at most this many seconds; None returns at once.
        """
        if wait is None or self._incoming or self._windowless:
            glfw.poll_events()
        else:
            glfw.wait_events_timeout(wait)
        return self._incoming.take()

    @property
    def behind(self) -> bool:
        """Whether something happened that `poll` will tell of only in a further frame."""
        return bool(self._incoming)

    def inject(self, *events: Event) -> None:
        """Make events happen in a windowless window as if the user had caused them, for imgui too."""
        tell, address = imgui.backends, self._address
        # Unless the mouse is known to be inside, the backend asks the null platform where it is: at (0, 0).
        tell.glfw_cursor_enter_callback(address, 1)
        for event in events:
            match event:
                case PointerMoved(x, y):
                    at = x / self.pixel_ratio, y / self.pixel_ratio
                    self._incoming.add(event, partial(tell.glfw_cursor_pos_callback, address, *at))
                case PointerPressed(button=button) | PointerReleased(button=button):
                    code = next(code for code, name in BUTTONS.items() if name == button)
                    action = glfw.PRESS if isinstance(event, PointerPressed) else glfw.RELEASE
                    told = partial(tell.glfw_mouse_button_callback, address, code, action, 0)
                    self._incoming.add(event, told)
                case Scrolled(steps=steps):
                    self._incoming.add(event, partial(tell.glfw_scroll_callback, address, 0.0, steps))
                case _:
                    self._incoming.add(event)

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
