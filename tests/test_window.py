"""What is drawn arrives in the window, the right way up."""

import numpy as np

from facepin.gpu.canvas import Canvas
from facepin.window import Window


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
