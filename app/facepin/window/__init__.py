"""The one window: glfw, its OpenGL context and imgui; input as event values; works without a screen."""

# glfw must come after imgui_bundle: the two then share one GLFW library, and imgui's compiled backend can be
# given the address of a window that pyGLFW made.
import imgui_bundle  # noqa: F401, I001
from facepin.window.window import NoDisplay, Window

__all__ = ["NoDisplay", "Window"]
