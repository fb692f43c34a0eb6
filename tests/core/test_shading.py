"""The ways to show a face: one shading per pane, edges and ghosts over any of them."""

from itertools import pairwise

import numpy as np

from facepin.core.look.shading import MODES
from facepin.panels.view import PaneView
from support.driver import running


def test_a_key_goes_through_all_modes_and_begins_again() -> None:
    view = PaneView()
    seen = []
    for _ in MODES:
        seen.append(view.mode)
        view.next_mode()
    assert seen == list(MODES)
    assert view.mode == "studio"


def test_edges_lie_over_any_shading_and_the_key_still_goes_on() -> None:
    view = PaneView(wireframe=True)
    assert view.mode is None
    view.next_mode()
    assert (view.mode, view.wireframe) == ("clay", False)
    view.wireframe = True
    assert view.mode == "wireframe"
    view.shading = "normals"
    view.next_mode()
    assert view.mode == "heat"


def test_the_heat_map_gives_way_to_what_was_there_before() -> None:
    view = PaneView(shading="clay", wireframe=True)
    view.toggle_heat()
    assert (view.shading, view.wireframe, view.measured) == ("heat", True, True)
    view.toggle_heat()
    assert (view.mode, view.measured) == ("wireframe", False)


def test_keys_in_the_window() -> None:
    with running(size=(500, 360)) as app:
        view = app.desk.view.panes[0]
        pictures = [app.screenshot()[40:250, :180].astype(int)]
        for _ in MODES:
            app.key("s")
            pictures.append(app.screenshot()[40:250, :180].astype(int))
        assert view.mode == "studio"
        np.testing.assert_array_equal(pictures[0], pictures[-1])
        for one, other in pairwise(pictures):
            assert np.abs(one - other).max() > 40
        app.key("s")
        app.key("h")
        assert view.shading == "heat"
        app.key("h")
        app.key("w")
        assert view.mode == "wireframe"
        assert not app.desk.session.undo(), "looking is nothing to undo"
