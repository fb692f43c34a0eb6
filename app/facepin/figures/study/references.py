"""Reference poses that people made, for the simulated animator to follow instead of poses drawn by chance."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from facepin.core.arrays import Floats
from facepin.core.errors import FacepinError
from facepin.core.names import clean_name, listed
from facepin.core.rig import Rig
from facepin.core.shapes import measures
from facepin.core.sorting import natural_key
from facepin.files.work.pose_file import READERS, read_weights
from facepin.files.work.pose_table import read_pose_table
from facepin.files.work.shape_spelling import match_shapes


@dataclass(frozen=True, eq=False)
class References:
    """Poses to be followed."""

    name: str
    """Of the file or folder."""
    poses: tuple[Floats, ...]
    """Weights (k,) each, one or more."""
    remarks: tuple[str, ...] = ()
    """What was left out, one line each."""


def read_references(path: Path, rig: Rig, most: int) -> References:
    """Read poses onto a rig; of more than `most`, evenly chosen ones.

    Parameters
    ----------
    path : Path
        A folder of pose files, a pose file, or a table of poses (see `pose_table`).

    Raises
    ------
    FacepinError
        When nothing there is a pose that moves this rig.
    """
    if not path.exists():
        raise FacepinError(f"{path}: no such file or folder")
    name = clean_name(path.resolve().name) or str(path)
    if path.is_dir():
        files = [file for file in path.iterdir() if file.suffix.lower() in READERS]
        files.sort(key=lambda file: natural_key(file.name))
        if not files:
            raise FacepinError(f"{path}: there are no poses in this folder ({', '.join(READERS)})")
        poses, remarks = _of_files(files, rig, name)
    elif path.suffix.lower() == ".csv" and not _is_pose(path, rig):
        table, unknown, without = read_pose_table(path, rig)
        poses, remarks = list(table), _unmatched(unknown, name, rig)
        if without:
            lines = listed([str(line) for line in without])
            remarks.append(f"{name}: left out, for a weight is missing there: line {lines}")
    else:
        poses, remarks = _of_files([path], rig, name)
    chosen = np.linspace(0, len(poses) - 1, min(most, len(poses))).round().astype(int).tolist()
    moving = [poses[at] for at in chosen if not _rests(rig, poses[at])]
    if not moving:
        raise FacepinError(f"{name}: there is no pose in it that moves {rig.name}")
    if len(moving) < len(chosen):
        remarks.append(f"{name}: left out, for they do not move this face: {len(chosen) - len(moving)} poses")
    return References(name, tuple(moving), tuple(remarks))


def _of_files(files: Sequence[Path], rig: Rig, name: str) -> tuple[list[Floats], list[str]]:
    """Read pose files; one that is none of many is left out, a single one is refused."""
    poses: list[Floats] = []
    remarks: list[str] = []
    unknown: dict[str, None] = {}
    for file in files:
        try:
            weights = read_weights(file, rig)
        except FacepinError as error:
            if len(files) == 1:
                raise
            remarks.append(f"left out: {error}")
            continue
        pose = np.zeros(rig.shape_count)
        for shape, place in zip(weights, match_shapes(list(weights), rig.shape_names), strict=True):
            if place is not None:
                pose[place] = weights[shape]
            elif weights[shape]:
                unknown[shape] = None
        poses.append(pose)
    return poses, [*_unmatched(list(unknown), name, rig), *remarks]


def _is_pose(path: Path, rig: Rig) -> bool:
    """Say whether a .csv holds a single pose: a shape and its weight in each row."""
    try:
        read_weights(path, rig)
    except FacepinError:
        return False
    return True


def _unmatched(names: list[str], where: str, rig: Rig) -> list[str]:
    return [f"{where}: not in {rig.name}: {listed(names)}"] if names else []


def _rests(rig: Rig, pose: Floats) -> bool:
    return bool(measures.resting(rig.evaluate(pose), rig.neutral, rig.height).all())
