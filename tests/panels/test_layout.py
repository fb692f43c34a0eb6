"""Panels stay where the user put them when everything is made larger or smaller."""

import re

import pytest
from imgui_bundle import imgui

from facepin.core.events import PointerMoved
from facepin.frame.layout_file import scaled
from facepin.panels.requests import Choose
from support.driver import App, running

PANELS = ("Solver", "Pins", "Weights", "Poses")
COLUMNS = """[Docking][Data]
DockSpace     ID=0x01 Window=0x1B Pos=0,23 Size=1600,850 Split=X
  DockNode    ID=0x02 Parent=0x01 SizeRef=900,850 CentralNode=1
  DockNode    ID=0x03 Parent=0x01 SizeRef=698,850 Split=X
    DockNode  ID=0x04 Parent=0x03 SizeRef=298,850 Selected=0x4
    DockNode  ID=0x05 Parent=0x03 SizeRef=398,850 Split=Y
      DockNode ID=0x06 Parent=0x05 SizeRef=398,257 Selected=0x40
      DockNode ID=0x07 Parent=0x05 SizeRef=398,591
"""


def sizes(text: str) -> dict[str, tuple[int, int]]:
    return {
        name: (int(width), int(height))
        for name, width, height in re.findall(r"ID=0x(\d+) .*SizeRef=(\d+),(\d+)", text)
    }


def places(app: App) -> dict[str, list[int]]:
    app.step(PointerMoved(5, 5), frames=6)
    windows = {name: imgui.internal.find_window_by_name(name) for name in PANELS}
    return {name: [round(c) for c in (*w.pos, *w.size)] for name, w in windows.items()}


def test_columns_grow_together_and_the_picture_gives_way() -> None:
    found = sizes(scaled(COLUMNS, 1.25, (1600, 850)))
    assert found["03"][0] == round(1.25 * 698)
    assert found["02"][0] == 1598 - found["03"][0]
    assert found["04"][0] == round(1.25 * 298)
    assert found["04"][0] + found["05"][0] == pytest.approx(1.25 * 696, abs=2)
    assert found["06"][1] == round(1.25 * 257)
    assert found["06"][1] + found["07"][1] == 257 + 591


@pytest.mark.parametrize("factor", [1.5, 2.0, 0.8])
def test_there_and_back_is_as_it_was(factor: float) -> None:
    there = scaled(COLUMNS.replace("698", "460"), factor, (1600, 850))
    assert "Selected=0x4\n" in there
    back = sizes(scaled(there, 1 / factor, (1600, 850)))
    for name, size in sizes(COLUMNS.replace("698", "460")).items():
        assert back[name] == pytest.approx(size, abs=2)


def test_the_program_keeps_what_the_user_arranged() -> None:
    with running(size=(1600, 900)) as app:
        text = imgui.save_ini_settings_to_memory()
        imgui.load_ini_settings_from_memory(re.sub(r"SizeRef=330,", "SizeRef=420,", text))
        before = places(app)
        assert before["Weights"][2] == 420
        app.ask(Choose("ui_scale", 1.5))
        larger = places(app)
        assert larger["Weights"][2] == 630
        assert larger["Solver"][3] > 1.3 * before["Solver"][3]
        app.ask(Choose("ui_scale", 1.0))
        assert places(app) == before


def click(app: App, x: float, y: float) -> None:
    app.press(x, y)
    app.release(x, y)
    app.step(frames=4)


def rows_in_sight(app: App) -> float:
    columns, window = app.desk.view.weights.columns, imgui.internal.find_window_by_name("Weights")
    assert columns is not None
    padding = imgui.get_style().window_padding.y
    return float((window.pos.y + window.size.y - padding - columns.top) / columns.row)


@pytest.mark.parametrize(("size", "scale", "rows"), [((1280, 720), 1.0, 16), ((1920, 1080), 2.0, 10)])
def test_weights_have_the_room_that_the_solver_does_not_need(
    size: tuple[int, int], scale: float, rows: int
) -> None:
    with running(size=size, scale=scale) as app:
        app.step(PointerMoved(5, 5), frames=4)
        assert rows_in_sight(app) >= rows


def test_the_solver_panel_is_as_tall_as_what_it_shows() -> None:
    with running(solver="sparse", size=(1600, 900)) as app:
        window = imgui.internal.find_window_by_name("Solver")
        closed = places(app)["Solver"]
        assert window.scroll_max.y == 0 and window.content_size.y > closed[3] - 60
        fold = closed[0] + 20, closed[1] + closed[3] - 14
        click(app, *fold)
        opened = places(app)["Solver"]
        assert opened[3] > closed[3] + 20 and window.scroll_max.y == 0
        x, y = opened[0] + 100, opened[1] + opened[3] + 1
        app.drag((x, y), (x, y + 120))
        dragged = places(app)["Solver"]
        assert dragged[3] == pytest.approx(opened[3] + 120, abs=3), "the user's height stays"
        click(app, *fold)
        assert places(app)["Solver"] == closed


def test_floating_windows_come_back_inside_when_the_main_window_shrinks() -> None:
    def all_inside() -> bool:
        area = imgui.get_main_viewport()
        spots = [(w.pos, w.size) for w in map(imgui.internal.find_window_by_name, ("Chart", "History"))]
        return all(
            at.x >= area.work_pos.x
            and at.y >= area.work_pos.y
            and at.x + size.x <= area.work_pos.x + area.work_size.x
            and at.y + size.y <= area.work_pos.y + area.work_size.y
            for at, size in spots
        )

    with running(size=(1280, 720)) as app:
        app.desk.view.chart = app.desk.view.history = True
        app.step(PointerMoved(5, 5), frames=4)
        for name, x in (("Chart", 700), ("History", 900)):
            imgui.internal.set_window_dock(imgui.internal.find_window_by_name(name), 0, imgui.Cond_.always)
            imgui.set_window_pos(name, imgui.ImVec2(x, 380))
            imgui.set_window_size(name, imgui.ImVec2(360, 300))
        app.step(PointerMoved(6, 5), frames=4)
        assert all_inside()
        app.window.resize((700, 300))
        app.step(PointerMoved(5, 5), frames=6)
        assert all_inside()
        assert imgui.internal.find_window_by_name("Chart").dock_node is None
