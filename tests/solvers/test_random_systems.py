"""Systems drawn by chance: every answer is finite, within limits and ties, and the minimum."""

import pytest

from fuzz.systems import KEYS, any_problem, faults


@pytest.mark.parametrize("key", KEYS)
def test_every_answer_is_the_minimum(key: str) -> None:
    wrong = [
        f"seed {seed}: {fault}"
        for seed in range(100)
        for fault in faults(any_problem(seed), key, proved=True, timed=False)
    ]
    assert wrong == []


@pytest.mark.parametrize("key", KEYS)
@pytest.mark.parametrize("most", [0, 1, 2, 5])
def test_where_steps_run_out_the_answer_obeys_limits_and_ties_and_says_so(
    monkeypatch: pytest.MonkeyPatch, key: str, most: int
) -> None:
    monkeypatch.setattr("facepin.solvers.boxed.MOST_STEPS", most)
    monkeypatch.setattr("facepin.solvers.ties.MOST_STEPS", most)
    found = [
        fault for seed in range(100) for fault in faults(any_problem(seed), key, proved=True, timed=False)
    ]
    assert found
    assert all("gave up after" in fault for fault in found), found
