"""The titles of several panes leave room for the faces."""

import pytest
from imgui_bundle import imgui

from facepin.core.events import PointerMoved
from support.driver import running


@pytest.mark.parametrize(
    ("solvers", "size", "lines"), [(2, (1280, 720), 3), (4, (1280, 720), 1), (4, (700, 480), 4)]
)
def test_a_title_takes_as_many_lines_as_the_pane_allows(
    solvers: int, size: tuple[int, int], lines: int
) -> None:
    keys = ("transpose", "tikhonov", "pseudo_inverse", "hybrid")[:solvers]
    with running(solver=",".join(keys), size=size) as app:
        app.step(PointerMoved(5, 5), frames=2)
        line = imgui.get_text_line_height_with_spacing()
        padding = 2 * imgui.get_style().window_padding.y
        for at, viewport in enumerate(app.frame.viewports):
            window = imgui.internal.find_window_by_name(f"##pane {at}")
            assert window.size.y <= lines * line + padding + 4
            assert window.size.x <= viewport.width


def test_only_the_button_of_a_title_is_in_the_way_of_the_hand() -> None:
    with running(solver="transpose,tikhonov", size=(1280, 720)) as app:
        window = imgui.internal.find_window_by_name("##pane 0")
        x, y = window.pos.x + imgui.get_style().window_padding.x, window.pos.y
        app.step(PointerMoved(x + 8, y + 0.6 * imgui.get_text_line_height() + 8), frames=4)
        assert imgui.get_io().want_capture_mouse
        app.step(PointerMoved(x + 8, y + window.size.y - 12), frames=4)
        assert not imgui.get_io().want_capture_mouse
        assert window.size.y > 3 * imgui.get_text_line_height()
