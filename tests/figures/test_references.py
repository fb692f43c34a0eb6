"""Poses that people made, as references of the study: from folders, pose files and tables."""

import json
from pathlib import Path

import numpy as np
import pytest

from facepin.__main__ import main
from facepin.core.errors import FacepinError
from facepin.core.pose import Pose
from facepin.core.rig import Rig
from facepin.core.rig_builder import build_rig
from facepin.figures.study.animator import Protocol, animate, make_task
from facepin.figures.study.references import read_references
from facepin.figures.study.study import study
from facepin.files.work.pose_file import write_pose
from facepin.files.work.pose_table import read_pose_table
from facepin.session.solving.solving import choose
from support.small_rigs import sheet

NAMES = ("jawOpen", "eyeBlinkLeft", "eyeBlinkRight", "mouthPucker")
PROTOCOL = Protocol(pins=3, seed=2)


@pytest.fixture(scope="module")
def rig() -> Rig:
    base = sheet(13, 13, shapes=4)
    deltas = base.deltas.toarray().T.reshape(4, -1, 3)
    named = list(zip(NAMES, deltas, strict=True))
    return build_rig("actor", base.neutral, base.corners, base.face_sizes, named)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    poses = tmp_path / "takes"
    poses.mkdir()
    documents = {
        "a smile": {"jawOpen": 0.5, "eyeBlink_L": 0.25, "tongueOut": 0.5, "cheekPuff": 0.0},
        "b rest": {"jawOpen": 0.0},
        "c": {"MouthPucker": 1.0, "tongueOut": 0.25},
    }
    for name, weights in documents.items():
        text = json.dumps({"format": "facepin-pose", "version": 1, "weights": weights})
        (poses / f"{name}.json").write_text(text, encoding="utf-8")
    (poses / "broken.json").write_text("{", encoding="utf-8")
    (poses / "notes.txt").write_text("not a pose", encoding="utf-8")
    return poses


def test_poses_of_a_folder_are_matched_by_name(folder: Path, rig: Rig) -> None:
    found = read_references(folder, rig, most=40)
    assert found.name == "takes"
    assert [pose.tolist() for pose in found.poses] == [[0.5, 0.25, 0, 0], [0, 0, 0, 1.0]]
    unmatched, broken, resting = found.remarks
    assert unmatched == "takes: not in actor: tongueOut"  # once, and not what is 0 anyway
    assert broken.startswith("left out: broken.json")
    assert resting.startswith("takes: left out") and resting.endswith("1 poses")


def test_a_single_pose_is_a_reference_too(tmp_path: Path, rig: Rig) -> None:
    pose = Pose(np.array([0.0, 0.5, 0.0, 0.25]))
    for suffix in (".json", ".csv"):
        write_pose(tmp_path / f"one{suffix}", rig, pose)
        (found,) = read_references(tmp_path / f"one{suffix}", rig, most=40).poses
        np.testing.assert_array_equal(found, pose.weights)


def test_rows_of_a_table_are_poses(tmp_path: Path, rig: Rig) -> None:
    path = tmp_path / "take.csv"
    path.write_text(
        "Timecode,BlendShapeCount,EyeBlinkLeft,jawOpen\n"
        "00:00:01,61,0.5,0.25\n\n00:00:02,0,,\n00:00:03,61,-0.25,1.5\n",
        encoding="utf-8-sig",
    )
    weights, unknown, without = read_pose_table(path, rig)
    assert weights.tolist() == [[0.25, 0.5, 0, 0], [1.5, -0.25, 0, 0]]
    assert unknown == ["Timecode", "BlendShapeCount"]
    assert without == [4]
    found = read_references(path, rig, most=40)
    assert [pose.tolist() for pose in found.poses] == weights.tolist()
    assert found.remarks == (
        "take.csv: not in actor: Timecode, BlendShapeCount",
        "take.csv: left out, for a weight is missing there: line 4",
    )


def test_of_a_long_table_even_rows_are_taken(tmp_path: Path, rig: Rig) -> None:
    path = tmp_path / "long.csv"
    rows = [f"{number / 100}" for number in range(1, 102)]
    path.write_text("\n".join(["jawOpen", *rows]), encoding="utf-8")
    found = read_references(path, rig, most=5)
    assert [pose[0] for pose in found.poses] == [0.01, 0.26, 0.51, 0.76, 1.01]


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("jawOpen,weird\n0.5\nx,1\n", "table.csv:3: jawOpen is 'x', allowed: a number"),
        ("jawOpen\nnan\n", "table.csv:2: jawOpen is 'nan', allowed: a number"),
        ("jawOpen,jawOpen\n1,2\n", "table.csv:1: 'jawOpen' is there twice"),
        ("time,tongue\n1,2\n", "the first row names no shape of actor"),
        ("", "the first row names no shape of actor"),
        ("jawOpen\n", "there is no pose in it that moves actor"),
        ("jawOpen\n0\n", "there is no pose in it that moves actor"),
    ],
)
def test_other_tables_are_refused(tmp_path: Path, rig: Rig, text: str, line: str) -> None:
    path = tmp_path / "table.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(FacepinError, match=line.replace("(", r"\(")):
        read_references(path, rig, most=40)


def test_the_animator_follows_them(folder: Path, rig: Rig) -> None:
    references = read_references(folder, rig, most=40)
    choice = choose("sparse")
    found = study(rig, PROTOCOL, [choice], ["screen"], trials=40, references=references, intervals=True)
    outcomes = [
        animate(rig, make_task(rig, PROTOCOL, trial, pose), choice, "screen")
        for trial, pose in enumerate(references.poses)
    ]
    (row,) = found.rows
    assert found.trials == 2 and found.reference == "takes"
    assert row.outcome.travel == np.median([outcome.travel for outcome in outcomes])
    low, high = row.intervals["travel"]
    assert (low, high) == (min(o.travel for o in outcomes), max(o.travel for o in outcomes))


def test_a_given_reference_changes_no_tremor_of_drawn_ones(rig: Rig) -> None:
    """What was drawn by chance before is drawn again: figures of old studies can be remade."""
    task = make_task(rig, Protocol(shapes=2), 3)
    random = np.random.default_rng([1, 3])
    chosen = random.choice(4, 2, replace=False)
    amounts = random.uniform(0.4, 1.0, 2)
    assert task.reference[chosen].tolist() == amounts.tolist()
    assert task.tremor.ravel()[0] == random.normal(0.0, 0.003 * rig.height, 1)[0]


@pytest.fixture
def npz(rig: Rig, tmp_path: Path) -> Path:
    path = tmp_path / "actor.npz"
    deltas = rig.deltas.toarray().T.reshape(4, -1, 3)
    np.savez(path, neutral=rig.neutral, faces=rig.corners.reshape(-1, 4), deltas=deltas, names=NAMES)
    return path


def test_command_follows_a_folder_on_several_rigs(
    npz: Path, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    second = npz.with_name("stand-in.npz")
    second.write_bytes(npz.read_bytes())
    small = ["--pins", "2", "--jobs", "1", "--solvers", "sparse", "--freedom", "screen", "--json"]
    assert main(["study", str(npz), str(second), "--reference", str(folder), *small]) == 0
    told = capsys.readouterr()
    found = json.loads(told.out)
    assert [(row["rig"], row["solver"]) for row in found["rows"]] == [
        ("actor", "sparse"),
        ("stand-in", "sparse"),
    ]
    assert found["settings"]["reference"] == "takes"
    assert [rig["trials"] for rig in found["settings"]["rigs"]] == [2, 2]
    assert told.err.count("not in actor: tongueOut") == 1
    assert told.err.count("not in stand-in: tongueOut") == 1


@pytest.mark.parametrize(
    ("options", "line"),
    [
        (["--reference", "nowhere"], "nowhere: no such file or folder"),
        (["--reference", ".", "--shapes", "3"], "--shapes and --without are for poses drawn by chance"),
        (["--reference", ".", "--drags"], "--reference is not used with --drags"),
    ],
)
def test_command_refuses_in_one_line(
    npz: Path, options: list[str], line: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["study", str(npz), *options]) == 2
    told = capsys.readouterr()
    assert line in told.err and told.err.count("\n") == 1 and not told.out
