"""Which lines the weights panel lists, and when it makes them anew."""

import numpy as np
import pytest

from facepin.core.rig import Rig
from facepin.files import open_rig
from facepin.panels.weights.columns import Columns
from facepin.panels.weights.listing import ARRANGEMENTS, Arrangement, Group, Listing
from facepin.resources import resource

NONE: frozenset[str] = frozenset()


@pytest.fixture(scope="module")
def ada() -> Rig:
    return open_rig(resource("assets", "faces/ada.npz"))


@pytest.mark.parametrize("arrangement", ARRANGEMENTS)
def test_every_shape_is_listed_once(ada: Rig, arrangement: Arrangement) -> None:
    weights = np.linspace(-1, 1, ada.shape_count)
    lines = Listing(ada).lines(arrangement, "", NONE, weights, in_gesture=False)
    shapes = [line for line in lines if not isinstance(line, Group)]
    assert sorted(shapes) == list(range(ada.shape_count))


def test_groups_hold_their_shapes_and_fold(ada: Rig) -> None:
    listing, weights = Listing(ada), np.zeros(ada.shape_count)
    lines = listing.lines("by region", "", NONE, weights, in_gesture=False)
    names = [line.name for line in lines if isinstance(line, Group)]
    assert names == ["brows", "eyes", "cheeks", "nose", "mouth", "jaw", "tongue"]
    folded = listing.lines("by region", "", frozenset({"brows", "mouth"}), weights, in_gesture=False)
    gone = {j for j in lines if not isinstance(j, Group)} - {j for j in folded if not isinstance(j, Group)}
    assert {ada.shape_names[j][:4] for j in gone} == {"brow", "mout"}


def test_a_search_opens_folded_groups_and_leaves_others_out(ada: Rig) -> None:
    lines = Listing(ada).lines("by side", "brow  up", frozenset({"left"}), np.zeros(52), in_gesture=False)
    told = [line.name if isinstance(line, Group) else ada.shape_names[line] for line in lines]
    assert told == ["left", "browOuterUpLeft", "right", "browOuterUpRight", "both", "browInnerUp"]


def test_lines_by_weight_stay_while_something_is_moved(ada: Rig) -> None:
    listing, weights = Listing(ada), np.zeros(ada.shape_count)
    weights[7] = -0.5
    first = listing.lines("by weight", "", NONE, weights, in_gesture=False)
    assert first[0] == 7
    moved = weights.copy()
    moved[9] = 0.9
    assert listing.lines("by weight", "", NONE, moved, in_gesture=True) is first
    assert listing.lines("by weight", "", NONE, moved, in_gesture=False)[:2] == (9, 7)


@pytest.mark.parametrize("arrangement", ["rig order", "by region", "by side"])
def test_nothing_is_done_for_each_shape_when_only_weights_change(ada: Rig, arrangement: Arrangement) -> None:
    listing = Listing(ada)
    first = listing.lines(arrangement, "eye", NONE, np.zeros(52), in_gesture=False)
    assert listing.lines(arrangement, "eye", frozenset(), np.ones(52), in_gesture=False) is first


def test_active_shapes_are_counted_by_group(ada: Rig) -> None:
    weights = np.zeros(ada.shape_count)
    weights[:3] = 0.06, -0.2, 0.04
    assert Listing(ada).active("by region", weights)["brows"] == 2
    assert Listing(ada).active("rig order", weights) == {}


def test_columns_tell_what_is_where() -> None:
    columns = Columns.fitted(100.0, 400.0, 50.0, widest=500.0, scale=1.0)
    begin, end = columns.slider
    assert end - begin > 90, "names leave room for sliders"
    zones = [columns.zone(x) for x in (columns.name, columns.icon(0), columns.icon(1), columns.icon(2))]
    assert zones == ["name", "solo", "mute", "lock"]
    assert columns.zone((begin + end) / 2) == "slider" and columns.zone(395.0) == "number"
    assert columns.line(columns.y(7) + 1) == 7 and columns.line(49.0) == -1
    for value in (-0.5, 0.0, 0.3, 1.0):
        assert columns.value(columns.x(value, (-0.5, 1.0)), (-0.5, 1.0)) == pytest.approx(value)
    assert columns.x(3.0, (0.0, 1.0)) == end and columns.x(0.2, (0.0, 0.0)) == begin
