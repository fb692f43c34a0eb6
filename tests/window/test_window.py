"""What is drawn arrives in the window, the right way up."""

import ctypes

import numpy as np
import pytest

from facepin.core.events import KeyPressed
from facepin.gpu.canvas import Canvas
from facepin.window import Window
from facepin.window.incoming import Incoming


def test_a_canvas_fills_the_window_with_its_first_row_on_top() -> None:
    with Window("test", (64, 48), windowless=True) as window:
        for samples in (0, 4):
            canvas = Canvas(window.ctx, samples, window.texture)
            canvas.resize(*window.size)
            canvas.clear((1.0, 0.5, 0.0, 1.0))
            canvas.framebuffer.scissor = (0, 0, 10, 5)
            canvas.framebuffer.clear(0.0, 0.25, 1.0)
            expected = np.full((48, 64, 3), (255, 128, 0))
            expected[:5, :10] = (0, 64, 255)
            np.testing.assert_allclose(canvas.read()[..., :3], expected, atol=1)
            window.show(canvas.flat())
            np.testing.assert_allclose(window.read(), expected, atol=1)
            canvas.release()


def test_a_held_key_is_told_by_what_the_keyboard_writes_there(monkeypatch: pytest.MonkeyPatch) -> None:
    import glfw  # not before the window has shared it with imgui

    from facepin.window.listener import Listener

    with Window("test", (64, 48), windowless=True):
        handle, incoming = glfw.get_current_context(), Incoming()
        listener = Listener(handle, ctypes.cast(handle, ctypes.c_void_p).value or 0, incoming)
        monkeypatch.setattr(glfw, "get_key_name", lambda key, _: {glfw.KEY_W: "z", glfw.KEY_Z: "w"}.get(key))
        for key, action in ((glfw.KEY_W, glfw.PRESS), (glfw.KEY_W, glfw.REPEAT), (glfw.KEY_Z, glfw.REPEAT)):
            listener._on_key(None, key, 0, action, 0)
        pressed = [event.key for event in incoming.take() if isinstance(event, KeyPressed)]
        assert pressed == ["z", "z"], "undo goes on while it is held, W does not"
