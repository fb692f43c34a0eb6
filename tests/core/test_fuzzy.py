"""How a few typed letters find what is meant."""

import pytest

from facepin.core.fuzzy import match

TITLES = (
    "Wireframe",
    "Frame the face",
    "Save picture",
    "Save pose…",
    "Reset the pose",
    "Reference from a file…",
)


def ranked(word: str, phrases: tuple[str, ...] = TITLES) -> list[str]:
    found = [(match(word, phrase), phrase) for phrase in phrases]
    fitting = [(way[0], phrase) for way, phrase in found if way is not None]
    return [phrase for _, phrase in sorted(fitting, reverse=True)]


@pytest.mark.parametrize(
    ("word", "first"),
    [
        ("frame", "Frame the face"),  # a word of its own before a part of one
        ("wf", "Wireframe"),
        ("spi", "Save picture"),
        ("rp", "Reset the pose"),
        ("POSE", "Save pose…"),
        ("rff", "Reference from a file…"),
    ],
)
def test_what_is_meant_comes_first(word: str, first: str) -> None:
    assert ranked(word)[0] == first


def test_letters_out_of_order_or_missing_are_not_found() -> None:
    assert match("ew", "Wireframe") is None
    assert match("wirez", "Wireframe") is None
    assert match("png", "Add the poses of another rig…") is None  # they are there, but nobody means that
    assert match("", "Wireframe") is None
    assert match("a", "") is None


def test_the_letters_found_are_those_that_fit_best() -> None:
    found = match("pose", "Compare the pose")
    assert found is not None
    assert found[1] == (12, 13, 14, 15)


def test_phrases_whose_small_form_is_longer_are_searched_too() -> None:
    found = match("x", "İİ x")
    assert found is None or found[1][-1] < len("İİ x")
