"""How the poses of a library are found, ordered and moved, and what undo leaves alone."""

from dataclasses import replace

import numpy as np
import pytest

from facepin.core.arrays import frozen
from facepin.core.saved_pose import SavedPose, clean_tags
from facepin.session.shelf import blended, differences, found, moved, next_order, standing


def pose(key: str, order: float | None = None, title: str = "", tags: tuple[str, ...] = ()) -> SavedPose:
    return SavedPose(key, title or key, tags, order, frozen(np.zeros(3), np.float64), "", {})


def row(*poses: SavedPose) -> tuple[SavedPose, ...]:
    return standing({each.key: each for each in poses}, {})


def keys(poses: tuple[SavedPose, ...]) -> str:
    return "".join(each.key for each in poses)


def test_poses_stand_by_order_and_those_without_one_last_by_name() -> None:
    assert keys(row(pose("d"), pose("b", 2), pose("a", 3), pose("c", -1), pose("e", title="A"))) == "cbaed"
    assert next_order([]) == 1
    assert next_order([pose("a", 4), pose("b")]) == 5


def test_a_shelf_changes_and_removes_and_says_nothing_of_what_came_later() -> None:
    stored = {key: pose(key, at) for at, key in enumerate("abc")}
    shelf = {"a": replace(stored["a"], title="renamed"), "b": None}
    assert [each.title for each in standing(stored, shelf)] == ["renamed", "c"]
    stored["d"] = pose("d", 9)
    assert keys(standing(stored, shelf)) == "acd"
    assert keys(standing(stored, {})) == "abcd"


@pytest.mark.parametrize("orders", [(1, 2, 3, 4), (None,) * 4, (1, 2, None, None), (1, 1, 1, 1)])
def test_every_move_leads_where_it_should(orders: tuple[float | None, ...]) -> None:
    poses = row(*(pose(key, order) for key, order in zip("abcd", orders, strict=True)))
    for key in "abcd":
        for before in [*"abcd", None]:
            others = [other for other in "abcd" if other != key]
            at = "abcd".index(key) if before == key else others.index(before) if before else 3
            wanted = "".join([*others[:at], key, *others[at:]])
            changes = moved(poses, key, before)
            assert keys(standing({each.key: each for each in poses}, changes)) == wanted
            assert (not changes) == (wanted == "abcd")
            if orders == (1, 2, 3, 4):
                assert len(changes) <= 1  # each change is a file to be written


def test_moving_for_ever_between_two_still_moves() -> None:
    poses = row(pose("a", 1), pose("b", 2), pose("c", 3))
    for number in range(200):
        changes = moved(poses, "bc"[number % 2], "cb"[number % 2])
        changes = changes or moved(poses, "cb"[number % 2], "bc"[number % 2])
        before = keys(poses)
        poses = standing({each.key: each for each in poses}, changes)
        assert keys(poses) != before
        assert len({each.order for each in poses}) == 3


def test_words_are_found_in_names_and_tags() -> None:
    poses = row(pose("a", 1, "Big smile", ("happy",)), pose("b", 2, "Frown", ("sad", "mouth")))
    assert keys(found(poses, "")) == "ab"
    assert keys(found(poses, "SMILE happy")) == "a"
    assert keys(found(poses, "mouth fr")) == "b"
    assert keys(found(poses, "smile sad")) == ""


def test_a_blend_is_exact_at_both_ends() -> None:
    start, goal = np.array([0.1, 0.7, -0.3]), np.array([0.3, 0.2, 1.4])
    np.testing.assert_array_equal(blended(start, goal, 0.0), start)
    np.testing.assert_array_equal(blended(start, goal, 1.0), goal)
    np.testing.assert_allclose(blended(start, goal, 0.25), [0.15, 0.575, 0.125])


def test_differences_come_biggest_first_and_equal_ones_not_at_all() -> None:
    assert differences(np.array([0.0, 1.0, 0.5, 0.2]), np.array([0.2, 0.1, 0.5, 0.2])) == (1, 0)


def test_tags_are_short_printable_and_none_twice() -> None:
    assert clean_tags(" happy, mouth ,happy,, \x1b[1mloud\n") == ("happy", "mouth", "loud")
    assert len(clean_tags(",".join(map(str, range(100))))) == 16
