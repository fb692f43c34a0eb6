"""Poses as .json (weights and pins) and .csv (weights alone), and how a pose comes to another rig."""

import csv
import json
from collections.abc import Callable
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np

from facepin.core.arrays import frozen
from facepin.core.errors import FacepinError
from facepin.core.names import listed
from facepin.core.pose import Pin, Pose
from facepin.core.rig import Rig
from facepin.core.rig_builder import LARGEST_WEIGHT
from facepin.files.safely.atomic import atomic_write
from facepin.files.safely.checked_json import JsonObject, parse_json
from facepin.files.safely.reading import read_bytes
from facepin.files.work.pins_file import parse_pins, pins_as_json
from facepin.files.work.shape_spelling import match_shapes
from facepin.files.work.spreadsheet import read_number, read_rows

FORMAT, VERSION = "facepin-pose", 1


def read_pose(path: Path, rig: Rig) -> tuple[Pose, str]:
    """Read a pose onto `rig`; shapes are found by name in any spelling (see `shape_spelling`).

    Returns
    -------
    pose : Pose
        Shapes that the file does not name are 0.  Weights are taken as they are, also outside limits.
    report : str
        What did not match, in one line; empty if all did.

    Raises
    ------
    FacepinError
        If the file cannot be read, is not a pose, or is of a newer version.
    """
    return _on_rig(rig, *_reader_for(path)(path, rig))


def read_weights(path: Path, rig: Rig) -> dict[str, float]:
    """Read the weights of a pose by the names that its file has for shapes, whether `rig` knows them or not.

    Raises
    ------
    FacepinError
        As `read_pose`.
    """
    return _reader_for(path)(path, rig)[0]


def pose_of_document(document: JsonObject, rig: Rig) -> tuple[Pose, str]:
    """Return the pose in a document on `rig`, as `read_pose` does.

    Raises
    ------
    FacepinError
        If it is not a pose, or is of a newer version.
    """
    return _on_rig(rig, *_content(document, rig))


def weights_of_document(document: JsonObject) -> dict[str, float]:
    """Return the weights in a document by the names that it has for shapes.

    Raises
    ------
    FacepinError
        If it is not a pose, or is of a newer version.
    """
    if document.text("format", FORMAT) != FORMAT:
        document.refuse("format", f'"{FORMAT}"')
    if document.integer("version", VERSION, low=1) > VERSION:
        document.refuse("version", f"{VERSION}, a newer Facepin wrote this")
    if "weights" not in document:
        document.refuse("weights", "an object of shape names and numbers")
    entries = document.child("weights")
    return {name: entries.number(name, low=-LARGEST_WEIGHT, high=LARGEST_WEIGHT) for name in entries.values}


def _on_rig(
    rig: Rig, weights: dict[str, float], pins: tuple[Pin, ...], report: list[str]
) -> tuple[Pose, str]:
    """Find the shapes of a file in a rig; add to the report what is in one of them only."""
    values = np.zeros(rig.shape_count)
    unknown = []
    for (name, weight), place in zip(
        weights.items(), match_shapes(rig.names_here(list(weights)), rig.shape_names), strict=True
    ):
        if place is None:
            unknown.append(name)
        else:
            values[place] = weight
    missing = rig.shape_count - len(weights) + len(unknown)
    if unknown:
        report.append(f"{len(unknown)} of {len(weights)} shapes are not in this rig: {listed(unknown)}")
    if missing:
        report.append(f"{missing} shapes of this rig are not in the file and stay 0")
    return Pose(frozen(values, np.float64), pins), "; ".join(report)


def write_pose(path: Path, rig: Rig, pose: Pose) -> None:
    """Write a pose in the format of the suffix, .json or .csv.

    Raises
    ------
    FacepinError
        For another suffix, or if it cannot be written.
    """
    check_suffix(path)
    if path.suffix.lower() == ".csv":
        table = StringIO()
        rows = [("shape", "weight"), *pose_document(rig, pose)["weights"].items()]
        csv.writer(table, lineterminator="\n").writerows(rows)
        atomic_write(path, table.getvalue().encode())
        return
    text = json.dumps(pose_document(rig, pose), indent=1, ensure_ascii=False, allow_nan=False)
    atomic_write(path, f"{text}\n".encode())


def check_suffix(path: Path) -> None:
    """Refuse a path that is none of a pose file.

    Raises
    ------
    FacepinError
        Naming the suffixes that there are.
    """
    if path.suffix.lower() not in READERS:
        raise _unknown_suffix(path)


def pose_document(rig: Rig, pose: Pose) -> dict[str, Any]:
    """Return what a pose file holds.

    Raises
    ------
    FacepinError
        For a weight that could not be read again.
    """
    for name, weight in _by_name(rig, pose).items():
        if abs(weight) > LARGEST_WEIGHT:
            raise FacepinError(f"the weight of {name} is {weight:.3g}, files hold up to {LARGEST_WEIGHT:.0e}")
    return {
        "format": FORMAT,
        "version": VERSION,
        "rig": {"name": rig.name, "shapes": rig.shape_count, "vertices": rig.vertex_count},
        "weights": _by_name(rig, pose),
        "pins": pins_as_json(pose.pins),
    }


def _by_name(rig: Rig, pose: Pose) -> dict[str, float]:
    return {name: float(weight) for name, weight in zip(rig.shape_names, pose.weights, strict=True)}


Content = tuple[dict[str, float], tuple[Pin, ...], list[str]]


def _read_json(path: Path, rig: Rig) -> Content:
    return _content(parse_json(read_bytes(path), path.name), rig)


def _content(document: JsonObject, rig: Rig) -> Content:
    weights = weights_of_document(document)
    vertices = document.child("rig").integer("vertices", rig.vertex_count)
    if vertices != rig.vertex_count and "pins" in document:
        return weights, (), [f"its pins are left out: they are for a mesh of {vertices} vertices"]
    return weights, parse_pins(document, rig), []


def _read_csv(path: Path, rig: Rig) -> Content:
    weights: dict[str, float] = {}
    for at, (number, row) in enumerate(read_rows(path)):
        if at == 0 and row[-1].strip().lower() == "weight":
            continue
        weight = _number(row[1]) if len(row) == 2 else None
        if weight is None:
            found = ",".join(row)[:60]
            raise FacepinError(
                f"{path.name}:{number}: found {found!a}, allowed: a shape's name, a comma, "
                f"a number up to {LARGEST_WEIGHT:.0e}"
            )
        if row[0] in weights:
            raise FacepinError(f"{path.name}:{number}: {row[0]!a} is there twice, allowed: once")
        weights[row[0]] = weight
    if not weights:
        raise FacepinError(
            f"{path.name}: no weights, allowed: one or more lines with a shape's name, a number"
        )
    return weights, (), []


def _number(text: str) -> float | None:
    value = read_number(text)
    return value if value is not None and abs(value) <= LARGEST_WEIGHT else None


READERS: dict[str, Callable[[Path, Rig], Content]] = {".json": _read_json, ".csv": _read_csv}


def _reader_for(path: Path) -> Callable[[Path, Rig], Content]:
    if path.suffix.lower() not in READERS:
        raise _unknown_suffix(path)
    return READERS[path.suffix.lower()]


def _unknown_suffix(path: Path) -> FacepinError:
    found = path.suffix or "files without a suffix"
    return FacepinError(f"{path.name}: no poses in {found!r}, there are: {', '.join(READERS)}")
