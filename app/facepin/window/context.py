"""The OpenGL context of a window, and the window's own framebuffer."""

import ctypes
from collections.abc import Callable
from typing import Any, Self

import glfw
import numpy as np
from numpy.typing import NDArray

from facepin import platforms
from facepin.core.errors import FacepinError


class Loader:
    """Gives moderngl the OpenGL functions of glfw's current context, on every platform alike."""

    def load_opengl_function(self, name: str) -> int:
        """Return the address of a function, 0 where there is none."""
        return ctypes.cast(glfw.get_proc_address(name), ctypes.c_void_p).value or 0

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def release(self) -> None:
        """Leave the context alone: the window owns it."""


class Screen:
    """The window's own framebuffer.  moderngl takes it to be as large for ever as it was at the start."""

    def __init__(self) -> None:
        integer, unsigned, pointer = ctypes.c_int, ctypes.c_uint, ctypes.c_void_p
        self._bind = _function("glBindFramebuffer", unsigned, unsigned)
        self._blit = _function("glBlitFramebuffer", *[integer] * 8, unsigned, unsigned)
        self._disable = _function("glDisable", unsigned)
        self._bind_texture = _function("glBindTexture", unsigned, unsigned)
        self._store = _function("glTexImage2D", unsigned, *[integer] * 5, unsigned, unsigned, pointer)
        self._clear_colour = _function("glClearColor", *[ctypes.c_float] * 4)
        self._clear = _function("glClear", unsigned)
        self._pack = _function("glPixelStorei", unsigned, integer)
        self._read = _function("glReadPixels", *[integer] * 4, unsigned, unsigned, pointer)

    def fill(self, colour: tuple[float, float, float, float]) -> None:
        """Fill the window."""
        self._bind(_FRAMEBUFFER, 0)
        self._disable(_SCISSOR_TEST)
        self._clear_colour(*colour)
        self._clear(_COLOR_BUFFER_BIT)

    def copy_to_screen(self, source: int, size: tuple[int, int]) -> None:
        """Copy the colours of a framebuffer, its first row to the top of the window."""
        width, height = size
        self._bind(_READ_FRAMEBUFFER, source)
        self._bind(_DRAW_FRAMEBUFFER, 0)
        self._disable(_SCISSOR_TEST)
        self._blit(0, height, width, 0, 0, 0, width, height, _COLOR_BUFFER_BIT, _NEAREST)
        self._bind(_FRAMEBUFFER, 0)

    def store_as_screens_do(self, texture: int, size: tuple[int, int]) -> None:
        """Give an RGBA texture storage whose bytes are blue, green, red, alpha."""
        self._bind_texture(_TEXTURE_2D, texture)
        # A format without sizes lets the driver follow the order of the bytes that are announced.
        self._store(_TEXTURE_2D, 0, _RGBA, *size, 0, _BGRA, _UNSIGNED_INT_8_8_8_8_REV, None)

    def read_screen(self, width: int, height: int) -> NDArray[np.uint8]:
        """Return the colours of the window, (h, w, 3) uint8, first row on top."""
        pixels = np.zeros((height, width, 3), np.uint8)
        self._bind(_FRAMEBUFFER, 0)
        self._pack(_PACK_ALIGNMENT, 1)
        self._read(0, 0, width, height, _RGB, _UNSIGNED_BYTE, pixels.ctypes.data)
        return pixels[::-1]


_FRAMEBUFFER, _READ_FRAMEBUFFER, _DRAW_FRAMEBUFFER = 0x8D40, 0x8CA8, 0x8CA9
_COLOR_BUFFER_BIT, _NEAREST, _SCISSOR_TEST = 0x4000, 0x2600, 0x0C11
_TEXTURE_2D, _RGBA, _BGRA, _UNSIGNED_INT_8_8_8_8_REV = 0x0DE1, 0x1908, 0x80E1, 0x8367
_PACK_ALIGNMENT, _RGB, _UNSIGNED_BYTE = 0x0D05, 0x1907, 0x1401


def _function(name: str, *arguments: type) -> Callable[..., None]:
    """Return a function of OpenGL by name."""
    address = ctypes.cast(glfw.get_proc_address(name), ctypes.c_void_p).value
    if not address:
        raise FacepinError(f"OpenGL on this machine has no {name}; 3.3 is needed")
    found: Callable[..., None] = ctypes.CFUNCTYPE(None, *arguments)(address)
    return found


class Complaints:
    """Keeps glfw from printing its complaints inside a `with` block; the last one can be told as a reason."""

    def __enter__(self) -> Self:
        self._before = glfw.ERROR_REPORTING
        glfw.ERROR_REPORTING = "ignore"
        return self

    def __exit__(self, *_: object) -> None:
        glfw.ERROR_REPORTING = self._before

    def __str__(self) -> str:
        _, text = glfw.get_error()
        return str(text.decode(errors="replace")) if text else "glfw gives no reason"


def create(title: str, size: tuple[int, int], windowless: bool) -> Any:
    """Return glfw's handle of a new window with a context of OpenGL 3.3, None where there can be none."""
    glfw.default_window_hints()
    glfw.window_hint(glfw.CONTEXT_VERSION_MAJOR, 3)
    glfw.window_hint(glfw.CONTEXT_VERSION_MINOR, 3)
    glfw.window_hint(glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE)
    glfw.window_hint(glfw.OPENGL_FORWARD_COMPAT, True)
    glfw.window_hint(glfw.SCALE_TO_MONITOR, True)
    if windowless:
        if platforms.has_windowless_contexts():
            glfw.window_hint(glfw.CONTEXT_CREATION_API, glfw.EGL_CONTEXT_API)
        else:
            glfw.window_hint(glfw.VISIBLE, False)
    elif (monitor := glfw.get_primary_monitor()) is not None:
        # The screen may be another one than that for which the size was good.
        _, _, width, height = glfw.get_monitor_workarea(monitor)
        scale = (
            1.0 if platforms.windows_are_measured_in_points() else glfw.get_monitor_content_scale(monitor)[0]
        )
        if width and height:
            size = (min(size[0], int(width / scale)), min(size[1], int(height / scale)))
    return glfw.create_window(*size, title, None, None)
