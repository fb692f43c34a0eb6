"""A library of poses on the disk: what is read, written, refused, and where it is."""

import json
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facepin.core.arrays import frozen
from facepin.core.errors import FacepinError
from facepin.core.pose import Pin, Pose
from facepin.core.rig import Rig
from facepin.core.saved_pose import SavedPose
from facepin.desk.library import Library, library_of
from facepin.files.work.pose_file import read_pose, write_pose
from facepin.files.work.pose_library import free_key, library_folder, pose_files, replaced, saved_poses
from facepin.files.work.thumbnails import mark_of, read_thumbnail, write_thumbnail
from facepin.session.session import Session
from facepin.session.shelf import moved
from facepin.session.solving.solving import choose
from support.small_rigs import sheet

RIG = sheet()
POSE = Pose(frozen([0.1, -0.5, 0.0, 1.75], np.float64), (Pin(3, (0.5, 0.25, 1.0)),))


def library(folder: Path | None, rig: Rig = RIG) -> tuple[Session, Library]:
    session = Session(rig, [choose("transpose")])
    shelf = Library(session, folder, "nowhere")
    shelf.read_all()
    return session, shelf


def titles(shelf: Library) -> list[str]:
    return [pose.title for pose in shelf.poses]


def test_a_saved_pose_is_an_ordinary_pose_file_and_comes_back(tmp_path: Path) -> None:
    folder = tmp_path / "rig.poses"
    _, shelf = library(folder)
    shelf.save(POSE, "Big smile", ("happy", "mouth"))
    pose, report = read_pose(folder / "Big smile.json", RIG)
    assert report == ""
    assert pose.pins == POSE.pins
    np.testing.assert_array_equal(pose.weights, POSE.weights)
    _, again = library(folder)
    (saved,) = again.poses
    assert (saved.key, saved.title, saved.tags, saved.order) == (
        "Big smile",
        "Big smile",
        ("happy", "mouth"),
        1,
    )
    np.testing.assert_array_equal(saved.weights, POSE.weights)


def test_pose_files_from_elsewhere_are_in_the_library_and_keep_what_they_say(tmp_path: Path) -> None:
    write_pose(tmp_path / "plain.json", RIG, POSE)
    document = json.loads((tmp_path / "plain.json").read_text()) | {"title": "Odd", "note": {"by": "me"}}
    (tmp_path / "odd.json").write_text(json.dumps(document))
    session, shelf = library(tmp_path)
    assert titles(shelf) == ["Odd", "plain"]
    session.arrange("Rename Odd", {"odd": _titled(shelf.pose("odd"), "Even")})
    shelf.follow()
    written = json.loads((tmp_path / "odd.json").read_text())
    assert written["title"] == "Even"
    assert written["note"] == {"by": "me"}
    assert written["pins"] == document["pins"]


@pytest.mark.parametrize("note", ['"\\ud800"', "1e999"])
def test_what_cannot_be_written_again_is_told_and_stays(tmp_path: Path, note: str) -> None:
    text = f'{{"weights": {{"shape0": 0.5}}, "note": {note}}}'
    (tmp_path / "odd.json").write_text(text)
    session, shelf = library(tmp_path)
    session.arrange("Rename", {"odd": _titled(shelf.pose("odd"), "Even")})
    with pytest.raises(FacepinError, match=r"odd\.json: a field"):
        shelf.follow()
    assert (tmp_path / "odd.json").read_text() == text


def _titled(pose: SavedPose, title: str) -> SavedPose:
    return SavedPose(pose.key, title, pose.tags, pose.order, pose.weights, pose.report, pose.document)


def test_files_follow_undo_and_redo(tmp_path: Path) -> None:
    session, shelf = library(tmp_path)
    for title in ("one", "two", "three"):
        shelf.save(POSE, title, ())
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    session.arrange("Rename one", {"one": _titled(shelf.pose("one"), "first")})
    session.arrange("Remove two", {"two": None})
    shelf.follow()
    assert titles(shelf) == ["first", "three"]
    assert titles(library(tmp_path)[1]) == ["first", "three"]
    session.undo()
    shelf.follow()
    assert titles(library(tmp_path)[1]) == ["first", "two", "three"]
    session.undo()
    shelf.follow()
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before
    session.redo()
    session.redo()
    shelf.follow()
    assert titles(library(tmp_path)[1]) == ["first", "three"]


def test_undo_never_takes_a_saved_pose_from_the_disk(tmp_path: Path) -> None:
    session, shelf = library(tmp_path)
    shelf.save(POSE, "one", ())
    session.arrange("Rename one", {"one": _titled(shelf.pose("one"), "first")})
    shelf.save(POSE, "two", ())
    while session.undo():
        shelf.follow()
    assert titles(library(tmp_path)[1]) == ["one", "two"]
    assert titles(shelf) == ["one", "two"]


@pytest.mark.parametrize("seed", range(20))
def test_undo_of_whatever_was_done_brings_every_file_back(tmp_path: Path, seed: int) -> None:
    random = np.random.default_rng(seed)
    for number in range(5):
        write_pose(tmp_path / f"{number}.json", RIG, Pose(frozen(random.random(4), np.float64)))
    session, shelf = library(tmp_path)

    def content() -> dict[str, bytes]:
        return {path.name: path.read_bytes() for path in tmp_path.iterdir()}

    began, steps = shelf.poses, [content()]
    for _ in range(25):
        if not shelf.poses:
            break
        pose = shelf.poses[random.integers(len(shelf.poses))]
        change: dict[str, SavedPose | None] = {pose.key: None}
        match random.integers(10):
            case 0 | 1:
                pass
            case 2 | 3 | 4:
                before = shelf.poses[random.integers(len(shelf.poses))].key
                change = dict(moved(shelf.poses, pose.key, before))
            case 5 | 6:
                change = {pose.key: replaced(pose, RIG, Pose(frozen(random.random(4), np.float64)))}
            case _:
                change = {pose.key: _titled(pose, f"{random.random()}")}
        session.arrange("Change", change)
        shelf.follow()
        steps.append(content())
        assert titles(library(tmp_path)[1]) == titles(shelf)
    for wanted in reversed(steps[:-1]):
        assert session.undo()
        shelf.follow()
        assert content() == wanted
    assert [pose.key for pose in shelf.poses] == [pose.key for pose in began]
    for _ in steps[1:]:
        assert session.redo()
        shelf.follow()
    assert content() == steps[-1]


def test_poses_that_come_while_it_is_open_are_found_when_it_is_read_again(tmp_path: Path) -> None:
    session, shelf = library(tmp_path)
    shelf.save(POSE, "one", ())
    session.arrange("Rename one", {"one": _titled(shelf.pose("one"), "first")})
    shelf.follow()
    library(tmp_path)[1].save(POSE, "two", ())  # another window
    (tmp_path / "broken.json").write_text("{")
    for _ in range(2):
        shelf.read_again()
        shelf.read_all()
        assert titles(shelf) == ["first", "two"]
        assert len(shelf.complaints) == 1


def test_poses_of_a_read_only_place_are_there_and_changes_go_elsewhere(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = tmp_path / "studio" / "girl.glb"
    source.parent.mkdir()
    source.write_bytes(b"")
    session = Session(replace(RIG, source=source), [choose("transpose")])
    shelf = library_of(session, tmp_path / "settings", own=True)
    for title in ("one", "two"):
        shelf.save(POSE, title, ())
    before = {path.name: path.read_bytes() for path in (tmp_path / "studio/girl.poses").iterdir()}

    monkeypatch.setattr(os, "access", lambda path, mode: "studio" not in str(path))
    session = Session(replace(RIG, source=source), [choose("transpose")])
    shelf = library_of(session, tmp_path / "settings", own=True)
    shelf.read_all()
    assert "read-only" in shelf.remark
    assert titles(shelf) == ["one", "two"]
    shelf.save(POSE, "mine", ())
    session.arrange("Rename one", {"one": _titled(shelf.pose("one"), "first")})
    shelf.follow()
    session.arrange("Remove two", {"two": None})
    with pytest.raises(FacepinError, match="read-only"):
        shelf.follow()
    assert {path.name: path.read_bytes() for path in (tmp_path / "studio/girl.poses").iterdir()} == before
    again = library_of(Session(session.rig, [choose("transpose")]), tmp_path / "settings", own=True)
    again.read_all()
    assert titles(again) == ["first", "two", "mine"]


def test_a_name_of_a_removed_pose_is_not_given_to_another(tmp_path: Path) -> None:
    session, shelf = library(tmp_path)
    shelf.save(POSE, "Smile", ())
    session.arrange("Remove Smile", {"Smile": None})
    shelf.follow()
    assert shelf.save(POSE, "Smile", ()).key == "Smile 2"
    session.undo()
    shelf.follow()
    assert {path.stem for path in tmp_path.iterdir()} == {"Smile", "Smile 2"}


def test_broken_and_foreign_files_are_told_and_left_alone(tmp_path: Path) -> None:
    write_pose(tmp_path / "good.json", RIG, POSE)
    foreign = {
        "cut.json": b'{"format": "facepin-pose", "weights": {"sha',
        "binary.json": bytes(range(256)),
        "other.json": b'{"bones": []}',
        "newer.json": b'{"format": "facepin-pose", "version": 99, "weights": {}}',
        "tags.json": b'{"weights": {}, "tags": "happy"}',
        "order.json": b'{"weights": {}, "order": "first"}',
        "notes.txt": b"not read",
        ".hidden.json": b"not read",
        "good.png": b"no picture",
    }
    for name, content in foreign.items():
        (tmp_path / name).write_bytes(content)
    (tmp_path / "folder.json").mkdir()
    _, shelf = library(tmp_path)
    assert titles(shelf) == ["good"]
    assert len(shelf.complaints) == 7
    assert all("\n" not in line for line in shelf.complaints)
    assert {line.split(":")[0].rpartition("/")[2] for line in shelf.complaints} == {
        *("cut.json", "binary.json", "other.json", "newer.json", "tags.json", "order.json", "folder.json")
    }
    shelf.save(POSE, "cut", ())  # must not replace the broken file: somebody may mend it
    assert (tmp_path / "cut.json").read_bytes() == foreign["cut.json"]
    assert shelf.pose("cut 2").title == "cut"


def test_what_cannot_be_written_is_not_in_the_library_and_a_change_is_kept_in_memory(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    _, shelf = library(tmp_path / "file" / "rig.poses")
    with pytest.raises(FacepinError, match=r"rig\.poses"):
        shelf.save(POSE, "one", ())
    assert shelf.poses == ()
    with pytest.raises(FacepinError, match="nowhere"):
        library(None)[1].save(POSE, "one", ())

    session, shelf = library(tmp_path / "rig.poses")
    shelf.save(POSE, "one", ())
    path = tmp_path / "rig.poses" / "one.json"
    content = path.read_bytes()
    path.unlink()
    path.mkdir()  # whoever runs the tests may write anywhere; but no file where a folder is
    session.arrange("Rename one", {"one": _titled(shelf.pose("one"), "first")})
    with pytest.raises(FacepinError, match=r"one\.json"):
        shelf.follow()
    assert titles(shelf) == ["first"]
    shelf.follow()  # said once
    path.rmdir()
    path.write_bytes(content)
    session.arrange("Rename one", {"one": _titled(shelf.pose("one"), "again")})
    shelf.follow()
    assert titles(library(tmp_path / "rig.poses")[1]) == ["again"]


def test_poses_of_another_rig_come_by_shape_name_with_a_report(tmp_path: Path) -> None:
    names = ["jawOpen", "eyeBlink_L", "browUp", "onlyHere"]
    other = _named(RIG, names)
    _, theirs = library(tmp_path / "theirs.poses", other)
    theirs.save(Pose(frozen([0.4, 0.6, 0.0, 0.9], np.float64), POSE.pins), "Wink", ("eye",))
    theirs.save(Pose(frozen([0.4, 0.0, 0.0, 0.0], np.float64)), "Open", ())
    (tmp_path / "theirs.poses" / "broken.json").write_text("{")
    mine = _named(RIG, ["JawOpen", "x.eyeBlinkLeft", "browUp", "cheek"])
    _, shelf = library(tmp_path / "mine.poses", mine)
    shelf.save(POSE, "Wink", ())
    added, complaints = shelf.take_from(tmp_path / "theirs.poses")
    assert titles(shelf) == ["Wink", "Wink", "Open"]
    assert [pose.key for pose in added] == ["Wink 2", "Open"]
    np.testing.assert_array_equal(added[0].weights, [0.4, 0.6, 0.0, 0.0])
    assert "onlyHere" in added[0].report
    assert len(complaints) == 1
    assert titles(library(tmp_path / "mine.poses", mine)[1]) == ["Wink", "Wink", "Open"]
    with pytest.raises(FacepinError, match="already"):
        shelf.take_from(tmp_path / "mine.poses")


def _named(rig: Rig, names: list[str]) -> Rig:
    return replace(rig, shape_names=tuple(names))


def test_where_a_library_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    settings = tmp_path / "settings"
    face = tmp_path / "rigs" / "Girl v2.glb"
    folder = tmp_path / "rigs" / "ict.objs"
    folder.mkdir(parents=True)
    face.write_bytes(b"")
    assert library_folder("girl", face, settings) == face.with_name("Girl v2.poses")
    assert library_folder("ict", folder, settings) == folder.with_name("ict.objs.poses")
    assert library_folder("ada", None, settings) == settings / "poses" / "ada.poses"
    assert library_folder("ada", None, None) is None
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    place = library_folder("girl", face, settings)
    assert place is not None
    assert place.parent == settings / "poses"
    other = tmp_path / "elsewhere" / "Girl v2.glb"
    assert library_folder("girl", other, settings) != place
    assert library_folder("girl", face, None) is None


@pytest.mark.parametrize(
    ("title", "key"),
    [
        ("Big smile", "Big smile"),
        ("../../etc/passwd", "etc-passwd"),
        ("a/b\\c:d*e?", "a-b-c-d-e"),
        ("...", "pose"),
        ("Con", "Con-pose"),
        ("Ärger 怒り", "Ärger 怒り"),
        ("x" * 200, "x" * 60),
    ],
)
def test_file_names_are_made_for_every_system(title: str, key: str) -> None:
    assert free_key(title, []) == key
    assert free_key(title, [key.upper()]) == f"{key} 2"


def test_a_folder_that_is_not_there_has_no_poses(tmp_path: Path) -> None:
    assert pose_files(tmp_path / "none") == []
    assert list(saved_poses(tmp_path / "none", RIG)) == []


def test_a_thumbnail_is_known_by_what_it_shows(tmp_path: Path) -> None:
    path = tmp_path / "pose.png"
    mark = mark_of(RIG, POSE.weights)
    image = np.random.default_rng(1).integers(0, 255, (8, 8, 4), np.uint8)
    image[..., 3] = 255
    write_thumbnail(path, image, mark)
    found = read_thumbnail(path, mark, 8)
    assert found is not None
    np.testing.assert_array_equal(found, image)
    assert read_thumbnail(path, mark_of(RIG, POSE.weights + 0.1), 8) is None
    assert read_thumbnail(path, mark_of(sheet(shapes=3), POSE.weights), 8) is None
    assert read_thumbnail(path, mark, 16) is None
    assert read_thumbnail(tmp_path / "none.png", mark, 8) is None
    for broken in (b"", b"no picture", path.read_bytes()[:60]):
        (tmp_path / "broken.png").write_bytes(broken)
        assert read_thumbnail(tmp_path / "broken.png", mark, 8) is None
    Image.fromarray(image).save(tmp_path / "foreign.png")
    assert read_thumbnail(tmp_path / "foreign.png", mark, 8) is None


def test_poses_of_numbered_files_stand_as_people_count(tmp_path: Path) -> None:
    for number in (10, 2, 1, 20, 3):
        write_pose(tmp_path / f"pose {number}.json", RIG, POSE)
    assert [path.stem for path in pose_files(tmp_path)] == [f"pose {n}" for n in (1, 2, 3, 10, 20)]
    assert titles(library(tmp_path)[1]) == [f"pose {n}" for n in (1, 2, 3, 10, 20)]
