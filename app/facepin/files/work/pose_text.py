"""Poses as text, for the clipboard: what a pose file holds, whole or of some shapes alone."""

import json
from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.control import Flags
from facepin.core.names import listed
from facepin.core.pose import Pose
from facepin.core.rig import Rig
from facepin.files.safely.checked_json import parse_json
from facepin.files.work.pose_file import pose_document, weights_of_document
from facepin.files.work.shape_spelling import match_shapes

SOURCE = "the clipboard"
PART = "part"
"""Names what the weights are of, where they are not of a whole pose."""


@dataclass(frozen=True, eq=False)
class PastedPose:
    """A pose, or a part of one, found in a rig by the names of its shapes."""

    weights: Floats
    """(k,); 0 for what is not named."""
    named: Flags
    """(k,) which shapes it says something of: all, for a whole pose."""
    report: str
    """What did not match, in one line; empty if all did."""


def pose_text(rig: Rig, pose: Pose) -> str:
    """Return a whole pose as text; it may be kept as a pose file.

    Raises
    ------
    FacepinError
        For a weight that could not be read again.
    """
    return json.dumps(pose_document(rig, pose), indent=1, ensure_ascii=False, allow_nan=False)


def part_text(rig: Rig, pose: Pose, shapes: Collection[int], part: str) -> str:
    """Return the weights of some shapes as text; `part` says what they are of.

    Raises
    ------
    FacepinError
        For a weight that could not be read again.
    """
    document = pose_document(rig, Pose(pose.weights))
    names = {rig.shape_names[j] for j in shapes}
    weights = {name: weight for name, weight in document["weights"].items() if name in names}
    whole = {**document, PART: part, "weights": weights}
    return json.dumps(whole, indent=1, ensure_ascii=False, allow_nan=False)


def pasted(text: str, rig: Rig) -> PastedPose:
    """Find the shapes of a text in a rig; names in any spelling are found, see `shape_spelling`.

    Raises
    ------
    FacepinError
        If it is no pose, or of a newer version.
    """
    document = parse_json(text.encode("utf-8", "replace"), SOURCE)
    found = weights_of_document(document)
    values, named = np.zeros(rig.shape_count), np.zeros(rig.shape_count, np.bool_)
    unknown = []
    for (name, weight), place in zip(found.items(), match_shapes(list(found), rig.shape_names), strict=True):
        if place is None:
            unknown.append(name)
        else:
            values[place], named[place] = weight, True
    report = []
    if unknown:
        report.append(f"{len(unknown)} of {len(found)} shapes are not in this rig: {listed(unknown)}")
    if PART not in document:
        if missing := int(np.count_nonzero(~named)):
            report.append(f"{missing} shapes of this rig are not in it and become 0")
        named[:] = True
    return PastedPose(values, named, "; ".join(report))
