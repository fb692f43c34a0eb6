"""What is copied arrives: whole, a part of it, and on rigs that have other shapes."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facepin.core.errors import FacepinError
from facepin.core.pose import Pose
from facepin.files.work.pose_file import read_pose
from facepin.files.work.pose_text import part_text, pasted, pose_text
from support.small_rigs import sheet

RIG = replace(sheet(), shape_names=("jawOpen", "smile##1", "眨眼", "browUp"))
POSE = Pose(np.array([0.25, 0.0, -0.5, 0.123456789]))


def test_a_copied_pose_comes_back_exactly_and_is_a_pose_file(tmp_path: Path) -> None:
    text = pose_text(RIG, POSE)
    back = pasted(text, RIG)
    assert back.named.all() and back.report == ""
    np.testing.assert_array_equal(back.weights, POSE.weights)
    path = tmp_path / "pose.json"
    path.write_text(text, encoding="utf-8")
    np.testing.assert_array_equal(read_pose(path, RIG)[0].weights, POSE.weights)


def test_a_part_says_nothing_of_the_other_shapes() -> None:
    back = pasted(part_text(RIG, POSE, (1, 2), "mouth"), RIG)
    assert back.named.tolist() == [False, True, True, False]
    assert back.weights.tolist() == [0, 0, -0.5, 0]
    assert back.report == ""


def test_another_rig_takes_what_it_knows_by_name_and_lists_the_rest() -> None:
    other = replace(sheet(), shape_names=("JawOpen", "other", "眨眼", "more"))
    back = pasted(pose_text(RIG, POSE), other)
    assert back.weights.tolist() == [0.25, 0, -0.5, 0]
    assert "smile##1" in back.report and "browUp" in back.report and "become 0" in back.report


@pytest.mark.parametrize(
    "text",
    ["hello", "{}", "[1]", '{"weights": {"a": "b"}}', '{"weights": {"a": 1e99}}', "\0"],
)
def test_what_is_no_pose_is_refused_in_one_line(text: str) -> None:
    with pytest.raises(FacepinError) as refused:
        pasted(text, RIG)
    assert "\n" not in str(refused.value)
