"""Where the panels are: docked beside the viewport, movable, and how they stand at first."""

from imgui_bundle import imgui

from facepin.core.camera import Viewport

WEIGHTS = "Weights"
SOLVER = "Solver"
PANEL_WIDTH = 330.0
SOLVER_HEIGHT = 332.0
"""First sizes of the docked panels, in pixels at 1x scale."""


def dock_space(scale: float, pixel_ratio: float, *, reset: bool) -> Viewport:
    """Lay out the docked panels; return what they leave free for the picture, in framebuffer pixels.

    Parameters
    ----------
    scale : float
        imgui units per pixel of a 1x screen.
    pixel_ratio : float
        Framebuffer pixels per imgui unit.
    reset : bool
        Put all panels back to where they stood first.
    """
    space = imgui.get_id("panels")
    if reset or imgui.internal.dock_builder_get_node(space) is None:
        _build(space, scale)
    imgui.dock_space_over_viewport(
        space, imgui.get_main_viewport(), imgui.DockNodeFlags_.passthru_central_node
    )
    node = imgui.internal.dock_builder_get_central_node(space)
    return Viewport(
        node.pos.x * pixel_ratio,
        node.pos.y * pixel_ratio,
        max(node.size.x, 1) * pixel_ratio,
        max(node.size.y, 1) * pixel_ratio,
    )


def _build(space: int, scale: float) -> None:
    """Solver above weights, both right of the picture."""
    builder = imgui.internal
    builder.dock_builder_remove_node(space)
    builder.dock_builder_add_node(space, imgui.internal.DockNodeFlagsPrivate_.dock_space)
    size = imgui.get_main_viewport().work_size
    builder.dock_builder_set_node_size(space, size)
    width = min(PANEL_WIDTH * scale / max(size.x, 1), 0.5)
    _, right, _ = builder.dock_builder_split_node_py(space, imgui.Dir.right, width)
    height = min(SOLVER_HEIGHT * scale / max(size.y, 1), 0.6)
    _, top, bottom = builder.dock_builder_split_node_py(right, imgui.Dir.up, height)
    builder.dock_builder_dock_window(SOLVER, top)
    builder.dock_builder_dock_window(WEIGHTS, bottom)
    builder.dock_builder_finish(space)
