"""Many poses in one .csv: shapes' names in the first row, then a row of weights for each pose."""

from pathlib import Path

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.errors import FacepinError
from facepin.core.names import clean_name
from facepin.core.rig import Rig
from facepin.core.rig_builder import LARGEST_WEIGHT
from facepin.files.work.shape_spelling import match_shapes
from facepin.files.work.spreadsheet import read_number, read_rows


def read_pose_table(path: Path, rig: Rig) -> tuple[Floats, list[str], list[int]]:
    """Read the weights of a table onto `rig`; shapes are found by name in any spelling.

    Returns
    -------
    weights : (m, k) float64
        A row for each pose; shapes that the table does not name are 0.  Taken as they are, also outside
        limits.
    unknown : list of str
        Names of columns that are no shapes of this rig (a time, say): what is in them is not read.
    without : list of int
        Lines that are left out, since a weight is missing there.

    Raises
    ------
    FacepinError
        If the file cannot be read, is no such table, or names no shape of this rig.
    """
    lines = read_rows(path)
    names = [name.strip() for name in lines[0][1]] if lines else []
    for name in names:
        if name and names.count(name) > 1:
            raise FacepinError(f"{path.name}:{lines[0][0]}: {name!a} is there twice, allowed: once")
    places = match_shapes(rig.names_here(names), rig.shape_names)
    used = [(column, place) for column, place in enumerate(places) if place is not None]
    if not used:
        raise FacepinError(
            f"{path.name}: the first row names no shape of {rig.name}, allowed: one or more of its shapes"
        )
    poses, without = [], []
    for number, row in lines[1:]:
        cells = [row[column].strip() if column < len(row) else "" for column, _ in used]
        if not all(cells):
            without.append(number)
            continue
        pose = np.zeros(rig.shape_count)
        for cell, (column, place) in zip(cells, used, strict=True):
            pose[place] = _weight(cell, f"{path.name}:{number}: {names[column]}")
        poses.append(pose)
    unknown = [clean_name(name) for name, place in zip(names, places, strict=True) if place is None]
    return np.array(poses).reshape(-1, rig.shape_count), [name for name in unknown if name], without


def _weight(cell: str, place: str) -> float:
    value = read_number(cell)
    if value is None or not abs(value) <= LARGEST_WEIGHT:
        raise FacepinError(f"{place} is {cell[:60]!a}, allowed: a number up to {LARGEST_WEIGHT:.0e}")
    return value
