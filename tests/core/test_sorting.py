"""The order of names for people."""

import random

from facepin.core.sorting import natural_key


def test_numbers_count_as_numbers_and_capitals_for_nothing() -> None:
    names = ["", "7", "10", "Anger", "anger 2", "Anger 10", "pose", "pose1", "pose02", "pose10", "pose10a2"]
    names += ["pose10a10", "v1.9", "v1.10", "ärger", "9" * 5000]
    names = sorted(names, key=natural_key)
    assert names.index("pose02") < names.index("pose10") < names.index("pose10a2") < names.index("pose10a10")
    assert names.index("anger 2") < names.index("Anger 10")
    assert names.index("v1.9") < names.index("v1.10")
    shuffled = random.Random(1).sample(names, len(names))
    assert sorted(shuffled, key=natural_key) == names


def test_only_equal_names_have_equal_keys() -> None:
    names = ["a1", "a01", "A1", "a\u0308", "\xe4", "a 1"]
    assert len({natural_key(name) for name in names}) == len(names)
