import pytest

from facepin.session.history import History


def test_undo_and_redo_walk_the_line_and_return_the_same_objects() -> None:
    values = [object() for _ in range(4)]
    history = History(values[0])
    for number, value in enumerate(values[1:], 1):
        history.commit(f"step {number}", value)
    assert history.undo_label == "step 3"
    assert history.redo_label is None
    for value in reversed(values[:-1]):
        assert history.undo()
        assert history.current is value
    assert not history.undo()
    for value in values[1:]:
        assert history.redo()
        assert history.current is value
    assert not history.redo()


def test_a_commit_forgets_what_was_undone() -> None:
    history = History(0)
    history.commit("a", 1)
    history.undo()
    history.commit("b", 2)
    assert history.redo_label is None
    history.undo()
    assert history.current == 0


@pytest.mark.parametrize("limit", [1, 3])
def test_the_oldest_steps_go_first(limit: int) -> None:
    history = History(0, limit)
    for value in range(1, 10):
        history.commit("", value)
    undone = []
    while history.undo():
        undone.append(history.current)
    assert undone == list(range(8, 8 - limit, -1))
