"""Scene files: round trips, refusals, and what is kept of a rig that changed."""

import json
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facepin.core.errors import FacepinError
from facepin.core.look.camera import Camera
from facepin.core.pose import Pin
from facepin.core.rig import Rig
from facepin.desk.scenes import RigSource, Snapshot, resume, scene_of, shown_over
from facepin.files.work.scene_file import (
    NewerVersion,
    parse_scene,
    places,
    read_scene,
    scene_bytes,
    write_scene,
)
from facepin.panels.view import PaneView
from facepin.session.edit import Edit
from facepin.session.session import Session
from facepin.session.solving.solving import choose
from facepin.solvers import SOLVERS
from support.small_rigs import sheet

RIG = sheet()


def at(vertex: int, **more: object) -> Pin:
    x, y, z = RIG.neutral[vertex].astype(float).tolist()
    return Pin(vertex, (x + 0.1, y + 0.2, z + 1 / 3), **more)


def worked() -> Session:
    """A session with something of everything."""
    session = Session(RIG, [choose("tikhonov"), choose("hybrid", keep_limits=True)])
    session.apply(Edit("Set", True, weights=np.array([0.25, 1 / 3, 0, -1.5])))
    turned = Camera().orbited(0.3, 0.2).axes[:2]
    axes = tuple(tuple(axis.tolist()) for axis in turned)
    odd = at(41, freedom="screen", stiffness=7.5, axes=axes, name="lip corner", locked=True, hidden=True)
    session.apply(Edit("Drag", True, (at(30, axes=axes), odd), solve=True))
    limits = session.control.limits * [[-0.5, 2.0]] - [[0.125, 0]]
    locked, muted = np.arange(4) == 3, np.arange(4) == 1
    session.set_control("Lock", replace(session.control, limits=limits, locked=locked, muted=muted))
    session.set_mirror("Pair shapes", session.mirror.parted(0).paired(1, 2))
    session.set_reference(np.array([0, 0.7, 0, 0.1]))
    session.active = 1
    return session


def snapshot(session: Session, source: Path = Path("/faces/sheet.npz"), **more: object) -> Snapshot:
    cameras = tuple(Camera().orbited(0.1 * pane.number, 0.2) for pane in session.panes)
    views = tuple(shown_over(PaneView(wireframe=True, ghost="reference")) for _ in session.panes)
    made = Snapshot(
        RIG, RigSource(source), session.committed, session.active, cameras, views, False, None, {}
    )
    return replace(made, **more)


def same_work(one: Session, other: Session) -> None:
    assert len(one.panes) == len(other.panes)
    for a, b in zip(one.panes, other.panes, strict=True):
        assert a.choice == b.choice
        assert a.pose.pins == b.pose.pins
        np.testing.assert_array_equal(a.pose.weights, b.pose.weights)
        np.testing.assert_array_equal(a.hand, b.hand)
        assert (a.began is None) == (b.began is None)
        if a.began is not None:
            np.testing.assert_array_equal(a.began.weights, b.began.weights)


def test_a_scene_comes_back_bit_for_bit(tmp_path: Path) -> None:
    session = worked()
    write_scene(tmp_path / "a.facepin", scene_of(snapshot(session), draft=False))
    found = resume(read_scene(tmp_path / "a.facepin"), RIG)
    assert not found.reference_shown
    shown = scene_of(snapshot(session, reference_shown=True), draft=False)
    assert parse_scene(scene_bytes(shown, None), "s").reference_shown
    again = Session.resumed(RIG, found.work, found.active)
    same_work(session, again)
    np.testing.assert_array_equal(again.work.reference, session.work.reference)
    np.testing.assert_array_equal(again.mirror.shapes, session.mirror.shapes)
    for name in ("limits", "locked", "muted", "solo"):
        np.testing.assert_array_equal(getattr(again.control, name), getattr(session.control, name))
    assert (again.active, found.linked, found.report) == (1, False, "")
    assert found.cameras == snapshot(session).cameras
    assert [(view.wireframe, view.ghost) for view in found.views] == [(True, "reference")] * 2
    # Work goes on as if nothing had been between: the next drags and another solver give the same.
    for one in (session, again):
        one.choose_solver(0, choose("sparse"))
        one.apply(Edit("Drag", True, (at(30), at(60)), solve=True))
    for a, b in zip(session.panes, again.panes, strict=True):
        np.testing.assert_array_equal(a.pose.weights, b.pose.weights)


@pytest.mark.parametrize("key", SOLVERS)
def test_every_solver_with_its_settings_comes_back(key: str) -> None:
    session = Session(RIG, [choose(key)])
    scene = parse_scene(scene_bytes(scene_of(snapshot(session), draft=True), None), "a")
    assert resume(scene, RIG).work.panes[0].choice == choose(key)


def test_the_rig_is_looked_for_beside_the_scene_then_where_it_was(tmp_path: Path) -> None:
    scene_file = tmp_path / "shots/one.facepin"
    scene_file.parent.mkdir()
    write_scene(scene_file, scene_of(snapshot(worked(), tmp_path / "faces/sheet.npz"), draft=False))
    moved = tmp_path.parent / "elsewhere/shots/one.facepin"
    assert list(places(read_scene(scene_file).rig, moved)) == [
        tmp_path.parent / "elsewhere/faces/sheet.npz",
        tmp_path / "faces/sheet.npz",
        tmp_path.parent / "elsewhere/shots/sheet.npz",
    ]
    assert json.loads(scene_file.read_text())["rig"]["relative"] == "../faces/sheet.npz"


def test_odd_paths_and_names_survive(tmp_path: Path) -> None:
    odd = Path(os.fsdecode(b"/f\xff/\xe2\x82\xac \xf0\x9f\x98\x80.npz"))
    scene = parse_scene(scene_bytes(scene_of(snapshot(worked(), odd), draft=False), tmp_path), "a")
    assert scene.rig.path == odd


def test_what_other_versions_keep_there_is_kept() -> None:
    document = json.loads(scene_bytes(scene_of(snapshot(worked()), draft=True), None))
    document["timeline"] = {"keys": [1, 2.5, "x"]}
    scene = parse_scene(json.dumps(document).encode(), "a")
    assert json.loads(scene_bytes(scene, None))["timeline"] == {"keys": [1, 2.5, "x"]}


def test_a_newer_version_and_another_format_are_refused_in_one_line() -> None:
    document = json.loads(scene_bytes(scene_of(snapshot(worked()), draft=True), None))
    newer = json.dumps({**document, "version": 2, "panes": "of another kind"}).encode()
    with pytest.raises(NewerVersion, match=r"^a: a newer Facepin wrote this scene"):
        parse_scene(newer, "a")
    with pytest.raises(FacepinError, match=r'format is .facepin-pose., allowed: "facepin-scene"'):
        parse_scene(json.dumps({**document, "format": "facepin-pose"}).encode(), "a")
    with pytest.raises(FacepinError, match=r"a\.json: scenes are files that end in \.facepin"):
        write_scene(Path("a.json"), scene_of(snapshot(worked()), draft=False))


def changed(names: tuple[str, ...] = ("shape0", "Shape2", "new"), rows: int = 6) -> Rig:
    """The sheet with other shapes and fewer vertices."""
    other = sheet(rows=rows, shapes=len(names), seed=3)
    return replace(other, shape_names=names)


def test_a_rig_that_changed_takes_what_fits_by_name_and_says_what_does_not() -> None:
    session = worked()
    session.apply(Edit("Drag", True, (at(30), at(80)), solve=True))
    session.apply(Edit("Set", True, (at(30), at(80)), weights=np.array([0.25, 0.5, 0.75, 0])))
    rig = changed()
    found = resume(parse_scene(scene_bytes(scene_of(snapshot(session), draft=True), None), "a"), rig)
    pose = found.work.panes[1].pose
    np.testing.assert_array_equal(pose.weights, [0.25, 0.75, 0])
    assert "sheet is not as it was" in found.report
    assert "1 of 2 pins are left out" in found.report
    assert "without these shapes, which the rig no longer has: shape1" in found.report
    # The goal is where the vertex is on this face, so that the next drag has nothing to catch up on.
    (pin,) = pose.pins
    assert pin.vertex == 30
    np.testing.assert_allclose(pin.goal, rig.evaluate(pose.weights)[30], atol=1e-6)
    assert found.cameras == (None, None)
    assert "\n" not in found.report


def test_a_solver_that_is_gone_and_settings_that_make_no_sense_are_replaced_and_said() -> None:
    scene = scene_of(snapshot(worked()), draft=True)
    gone, wild = (replace(pane, solver="gone") for pane in scene.panes)
    wild = replace(scene.panes[0], settings={"alpha": -3.0})
    found = resume(replace(scene, panes=(gone, wild)), RIG)
    assert [pane.choice.kind.key for pane in found.work.panes] == ["transpose", "tikhonov"]
    assert "no solver 'gone'" in found.report
    assert "alpha" in found.report


def test_weights_beyond_all_sense_are_cut_down_and_said() -> None:
    scene = scene_of(snapshot(worked()), draft=True)
    pane = replace(scene.panes[0], weights={"shape0": 1e200})
    found = resume(replace(scene, panes=(pane,), active=0), RIG)
    assert found.work.panes[0].pose.weights[0] == 1e6
    assert "shape0" in found.report


def test_what_a_pane_shows_is_taken_where_it_makes_sense() -> None:
    scene = scene_of(snapshot(worked()), draft=True)
    odd = {"wireframe": True, "ghost": "of Hamlet's father", "reach": True, "gone": 1.0}
    found = resume(replace(scene, panes=tuple(replace(pane, shown=odd) for pane in scene.panes)), RIG)
    assert [view.key for view in found.views] == [replace(PaneView(), wireframe=True).key] * 2


def test_the_fingerprint_is_of_the_geometry_alone() -> None:
    assert replace(RIG, name="other", source=Path("x"), limits=RIG.limits * 2).fingerprint == RIG.fingerprint
    moved = RIG.neutral.copy()
    moved[3, 1] += 1e-3
    assert replace(RIG, neutral=moved).fingerprint != RIG.fingerprint
    assert replace(RIG, deltas=RIG.deltas * 1.001).fingerprint != RIG.fingerprint


def test_a_torn_file_is_refused_wherever_it_is_torn() -> None:
    whole = scene_bytes(scene_of(snapshot(worked()), draft=True), None).rstrip()
    for end in range(0, len(whole) - 1, 7):
        with pytest.raises(FacepinError) as refused:
            parse_scene(whole[:end], "a.facepin")
        assert "a.facepin" in str(refused.value)


def test_odd_json_is_refused_in_one_line_or_makes_a_scene_that_resumes() -> None:
    """Every value of a real scene is replaced by every kind of nonsense."""
    whole = json.loads(scene_bytes(scene_of(snapshot(worked()), draft=True), None))
    odd = (None, True, -1, 1e308, 10**400, "", "\0", [], {}, [None], {"": []}, [[1, 2], 3], "x" * 100_000)
    spots = list(_spots(whole))
    assert len(spots) > 100
    refused = 0
    for path in spots:
        for value in odd:
            try:
                found = resume(parse_scene(json.dumps(_with(whole, path, value)).encode(), "a"), RIG)
                assert all(np.isfinite(pane.pose.weights).all() for pane in found.work.panes)
                assert "\n" not in found.report
            except FacepinError as error:
                refused += 1
                assert "\n" not in str(error)
    assert refused > len(spots)


@pytest.mark.parametrize(
    "text",
    [
        b"",
        b"\xff\xfe",
        b"[]",
        b"null",
        b"NaN",
        b"[" * 100_000,
        b'{"a":' * 100_000,
        b'{"version": 1e999}',
        b"{}",
    ],
)
def test_what_is_no_scene_is_refused(text: bytes) -> None:
    with pytest.raises(FacepinError):
        parse_scene(text, "a")


def test_a_section_that_could_not_be_written_again_is_refused() -> None:
    whole = scene_bytes(scene_of(snapshot(worked()), draft=True), None).rstrip()
    with pytest.raises(FacepinError, match="more can't be kept"):
        parse_scene(whole[:-1] + b', "more": [1e999]}', "a")


def _spots(value: object, path: tuple[object, ...] = ()) -> object:
    """Yield the path of every value inside a JSON document; of a long list, the first few."""
    if path:
        yield path
    inside = (
        value.items() if isinstance(value, dict) else enumerate(value[:3]) if isinstance(value, list) else ()
    )
    for key, inner in inside:
        yield from _spots(inner, (*path, key))


def _with(value: object, path: tuple[object, ...], new: object) -> object:
    """Return a document with the value at `path` replaced."""
    if not path:
        return new
    copy = dict(value) if isinstance(value, dict) else list(value)
    copy[path[0]] = _with(copy[path[0]], path[1:], new)
    return copy
