"""The card that tells which shapes move a vertex, drawn without a window."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from imgui_bundle import imgui

from facepin.core.control import ShapeControl
from facepin.core.shapes.motion import movers
from facepin.panels.picture.vertex_card import vertex_card
from support.small_rigs import sheet


@pytest.fixture
def texts(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[str]]:
    """What is written between two frames."""
    written: list[str] = []
    for name in ("text", "text_disabled"):
        monkeypatch.setattr(imgui, name, written.append)
    imgui.create_context()
    imgui.get_io().set_ini_filename(None)  # else the layout is written where tests are run
    io = imgui.get_io()
    io.backend_flags |= imgui.BackendFlags_.renderer_has_textures
    io.display_size = imgui.ImVec2(800, 600)
    imgui.new_frame()
    yield written
    imgui.end_frame()
    imgui.destroy_context()


def test_shapes_are_listed_with_what_holds_them(texts: list[str]) -> None:
    rig = sheet(shapes=20)
    vertex = int(np.argmax(np.count_nonzero(rig.rows_at(range(81)).reshape(81, 3, -1).any(axis=1), axis=1)))
    found = movers(rig, vertex)
    assert len(found) > 10
    locked = np.zeros(20, bool)
    locked[found[0][0]] = True
    vertex_card(rig, replace(ShapeControl.of(rig), locked=locked), "chin", found, 1.0)
    assert texts[0] == f"Chin: {len(found)} shapes, % of face height"
    assert texts[1:21:2] == [rig.shape_names[j] for j, _ in found[:10]]
    assert texts[2].endswith("locked") and not texts[4].endswith("locked")
    assert texts[-1] == f"and {len(found) - 10} more"


def test_a_vertex_that_nothing_moves_says_so(texts: list[str]) -> None:
    rig = sheet()
    vertex_card(rig, ShapeControl.of(rig), "hair", [], 1.0)
    assert texts == ["No shape moves this place (hair)"]
