"""From the open work to a scene, and back onto a rig: the same one, or one that changed meanwhile."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any, get_args, get_type_hints

import numpy as np

from facepin.core.arrays import Floats, frozen
from facepin.core.control import Flags, ShapeControl
from facepin.core.errors import FacepinError
from facepin.core.look.camera import Camera
from facepin.core.names import listed
from facepin.core.pose import FRONT_AXES, Pin, Pose, Vector
from facepin.core.rig import Rig
from facepin.core.rig_builder import LARGEST_WEIGHT
from facepin.core.shapes.mirror import Mirror, find_mirror
from facepin.core.turn import Turn
from facepin.files.safely.checked_json import JsonObject
from facepin.files.work.pins_file import parse_pins, pins_as_json
from facepin.files.work.scene_file import RigReference, Scene, SceneControl, ScenePane, Weights
from facepin.files.work.shape_spelling import match_shapes
from facepin.panels.view import PaneView
from facepin.session.solving.solving import SolverChoice, choose, snapped
from facepin.session.work import MOST_PANES, Pane, Work
from facepin.solvers import SOLVERS
from facepin.solvers.settings import Plain, make_settings, plain_settings


@dataclass(frozen=True)
class RigSource:
    """Where the open rig came from."""

    path: Path
    neutral: str | None = None
    """For a folder of OBJ files: the one with the neutral, where it was named."""
    asset: str = ""
    """For one of the program's own faces: its place among the assets."""


@dataclass(frozen=True, eq=False)
class Snapshot:
    """Everything a scene is made of, at one moment; a thread may take its time over it."""

    rig: Rig
    source: RigSource
    work: Work
    active: int
    cameras: tuple[Camera, ...]
    shown: tuple[Mapping[str, Plain], ...]
    """Of each pane, see `shown_over`."""
    linked: bool
    of: Path | None
    """The scene file that it is work on."""
    sections: Mapping[str, Any]
    """What that file held for other versions of the program."""
    reference_shown: bool = False
    digest: str = ""
    """Of that file, see `Scene.digest`."""


@dataclass(frozen=True, eq=False)
class Resumed:
    """A scene on a rig."""

    work: Work
    active: int
    cameras: tuple[Camera | None, ...]
    """None where the face has to be framed anew."""
    views: tuple[PaneView, ...]
    linked: bool
    reference_shown: bool
    report: str
    """What did not fit, in one line; empty if all did."""


def shown_over(view: PaneView) -> dict[str, Plain]:
    """Return what a pane shows over its face as plain values by name."""
    values = {field.name: getattr(view, field.name) for field in fields(view)}
    return {name: value for name, value in values.items() if name != "reach" and isinstance(value, Plain)}


def scene_of(snapshot: Snapshot, *, draft: bool) -> Scene:
    """Return a snapshot as a scene; a draft remembers which file it is work on."""
    rig, source, work = snapshot.rig, snapshot.source, snapshot.work

    def named(weights: Floats) -> Weights:
        return {rig.shape_names[j]: float(weights[j]) for j in np.flatnonzero(weights)}

    def in_scene(pane: Pane, camera: Camera, shown: Mapping[str, Plain]) -> ScenePane:
        return ScenePane(
            pane.choice.kind.key,
            plain_settings(pane.choice.settings),
            pane.choice.keep_limits,
            named(pane.pose.weights),
            named(pane.hand),
            None if pane.began is None else named(pane.began.weights),
            camera,
            shown,
        )

    return Scene(
        RigReference(
            rig.name,
            None if source.asset else source.path.absolute(),
            source.neutral,
            asset=source.asset,
            vertices=rig.vertex_count,
            shapes=rig.shape_names,
            fingerprint=rig.fingerprint,
            turn=rig.turn,
        ),
        tuple(map(in_scene, work.panes, snapshot.cameras, snapshot.shown)),
        _pins_of(work.panes[0].pose.pins),
        _control_of(work.control, rig),
        None if work.mirror is None else _twins_of(work.mirror, rig),
        None if work.reference is None else named(work.reference),
        snapshot.active,
        snapshot.linked,
        snapshot.reference_shown,
        snapshot.of if draft else None,
        snapshot.sections,
        snapshot.digest if draft else "",
    )


def turned_scene(snapshot: Snapshot, turn: Turn) -> Scene:
    """Return a snapshot as a scene whose face is turned; its pins go along, its cameras look anew."""

    def place(vector: Vector) -> Vector:
        x, y, z = (float(vector[abs(axis) - 1]) * (1 if axis > 0 else -1) for axis in turn)
        return x, y, z

    def along(pose: Pose) -> Pose:
        pins = (
            replace(pin, goal=place(pin.goal), axes=(place(pin.axes[0]), place(pin.axes[1])))
            for pin in pose.pins
        )
        return pose.with_pins(tuple(pins))

    work = snapshot.work
    panes = tuple(replace(pane, pose=along(pane.pose)) for pane in work.panes)
    turned = replace(snapshot, rig=snapshot.rig.turned(turn), work=replace(work, panes=panes))
    scene = scene_of(turned, draft=True)
    return replace(scene, panes=tuple(replace(pane, camera=None) for pane in scene.panes))


def resume(scene: Scene, rig: Rig) -> Resumed:
    """Put a scene on a rig: weights by the names of shapes, pins by the numbers of vertices.

    Raises
    ------
    FacepinError
        When its pins are none, or there are more panes than fit.
    """
    if len(scene.panes) > MOST_PANES:
        raise FacepinError(f"the scene has {len(scene.panes)} panes, {MOST_PANES} fit")
    same = scene.rig.fingerprint == rig.fingerprint
    report = [] if same else [f"{rig.name} is not as it was when the scene was saved"]
    weights = _Placing(scene.rig, rig)
    control = weights.control(scene.control)
    known = [pin for pin in scene.pins if not _beyond(pin, rig)]
    pins = parse_pins(JsonObject({"pins": known}, "the scene:"), rig)
    if beyond := len(scene.pins) - len(known):
        report.append(f"{beyond} of {len(scene.pins)} pins are left out: their vertices are gone")
    panes = []
    for number, saved in enumerate(scene.panes):
        choice, remark = _choice(saved)
        pose = Pose(weights.place(saved.weights), pins)
        hand = pose.weights if saved.hand == saved.weights else weights.place(saved.hand)
        began = None if saved.began is None else Pose(weights.place(saved.began), pins)
        if not same and number == scene.active:
            pins = snapped(rig, pose, control).pins  # the goals were where another face's vertices came
        panes.append(Pane(choice, pose, hand, began, number=number))
        report += remark
    shared = tuple(
        Pane(pane.choice, pane.pose.with_pins(pins), pane.hand, pane.began, number=pane.number)
        for pane in panes
    )
    reference = None if scene.reference is None else weights.place(scene.reference)
    return Resumed(
        Work(shared, control, None if scene.twins is None else weights.mirror(scene.twins), reference),
        scene.active,
        tuple(pane.camera if same else None for pane in scene.panes),
        tuple(_view(pane.shown) for pane in scene.panes),
        scene.linked,
        scene.reference_shown,
        "; ".join(report + weights.report()),
    )


class _Placing:
    """Finds the shapes of a rig by the names that a scene has for them."""

    def __init__(self, saved: RigReference, rig: Rig) -> None:
        self._rig = rig
        self._places: dict[str, int | None] = dict(
            zip(saved.shapes, match_shapes(saved.shapes, rig.shape_names), strict=True)
        )
        self._missing: dict[str, None] = {}
        self._wild: dict[str, None] = {}

    def place(self, weights: Weights) -> Floats:
        """Return the weights (k,) of the rig, read-only."""
        values = np.zeros(self._rig.shape_count)
        for name, weight in weights.items():
            at = self._find(name)
            if at is None:
                continue
            if abs(weight) > LARGEST_WEIGHT:
                self._wild[name] = None
            values[at] = min(max(weight, -LARGEST_WEIGHT), LARGEST_WEIGHT)
        return frozen(values, np.float64)

    def control(self, saved: SceneControl) -> ShapeControl:
        """Return what holds for the shapes of the rig."""
        control = ShapeControl.of(self._rig)
        limits = control.limits.copy()
        for name, allowed in saved.limits.items():
            if (at := self._find(name)) is not None:
                limits[at] = np.clip(allowed, -LARGEST_WEIGHT, LARGEST_WEIGHT)

        def flags(names: Sequence[str]) -> Flags:
            found = np.zeros(self._rig.shape_count, np.bool_)
            found[[at for name in names if (at := self._find(name)) is not None]] = True
            return found

        locked, muted, solo = flags(saved.locked), flags(saved.muted), flags(saved.solo)
        return replace(control, limits=limits, locked=locked, muted=muted, solo=solo)

    def mirror(self, pairs: Sequence[tuple[str, str]]) -> Mirror:
        """Return who is whose twin on the rig: shapes as in `pairs`, vertices as they are found."""
        twins = np.full(self._rig.shape_count, -1, np.int32)
        for pair in pairs:
            one, other = map(self._find, pair)
            if one is not None and other is not None and twins[one] == twins[other] == -1:
                twins[one], twins[other] = other, one
        return replace(find_mirror(self._rig), shapes=frozen(twins, np.int32))

    def _find(self, name: str) -> int | None:
        if name not in self._places:
            (self._places[name],) = match_shapes([name], self._rig.shape_names)
        at = self._places[name]
        if at is None:
            self._missing[name] = None
        return at

    def report(self) -> list[str]:
        """Return what could not be placed as it was, a line each."""
        lines = []
        if self._missing:
            lines.append(f"without these shapes, which the rig no longer has: {listed(list(self._missing))}")
        if self._wild:
            lines.append(f"weights beyond {LARGEST_WEIGHT:.0e} are cut down: {listed(list(self._wild))}")
        return lines


def _pins_of(pins: Sequence[Pin]) -> tuple[Mapping[str, Any], ...]:
    """Return pins as in a pins file, and the axes of all: a pin in space may be held on screen again."""
    entries = pins_as_json(tuple(pins))
    for entry, pin in zip(entries, pins, strict=True):
        if pin.axes != FRONT_AXES:
            entry["axes"] = [list(axis) for axis in pin.axes]
    return tuple(entries)


def _control_of(control: ShapeControl, rig: Rig) -> SceneControl:
    """Return by name what holds for the shapes."""

    def named(flags: Flags) -> tuple[str, ...]:
        return tuple(rig.shape_names[j] for j in np.flatnonzero(flags))

    changed = np.flatnonzero((control.limits != rig.limits).any(axis=1)).tolist()
    limits = {rig.shape_names[j]: (float(control.limits[j, 0]), float(control.limits[j, 1])) for j in changed}
    return SceneControl(limits, named(control.locked), named(control.muted), named(control.solo))


def _twins_of(mirror: Mirror, rig: Rig) -> tuple[tuple[str, str], ...]:
    """Return by name who is whose twin, each pair once."""
    pairs = [(j, int(twin)) for j, twin in enumerate(mirror.shapes) if twin >= j]
    return tuple((rig.shape_names[one], rig.shape_names[other]) for one, other in pairs)


def _beyond(pin: Mapping[str, Any], rig: Rig) -> bool:
    """Say whether a pin sits on a vertex that the rig does not have (nonsense is left to `parse_pins`)."""
    vertex = pin.get("vertex")
    return isinstance(vertex, int) and vertex >= rig.vertex_count


def _choice(pane: ScenePane) -> tuple[SolverChoice, Sequence[str]]:
    """Return a pane's solver, or the one that comes nearest with a remark."""
    if pane.solver not in SOLVERS:
        other = choose("transpose", keep_limits=pane.keep_limits)
        return other, [f"there is no solver '{pane.solver[:40]}', {other.kind.title} stands in for it"]
    try:
        settings = make_settings(SOLVERS[pane.solver], pane.settings)
    except ValueError as error:
        return choose(pane.solver, keep_limits=pane.keep_limits), [f"{error}: its defaults are used"]
    return choose(pane.solver, settings, pane.keep_limits), []


def _view(shown: Mapping[str, Plain]) -> PaneView:
    """Return what a pane shows; a value that makes no sense is left out."""
    view, kinds = PaneView(), get_type_hints(PaneView)
    for name, usual in shown_over(view).items():
        value, allowed = shown.get(name, usual), get_args(kinds[name])
        if value in allowed if allowed else type(value) is type(usual):
            setattr(view, name, value)
    return view
