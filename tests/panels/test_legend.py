"""The legend of the heat map."""

from collections.abc import Iterator

import pytest
from imgui_bundle import imgui

from facepin.core.look.camera import Viewport
from facepin.panels.picture.legend import heat_legend
from facepin.panels.theme import THEMES, apply_theme


@pytest.fixture
def frame() -> Iterator[None]:
    """An imgui frame without a window."""
    context = imgui.create_context()
    imgui.get_io().set_ini_filename(None)  # else the layout is written where tests are run
    io = imgui.get_io()
    io.set_ini_filename(None)
    io.display_size = imgui.ImVec2(800, 600)
    io.backend_flags |= imgui.BackendFlags_.renderer_has_textures
    apply_theme(THEMES["dark"], 1.0)
    imgui.new_frame()
    yield
    imgui.end_frame()
    imgui.destroy_context(context)


def corners() -> list[tuple[float, float]]:
    return [(vertex.pos.x, vertex.pos.y) for vertex in imgui.get_background_draw_list().vtx_buffer]


@pytest.mark.parametrize("height", [0.3, 27.8, 5000.0])
@pytest.mark.usefixtures("frame")
def test_it_stands_at_the_lower_right_of_its_pane(height: float) -> None:
    place = Viewport(100, 50, 600, 500)
    heat_legend(height, place, pixel_ratio=1.0, scale=1.0)
    x, y = zip(*corners(), strict=True)
    assert 100 + 300 < min(x) < max(x) < 700
    assert 50 + 250 < min(y) < max(y) < 550


@pytest.mark.usefixtures("frame")
def test_it_is_as_large_on_the_screen_whatever_the_pixels() -> None:
    heat_legend(1.0, Viewport(0, 0, 1600, 1200), pixel_ratio=2.0, scale=1.0)
    x, y = zip(*corners(), strict=True)
    assert max(x) < 800
    assert max(y) < 600


@pytest.mark.usefixtures("frame")
def test_a_tiny_pane_goes_without() -> None:
    heat_legend(1.0, Viewport(0, 0, 200, 150), pixel_ratio=1.0, scale=1.0)
    assert not corners()
