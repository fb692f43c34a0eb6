"""Poses and pins as files, and poses that come to another rig."""

import json
from pathlib import Path

import numpy as np
import pytest

from facepin.core.errors import FacepinError
from facepin.core.pose import FRONT_AXES, Pin, Pose
from facepin.core.rig_builder import build_rig
from facepin.files.work.pins_file import read_pins, write_pins
from facepin.files.work.pose_file import read_pose, write_pose
from facepin.files.work.pose_table import read_pose_table
from facepin.files.work.shape_spelling import match_shapes, spelling
from support.sample_files import POSITIONS
from support.small_rigs import sheet

PINS = (
    Pin(2, (0.1, -3.0, 8.25)),
    Pin(0, (1.0, 2.0, 3.0), "screen", ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0)), 2.5),
)


def rig_of(*names, vertices=4):
    positions = np.resize(POSITIONS, (vertices, 3))
    shapes = [(name, np.full((vertices, 3), j + 1.0)) for j, name in enumerate(names)]
    return build_rig("girl", positions, [0, 1, 2], [3], shapes)


RIG = rig_of("jawOpen", "eyeBlink_L", "Lächeln, breit")
POSE = Pose(np.array([0.1, -0.5, 1.75]), PINS)


@pytest.mark.parametrize("suffix", [".json", ".JSON", ".csv"])
def test_a_pose_comes_back(tmp_path, suffix):
    path = tmp_path / f"pose{suffix}"
    write_pose(path, RIG, POSE)
    pose, report = read_pose(path, RIG)
    assert pose.weights.tolist() == [0.1, -0.5, 1.75]
    assert pose.pins == (() if suffix == ".csv" else PINS)
    assert not pose.weights.flags.writeable
    assert report == ""


def test_the_layout_of_a_pose_file(tmp_path):
    write_pose(tmp_path / "p.json", RIG, POSE)
    assert json.loads((tmp_path / "p.json").read_text(encoding="utf-8")) == {
        "format": "facepin-pose",
        "version": 1,
        "rig": {"name": "girl", "shapes": 3, "vertices": 4},
        "weights": {"jawOpen": 0.1, "eyeBlink_L": -0.5, "Lächeln, breit": 1.75},
        "pins": [
            {"vertex": 2, "goal": [0.1, -3.0, 8.25]},
            {
                "vertex": 0,
                "goal": [1.0, 2.0, 3.0],
                "freedom": "screen",
                "axes": [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0]],
                "stiffness": 2.5,
            },
        ],
    }
    write_pose(tmp_path / "p.csv", RIG, POSE)
    assert (tmp_path / "p.csv").read_text(encoding="utf-8").splitlines() == [
        "shape,weight",
        "jawOpen,0.1",
        "eyeBlink_L,-0.5",
        '"Lächeln, breit",1.75',
    ]


@pytest.mark.parametrize(
    "name", ["eyeBlink_L", "eyeBlinkLeft", "EyeBlinkLeft", "x.eyeBlinkLeft", "a.b.EyeBlink_L"]
)
@pytest.mark.parametrize(
    "shape", ["eyeBlink_L", "eyeBlinkLeft", "EyeBlinkLeft", "x.eyeBlinkLeft", "eyeBlink.L"]
)
def test_the_spellings_of_one_shape(name, shape):
    assert spelling(name) == spelling(shape)
    same = name == shape or "." not in name or "x." not in shape  # two prefixes say two things
    assert match_shapes([name], ["eyeBlinkRight", "jawOpen", shape, "eyeBlink"]) == [2 if same else None]


def test_different_shapes_stay_different():
    names = [
        "eyeBlink_L",
        "eyeBlink_R",
        "eyeBlink",
        "eyeblink_L",
        "jawLeft",
        "jaw",
        "Left",
        "mouthLeft",
        "_L",
        "x.",
    ]
    assert len({spelling(name) for name in names}) == len(names)


def test_the_very_name_comes_before_another_spelling_and_none_is_used_twice():
    shapes = ["EyeBlinkLeft", "eyeBlink_L"]
    assert match_shapes(["eyeBlink_L", "jawOpen"], shapes) == [1, None]
    assert match_shapes(["x.eyeBlinkLeft"], shapes) == [None]  # which of both is meant, nobody can tell
    assert match_shapes(["jawOpen", "x.jawOpen", "JawOpen"], ["JAWOpen", "jawOpen"]) == [1, None, None]


@pytest.mark.parametrize(
    ("names", "shapes", "found"),
    [
        (["smile.001", "mouth.open"], ["blink.001", "smile", "eyes.open", "jaw"], [None, None]),
        (["smile.001"], ["Smile.001", "smile"], [0]),
        (["open"], ["eyes.open", "mouth.open"], [None]),
        (["open"], ["mouth.open", "jaw"], [0]),
        (["head.open", "head.smile"], ["teeth.smile", "teeth.open"], [1, 0]),
        (["head.open", "face.smile"], ["teeth.smile", "teeth.open"], [1, 0]),
        (["Lächeln", "かお"], ["La\u0308cheln", "か\u304a"], [0, 1]),
        (["x" * 70 + "_R"], ["x" * 70 + "_L", "x" * 70 + "_R"], [1]),
        (["a b"], ["  a  b "], [0]),
        (["a b"], ["  a  b ", " a b"], [None]),
        (["x" * 63 + "…"], ["x" * 70], [0]),
    ],
)
def test_nothing_is_matched_that_is_not_unique(names, shapes, found):
    assert match_shapes(names, shapes) == found


def test_weights_that_find_no_shape_are_listed(tmp_path):
    (tmp_path / "p.json").write_text('{"weights": {"smile.001": 0.8, "mouth.open": 0.7}}')
    pose, report = read_pose(tmp_path / "p.json", rig_of("blink.001", "smile", "eyes.open"))
    assert not pose.weights.any()
    assert "2 of 2 shapes are not in this rig: smile.001, mouth.open" in report


def test_a_pose_of_another_rig_says_what_did_not_match(tmp_path):
    path = tmp_path / "p.json"
    write_pose(
        path,
        rig_of("x.eyeBlinkLeft", "JawOpen", "tongueOut", "cheekPuff", vertices=9),
        Pose(np.arange(4.0), PINS),
    )
    pose, report = read_pose(path, RIG)
    assert pose.weights.tolist() == [1.0, 0.0, 0.0]
    assert pose.pins == ()
    assert "2 of 4 shapes are not in this rig: tongueOut, cheekPuff" in report
    assert "1 shapes of this rig are not in the file" in report
    assert "mesh of 9 vertices" in report


def test_a_pose_with_the_least_that_is_needed(tmp_path):
    (tmp_path / "p.json").write_text('{"weights": {"JawOpen": 1}}')
    pose, report = read_pose(tmp_path / "p.json", RIG)
    assert pose.weights.tolist() == [1.0, 0.0, 0.0]
    assert "2 shapes" in report
    (tmp_path / "p.csv").write_text("jawOpen,0.25\r\n\r\n")
    assert read_pose(tmp_path / "p.csv", RIG)[0].weights.tolist() == [0.25, 0.0, 0.0]


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("p.json", "", "not JSON"),
        ("p.json", "[1]", "root is a list of 1"),
        ("p.json", "{}", "weights is missing"),
        ("p.json", '{"weights": []}', "weights is a list of 0, allowed: an object"),
        ("p.json", '{"weights": {"jawOpen": NaN}}', "NaN is not a JSON number"),
        ("p.json", '{"weights": {"jawOpen": 1e999}}', r"weights\.jawOpen is inf"),
        ("p.json", '{"weights": {"jawOpen": "1"}}', r"weights\.jawOpen is '1', allowed: a number"),
        ("p.json", '{"weights": {"jawOpen": true}}', r"weights\.jawOpen is True"),
        ("p.json", '{"format": "other", "weights": {}}', "format is 'other'"),
        ("p.json", '{"version": 2, "weights": {}}', "version is 2, allowed: 1"),
        ("p.json", '{"weights": {}, "pins": [{"vertex": 4, "goal": [0, 0, 0]}]}', r"pins\[0\]\.vertex is 4"),
        ("p.json", '{"weights": {"' + "[" * 100 + '": 1' * 2, "not JSON"),
        ("p.json", '{"weights": ' + "[" * 100_000, "nested too deeply"),
        ("p.csv", "shape,weight\njawOpen,x\n", r"p\.csv:2: found 'jawOpen,x'"),
        ("p.csv", "shape,weight\njawOpen,nan\n", ":2:"),
        ("p.csv", "jawOpen\n", ":1:"),
        ("p.csv", "a,1,2\n", ":1:"),
        ("p.csv", "a,1e7\n", "a number up to 1e"),
        ("p.csv", "jawOpen,0.5\njawOpen,0.7\n", r"p\.csv:2: 'jawOpen' is there twice"),
        ("p.csv", "", "no weights"),
        ("p.txt", "", r"no poses in '\.txt', there are: \.json, \.csv"),
    ],
)
def test_what_is_no_pose_is_refused(tmp_path, name, text, words):
    (tmp_path / name).write_text(text)
    with pytest.raises(FacepinError, match=words):
        read_pose(tmp_path / name, RIG)


def test_poses_that_are_not_there_or_not_text(tmp_path):
    for name in ("p.json", "p.csv"):
        with pytest.raises(FacepinError, match="no such file"):
            read_pose(tmp_path / name, RIG)
        (tmp_path / name).write_bytes(b"\xff\xfe{}")
        with pytest.raises(FacepinError, match="UTF-8"):
            read_pose(tmp_path / name, RIG)
    with pytest.raises(FacepinError, match=r"no poses in '\.fbx'"):
        write_pose(tmp_path / "p.fbx", RIG, POSE)


def test_pins_come_back(tmp_path):
    write_pins(tmp_path / "pins.json", PINS)
    assert read_pins(tmp_path / "pins.json", RIG) == PINS
    write_pose(tmp_path / "pose.json", RIG, POSE)
    assert read_pins(tmp_path / "pose.json", RIG) == PINS


def test_names_locks_and_hidden_pins_come_back_and_take_no_room_where_they_are_not(tmp_path: Path) -> None:
    pins = (
        Pin(2, (0.1, -3.0, 8.25), name="Mundwinkel, links “L”", locked=True),
        Pin(0, (1.0, 2.0, 3.0), hidden=True),
        Pin(1, (1.0, 2.0, 3.0)),
    )
    write_pins(tmp_path / "pins.json", pins)
    assert read_pins(tmp_path / "pins.json", RIG) == pins
    write_pose(tmp_path / "pose.json", RIG, POSE.with_pins(pins))
    assert read_pose(tmp_path / "pose.json", RIG)[0].pins == pins
    written = json.loads((tmp_path / "pins.json").read_text())["pins"]
    assert [sorted(entry) for entry in written] == [
        ["goal", "locked", "name", "vertex"],
        ["goal", "hidden", "vertex"],
        ["goal", "vertex"],
    ]


def test_what_a_later_program_says_of_a_pin_is_passed_over(tmp_path: Path) -> None:
    (tmp_path / "p.json").write_text('{"pins": [{"vertex": 2, "goal": [0, 1, 2], "colour": "red"}]}')
    assert read_pins(tmp_path / "p.json", RIG) == (Pin(2, (0.0, 1.0, 2.0)),)


def test_a_move_is_from_the_neutral(tmp_path):
    (tmp_path / "p.json").write_text('{"pins": [{"vertex": 2, "move": [0, -1, 0.5], "freedom": "screen"}]}')
    assert read_pins(tmp_path / "p.json", RIG) == (Pin(2, (1.0, 0.0, 0.5), "screen", FRONT_AXES),)


@pytest.mark.parametrize(
    ("pin", "words"),
    [
        ("3", "is 3, allowed: an object"),
        ('{"goal": [0, 0, 0]}', "vertex is missing"),
        ('{"vertex": -1, "goal": [0, 0, 0]}', "vertex is -1, allowed: a whole number 0 to 3"),
        ('{"vertex": 1.5, "goal": [0, 0, 0]}', "vertex is 1.5"),
        ('{"vertex": 1}', "either a goal or a move"),
        ('{"vertex": 1, "goal": [0, 0, 0], "move": [0, 0, 0]}', "either a goal or a move"),
        ('{"vertex": 1, "goal": [0, 0]}', "goal is a list of 2, allowed: a list of 3 finite numbers"),
        ('{"vertex": 1, "goal": [0, 0, 1e30]}', "goal"),
        ('{"vertex": 1, "move": [0, 0, null]}', "move"),
        (
            '{"vertex": 1, "move": [0, 0, 0], "freedom": "plane"}',
            'freedom is \'plane\', allowed: "space" or "screen"',
        ),
        ('{"vertex": 1, "move": [0, 0, 0], "stiffness": 0}', "stiffness is 0"),
        ('{"vertex": 1, "move": [0, 0, 0], "name": 3}', "name is 3, allowed: a text"),
        ('{"vertex": 1, "move": [0, 0, 0], "name": "a\\nb"}', "without line ends"),
        ('{"vertex": 1, "move": [0, 0, 0], "locked": 1}', "locked is 1, allowed: true or false"),
        ('{"vertex": 1, "move": [0, 0, 0], "hidden": "no"}', "hidden is 'no', allowed: true or false"),
        ('{"vertex": 1, "move": [0, 0, 0], "axes": [[1, 0, 0]]}', "axes"),
        ('{"vertex": 1, "move": [0, 0, 0], "axes": [[1, 0, 0], [2, 0, 0]]}', "axes"),
    ],
)
def test_wrong_pins_are_refused(tmp_path, pin, words):
    (tmp_path / "p.json").write_text(f'{{"pins": [{{"vertex": 0, "goal": [0, 0, 0]}}, {pin}]}}')
    with pytest.raises(FacepinError, match=words) as error:
        read_pins(tmp_path / "p.json", RIG)
    assert "p.json: pins[1]" in str(error.value)


def test_a_file_without_pins_is_not_a_pins_file(tmp_path):
    (tmp_path / "p.json").write_text("{}")
    with pytest.raises(FacepinError, match="pins is missing"):
        read_pins(tmp_path / "p.json", RIG)


def test_two_pins_on_one_vertex_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "pins.json"
    path.write_text('{"pins": [{"vertex": 3, "move": [0, 1, 0]}, {"vertex": 3, "move": [0, -1, 0]}]}')
    with pytest.raises(FacepinError, match=r"pins\[1\].*vertex 3 is held by.*pins\[0\]"):
        read_pins(path, sheet())


@pytest.mark.parametrize("suffix", [".json", ".csv"])
def test_no_pose_is_written_that_could_not_be_read_again(tmp_path: Path, suffix: str) -> None:
    weights = np.zeros(RIG.shape_count)
    weights[0] = 2e6
    with pytest.raises(FacepinError, match="hold up to"):
        write_pose(tmp_path / f"p{suffix}", RIG, Pose(weights))
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "text",
    [
        "shape;weight\njawOpen;0,25\n",
        "\ufeffshape;weight\r\njawOpen;0,25\r\neyeBlink_L;-1,5e-1\r\n",
        "jawOpen;0.25\n",
        'sep=;\nshape;weight\njawOpen;"0,25"\n',
        'shape,weight\njawOpen,"0,25"\n',
    ],
)
def test_tables_with_semicolons_and_decimal_commas_are_read(tmp_path, text):
    (tmp_path / "p.csv").write_bytes(text.encode())
    pose, _ = read_pose(tmp_path / "p.csv", RIG)
    assert pose.weights[:2].tolist() == [0.25, -0.15 if "Blink" in text else 0.0]


def test_many_poses_with_semicolons_and_decimal_commas(tmp_path):
    text = 'Zeit;jawOpen;"Lächeln, breit"\n0,04;0,25;1\n0,08;0,5;0,125\n'
    (tmp_path / "p.csv").write_bytes(text.encode("utf-8-sig"))
    weights, unknown, without = read_pose_table(tmp_path / "p.csv", RIG)
    assert weights.tolist() == [[0.25, 0, 1], [0.5, 0, 0.125]]
    assert (unknown, without) == (["Zeit"], [])


def test_decimal_commas_between_commas_are_refused_with_the_line(tmp_path):
    (tmp_path / "p.csv").write_text("shape,weight\njawOpen,0,25\n")
    with pytest.raises(FacepinError, match=r"^p\.csv:2: found 'jawOpen,0,25'"):
        read_pose(tmp_path / "p.csv", RIG)
