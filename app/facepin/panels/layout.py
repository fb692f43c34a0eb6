"""Where the panels are: docked beside the viewport, movable, and how they stand at first."""

from collections.abc import Sequence
from math import ceil

from imgui_bundle import imgui

from facepin.core.look.camera import Viewport

SPACE = "panels"
WEIGHTS = "Weights"
SOLVER = "Solver"
PINS = "Pins"
LIBRARY = "Poses"
PANEL_WIDTH = 330.0
SOLVER_HEIGHT = 170.0
"""First sizes of the docked panels, in pixels at 1x scale."""
LEAST_BELOW = 333.0
"""What is left to the panel below one that grows, at 1x scale: ten weights and the head of their list."""
LEAST_SHARE = 0.25
"""Of the two: where there is no room for so much, the upper one has this share at least."""
SIGN = (
    imgui.WindowFlags_.no_decoration
    | imgui.WindowFlags_.always_auto_resize
    | imgui.WindowFlags_.no_saved_settings
    | imgui.WindowFlags_.no_docking
    | imgui.WindowFlags_.no_move
    | imgui.WindowFlags_.no_focus_on_appearing
    | imgui.WindowFlags_.no_bring_to_front_on_focus
)
"""What a small window over the picture is like: it stays where it is put, behind everything else."""
MOST_TAKEN = 0.5
"""Share of the picture that a window takes at most when it opens below."""
MOST_EVEN = 4
"""Panes that are put into full rows only."""
FACE_ASPECT = 0.75
"""Width over height of a pane that a face fills well."""


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
    space = imgui.get_id(SPACE)
    if reset or imgui.internal.dock_builder_get_node(space) is None:
        _build(space, scale)
    push_no_ground()
    imgui.dock_space_over_viewport(
        space,
        imgui.get_main_viewport(),
        imgui.DockNodeFlags_.passthru_central_node | imgui.DockNodeFlags_.no_docking_over_central_node,
    )
    pop_no_ground()
    node = imgui.internal.dock_builder_get_central_node(space)
    return Viewport(
        node.pos.x * pixel_ratio,
        node.pos.y * pixel_ratio,
        max(node.size.x, 1) * pixel_ratio,
        max(node.size.y, 1) * pixel_ratio,
    )


def push_no_ground() -> None:
    """Leave out the grounds of windows and menu bars until `pop_no_ground`.

    The picture has their colour there already.  A GPU would not care; where a processor draws, grounds that
    are blended take longer than all that is written on them.
    """
    for index in (imgui.Col_.window_bg, imgui.Col_.menu_bar_bg):
        imgui.push_style_color(index, imgui.ImVec4(0, 0, 0, 0))


def pop_no_ground() -> None:
    """End what `push_no_ground` began."""
    imgui.pop_style_color(2)


def without_background(name: str) -> None:
    """Leave out the background of the next window, `name`, where it is docked beside the picture.

    See `push_no_ground`.
    """
    window = imgui.internal.find_window_by_name(name)
    if window is not None and window.dock_node is not None:
        space = imgui.get_main_viewport()
        beside = (
            window.pos.x <= space.pos.x + 1 or window.pos.x + window.size.x >= space.pos.x + space.size.x - 1
        )
        if beside:
            imgui.set_next_window_bg_alpha(0.0)


def fit_height(below: str, scale: float, height: float | None = None) -> None:
    """Make the docked window that is being drawn as tall as what it shows; another one takes the rest.

    To be called after its last item.  A height that the user gives it stays until what it shows becomes
    taller or lower, or until another of its tabs was in front.

    Parameters
    ----------
    below : str
        The window that shares the column, which keeps `LEAST_BELOW`.
    scale : float
        imgui units per pixel of a 1x screen.
    height : float
        Wanted, in imgui units; None for what its items take.
    """
    node = imgui.internal.get_current_window().dock_node
    other = imgui.internal.find_window_by_name(below)
    rest = None if other is None else other.dock_node
    if node is None or rest is None or node.parent_node is None or rest.parent_node is None:
        return
    column = node.parent_node
    if column.id_ != rest.parent_node.id_ or column.split_axis != imgui.internal.Axis.y:
        return
    style = imgui.get_style()
    if height is None:
        height = imgui.get_cursor_pos().y - style.item_spacing.y + style.window_padding.y
    room = column.size.y - style.docking_separator_size
    wanted = min(height, max(room - LEAST_BELOW * scale, LEAST_SHARE * room))
    storage, last, by_hand = imgui.get_state_storage(), imgui.get_id("height"), imgui.get_id("by hand")
    if abs(storage.get_float(last, 0.0) - wanted) > 1.0 or imgui.is_window_appearing():
        storage.set_float(last, wanted)
        storage.set_bool(by_hand, False)
    elif abs(node.size.y - wanted) > 1.0 and imgui.is_mouse_down(0):
        storage.set_bool(by_hand, True)
    if abs(node.size.y - wanted) > 1.0 and not storage.get_bool(by_hand):
        imgui.internal.dock_builder_set_node_size(node.id_, imgui.ImVec2(column.size.x, wanted))
        imgui.internal.dock_builder_set_node_size(rest.id_, imgui.ImVec2(column.size.x, room - wanted))


def is_known(name: str) -> bool:
    """Say whether a window has been drawn before."""
    return imgui.internal.find_window_by_name(name) is not None


def beside(name: str, other: str) -> None:
    """Dock the next window, `name`, as a tab with `other` where a layout of former days doesn't know it."""
    window = imgui.internal.find_window_by_name(other)
    if window is not None and window.dock_id and not is_known(name):
        imgui.set_next_window_dock_id(window.dock_id, imgui.Cond_.first_use_ever)


class Beside:
    """Gives windows that open later a place where they do not cover the faces, once.

    Where the user puts them from then on they stay, also in later runs.
    """

    def __init__(self) -> None:
        self._known: set[str] = set()
        self._anew = False

    def forget(self) -> None:
        """Begin anew: the panels were put back to where they stood first."""
        self._known.clear()
        self._anew = True

    def left(self, name: str, width: float, panes: int, otherwise: str) -> None:
        """Dock the next window, `name`, left of the picture if the faces there lose nothing.

        Otherwise it becomes a tab in front of another window.

        Parameters
        ----------
        name, otherwise : str
            Of the window and of the other one.
        width : float
            In imgui units.
        panes : int
            How many faces there are.
        """
        middle = imgui.internal.dock_builder_get_central_node(imgui.get_id(SPACE)).size
        before, after = (
            max(_face(Viewport(0, 0, room, middle.y), n, ceil(panes / n)) for n in range(1, panes + 1))
            for room in (middle.x, middle.x - width)
        )
        if after < before:
            self.in_front_of(otherwise, name)
        else:
            self._at_side(name, imgui.Dir.left, width / max(middle.x, 1.0))

    def below(self, name: str, height: float) -> None:
        """Dock the next window, `name`, below the picture, `height` imgui units high."""
        middle = imgui.internal.dock_builder_get_central_node(imgui.get_id(SPACE)).size
        self._at_side(name, imgui.Dir.down, min(height / max(middle.y, 1.0), MOST_TAKEN))

    def in_front_of(self, other: str, name: str) -> None:
        """Dock the next window, `name`, as a tab in front of another one, if that is docked."""
        window = imgui.internal.find_window_by_name(other)
        if window is not None and window.dock_id and self._is_new(name):
            imgui.set_next_window_dock_id(window.dock_id, imgui.Cond_.always)

    def _at_side(self, name: str, side: imgui.Dir, share: float) -> None:
        if self._is_new(name):
            middle = imgui.internal.dock_builder_get_central_node(imgui.get_id(SPACE))
            _, node, _ = imgui.internal.dock_builder_split_node_py(middle.id_, side, share)
            imgui.set_next_window_dock_id(node, imgui.Cond_.always)

    def _is_new(self, name: str) -> bool:
        """Say whether a window has no place yet; from now on it has."""
        if name in self._known:
            return False
        self._known.add(name)
        kept = imgui.internal.find_window_settings_by_id(imgui.internal.im_hash_str(name))
        return self._anew or kept is None


def split(viewport: Viewport, count: int, gap: float) -> tuple[Viewport, ...]:
    """Cut a viewport into `count` equal panes, in rows and columns that leave a face as large as possible.

    Up to `MOST_EVEN` fill it; of more, the last row may have fewer.

    Parameters
    ----------
    viewport : Viewport
        What is there to cut.
    count : int
        One or more.
    gap : float
        Pixels between panes.
    """
    columns = max(
        (columns for columns in range(1, count + 1) if count % columns == 0 or count > MOST_EVEN),
        key=lambda columns: _face(viewport, columns, ceil(count / columns)),
    )
    rows = ceil(count / columns)
    width = (viewport.width - gap * (columns - 1)) / columns
    height = (viewport.height - gap * (rows - 1)) / rows
    return tuple(
        Viewport(
            round(viewport.x + (at % columns) * (width + gap)),
            round(viewport.y + (at // columns) * (height + gap)),
            max(round(width), 1),
            max(round(height), 1),
        )
        for at in range(count)
    )


def unused(viewport: Viewport, panes: Sequence[Viewport]) -> Viewport | None:
    """Return what panes that `split` has cut leave over at the end of their last row, or None."""
    last = panes[-1]
    left, right = last.x + last.width, viewport.x + viewport.width
    if right - left < last.width / 2:
        return None
    return Viewport(left, last.y, right - left, viewport.y + viewport.height - last.y)


def _face(viewport: Viewport, columns: int, rows: int) -> float:
    """Return how large a face is in a pane of so many columns and rows."""
    return min(viewport.width / columns / FACE_ASPECT, viewport.height / rows)


def _build(space: int, scale: float) -> None:
    """Solver (and pins, as a tab) above weights (and the library), all right of the picture."""
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
    builder.dock_builder_dock_window(PINS, top)
    builder.dock_builder_dock_window(WEIGHTS, bottom)
    builder.dock_builder_dock_window(LIBRARY, bottom)
    builder.dock_builder_finish(space)
